// SPDX-License-Identifier: Apache-2.0
// Rows of evidence of mutants: what they depend on, and their page.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "evidence/evidence.hpp"
#include "mutants/design.hpp"
#include "mutants/source_faults.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::mutants {

struct RowFolders {
  std::filesystem::path source, vectors;
};

/// Hash of the programs that make and replay faults, and of the tools' versions.
Result<std::string> programs_hash(const std::filesystem::path& source);

/// Hash of what the outcomes of a netlist's faults depend on: `programs`, the netlist without names, the
/// design's description and its vectors.
Result<std::string> design_hash(const Design& design, const GhdlLibrary& library, const RowFolders& folders,
                                std::string_view programs);

/// The same for the source faults of one testbench: the sources that it uses, the faults and the vectors.
Result<std::string> testbench_hash(const std::string& test, std::span<const SourceFault> faults,
                                   const RowFolders& folders, std::string_view programs);

/// The reasons for survivors, by file and text of the VHDL line: survivors.toml.
class Reasons {
 public:
  static Result<Reasons> read(const std::filesystem::path& source);
  /// "file: text of the line" for "file:line"; a comment above the line does not change it.
  std::string line_at(const std::string& place) const;
  /// The reason for survivors of the line `line_at(place)`; empty if there is none.
  std::string of(std::string_view line) const;

 private:
  Reasons(std::filesystem::path source, std::vector<Survivor> listed)
      : source_(std::move(source)), listed_(std::move(listed)) {}
  std::filesystem::path source_;
  std::vector<Survivor> listed_;
};

inline constexpr std::string_view c_netlist_section = "Netlist faults", c_source_section = "Source faults";

/// Lines of a netlist row's details, with fields separated by tabs: `kind`, faults, found, equivalent,
/// survived; or `survivor`, the VHDL line, and number, kind, port and wire of the fault.
inline constexpr std::string_view c_kind = "kind", c_survivor = "survivor";

/// The tables of the page: netlists with their sum, kinds of faults, testbenches, survivors with reasons.
std::vector<page::Section> mutant_sections(std::span<const evidence::Row> rows, const Reasons& reasons);

}  // namespace halfway::mutants
