// SPDX-License-Identifier: Apache-2.0
// Whether a change of the RTL changes the hardware at all: GHDL's netlists of both, module by module, and
// where two differ, a miter of them, of which ABC proves that it never tells them apart.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "judge.hpp"

namespace halfway::mutants {

/// A netlist's modules by name.
struct Netlist {
  std::string top;
  std::map<std::string, std::string> modules;
};

/// Without comments, and with GHDL's numbers of nets in the order of the text: equal texts are equal
/// hardware.
Netlist netlist_of(std::string_view verilog, const std::string& top);

/// A memory's ports in place of the memory, so that a miter need not hold its words: what is read comes from
/// outside, the same to both, while all that is asked and written is compared.
std::string with_open_memories(std::string_view verilog);

class Equivalence {
 public:
  explicit Equivalence(const Judge& judge);

  /// True only where it is proved: at the generics of all `hardware()`, from all registers zero on, whatever
  /// the inputs are, reset included, every output of some module around the change is the same in every
  /// clock.
  Result<bool> proved(const Exchanged& exchanged);
  const std::vector<HardwareKey>& hardware() const { return keys_; }

 private:
  Result<Netlist> synthesize(const HardwareKey& key, const Exchanged& exchanged) const;
  Result<bool> same(const Netlist& gold, const Netlist& gate, const std::string& module);
  Result<bool> same_within(const Netlist& gold, const Netlist& gate);

  const Judge& judge_;
  std::vector<HardwareKey> keys_;
  std::mutex mutex_;
  std::map<std::string, Netlist> gold_;  ///< by the key's name
};

}  // namespace halfway::mutants
