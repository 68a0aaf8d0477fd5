// SPDX-License-Identifier: Apache-2.0
// How large a shader's netlist is, by Yosys.
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

inline constexpr const char* kInstallYosys = "apt-get install yosys";

/// Of no FPGA family: functions of up to four inputs, flip-flops, and bits of memory that is written. Tables
/// are made of the first. So are multipliers, but for those of the shading processors, nine tenths of whose
/// LUTs they would be: they are counted apart.
struct Cells {
  std::uint64_t luts = 0, flip_flops = 0, memory_bits = 0;
  std::uint64_t multipliers = 0, product_bits = 0;  ///< the latter of all multipliers' products together
  /// What Yosys makes of the multipliers on an iCE40, which has none: of each by itself, and as wide as its
  /// operands are without copies of their signs.
  std::uint64_t multiplier_luts = 0;
  friend bool operator==(Cells, Cells) = default;
};

/// A multiplier by itself. `square`: both operands are the same word.
struct MultiplierShape {
  bool is_signed = false, square = false;
  unsigned a_bits = 0, b_bits = 0, product_bits = 0;
  friend auto operator<=>(const MultiplierShape&, const MultiplierShape&) = default;
};

/// Of the cells of this type in a netlist as Yosys writes it as JSON, in its order.
Result<std::vector<MultiplierShape>> read_multiplier_shapes(const std::string& netlist,
                                                            const std::string& type);

class CellCounter {
 public:
  /// Where there is no Yosys, an error with the command that installs it.
  static Result<CellCounter> open(const SimulatorFolders& folders);

  /// Synthesizes the flattened netlist, or takes its figures from the cache. Threads may call it at once.
  Result<Cells> count(const HardwareKey& key) const;
  /// Of Yosys, as it says it.
  const std::string& version() const { return version_; }

 private:
  CellCounter(std::string version, GhdlLibrary library, std::filesystem::path cache)
      : version_(std::move(version)), library_(std::move(library)), cache_(std::move(cache)) {}
  /// By name, text.
  using Files = std::vector<std::pair<std::string, std::string>>;
  /// What `read` finds in the folder that Yosys's script leaves of the files; kept in the cache.
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
