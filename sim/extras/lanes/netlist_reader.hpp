// SPDX-License-Identifier: Apache-2.0
// Phase 1 of the lane generator: finds the inputs, registers, tables and memories in the XML that Verilator
// writes of a flattened netlist.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/extras/lanes/lane_graph.hpp"

namespace halfway {

/// A table that is never written.
struct LaneRom {
  unsigned width = 0;  ///< of a datum, in bits: two words at most
  std::vector<std::uint64_t> data;
  std::vector<std::size_t> tables;  ///< of its words, the least significant first
};

/// A memory that is written; each lane has its own.
struct LaneMemory {
  unsigned width = 0;  ///< of a datum, in bits
  std::size_t places = 0;
  std::size_t words() const { return (width + c_lane_word - 1) / c_lane_word; }
};

/// A netlist by the names of its signals. Expressions stay nodes of the document.
struct LaneNetlist {
  std::unique_ptr<pugi::xml_document> document;
  std::map<std::string, unsigned> type_widths;                        ///< by the type's number
  std::map<std::string, std::pair<std::string, std::size_t>> arrays;  ///< element type and length, by type
  std::map<std::string, unsigned> inputs;                             ///< width
  std::map<std::string, unsigned> registers;                          ///< width
  std::map<std::string, pugi::xml_node> drivers;                      ///< the expression assigned to a wire
  std::vector<pugi::xml_node> clocked;                                ///< the statements of `always` blocks
  std::map<std::string, LaneRom> roms;
  std::vector<std::vector<std::uint32_t>> tables;  ///< the words of all roms; equal ones exist once
  std::map<std::string, LaneMemory> memories;

  /// The width of an expression in bits, 0 if unknown.
  unsigned width_of(pugi::xml_node expression) const;
};

/// `clk` is no input of the result. A construct that the lanes do not support is a Failure that names it
/// (exit code tool_failed).
LaneNetlist read_lane_netlist(std::string_view xml);

}  // namespace halfway
