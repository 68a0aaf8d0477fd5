// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live/hardware_module.hpp"

#include "sim/driver/shader_stages.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/extras/lanes/lane_simulator.hpp"
#include "sim/os/must.hpp"

namespace halfway {

std::filesystem::path build_hardware_module(const HardwareKey& key, const SimulatorFolders& folders) {
  LaneBuild build = lane_build_of(key, folders);
  build.harness = folders.source / "sim/extras/live/hardware_harness.cpp";
  build.target = LaneTarget::web_assembly;
  const GhdlLibrary library = rtl_library(folders);
  build.names = RegisterNames(must(library.synthesize_vhdl(key.entity(), key.generics())), library.folder());
  build.ports.top = build.top;
  for (const TracedPart& part : make_stages(key)->parts())
    build.ports.observed.push_back(
        {part.netlist_path, static_cast<unsigned>(part.low), static_cast<unsigned>(part.bits)});
  return build_lanes(build, folders.cache);
}

}  // namespace halfway
