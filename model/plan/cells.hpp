// SPDX-License-Identifier: Apache-2.0
// How large a shader's netlist is, by Yosys.
#pragma once

#include <cstdint>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

inline constexpr const char* kInstallYosys = "apt-get install yosys";

/// Of no FPGA family: functions of up to four inputs, flip-flops, and bits of memory that is written. Tables
/// are made of the first. So are multipliers, but for those of the shading processors, nine tenths of whose
/// LUTs they would be: they are counted apart.
struct Cells {
  std::uint64_t luts = 0, flip_flops = 0, memory_bits = 0;
  std::uint64_t multipliers = 0, product_bits = 0;  ///< the latter of all multipliers' products together
  friend bool operator==(Cells, Cells) = default;
};

class CellCounter {
 public:
  /// Where there is no Yosys, an error with the command that installs it.
  static Result<CellCounter> open(const SimulatorFolders& folders);

  /// Synthesizes the flattened netlist, or takes its figures from the cache. Threads may call it at once.
  Result<Cells> count(const HardwareKey& key) const;

 private:
  CellCounter(std::string version, GhdlLibrary library, std::filesystem::path cache)
      : version_(std::move(version)), library_(std::move(library)), cache_(std::move(cache)) {}
  std::string version_;
  GhdlLibrary library_;
  std::filesystem::path cache_;
};

}  // namespace halfway
