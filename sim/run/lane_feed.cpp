// SPDX-License-Identifier: Apache-2.0
#include "sim/run/lane_feed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "sim/system/seconds.hpp"

namespace halfway {
namespace {

bool has_avx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

}  // namespace

Result<RtlEngine> parse_rtl_engine(const std::string& text) {
  for (const RtlEngine engine : {RtlEngine::automatic, RtlEngine::verilator, RtlEngine::lanes})
    if (text == to_string(engine)) return engine;
  return bad_input(fmt::format("--simulator: '{}' is none of auto, verilator and lanes", text));
}

Result<bool> use_lanes(RtlEngine engine, const HardwareKey& key, double pixels) {
  const bool possible = LaneSimulator::refused(key).empty();
  if (engine == RtlEngine::lanes && !possible)
    return bad_input(fmt::format("{}: no lanes for this hardware; leave --simulator out", key.name()));
  if (engine != RtlEngine::automatic) return engine == RtlEngine::lanes;
  return possible && has_avx512() && pixels >= c_least_lane_pixels;
}

Status LaneFeed::add(std::span<const std::uint32_t> init_words, std::span<const Fragment> golden) {
  if (!alive_) return Ok{};
  const auto start = std::chrono::steady_clock::now();
  const Status ran = simulator_.run(init_words, SIZE_MAX, [&](auto words, std::span<const Fragment> drawn) {
    if (golden_ != nullptr) {
      const auto golden_start = std::chrono::steady_clock::now();
      const std::span<const Fragment> expected = golden_->draw(words);
      golden_seconds_ += seconds_since(golden_start);
      rtl_.add(expected, drawn);
      return;
    }
    const std::span<const Fragment> expected = golden.first(std::min(golden.size(), drawn.size()));
    rtl_.add(expected, drawn);
    if (on_drawn_) on_drawn_(drawn);
    golden = golden.subspan(expected.size());
  });
  rtl_.add_golden(golden);
  seconds_ += seconds_since(start);
  if (ran) return Ok{};
  if (ran.error().code != ExitCode::differs) return ran;
  rtl_.set_fault(ran.error().message);
  alive_ = false;
  return Ok{};
}

}  // namespace halfway
