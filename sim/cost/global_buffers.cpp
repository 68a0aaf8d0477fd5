// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/global_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

namespace halfway::synth {
namespace {

using nlohmann::ordered_json;  // keeps Yosys's order, because a placement depends on it
using Net = std::int64_t;

bool is_net(const ordered_json& bit) {
  return bit.is_number_integer();
}  // otherwise a constant, such as "0"

bool is_register(const ordered_json& cell) {
  return cell.at("type").get_ref<const std::string&>().starts_with("SB_DFF");
}

// std::nullopt if the pin is missing or constant.
std::optional<Net> net_at(const ordered_json& cell, const char* pin) {
  const ordered_json& pins = cell.at("connections");
  const auto found = pins.find(pin);
  if (found == pins.end() || found->empty() || !is_net(found->front())) return {};
  return found->front().get<Net>();
}

// The nets driven by the lookup tables of full sums.
std::set<Net> full_sums(const ordered_json& cells) {
  std::set<Net> carries, sums;
  for (const ordered_json& cell : cells)
    if (cell.at("type") == "SB_CARRY")
      if (const auto carry = net_at(cell, "CO")) carries.insert(*carry);
  for (const ordered_json& cell : cells) {
    if (cell.at("type") != "SB_LUT4") continue;
    const auto carry = net_at(cell, "I3"), sum = net_at(cell, "O");
    if (carry && sum && carries.contains(*carry) && net_at(cell, "I0") && net_at(cell, "I1") &&
        net_at(cell, "I2"))
      sums.insert(*sum);
  }
  return sums;
}

struct Enable {
  std::size_t sums = 0;
  std::string name;
  Net net = 0;
};

std::vector<Enable> chosen_enables(const ordered_json& module) {
  const ordered_json& cells = module.at("cells");
  const std::set<Net> sums = full_sums(cells);
  std::map<Net, Enable> enables;
  for (const ordered_json& cell : cells) {
    if (!is_register(cell)) continue;
    const auto enable = net_at(cell, "E"), input = net_at(cell, "D");
    if (enable && input && sums.contains(*input)) ++enables[*enable].sums;
  }
  for (const auto& [name, named] : module.at("netnames").items()) {
    const ordered_json& bits = named.at("bits");
    for (std::size_t i = 0; i < bits.size(); ++i) {
      const auto found = is_net(bits[i]) ? enables.find(bits[i].get<Net>()) : enables.end();
      if (found == enables.end()) continue;
      std::string whole = bits.size() == 1 ? name : fmt::format("{}[{}]", name, i);
      std::string& first = found->second.name;
      if (first.empty() || whole < first) first = std::move(whole);
    }
  }
  std::vector<Enable> chosen;
  for (auto& [net, enable] : enables) {
    enable.net = net;
    if (enable.sums >= c_least_sums) chosen.push_back(std::move(enable));
  }
  std::ranges::sort(chosen, [](const Enable& a, const Enable& b) {
    return std::tie(b.sums, a.name, a.net) < std::tie(a.sums, b.name, b.net);
  });
  chosen.resize(std::min(chosen.size(), c_enable_buffers));
  return chosen;
}

Net last_net(const ordered_json& module) {
  Net last = 0;
  const auto see = [&](const ordered_json& bits) {
    for (const ordered_json& bit : bits)
      if (is_net(bit)) last = std::max(last, bit.get<Net>());
  };
  for (const ordered_json& cell : module.at("cells"))
    for (const ordered_json& bits : cell.at("connections")) see(bits);
  for (const ordered_json& named : module.at("netnames")) see(named.at("bits"));
  return last;
}

// Insert a buffer between the net `from` and those of its pins that are loads of the buffer.
template <class IsLoad>
void insert_buffer(ordered_json& module, const std::string& name, Net from, const IsLoad& is_load) {
  const Net to = last_net(module) + 1;
  for (ordered_json& cell : module.at("cells"))
    for (auto& [pin, bits] : cell.at("connections").items())
      if (is_load(cell, pin)) std::replace(bits.begin(), bits.end(), ordered_json(from), ordered_json(to));
  const std::string buffer = name + "_SB_GB";
  module.at("cells")[buffer] = {
      {"hide_name", 0},
      {"type", "SB_GB"},
      {"parameters", ordered_json::object()},
      {"attributes", ordered_json::object()},
      {"port_directions", {{"USER_SIGNAL_TO_GLOBAL_BUFFER", "input"}, {"GLOBAL_BUFFER_OUTPUT", "output"}}},
      {"connections",
       {{"USER_SIGNAL_TO_GLOBAL_BUFFER", ordered_json::array({from})},
        {"GLOBAL_BUFFER_OUTPUT", ordered_json::array({to})}}}};
  module.at("netnames")[buffer + "_O"] = {
      {"hide_name", 0}, {"bits", ordered_json::array({to})}, {"attributes", ordered_json::object()}};
}

}  // namespace

Result<std::string> with_global_buffers(std::string_view netlist) {
  try {
    ordered_json design = ordered_json::parse(netlist);
    ordered_json& module = design.at("modules").at("wrapped");
    const Net clock = module.at("ports").at("clk").at("bits").at(0).get<Net>();
    const std::vector<Enable> enables = chosen_enables(module);
    insert_buffer(module, "clk", clock, [](const ordered_json& cell, const std::string& pin) {
      return cell.at("port_directions").at(pin) == "input";
    });
    for (const Enable& enable : enables)
      insert_buffer(module, enable.name, enable.net, [](const ordered_json& cell, const std::string& pin) {
        return is_register(cell) && pin == "E";
      });
    return design.dump();
  } catch (const ordered_json::exception& error) {
    return tool_failed(fmt::format("not a netlist to place, by Yosys with a clock clk: {}", error.what()));
  }
}

}  // namespace halfway::synth
