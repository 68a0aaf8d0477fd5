// SPDX-License-Identifier: Apache-2.0
// Size of a shader's netlist, by Yosys.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "plan/hardware_key.hpp"
#include "sim/cost/yosys.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

/// Generic cells of no FPGA family: LUTs with up to four inputs, flip-flops, and bits of writable memory.
/// Tables are LUTs. Multipliers are LUTs too, except those of the shading processors, which are counted
/// separately, because they would be nine tenths of the LUTs.
struct Cells {
  std::uint64_t luts = 0, flip_flops = 0, memory_bits = 0;
  std::uint64_t multipliers = 0, product_bits = 0;  ///< product_bits: sum over all multipliers
  /// LUTs for the multipliers on an iCE40 without DSP blocks. Each is synthesized separately, with its
  /// operands reduced by redundant sign bits.
  std::uint64_t multiplier_luts = 0;
  friend bool operator==(Cells, Cells) = default;
};

/// Shape of a multiplier. `square`: both operands are the same word.
struct MultiplierShape {
  bool is_signed = false, square = false;
  unsigned a_bits = 0, b_bits = 0, product_bits = 0;
  friend auto operator<=>(const MultiplierShape&, const MultiplierShape&) = default;
};

/// Shapes of all cells of this type in a netlist in Yosys's JSON format, in file order. Throws Failure.
std::vector<MultiplierShape> read_multiplier_shapes(const std::string& netlist, const std::string& type);

class CellCounter {
 public:
  /// Without Yosys, throws Failure with the command that installs it.
  explicit CellCounter(const SimulatorFolders& folders);

  /// Synthesize the flattened netlist, or read its counts from the cache. Thread-safe.
  Cells count(const HardwareKey& key) const;
  /// Version of Yosys, as Yosys prints it.
  const std::string& version() const { return yosys_.version(); }

 private:
  Cells read_cells(const std::filesystem::path& folder) const;
  std::uint64_t luts_of(const MultiplierShape& shape) const;
  synth::Yosys yosys_;
  GhdlLibrary library_;
};

}  // namespace halfway
