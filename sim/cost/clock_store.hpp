// SPDX-License-Identifier: Apache-2.0
// The measured clocks that are kept in the checkout, one file for each device, written by
// `make evidence PAGE=clocks`, which places only hardware that is not in the file.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sim/cost/families.hpp"

namespace halfway::synth {

/// The file of the family's device, relative to the project's root: docs/results/clocks_hx8k.csv.
std::string clocks_file(const Family& family);

struct StoredClock {
  Cells cells;             ///< on the device
  double mhz = 0;          ///< median of the placements; 0: the hardware is not placed
  unsigned seeds = 0;      ///< number of placements, with those that did not end; 0: there is no room
  std::string range{};     ///< of the placements' clocks, for the page
  std::string path{};      ///< the critical path, or why there is no clock, for the page
  std::string tools{};     ///< Synthesizer::versions
  std::string netlist{};   ///< netlist_identity, without g_multiplier_bits
  std::string hardware{};  ///< hardware_text
};
/// By the name of the design, or of the hardware key.
using ClockStore = std::map<std::string, StoredClock>;

/// The first clock of a netlist with this identity.
ClockStore::const_iterator clock_of(const ClockStore& clocks, const std::string& netlist);

/// The first clock of this hardware that was placed from the netlist of another GHDL than `ghdl`, such as
/// "GHDL 2.0.0". That netlist differs, and cannot be compared.
ClockStore::const_iterator clock_by_other_ghdl(const ClockStore& clocks, const std::string& hardware,
                                               const std::string& ghdl);

/// True if the same tools have placed this netlist with as many seeds, or have found no room for it.
bool is_placed(const StoredClock& clock, const std::string& tools, const std::string& netlist,
               unsigned seeds);

/// Empty if there is no file.
Result<ClockStore> read_clocks(const std::filesystem::path& root, const Family& family);
Status write_clocks(const std::filesystem::path& root, const Family& family, const ClockStore& clocks);

}  // namespace halfway::synth
