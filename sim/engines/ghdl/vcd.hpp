// SPDX-License-Identifier: Apache-2.0
// Reads VCD traces: the values of signals before each rising edge of a clock.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace halfway {

struct SampledSignals {
  std::size_t edges = 0;
  /// By path, such as "frame_tb/dut/x": one value per clock edge, as bits.
  std::map<std::string, std::vector<std::string>> values;
};

/// Read the first `most_edges` clocks. `clock` and `paths` are scopes and name joined by '/'. A path that is
/// not in the trace is an error.
Result<SampledSignals> sample_vcd(const std::filesystem::path& file, const std::string& clock,
                                  const std::vector<std::string>& paths, std::size_t most_edges);

}  // namespace halfway
