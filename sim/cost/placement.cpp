// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

using nlohmann::json;

// The registers of a netlist for nextpnr, by the names of the logic cells that nextpnr packs them into.
class Registers {
 public:
  Registers(const json& module, const PlacedNames& types)
      : cells_(module.at("cells")), nets_(module.at("netnames")), types_(types) {}

  /// Name of the register's output in the RTL.
  std::string name(std::string cell) const {
    for (const std::string_view suffix : types_.packed)
      if (cell.ends_with(suffix)) {
        cell.erase(cell.size() - suffix.size());
        break;
      }
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return tidy(cell);
    const auto& pins = found->at("connections");
    if (is_register(*found)) return name_of(pins.at(types_.output).at(0));
    if (found->value("type", "") != types_.lut) return tidy(cell);
    const json& made = pins.at(types_.lut_output).at(0);
    for (const auto& other : cells_)
      if (is_register(other) && other.at("connections").at(types_.input).at(0) == made)
        return name_of(other.at("connections").at(types_.output).at(0));
    return name_of(made);
  }

 private:
  bool is_register(const json& cell) const { return cell.value("type", "").starts_with(types_.flip_flop); }

  // Remove the wrapper's prefix and Yosys's suffixes.
  std::string tidy(std::string_view name) const {
    if (name.starts_with("dut.")) name.remove_prefix(4);
    return std::string(name.substr(0, name.find(types_.mark)));
  }

  // Preference among several names: names of the RTL, then names made by GHDL, then names made by Yosys.
  int worth(std::string_view name) const {
    if (name.find(types_.mark) != std::string_view::npos) return 0;
    const std::string_view last = name.substr(name.rfind('.') + 1);
    const std::size_t end = std::min(last.find_first_not_of("0123456789", 1), last.size());
    const std::string_view ending = last.substr(end);
    // GHDL 6 writes n7, earlier versions n7_o, or n7_q for a register.
    if (last.starts_with('n') && end > 1 && (ending.empty() || ending == "_q" || ending == "_o")) return 1;
    return name.starts_with("dut.") ? 3 : 2;
  }

  std::string name_of(const json& bit) const {
    std::string best;
    for (const auto& [name, net] : nets_.items()) {
      const json& bits = net.at("bits");
      const auto at = std::find(bits.begin(), bits.end(), bit);
      if (at == bits.end() || net.value("hide_name", 0) != 0) continue;
      const std::string whole = bits.size() == 1 ? name : fmt::format("{}[{}]", name, at - bits.begin());
      const int more = worth(name) - (best.empty() ? -1 : worth(best.substr(0, best.find('['))));
      if (more > 0 || (more == 0 && whole.size() < best.size())) best = whole;
    }
    return tidy(best.empty() ? "?" : best);
  }

  const json& cells_;
  const json& nets_;
  const PlacedNames& types_;
};

bool is_product(const std::string& port, const PlacedNames& names) {
  return !names.product_output.empty() && port.starts_with(names.product_output);
}

CriticalPath read_path(const json& path, const Registers& registers, const PlacedNames& names) {
  CriticalPath result;
  for (const json& part : path) {
    const double delay = part.value("delay", 0.0);
    const std::string type = part.value("type", "");
    (type == "routing" ? result.routing : result.logic) += delay;
    if (type != "logic") continue;
    const std::string port = part.at("to").value("port", "");
    ++(port == names.carry_output ? result.carries
       : is_product(port, names)  ? result.multipliers
                                  : result.luts);
  }
  result.from = registers.name(path.front().at("from").value("cell", ""));
  result.to = registers.name(path.back().at("to").value("cell", ""));
  return result;
}

}  // namespace

std::vector<std::string> placer_command(const Device& device, int mhz, const std::vector<std::string>& more) {
  std::vector<std::string> command{std::string(device.placer)};
  command.insert(command.end(), device.options.begin(), device.options.end());
  command.insert(command.end(), {"--freq", std::to_string(mhz)});
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

Placement read_placement(std::string_view report, std::string_view netlist, unsigned seed,
                         const PlacedNames& names) {
  Placement placement{.seed = seed};
  const json figures = json::parse(report, nullptr, false);
  const json design = json::parse(netlist, nullptr, false);
  try {
    const Registers registers(design.at("modules").at("wrapped"), names);
    if (figures.at("fmax").size() != 1)
      throw_tool_failed("nextpnr reports {} clocks, not one", figures.at("fmax").size());
    const auto clock = figures.at("fmax").begin();
    placement.mhz = clock->at("achieved");
    for (const json& path : figures.at("critical_paths")) {
      const std::string edge = "posedge " + clock.key();
      if (path.value("from", "") != edge || path.value("to", "") != edge) continue;
      placement.path = read_path(path.at("path"), registers, names);
    }
  } catch (const json::exception& error) {
    throw_tool_failed("not what nextpnr 0.4 reports: {}", error.what());
  }
  return placement;
}

std::uint64_t read_packing(std::string_view said, const PlacedNames& names) {
  const std::size_t at = said.find(fmt::format("{}:", names.logic_cell));
  unsigned long long used = 0, there = 0;
  if (at == std::string_view::npos ||
      std::sscanf(std::string(said.substr(at + names.logic_cell.size() + 1, 40)).c_str(), "%llu / %llu",
                  &used, &there) != 2)
    throw_tool_failed("not what nextpnr 0.4 says of a device's utilisation:\n{}", said);
  return used;
}

}  // namespace halfway::synth
