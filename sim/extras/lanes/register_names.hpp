// SPDX-License-Identifier: Apache-2.0
// Names of registers as in the RTL: path of blocks and instances, signal and field of its record. GHDL's
// netlist numbers registers and flattens records. Printed as VHDL it has the position in the RTL above each
// line; where a line takes bits from a signal, the field's name is at that position.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace halfway {

class RegisterNames {
 public:
  /// Without names: registers have the netlist's.
  RegisterNames() = default;
  /// `netlist`: in VHDL, as GHDL prints it. `source`: the folder of the RTL's files. Fields in files that
  /// cannot be read have no names.
  RegisterNames(std::string_view netlist, const std::filesystem::path& source);

  /// The name of bits of a register of `bits` bits, for example walker/span_stage/r.x, or r.x(3 downto 0).
  /// `signal` is the name in the flattened netlist: top, instances and register, with dots.
  std::string name(std::string_view signal, unsigned bits, unsigned low, unsigned width) const;

  /// The path of a whole signal, for example walker/spans/valid.
  std::string path(std::string_view signal) const;

  /// All names, for the key of a cache.
  std::string text() const;

 private:
  struct Entity {
    std::map<std::string, unsigned> copies;        ///< first index of each `for ... generate`, by its label
    std::set<std::string> blocks;                  ///< labels of each `if ... generate`
    std::set<std::string> own;                     ///< names of instances and signals in the RTL
    std::map<std::string, std::string> instances;  ///< their entities
    std::map<std::string, std::string> signals;    ///< that have a register's value, by the register
    /// By signal and by lowest bit and width.
    std::map<std::string, std::map<std::pair<unsigned, unsigned>, std::string>> fields;
  };
  class Reader;
  /// A signal's entity, the path of the entity's instance, and the signal's name there.
  struct Place {
    const Entity* entity;  ///< nullptr if unknown
    std::string instance, signal;
  };
  Place place_of(std::string_view signal) const;
  static std::string path_of(const Entity* entity, std::string name);
  std::map<std::string, Entity> entities_;
};

}  // namespace halfway
