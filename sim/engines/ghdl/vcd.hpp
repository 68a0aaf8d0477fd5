// SPDX-License-Identifier: Apache-2.0
// Reads VCD traces: every change, or the values of signals before each rising edge of a clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/os/file.hpp"

namespace halfway {

struct VcdSignal {
  std::string code;  ///< the trace's name of the signal
  bool is_scalar = false;
};

struct VcdChange {
  std::string code;
  std::string value;  ///< bits, the highest first
};

/// Reads a trace change by change. Its functions throw Failure.
class VcdReader {
 public:
  /// Read the header.
  explicit VcdReader(const std::filesystem::path& file);

  /// All signals, by scopes and name joined by '/', such as "frame_tb/dut/x".
  const std::map<std::string, VcdSignal>& signals() const { return signals_; }
  /// The next change; nothing at the end of the trace.
  std::optional<VcdChange> next();
  /// The time of the last change, in the trace's unit; at the end of the trace, the end.
  std::uint64_t time() const { return time_; }
  /// An error at the current line.
  Error at(std::string_view what) const { return lines_.at(what); }

 private:
  LineReader lines_;
  std::map<std::string, VcdSignal> signals_;
  std::uint64_t time_ = 0;
};

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
