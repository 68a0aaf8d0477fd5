// SPDX-License-Identifier: Apache-2.0
#include "sim/run/rtl_stream.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "sim/compare/limits.hpp"
#include "sim/system/seconds.hpp"

namespace halfway {
namespace {

// Where no golden model says how many fragments there are: vectors a call, so that its fragments, at most one
// a pixel and vector, stay below this.
constexpr std::size_t c_most_uncompared = std::size_t{1} << 22;
constexpr std::size_t c_most_slice = 64;
constexpr std::size_t c_in_flight = 4;  // vectors that the hardware may hold from calls before

std::size_t slice_of(std::size_t pixels) {
  return std::clamp(c_most_uncompared / pixels, std::size_t{1}, c_most_slice);
}

}  // namespace

void RtlStream::clear() {
  comparator_ = {};
  assembler_.clear();
  count_ = golden_count_ = 0;
  compare_seconds_ = assemble_seconds_ = 0.0;
  fault_.clear();
}

void RtlStream::add_golden(std::span<const Fragment> fragments) {
  const Clock::time_point start = Clock::now();
  golden_count_ += fragments.size();
  comparator_.add_golden(fragments);
  compare_seconds_ += seconds_since(start);
}

void RtlStream::add(std::span<const Fragment> fragments) {
  count_ += fragments.size();
  const Clock::time_point start = Clock::now();
  if (compares_) comparator_.add_rtl(fragments);
  assemble_compared(start, fragments);
}

void RtlStream::add(std::span<const Fragment> golden, std::span<const Fragment> fragments) {
  golden_count_ += golden.size();
  count_ += fragments.size();
  const Clock::time_point start = Clock::now();
  if (compares_) comparator_.add(golden, fragments);
  assemble_compared(start, fragments);
}

void RtlStream::assemble_compared(Clock::time_point start, std::span<const Fragment> fragments) {
  const Clock::time_point compared = Clock::now();
  assemble(fragments);
  compare_seconds_ += seconds_between(start, compared);
  assemble_seconds_ += seconds_since(compared);
}

// Wrong hardware may draw anywhere; the frame then holds what it drew inside.
void RtlStream::assemble(std::span<const Fragment> fragments) {
  while (!fragments.empty()) {
    const std::uint64_t before = assembler_.fragments();
    if (assembler_.add(fragments)) break;
    if (fault_.empty()) fault_ = "a fragment lies outside the frame";
    fragments = fragments.subspan(static_cast<std::size_t>(assembler_.fragments() - before));
  }
}

SimulatorRun RtlStream::finish(std::string simulator) {
  comparator_.finish();
  SimulatorRun run;
  run.simulator = std::move(simulator);
  run.fragments = count_;
  run.mismatches = comparator_.mismatches();
  run.fault = fault_;
  run.first = comparator_.first();
  if (run.mismatches != 0)
    run.description = comparator_.describe(run.simulator == "ghdl"        ? "GHDL"
                                           : run.simulator == "verilator" ? "Verilator"
                                                                          : run.simulator);
  return run;
}

VerilatorFeed::VerilatorFeed(VerilatorSimulator& simulator, RtlStream& rtl, OnDrawn on_drawn)
    : simulator_(simulator), rtl_(rtl), on_drawn_(std::move(on_drawn)) {}

// `drawn_` is emptied on every take, so its limit is what the golden model is ahead by, and some.
std::size_t VerilatorFeed::limit() const {
  const std::size_t pixels = rtl_.assembler().frame().pixels();
  const std::uint64_t ahead = rtl_.compares()
                                  ? rtl_.golden_count() - std::min(rtl_.count(), rtl_.golden_count())
                                  : (slice_of(pixels) + c_in_flight) * pixels;
  return static_cast<std::size_t>(ahead + c_most_surplus);
}

Status VerilatorFeed::take(const Status& ran) {
  rtl_.add(drawn_);
  if (on_drawn_) on_drawn_(drawn_);
  drawn_.clear();
  if (ran) return Ok{};
  if (ran.error().code != ExitCode::differs) return ran;
  rtl_.set_fault(ran.error().message);
  alive_ = false;
  return Ok{};
}

Status VerilatorFeed::add(std::span<const std::uint32_t> init_words) {
  const std::size_t words_per_vector = (simulator_.init_bits() + 31) / 32;
  while (alive_ && !init_words.empty()) {
    const std::size_t slice =
        rtl_.compares()
            ? init_words.size()
            : std::min(init_words.size(), words_per_vector * slice_of(rtl_.assembler().frame().pixels()));
    const auto begin = std::chrono::steady_clock::now();
    const Status ran = simulator_.run(init_words.first(slice), slice / words_per_vector, drawn_, limit());
    seconds_ += seconds_since(begin);
    init_words = init_words.subspan(slice);
    if (Status status = take(ran); !status) return status;
  }
  return Ok{};
}

Status VerilatorFeed::finish() {
  if (!alive_) return Ok{};
  const auto begin = std::chrono::steady_clock::now();
  const Status ran = simulator_.finish(drawn_, limit());
  seconds_ += seconds_since(begin);
  return take(ran);
}

}  // namespace halfway
