// SPDX-License-Identifier: Apache-2.0
// Size of a shader's netlist, by Yosys.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

inline constexpr const char* c_install_yosys = "apt-get install yosys";

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

/// Shapes of all cells of this type in a netlist in Yosys's JSON format, in file order.
Result<std::vector<MultiplierShape>> read_multiplier_shapes(const std::string& netlist,
                                                            const std::string& type);

class CellCounter {
 public:
  /// Without Yosys, returns an error with the command that installs it.
  static Result<CellCounter> open(const SimulatorFolders& folders);

  /// Synthesize the flattened netlist, or read its counts from the cache. Thread-safe.
  Result<Cells> count(const HardwareKey& key) const;
  /// Version of Yosys, as Yosys prints it.
  const std::string& version() const { return version_; }

 private:
  CellCounter(std::string version, GhdlLibrary library, std::filesystem::path cache)
      : version_(std::move(version)), library_(std::move(library)), cache_(std::move(cache)) {}
  /// Pairs of name and text.
  using Files = std::vector<std::pair<std::string, std::string>>;
  /// Run Yosys on the files and return what `read` extracts from the folder with its output. The output is
  /// cached.
  template <class Figures, class Read>
  Result<Figures> figures(const std::string& name, const std::string& script, const Files& files,
                          const Read& read) const;
  Result<Cells> read(const std::filesystem::path& folder) const;
  Result<std::uint64_t> luts_of(const MultiplierShape& shape) const;
  std::string version_;
  GhdlLibrary library_;
  std::filesystem::path cache_;
};

}  // namespace halfway
