// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/lane_generator.hpp"

#include <utility>

#include "sim/extras/lanes/cell_layout.hpp"
#include "sim/extras/lanes/emitter.hpp"
#include "sim/extras/lanes/graph_builder.hpp"
#include "sim/extras/lanes/netlist_reader.hpp"
#include "sim/extras/lanes/schedule.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

struct Steps {
  Step step, reset_step;
};

/// Builds the graphs until the layout no longer changes.
Steps build_steps(const LaneNetlist& netlist, const LanePorts& ports, CellLayout& layout) {
  layout.memory_words = place_memories(netlist.memories, {}, {});
  while (true) {
    CellLayout next = layout;
    Step step = build_step(netlist, ports, false, next);
    if (next != layout) {  // the reset step is built only with a layout that suits the other one
      layout = std::move(next);
      continue;
    }
    Step reset_step = build_step(netlist, ports, true, next);
    note_twins(next, step, reset_step);
    next.memory_words = place_memories(netlist.memories, step, reset_step);
    if (next == layout && layout.words) return {std::move(step), std::move(reset_step)};
    next.words = layout.words || next == layout;
    layout = std::move(next);
  }
}

/// The observed parts with their signals' names in the netlist as paths.
std::vector<ObservedPart> in_netlist(const LanePorts& ports, const LaneNetlist& netlist,
                                     const RegisterNames& names) {
  std::vector<ObservedPart> parts = ports.observed;
  if (parts.empty()) return parts;
  // Verilator omits the top in the names of its ports and of ports of instances.
  const std::string top = ports.top + '.';
  std::map<std::string, std::string> by_path;
  const auto add = [&](const std::string& name) {
    by_path.emplace(names.path(name.starts_with(top) ? name : top + name), name);
  };
  for (const auto& [name, width] : netlist.inputs) add(name);
  for (const auto& [name, driver] : netlist.drivers) add(name);
  for (ObservedPart& part : parts) {
    const auto name = by_path.find(part.path);
    if (name == by_path.end()) throw_tool_failed("{}: the netlist has no such signal to observe", part.path);
    part.path = name->second;
  }
  return parts;
}

}  // namespace

Result<std::string> generate_lanes(std::string_view xml, const LanePorts& rtl_ports,
                                   const RegisterNames& names) try {
  LaneNetlist netlist = read_lane_netlist(xml);
  LanePorts ports = rtl_ports;
  ports.observed = in_netlist(rtl_ports, netlist, names);
  netlist.inputs.erase("reset");
  for (const auto& fixed : ports.fixed) netlist.inputs.erase(fixed.first);

  CellLayout layout;
  auto [step, reset_step] = build_steps(netlist, ports, layout);
  const CellSet live = live_cells(step, layout.memory_words);
  const Delays delays = find_delays(step, reset_step, live);
  Schedule schedule = make_schedule(step, layout.memory_words, live, delays);
  Schedule reset_schedule = make_schedule(reset_step, layout.memory_words, live, delays);
  return emit_lanes({.netlist = netlist,
                     .names = names,
                     .memory_words = layout.memory_words,
                     .live = live,
                     .delays = delays},
                    {std::move(step), std::move(schedule)},
                    {std::move(reset_step), std::move(reset_schedule)});
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway
