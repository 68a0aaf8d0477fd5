// SPDX-License-Identifier: Apache-2.0
// How many of each entity the hardware of a key has: instances in GHDL's netlist.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "plan/plan.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

using UnitCounts = std::map<std::string, int>;  ///< by entity; none is zero

/// The instances in a netlist, as a tree.
class InstanceTree {
 public:
  /// `netlist` is GHDL's Verilog. GHDL appends a module's generics to the name of its entity.
  InstanceTree(std::string_view netlist, const std::set<std::string>& entities);

  /// All instances below the module `top`.
  UnitCounts count(const std::string& top) const;
  /// The instances below `top` that have one of these names, and all instances below them. A name is an
  /// entity's or a label's; a generate statement's label is the beginning of the label in the netlist.
  UnitCounts count_named(const std::string& top, const std::vector<std::string>& names) const;

 private:
  struct Instance {
    std::string module, entity, label;
  };
  void add(const std::string& module, UnitCounts& counts) const;
  void add_named(const std::string& module, const std::vector<std::string>& names, UnitCounts& counts) const;
  std::map<std::string, std::vector<Instance>> instances_;  ///< by module
};

class UnitCounter {
 public:
  /// Fails if GHDL is missing or does not take the RTL.
  static Result<UnitCounter> open(const SimulatorFolders& folders);

  /// The entities below the top. Synthesizes the netlist, or takes it from the cache.
  Result<UnitCounts> count(const HardwareKey& key);
  /// The entities in the hardware `key` that only this effect needs; if it is not elaborated, those that it
  /// would add.
  Result<UnitCounts> count(const HardwareKey& key, const PlannedEffect& effect);

 private:
  UnitCounter(GhdlLibrary library, std::set<std::string> entities)
      : library_(std::move(library)), entities_(std::move(entities)) {}
  Result<InstanceTree> tree(const HardwareKey& key) const;
  GhdlLibrary library_;
  std::set<std::string> entities_;
  std::map<std::string, UnitCounts> counted_;  ///< by the key's name
};

}  // namespace halfway
