// SPDX-License-Identifier: Apache-2.0
// One property of one entity, from VHDL to a solver's answer.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"

namespace halfway::proofs {

/// A text of the RTL exchanged for another.
struct Fault {
  const char* file;       ///< in rtl/
  std::string_view from;  ///< occurs once; in the formats, first in preset exact
  std::string_view to;
};

enum class Method {
  induction,  ///< true in the first `depth` clocks, and after any `depth` clocks in which it was
  bounded,    ///< true in the first `depth` clocks
  unrolled,   ///< the same, bit by bit by ABC: for what has many registers and little arithmetic
  pdr,    ///< a set of states around all that can be reached, found by ABC; `depth` serves the faults alone
  gappa,  ///< bounds of real expressions; `unit` is Gappa's text with names of formats_pkg in it
};

/// A format made narrower, so that the solver comes to an end.
struct Width {
  std::string_view format;
  int integer_bits;
  int fraction_bits;
};

struct Proof {
  const char* entity;    ///< in rtl/, with its folder
  const char* unit;      ///< in tb/proofs/, beside the entity's folder: PSL, or Gappa's text
  std::string property;  ///< for the page
  Method method;
  int depth;   ///< clocks
  bool quick;  ///< a few seconds with its faults: in `make test` too
  std::vector<std::pair<std::string, std::string>> generics;
  std::vector<Fault> faults;
  std::vector<Width> widths{};  ///< of both presets
  bool any_products = false;    ///< a product is anything at all: what is proved holds whatever is multiplied
  int fault_depth = 10;         ///< clocks in which a fault has to show
  bool full_width = false;      ///< `widths` are the faults' alone
  std::vector<std::uint64_t> entries{};  ///< of the golden model's table, for `$entries` in the unit
  int entry_bits = 0;
  bool bit_registers = false;  ///< of less than a byte, so that Yosys makes one of those that are the same
  std::vector<const char*> contracts{};  ///< files beside `unit`: architectures that give out anything that
                                         ///< their entity's contract lets them, in place of the RTL's
};

/// All of them, in the order of the page.
std::vector<Proof> all_proofs();

struct Folders {
  std::filesystem::path source;   ///< the project's root
  std::filesystem::path scratch;  ///< for temporary files
};

/// Whether the programs that proofs call are there; the error names what installs the first that is missing.
Status find_tools();

enum class Verdict { holds, refuted, open };

struct Answer {
  Verdict verdict;
  std::string said;  ///< by the solver: where it was refuted, or why it is open
};

/// `fault` null: the RTL as it is.
Result<Answer> prove(const Folders& folders, const Proof& proof, const Fault* fault);

}  // namespace halfway::proofs
