// SPDX-License-Identifier: Apache-2.0
// A frame's init vectors to lanes of the RTL, and an RtlStream what they draw; and when lanes pay.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "common/result.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/hardware_key.hpp"
#include "sim/lanes/lane_simulator.hpp"
#include "sim/run/rtl_stream.hpp"

namespace halfway {

/// Which simulates the RTL in this process.
enum class RtlEngine { automatic, verilator, lanes };
inline const char* to_string(RtlEngine engine) {
  return engine == RtlEngine::lanes ? "lanes" : engine == RtlEngine::verilator ? "verilator" : "auto";
}
Result<RtlEngine> parse_rtl_engine(const std::string& text);

/// Of all frames together; from here on lanes save more than the 5 s that their compilation takes.
inline constexpr double c_least_lane_pixels = double(1U << 26);

/// Whether lanes are to draw so many pixels: on processors with AVX-512, a shader whose triangles stand
/// alone, and work enough. An engine that was asked for is taken; lanes that cannot be had are bad input.
Result<bool> use_lanes(RtlEngine engine, const HardwareKey& key, double pixels);

/// As VerilatorFeed. Each batch ends with the hardware idle. Where the stream compares, golden fragments come
/// from the caller or, with a golden model, from that: part by part, where they are compared, so that no more
/// than a part's are held.
class LaneFeed {
 public:
  using OnDrawn = VerilatorFeed::OnDrawn;

  /// Simulator and stream must outlive the feed; `on_drawn` sees the fragments too, in their order.
  LaneFeed(LaneSimulator& simulator, RtlStream& rtl, OnDrawn on_drawn = {})
      : simulator_(simulator), rtl_(rtl), on_drawn_(std::move(on_drawn)) {}
  LaneFeed(LaneSimulator& simulator, RtlStream& rtl, GoldenModel& golden)
      : simulator_(simulator), rtl_(rtl), golden_(&golden) {}

  /// `golden`: what the golden model draws for these vectors, where the stream compares and there is no
  /// model.
  Status add(std::span<const std::uint32_t> init_words, std::span<const Fragment> golden = {});
  bool alive() const { return alive_; }  ///< false after a fault
  /// By the clock; with golden model, comparison and assembly.
  double seconds() const { return seconds_; }
  double golden_seconds() const { return golden_seconds_; }  ///< of these, the model's here

 private:
  LaneSimulator& simulator_;
  RtlStream& rtl_;
  OnDrawn on_drawn_;
  GoldenModel* golden_ = nullptr;
  double seconds_ = 0.0, golden_seconds_ = 0.0;
  bool alive_ = true;
};

}  // namespace halfway
