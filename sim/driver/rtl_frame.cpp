// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/rtl_frame.hpp"

#include <algorithm>
#include <utility>

#include "sim/driver/limits.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_chunk = 1 << 16;  // fragments

}  // namespace

FrameSeconds& FrameSeconds::operator+=(const FrameSeconds& other) {
  setup += other.setup;
  golden += other.golden;
  rtl += other.rtl;
  compare += other.compare;
  assemble += other.assemble;
  return *this;
}

RtlFrame::RtlFrame(std::shared_ptr<Engine> engine, FrameSize size, glm::dvec3 background,
                   RtlFrameOptions options)
    : engine_(std::move(engine)),
      o_(std::move(options)),
      assembler_(size, o_.tile.value_or(whole_frame(size)), background) {}

void RtlFrame::clear() {
  const double start = o_.clocks.elapsed(), processor_start = o_.clocks.processor();
  comparator_ = {};
  assembler_.clear();
  expected_ = fragments_ = golden_count_ = 0;
  fault_.clear();
  alive_ = true;
  finishing_ = false;
  processor_ = o_.clocks.processor() - processor_start;
  assemble_elapsed_ = elapsed_ = o_.clocks.elapsed() - start;
  golden_elapsed_ = compare_elapsed_ = 0.0;
}

template <class Work>
Status RtlFrame::timed(const Work& work) {
  const double start = o_.clocks.elapsed(), processor_start = o_.clocks.processor();
  Status status = work();
  processor_ += o_.clocks.processor() - processor_start;
  elapsed_ += o_.clocks.elapsed() - start;
  return status;
}

Status RtlFrame::add(std::span<const std::uint32_t> init_words, std::span<const Fragment> golden) {
  return timed([&]() -> Status {
    words_ = init_words;
    if (!o_.late_golden) given_ = golden;
    expected_ += o_.golden ? o_.golden->all_pixels(init_words) : golden.size();
    Status drawn = Ok{};
    if (alive_) drawn = ended(engine_->draw(init_words, most(), [this](auto part) { take(part); }));
    // Keep the golden fragments of triangles that are still in the hardware, or that a fault omitted.
    compare({}, SIZE_MAX);
    return drawn;
  });
}

Status RtlFrame::finish() {
  return timed([&]() -> Status {
    finishing_ = true;
    if (alive_)
      if (Status drawn = ended(engine_->drain(most(), [this](auto part) { take(part); })); !drawn)
        return drawn;
    // Add the golden fragments that the engine has not drawn.
    while (o_.late_golden && compare({}, c_chunk) != 0) {
    }
    if (error_) return *error_;
    return Ok{};
  });
}

std::uint64_t RtlFrame::most() const {
  return expected_ - std::min(expected_, fragments_) + c_most_surplus;
}

// A fault of the hardware ends the drawing, but is not an error.
Status RtlFrame::ended(const Status& drawn) {
  if (error_) return *error_;
  if (drawn || drawn.error().code != ExitCode::differs) return drawn;
  fault_ = drawn.error().message;
  alive_ = false;
  return Ok{};
}

void RtlFrame::take(std::span<const Fragment> drawn) {
  // The golden model draws whole triangles. Draw no further while it is ahead of the engine.
  const std::uint64_t needed = fragments_ + drawn.size();
  compare(drawn, static_cast<std::size_t>(needed - std::min(needed, golden_count_)));
  const double start = o_.clocks.elapsed();
  assemble(drawn);
  if (o_.on_drawn) o_.on_drawn(drawn);
  assemble_elapsed_ += o_.clocks.elapsed() - start;
}

// Wrong hardware may draw outside the frame: this is a fault, and the picture contains only the fragments
// inside.
void RtlFrame::assemble(std::span<const Fragment> drawn) {
  fragments_ += drawn.size();
  while (!drawn.empty()) {
    const std::uint64_t before = assembler_.fragments();
    if (assembler_.add(drawn)) break;
    if (fault_.empty()) fault_ = "a fragment lies outside the frame";
    drawn = drawn.subspan(static_cast<std::size_t>(assembler_.fragments() - before));
  }
}

std::size_t RtlFrame::compare(std::span<const Fragment> drawn, std::size_t golden_count) {
  const double start = o_.clocks.elapsed();
  const std::span<const Fragment> golden = next_golden(golden_count);
  const double drew = o_.clocks.elapsed();
  golden_count_ += golden.size();
  if (o_.compare) comparator_.add(golden, drawn);
  golden_elapsed_ += drew - start;
  compare_elapsed_ += o_.clocks.elapsed() - drew;
  return golden.size();
}

std::span<const Fragment> RtlFrame::next_golden(std::size_t count) {
  if (!o_.compare || count == 0) return {};
  if (o_.golden) return o_.golden->draw_next(words_, count);
  if (o_.late_golden) {
    if (!finishing_ || error_) return {};
    const auto next = o_.late_golden(count);
    if (!next) error_ = next.error();
    return next ? *next : std::span<const Fragment>();
  }
  const auto next = given_.first(std::min(count, given_.size()));
  given_ = given_.subspan(next.size());
  return next;
}

FrameSeconds RtlFrame::seconds() const {
  const auto share = [&](double elapsed) { return elapsed_ > 0.0 ? processor_ * elapsed / elapsed_ : 0.0; };
  const double golden = share(golden_elapsed_), compare = share(compare_elapsed_),
               assemble = share(assemble_elapsed_);
  return {.golden = golden,
          .rtl = processor_ - golden - compare - assemble,
          .compare = compare,
          .assemble = assemble};
}

SimulatorRun RtlFrame::result() {
  comparator_.finish();
  SimulatorRun run{.simulator = to_string(engine_->kind()),
                   .fragments = fragments_,
                   .mismatches = comparator_.mismatches(),
                   .cycles = engine_->cycles(),
                   .parts = engine_->parts(),
                   .fault = fault_,
                   .first = comparator_.first()};
  if (alive_ || run.cycles) run.seconds = elapsed_ - golden_elapsed_ - compare_elapsed_ - assemble_elapsed_;
  if (run.mismatches != 0) run.description = comparator_.describe(title(engine_->kind()));
  return run;
}

}  // namespace halfway
