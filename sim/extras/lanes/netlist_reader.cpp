// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/netlist_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

/// The value of a constant as Verilator prints it: `6'h2a`.
std::optional<std::uint64_t> to_number(std::string_view literal) {
  const std::size_t at = literal.find('h');
  if (at == std::string_view::npos) return std::nullopt;
  return std::strtoull(std::string(literal.substr(at + 1)).c_str(), nullptr, 16);
}

std::string name_of(pugi::xml_node node) {
  return node.attribute("name").value();
}

bool is(pugi::xml_node node, std::string_view kind) {
  return node.name() == kind;
}

class NetlistReader {
 public:
  explicit NetlistReader(LaneNetlist& netlist) : netlist_(netlist) {}

  void read() {
    const pugi::xml_node root = netlist_.document->child("verilator_xml").child("netlist");
    const pugi::xml_node module = root.find_child_by_attribute("module", "topModule", "1");
    const pugi::xml_node scope = module.child("topscope").child("scope");
    if (!scope) fail("Verilator's XML has no flattened module");
    read_types(root.child("typetable"));
    read_variables(module);
    for (const pugi::xml_node node : scope.children()) read_statement(node);
    finish();
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw_tool_failed("{}", what); }

  void read_types(pugi::xml_node table) {
    for (const pugi::xml_node type : table.children()) {
      const std::string id = type.attribute("id").value();
      if (is(type, "basicdtype")) {
        netlist_.type_widths[id] = static_cast<unsigned>(type.attribute("left").as_int() + 1);
      } else if (is(type, "unpackarraydtype")) {
        const pugi::xml_node range = type.child("range");
        const auto left = to_number(name_of(range.first_child()));
        const auto right = to_number(name_of(range.last_child()));
        if (!left || !right) fail("Verilator's XML: an array of unknown size");
        netlist_.arrays[id] = {type.attribute("sub_dtype_id").value(), std::max(*left, *right) + 1};
      }
    }
  }

  void read_variables(pugi::xml_node module) {
    for (const pugi::xml_node variable : module.children("var")) {
      const std::string name = name_of(variable);
      type_of_[name] = variable.attribute("dtype_id").value();
      if (std::string_view(variable.attribute("dir").value()) == "input")
        netlist_.inputs[name] = netlist_.type_widths[type_of_[name]];
    }
  }

  void read_statement(pugi::xml_node node) {
    if (is(node, "always"))
      read_always(node);
    else if (is(node, "contassign") || is(node, "assignalias"))
      read_assignment(node);
    else if (is(node, "initial"))
      read_tables(node);
    else if (!is(node, "varscope"))
      fail(fmt::format("the lanes do not support '{}' in a module", node.name()));
  }

  void read_always(pugi::xml_node node) {
    const pugi::xml_node edge = node.child("sentree").child("senitem");
    const bool rising = std::string_view(edge.attribute("edgeType").value()) == "POS";
    if (!rising || name_of(edge.child("varref")) != "clk" || edge.next_sibling())
      fail("the lanes do not support an 'always' without the clock's rising edge");
    for (pugi::xml_node at = node.child("sentree").next_sibling(); at; at = at.next_sibling()) {
      netlist_.clocked.push_back(at);
      read_targets(at);
    }
  }

  /// Each target of a clocked assignment is a register, or a memory if one of its elements is assigned.
  void read_targets(pugi::xml_node node) {
    if (is(node, "assigndly")) {
      const pugi::xml_node target = node.last_child();
      const bool element = is(target, "arraysel");
      const std::string name = name_of(element ? target.first_child() : target);
      const auto array = netlist_.arrays.find(type_of_[name]);
      if (element && array != netlist_.arrays.end()) {
        netlist_.memories[name] = {netlist_.type_widths[array->second.first], array->second.second};
      } else {
        netlist_.registers[name] = netlist_.type_widths[type_of_[name]];
      }
    }
    for (const pugi::xml_node inner : node.children()) read_targets(inner);
  }

  void read_assignment(pugi::xml_node node) {
    if (!is(node.last_child(), "varref"))
      fail("the lanes do not support an assignment to a part of a signal");
    const std::string name = name_of(node.last_child());
    if (is(node, "contassign") || name != name_of(node.first_child()))
      netlist_.drivers[name] = node.first_child();
  }

  void read_tables(pugi::xml_node initial) {
    for (const pugi::xml_node assign : initial.children()) {
      const pugi::xml_node datum = assign.first_child(), target = assign.last_child();
      if (is(target, "varref")) {
        netlist_.drivers[name_of(target)] = datum;
        continue;
      }
      const std::string name = name_of(target.first_child());
      const auto index = to_number(name_of(target.last_child())), value = to_number(name_of(datum));
      const auto array = netlist_.arrays.find(type_of_[name]);
      if (!is(target, "arraysel") || !index || !value || array == netlist_.arrays.end())
        fail(fmt::format("{}: the lanes do not support this initial value", name));
      LaneRom& rom = netlist_.roms[name];
      rom.width = netlist_.type_widths[array->second.first];
      rom.data.resize(array->second.second);
      if (*index >= rom.data.size() || rom.width > 2 * c_lane_word)
        fail(fmt::format("{}: a table too wide or too small", name));
      rom.data[*index] = *value;
    }
  }

  void finish() {
    // A signal without a driver is a register that never changes.
    for (const auto& [name, type] : type_of_) {
      const auto width = netlist_.type_widths.find(type);
      if (width != netlist_.type_widths.end() && netlist_.inputs.count(name) == 0 &&
          netlist_.drivers.count(name) == 0)
        netlist_.registers.emplace(name, width->second);
    }
    netlist_.inputs.erase("clk");
    for (const auto& [name, width] : netlist_.registers) netlist_.roms.erase(name);
    for (const auto& [name, memory] : netlist_.memories) {
      if (netlist_.roms.erase(name) != 0)
        fail(fmt::format("{}: the lanes do not support a memory with an initial value", name));
    }
    for (auto& [name, rom] : netlist_.roms) make_tables(rom);
  }

  /// One table per word of the data; the same table for equal words.
  void make_tables(LaneRom& rom) {
    for (unsigned low = 0; low < rom.width; low += c_lane_word) {
      std::vector<std::uint32_t> table;
      for (const std::uint64_t datum : rom.data) table.push_back(static_cast<std::uint32_t>(datum >> low));
      auto& tables = netlist_.tables;
      const auto same = std::find(tables.begin(), tables.end(), table);
      rom.tables.push_back(static_cast<std::size_t>(same - tables.begin()));
      if (same == tables.end()) tables.push_back(std::move(table));
    }
  }

  LaneNetlist& netlist_;
  std::map<std::string, std::string> type_of_;  ///< the type's number, by signal
};

}  // namespace

unsigned LaneNetlist::width_of(pugi::xml_node expression) const {
  const auto found = type_widths.find(expression.attribute("dtype_id").value());
  return found == type_widths.end() ? 0 : found->second;
}

LaneNetlist read_lane_netlist(std::string_view xml) {
  LaneNetlist netlist;
  netlist.document = std::make_unique<pugi::xml_document>();
  if (const auto parsed = netlist.document->load_buffer(xml.data(), xml.size()); !parsed)
    throw_tool_failed("Verilator's XML cannot be read: {}", parsed.description());
  NetlistReader(netlist).read();
  return netlist;
}

}  // namespace halfway
