// SPDX-License-Identifier: Apache-2.0
// What hardware costs is asked of: an entity with generics, and its sources.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plan/hardware_key.hpp"

namespace halfway::synth {

struct Design {
  std::string name;  ///< without spaces; prefix of messages and cache folders
  std::string entity;
  std::vector<std::pair<std::string, std::string>> generics{};
  std::filesystem::path root{};  ///< the project, or a copy of its RTL
  std::string more{};         ///< a VHDL source in addition to those of rtl/, relative to the root; or empty
  std::string key{};          ///< name of the hardware key; empty: an entity of another kind
  bool has_products = false;  ///< nine tenths of it would be multipliers in LUTs (generic_cells.hpp)
};

/// The hardware of a key, with the RTL of `root`.
Design design_of(const HardwareKey& key, const std::filesystem::path& root);

/// The name of the hardware key; otherwise the entity and its generics, as in "power g_exact=true".
std::string hardware_text(const Design& design);

/// True if the entity has the generic g_multiplier_bits, which changes no fragment and no number of clocks.
bool takes_multiplier_bits(std::string_view entity);

/// The netlist by GHDL, mended. Cached. Throws Failure.
std::string netlist_of(const Design& design, const std::filesystem::path& cache);

/// The identity of a mended netlist: equal hardware has the same one, in whatever it is contained. GHDL
/// counts all objects that it has visited, and adds a hash of the generics to a module's name. Both are
/// replaced by numbers in the order of first use; the result is the hash of that text.
std::string netlist_identity(std::string_view netlist);

}  // namespace halfway::synth
