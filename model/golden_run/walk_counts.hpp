// SPDX-License-Identifier: Apache-2.0
// Counts of preset exact's walker over a stream of init vectors: lines, spans, and the clocks of the
// hardware.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "golden/triangle_walker.hpp"
#include "golden/walker_clock.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/hardware_key.hpp"
#include "words/formats.hpp"

namespace halfway {

/// They are equal for all shaders with this walker.
struct WalkCounts {
  std::uint64_t headers = 0, lines = 0, empty_lines = 0, spans = 0, pixels = 0;
  /// Clocks without a pixel because the line stage handles one line per clock while the span stage draws.
  std::uint64_t lost_to_lines = 0;
  /// Additional clocks: two for a header before line records; without line records, a second clock for a
  /// triangle of one line.
  std::uint64_t lost_to_headers = 0;
  /// Clocks of the hardware for all vectors, without the depth of its pipeline.
  std::uint64_t clocks() const { return pixels + lost_to_lines + lost_to_headers; }
};

/// True if WalkCounter counts the clocks of this hardware: preset exact, without object processors,
/// and without shading processors of several clocks per token.
bool has_walk_clocks(const HardwareKey& key);

class WalkCounter {
 public:
  /// For hardware that has_walk_clocks.
  explicit WalkCounter(const HardwareKey& key);
  /// Adds the stream's next vectors, which must be whole triangles.
  void add(std::span<const std::uint32_t> init_words);
  WalkCounts counts() const;

 private:
  std::unique_ptr<GoldenModel> golden_;
  bool processors_;
  golden::TriangleWalker<words::Exact> walker_;
  golden::WalkerClock clock_;
  WalkCounts counts_;
  /// Clocks lost to lines alone: the line stage handles one line per clock, the span stage one pixel per
  /// clock. The next span starts when both are ready.
  std::uint64_t span_ = 0, lines_ = 0;
};

}  // namespace halfway
