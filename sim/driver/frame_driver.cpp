// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/frame_driver.hpp"

#include <fmt/format.h>

#include <atomic>
#include <utility>

#include "setup/setup.hpp"
#include "sim/driver/tile_setup.hpp"

namespace halfway {

FrameDriver::FrameDriver(const Scene& scene, FrameSize size, const HardwareKey& key,
                         std::vector<std::shared_ptr<Engine>> engines, FrameOptions options)
    : scene_(scene),
      size_(size),
      key_(key),
      o_(std::move(options)),
      init_bits_(o_.models.golden(key)->init_bits()) {
  if (o_.golden_picture) golden_.emplace(size, o_.tile.value_or(whole_frame(size)), scene.background);
  frames_.reserve(engines.size());
  for (std::size_t i = 0; i < engines.size(); ++i) {
    RtlFrameOptions frame{.tile = o_.tile, .compare = o_.golden != GoldenDraws::nothing, .clocks = o_.clocks};
    if (o_.golden != GoldenDraws::batches) frame.golden = o_.models.golden(key);
    if (o_.late_golden && engines[i]->draws_late()) frame.late_golden = o_.late_golden();
    if (o_.on_drawn) frame.on_drawn = [this, i](std::span<const Fragment> drawn) { o_.on_drawn(i, drawn); };
    frames_.emplace_back(std::move(engines[i]), size, scene.background, std::move(frame));
  }
}

void FrameDriver::clear() {
  for (RtlFrame& frame : frames_) frame.clear();
  if (golden_) golden_->clear();
  words_ = fragments_ = 0;
  counts_ = {};
  fault_ = false;
}

Status FrameDriver::draw(const OnBatch& on_batch) {
  if (Status status = stream(on_batch); !status) return status;
  return finish();
}

Status FrameDriver::stream(const OnBatch& on_batch) {
  clear();
  const double start = o_.clocks.processor();
  const std::unique_ptr<Setup> whole = o_.models.setup(scene_, size_, key_, o_.setup);
  notes_ = whole->notes();
  std::optional<TileSetup> tile;
  if (o_.tile) tile.emplace(*whole, o_.models.golden(key_), *o_.tile);
  seconds_ = {.setup = o_.clocks.processor() - start};
  if (Status status = draw_stream(tile ? static_cast<const Setup&>(*tile) : *whole, on_batch); !status)
    return status;
  return o_.check ? check_projection(scene_, counts_) : Status(Ok{});
}

Status FrameDriver::draw_stream(const Setup& setup, const OnBatch& on_batch) {
  BatchMaker::MakeGolden golden;
  if (o_.golden == GoldenDraws::batches) golden = [this] { return o_.models.golden(key_); };
  BatchMaker maker(setup, std::move(golden), o_.workers.count, o_.clocks);
  counts_ = maker.counts();
  Batch batch;
  Status taken = Ok{};
  for (bool is_made = false, more = maker.begin({}); is_made || more;) {
    // The first worker takes the batch that is made, and then helps to make the next one.
    std::atomic<bool> waits = is_made;
    o_.workers.run(o_.workers.count, [&] {
      if (waits.exchange(false)) taken = take(batch, on_batch);
      if (more) maker.work();
    });
    if (!taken) break;
    is_made = more;
    if (!more) continue;
    Batch next = maker.end();
    counts_ = maker.counts();
    fault_ = maker.fault();
    std::swap(batch, next);
    more = maker.begin(std::move(next));
  }
  seconds_ += {.setup = maker.setup_seconds(), .golden = maker.golden_seconds()};
  return taken;
}

// While the next batch is made, the counts are those up to this one.
Status FrameDriver::take(const Batch& batch, const OnBatch& on_batch) {
  if (Status status = check_counts(); !status) return status;
  if (on_batch)
    if (Status status = on_batch(batch); !status) return status;
  words_ += batch.init_words.size();
  fragments_ += batch.golden.size();
  if (golden_)
    if (Status status = golden_->add(batch.golden); !status)
      return tool_failed(fmt::format("{}: setup made a fragment outside the frame: {}; please report it",
                                     scene_.name, status.error().message));
  for (RtlFrame& frame : frames_) {
    if (Status status = frame.add(batch.init_words, batch.golden); !status) return status;
    fault_ = fault_ || frame.golden_fault();
  }
  return check_counts();
}

Status FrameDriver::check_counts() const {
  return o_.check ? check_pixels(scene_, key_, counts_, fault_) : Status(Ok{});
}

Status FrameDriver::finish() {
  for (RtlFrame& frame : frames_)
    if (Status status = frame.finish(); !status) return status;
  return Ok{};
}

Status FrameDriver::equal() {
  for (RtlFrame& frame : frames_)
    if (const SimulatorRun run = frame.result(); !run.equal())
      return Error{ExitCode::differs,
                   fmt::format("{}: the RTL differs from the golden model: {} mismatches {}\n{}", key_.name(),
                               run.mismatches, run.fault, run.description)};
  return Ok{};
}

FrameSeconds FrameDriver::seconds() const {
  FrameSeconds all = seconds_;
  for (const RtlFrame& frame : frames_) all += frame.seconds();
  return all;
}

Result<FrameStream> whole_stream(const Scene& scene, FrameSize size, const HardwareKey& key,
                                 FrameOptions options) {
  FrameDriver driver(scene, size, key, {}, std::move(options));
  FrameStream all{.init_bits = driver.init_bits()};
  const Status drawn = driver.stream([&](const Batch& batch) -> Status {
    all.words.insert(all.words.end(), batch.init_words.begin(), batch.init_words.end());
    all.golden.insert(all.golden.end(), batch.golden.begin(), batch.golden.end());
    return Ok{};
  });
  if (!drawn) return drawn.error();
  all.counts = driver.counts();
  all.notes = driver.notes();
  all.fault = driver.fault();
  return all;
}

}  // namespace halfway
