// SPDX-License-Identifier: Apache-2.0
// The way of a frame from the scene to the comparison: set-up, golden model, engines, comparison of every
// fragment, pictures. Every command that draws a frame goes this way; a browser does, too.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/host.hpp"
#include "common/result.hpp"
#include "frame/assemble.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/driver/batch_maker.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/models.hpp"
#include "sim/driver/rtl_frame.hpp"

namespace halfway {

/// Where the golden model draws.
enum class GoldenDraws {
  batches,  ///< each batch, by all workers; every engine is compared with it
  beside,   ///< a few triangles at a time beside each engine; the fragments are not stored
  nothing,  ///< it only counts the expected fragments; nothing is compared
};

struct FrameOptions {
  SetupOptions setup{};
  std::optional<Tile> tile{};  ///< draw this part of the frame; its pixels get the same fragments
  GoldenDraws golden = GoldenDraws::batches;
  bool golden_picture = false;  ///< with GoldenDraws::batches: assemble the golden model's frame
  /// False: draw also what the hardware reports as a fault, to test that it does.
  bool check = true;
  Workers workers{};
  Clocks clocks{};
  Models models{};
  /// For engines that draw late: see RtlFrameOptions. Called once for each of them.
  std::function<GoldenSource()> late_golden{};
  /// The fragments of an engine, in its stream's order. Valid during the call.
  std::function<void(std::size_t engine, std::span<const Fragment> drawn)> on_drawn{};
};

class FrameDriver {
 public:
  /// Called with each batch before the engines draw it, one at a time and in order. An error ends the frame.
  using OnBatch = std::function<Status(const Batch& batch)>;

  /// The scene must outlive the driver. Its camera may move between two frames.
  FrameDriver(const Scene& scene, FrameSize size, const HardwareKey& key,
              std::vector<std::shared_ptr<Engine>> engines = {}, FrameOptions options = {});
  FrameDriver(const FrameDriver&) = delete;
  FrameDriver& operator=(const FrameDriver&) = delete;

  /// Draws a frame: stream() and finish(). Returns bad input if the scene cannot be drawn. A difference or a
  /// fault of the hardware is not an error: see equal().
  Status draw(const OnBatch& on_batch = {});
  /// Gives the whole stream to golden model and engines. One worker gives a batch to the engines while the
  /// others make the next one.
  Status stream(const OnBatch& on_batch = {});
  /// Draws the fragments that remain in the engines.
  Status finish();
  /// Returns the first differences (ExitCode::differs) if an engine differs from the golden model or has a
  /// fault. Call it after finish().
  Status equal();

  const HardwareKey& key() const { return key_; }
  /// The frame of an engine, in the order in which they were given.
  RtlFrame& frame(std::size_t engine = 0) { return frames_[engine]; }
  /// With FrameOptions::golden_picture.
  const FrameAssembler& golden_frame() const { return *golden_; }
  unsigned init_bits() const { return init_bits_; }

  // Of the last frame.
  std::uint64_t words() const { return words_; }
  std::uint64_t fragments() const { return fragments_; }  ///< of GoldenDraws::batches
  const SetupCounts& counts() const { return counts_; }
  const std::vector<std::string>& notes() const { return notes_; }
  bool fault() const { return fault_; }  ///< of the golden model
  FrameSeconds seconds() const;          ///< the sum over the engines

 private:
  void clear();
  Status check_counts() const;
  Status draw_stream(const Setup& setup, const OnBatch& on_batch);
  Status take(const Batch& batch, const OnBatch& on_batch);

  const Scene& scene_;
  FrameSize size_;
  HardwareKey key_;
  FrameOptions o_;
  unsigned init_bits_;
  std::vector<RtlFrame> frames_;
  std::optional<FrameAssembler> golden_;

  std::uint64_t words_ = 0, fragments_ = 0;
  SetupCounts counts_;
  std::vector<std::string> notes_;
  bool fault_ = false;
  FrameSeconds seconds_;  ///< of set-up and golden model; RtlFrame has those of the engines
};

/// A frame's stream in memory.
struct FrameStream {
  unsigned init_bits = 0;
  std::vector<std::uint32_t> words;
  std::vector<Fragment> golden;
  SetupCounts counts;
  std::vector<std::string> notes;
  bool fault = false;  ///< of the golden model, without FrameOptions::check
  std::size_t vector_words() const { return (init_bits + 31) / 32; }
  std::size_t vectors() const { return words.size() / vector_words(); }
};
/// Makes all of it, without fragments if the golden model draws nothing.
Result<FrameStream> whole_stream(const Scene& scene, FrameSize size, const HardwareKey& key,
                                 FrameOptions options = {});

}  // namespace halfway
