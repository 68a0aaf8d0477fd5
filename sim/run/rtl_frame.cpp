// SPDX-License-Identifier: Apache-2.0
#include "sim/run/rtl_frame.hpp"

#include <algorithm>
#include <utility>

#include "setup/check_counts.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_chunk = 1 << 16;  // fragments

}  // namespace

RtlFrame::RtlFrame(std::shared_ptr<Engine> engine, FrameSize size, glm::dvec3 background,
                   RtlFrameOptions options)
    : engine_(std::move(engine)),
      o_(std::move(options)),
      frame_(size, o_.tile.value_or(whole_frame(size)), background) {}

void RtlFrame::clear() {
  comparator_ = {};
  frame_.clear();
  golden_count_ = 0;
  stretch_ = {};
  golden_clock_ = compare_clock_ = assemble_clock_ = 0.0;
}

Status RtlFrame::add(std::span<const std::uint32_t> init_words, std::span<const Fragment> golden) {
  return stretch_.add([&]() -> Status {
    words_ = init_words;
    if (o_.golden_trace.empty()) given_ = golden;
    frame_.expect(o_.golden ? o_.golden->all_pixels(init_words) : golden.size());
    Status drawn = Ok{};
    if (alive()) drawn = ended(engine_->draw(init_words, frame_.most(), [this](auto part) { take(part); }));
    // Keep the golden fragments of triangles that are still in the hardware, or that a fault omitted.
    compare({}, SIZE_MAX);
    return drawn;
  });
}

Status RtlFrame::finish() {
  return stretch_.add([&]() -> Status {
    if (!o_.golden_trace.empty()) {
      auto trace = TraceReader::open(o_.golden_trace, "");
      if (!trace) return trace.error();
      trace_.emplace(std::move(*trace));
    }
    if (alive())
      if (Status drawn = ended(engine_->drain(frame_.most(), [this](auto part) { take(part); })); !drawn)
        return drawn;
    // Add the golden fragments that the engine has not drawn.
    while (trace_ && compare({}, c_chunk) != 0) {
    }
    if (error_) return *error_;
    return Ok{};
  });
}

Status RtlFrame::draw(const Scene& scene, SceneStream& stream) {
  for (Batch batch; stream.next(batch);) {
    if (Status status = add(batch.init_words, batch.golden); !status) return status;
    if (Status status =
            check_shadow_counts(scene, stream.counts(), stream.fault() || (o_.golden && o_.golden->fault()));
        !status)
      return status;
  }
  if (Status status = check_projection(scene, stream.counts()); !status) return status;
  return finish();
}

Status RtlFrame::ended(const Status& drawn) {
  if (error_) return *error_;
  return frame_.ended(drawn);
}

void RtlFrame::take(std::span<const Fragment> drawn) {
  // The golden model draws whole triangles. Draw no further while it is ahead of the engine.
  const std::uint64_t needed = frame_.fragments() + drawn.size();
  compare(drawn, static_cast<std::size_t>(needed - std::min(needed, golden_count_)));
  const auto start = Stretch::now();
  frame_.add(drawn);
  if (o_.on_drawn) o_.on_drawn(drawn);
  assemble_clock_ += seconds_since(start);
}

std::size_t RtlFrame::compare(std::span<const Fragment> drawn, std::size_t golden_count) {
  const auto start = Stretch::now();
  const std::span<const Fragment> golden = next_golden(golden_count);
  const auto drew = Stretch::now();
  golden_count_ += golden.size();
  if (o_.compare) comparator_.add(golden, drawn);
  golden_clock_ += seconds_between(start, drew);
  compare_clock_ += seconds_since(drew);
  return golden.size();
}

std::span<const Fragment> RtlFrame::next_golden(std::size_t count) {
  if (!o_.compare || count == 0) return {};
  if (o_.golden) return o_.golden->draw_next(words_, count);
  if (trace_) {
    read_.clear();
    if (const auto read = trace_->read(read_, count); !read) error_ = read.error();
    return read_;
  }
  const auto next = given_.first(std::min(count, given_.size()));
  given_ = given_.subspan(next.size());
  return next;
}

RtlFrame::Seconds RtlFrame::seconds() const {
  const double golden = stretch_.share(golden_clock_), compare = stretch_.share(compare_clock_),
               assemble = stretch_.share(assemble_clock_);
  return {stretch_.processor() - golden - compare - assemble, golden, compare, assemble};
}

SimulatorRun RtlFrame::result() {
  comparator_.finish();
  SimulatorRun run{.simulator = to_string(engine_->kind()),
                   .fragments = frame_.fragments(),
                   .mismatches = comparator_.mismatches(),
                   .cycles = engine_->cycles(),
                   .parts = engine_->parts(),
                   .fault = frame_.fault(),
                   .first = comparator_.first()};
  if (alive() || run.cycles)
    run.seconds = stretch_.clock() - golden_clock_ - compare_clock_ - assemble_clock_;
  if (run.mismatches != 0) run.description = comparator_.describe(title(engine_->kind()));
  return run;
}

}  // namespace halfway
