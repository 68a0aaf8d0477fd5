// SPDX-License-Identifier: Apache-2.0
// A long run of GHDL, which is one thread, as several short ones side by side.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_runner.hpp"

namespace halfway {

/// Where a stream of init vectors may be cut: before a triangle, some way behind the last place.
class Cuts {
 public:
  explicit Cuts(const HardwareKey& key);
  /// The stream's next vectors, whole triangles.
  void add(std::span<const std::uint32_t> init_words);
  /// The first vectors of the parts to draw in, by the frame alone and not by the machine; the first one's is
  /// 0. Parts of many clocks first, an eighth of all, then of fewer, so that whoever takes them by turns ends
  /// together. One part where triangles hang on those before (the shading processors: lights, shadow
  /// counters), or where there is little to draw.
  std::vector<std::uint64_t> parts() const;

 private:
  struct Place {
    std::uint64_t vectors, clocks;  ///< before
  };
  std::unique_ptr<GoldenModel> golden_;  ///< none where there is no place to cut
  std::vector<Place> places_{{0, 0}};
  Place end_{0, 0};
};

/// Fragments in the stream's order.
using OnJoined = std::function<Status(std::span<const Fragment>)>;

/// Runs `runner` on each part of `init_file`, up to `threads` at a time, each from the reset on, and joins
/// their traces in order as they end: the same fragments as in one run, which `on_joined` sees as well, one
/// thread at a time. Cycles are the sum: a few more for each part, in which the hardware fills and drains.
Result<GhdlRun> run_in_parts(const GhdlRunner& runner, const HardwareKey& key,
                             const std::filesystem::path& init_file,
                             std::span<const std::uint64_t> first_vectors,
                             const std::filesystem::path& trace_file, const GhdlRunOptions& options,
                             unsigned threads, const OnJoined& on_joined = {});

}  // namespace halfway
