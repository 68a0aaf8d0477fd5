// SPDX-License-Identifier: Apache-2.0
// One property of one entity, how it is proved, and the faults in the RTL that the proof must refute.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace halfway::proofs {

/// One text of the RTL, replaced by another.
struct Fault {
  std::string file;      ///< in rtl/
  std::string old_text;  ///< occurs `occurrences` times in the file; the first is replaced
  std::string new_text;
  int occurrences = 1;
  std::string where{};  ///< file:line of its description
};

enum class Method {
  induction,    ///< no violation in the first `clocks` clocks, nor after any `clocks` clocks without one; by
                ///< cvc5
  bounded,      ///< no violation in the first `clocks` clocks; by cvc5
  bounded_abc,  ///< the same, bit by bit, by ABC: for many registers and little arithmetic
  pdr,          ///< ABC finds an invariant that no reachable state violates
  gappa,        ///< bounds of real expressions, by Gappa
};

/// A number format of formats_pkg, with other word lengths in both presets.
struct Format {
  std::string name;
  int integer_bits;
  int fraction_bits;
};

struct Proof {
  std::string name{};      ///< of its description without `.toml`, and its number if there are several
  std::string entity;      ///< in rtl/, with its folder and without `.vhd`
  std::string unit;        ///< in tb/rtl/: the PSL unit, or Gappa's text
  std::string property{};  ///< one sentence, for the page
  Method method = Method::induction;
  int clocks = 0;        ///< of induction and bounded proofs
  int fault_clocks = 0;  ///< a fault must be refuted within this number of clocks
  bool quick = false;    ///< takes a few seconds with its faults: `make test` runs it too
  std::vector<std::pair<std::string, std::string>> generics{};
  std::vector<Format> formats{};         ///< narrower formats, where the solver needs them
  std::vector<Format> fault_formats{};   ///< the same, for faults
  bool any_products = false;             ///< products are arbitrary words
  std::vector<std::string> contracts{};  ///< in tb/rtl/: architectures that replace those of the RTL and
                                         ///< put out anything that their entity's contract allows
  std::vector<std::uint64_t> table{};    ///< entries of the golden model's table, for `$entries` in the unit
  int table_bits = 0;                    ///< of one entry
  std::vector<Fault> faults{};
};

}  // namespace halfway::proofs
