// SPDX-License-Identifier: Apache-2.0
// The page of mutants: its tables, and the values that thresholds judge.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evidence/page.hpp"
#include "evidence/thresholds.hpp"
#include "mutants/design.hpp"

namespace halfway::mutants {

/// The reasons for survivors, by file and text of the VHDL line: survivors.toml.
class Reasons {
 public:
  /// Throws Failure.
  explicit Reasons(const std::filesystem::path& source);
  /// "file: text of the line" for "file:line"; a comment above the line does not change it.
  std::string line_at(const std::string& place) const;
  /// The reason for survivors of the line `line_at(place)`, or of the netlist if the line is not known; empty
  /// if there is none.
  std::string of(std::string_view line, std::string_view netlist) const;

 private:
  std::filesystem::path source_;
  std::vector<Survivor> listed_;
};

inline constexpr std::string_view c_netlist_section = "Netlist faults", c_source_section = "Source faults";

/// Lines of a netlist row's details, with fields separated by tabs: `kind`, faults, found, equivalent,
/// survived; or `survivor`, the VHDL line, and number, kind, port and wire of the fault.
inline constexpr std::string_view c_kind = "kind", c_survivor = "survivor";

/// The tables of the page: netlists with their sum, kinds of faults, testbenches, survivors with reasons.
std::vector<page::Section> mutant_sections(std::span<const page::Row> rows, const Reasons& reasons);

/// The share of the faults that are found of each netlist and of all, in %. Faults that are proved equivalent
/// count as not found: how many are proved depends on the machine's speed.
std::vector<page::Value> mutant_values(std::span<const page::Row> rows);

}  // namespace halfway::mutants
