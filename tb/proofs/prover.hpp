// SPDX-License-Identifier: Apache-2.0
// Proves one property of the RTL, from VHDL to the solver's answer.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "proof.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::proofs {

struct Folders {
  std::filesystem::path source;   ///< the project's root
  std::filesystem::path scratch;  ///< for temporary files
};

// These functions throw Failure.

/// Fails if a program that proofs call is missing; the error names the package to install.
void find_tools();

/// The RTL of a proof: rtl/, and for an entity of the board also rtl/board.
std::vector<VhdlSource> read_sources(const Folders& folders, const Proof& proof);

/// The text of the fault's file with the fault in it. Fails if the old text does not occur as often as it
/// must.
std::string text_with_fault(const std::vector<VhdlSource>& rtl, const Fault& fault);

enum class Verdict { holds, refuted, open };

struct Answer {
  Verdict verdict;
  std::string reason{};  ///< where the property was refuted, or why it is open
};

/// Proves the property on the RTL, or looks for a refutation on the RTL with `fault`, if it is not null.
Answer prove(const Folders& folders, const Proof& proof, const Fault* fault);

}  // namespace halfway::proofs
