// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/cost.hpp"

namespace halfway::synth {
namespace {

void add_tools(Cost& cost, const std::string& tools) {
  if (!cost.tools.empty()) cost.tools += ", ";
  cost.tools += tools;
}

}  // namespace

double cell_count(const Cells& cells) {
  constexpr double c_lut_bits = 16;
  return static_cast<double>(cells.luts + cells.flip_flops + cells.multiplier_luts) +
         static_cast<double>(cells.memory_bits) / c_lut_bits;
}

// Generic cells already show that some hardware is too large for the device, because every cell takes at
// least one logic cell. This avoids minutes and gigabytes of synthesis for the device. Products are in logic
// cells only if the device has no multipliers.
void Costing::take_size(Cost& cost) const {
  const Device& device = *family_.device;
  if (cost.mhz || !cost.fits) return;
  std::string why = does_not_fit(device, "flip-flops", cost.cells->flip_flops, device.cells);
  if (why.empty() && device.multipliers == 0)
    why = does_not_fit(device, "LUTs of multipliers", cost.cells->multiplier_luts, device.cells);
  if (why.empty()) return;
  cost.clock = std::move(why);
  cost.fits = false;
}

void Costing::add_placement(const Synthesizer& synthesizer, const Design& design, Cost& cost) const {
  const Clock clock = synthesizer.clock(design, c_seeds);
  cost.device_cells = synthesizer.cells(design, family_);
  add_tools(cost, "placed with " + synthesizer.versions());
  if (const Placement* median = clock.median(); median != nullptr) {
    cost.mhz = median->mhz;
    cost.clock = c_placed;
  } else {
    cost.clock = clock.none;
    cost.fits = clock.endless > 0;
  }
}

Cost Costing::stored(const Design& design) const {
  Cost cost{.device = std::string(family_.device->title)};
  auto found = clock_of(clocks_, netlist_identity(netlist_of(design, cache_)));
  const bool is_of_this_netlist = found != clocks_.end();
  if (!is_of_this_netlist) found = clock_by_other_ghdl(clocks_, hardware_text(design), ghdl_);
  if (found == clocks_.end()) return cost;
  const StoredClock& stored = found->second;
  cost.device_cells = stored.cells;
  cost.fits = stored.mhz > 0;
  if (cost.fits) {
    cost.mhz = stored.mhz;
    cost.clock = c_stored;
  } else {
    cost.clock = does_not_fit(*family_.device, stored.cells);
    if (cost.clock.empty()) cost.clock = "too full, or nextpnr does not end";
  }
  add_tools(cost, "placed with " + stored.tools +
                      (is_of_this_netlist ? "" : ", from a netlist that this GHDL does not write"));
  return cost;
}

Cost Costing::of(const Design& design, bool place) const {
  Cost cost = stored(design);
  if (!find_program("yosys").empty()) {
    const Synthesizer synthesizer = Synthesizer::open(cache_, place, family_);
    cost.cells = synthesizer.generic_cells(design);
    add_tools(cost, "cells by " + synthesizer.yosys_version());
    take_size(cost);
    if (place && !cost.mhz && cost.fits) add_placement(synthesizer, design, cost);
  }
  return cost;
}

}  // namespace halfway::synth
