// SPDX-License-Identifier: Apache-2.0
// Number of instances of each entity in the hardware of a key, from GHDL's netlist.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "plan/plan.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

using UnitCounts = std::map<std::string, int>;  ///< by entity; every count is at least one

/// The instances in a netlist, as a tree.
class InstanceTree {
 public:
  /// `netlist` is GHDL's Verilog.
  InstanceTree(std::string_view netlist, const std::set<std::string>& entities);

  /// Count the instances below `top` with one of these names, and all instances inside them; without names
  /// all instances. A name is an entity or a label. The label of a generate statement is a prefix of the
  /// label in the netlist.
  UnitCounts count(const std::string& top, const std::vector<std::string>& names = {}) const;

 private:
  struct Instance {
    std::string module, entity, label;
  };
  void add(const std::string& module, const std::vector<std::string>& names, UnitCounts& counts) const;
  std::map<std::string, std::vector<Instance>> instances_;  ///< by module
};

class UnitCounter {
 public:
  /// Fails if GHDL is missing or rejects the RTL.
  static Result<UnitCounter> open(const SimulatorFolders& folders);

  /// Count the entities below the top. Synthesizes the netlist or takes it from the cache.
  /// Throws Failure.
  UnitCounts count(const HardwareKey& key);
  /// Count the entities in the hardware `key` that only this effect needs. If the effect is not elaborated,
  /// count those that it would add.
  UnitCounts count(const HardwareKey& key, const PlannedEffect& effect);

 private:
  UnitCounter(GhdlLibrary library, std::set<std::string> entities)
      : library_(std::move(library)), entities_(std::move(entities)) {}
  InstanceTree tree(const HardwareKey& key) const;
  GhdlLibrary library_;
  std::set<std::string> entities_;
  std::map<std::string, UnitCounts> counted_;  ///< by the key's name
};

}  // namespace halfway
