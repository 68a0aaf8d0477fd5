// SPDX-License-Identifier: Apache-2.0
#include "sim/verilator/shader_netlist.hpp"

#include "sim/verilator/netlist.hpp"

namespace halfway {

Result<GhdlLibrary> rtl_library(const SimulatorFolders& folders) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  const auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  return GhdlLibrary::for_synthesis(*tool, *sources, folders.cache);
}

Result<std::string> netlist_of(const HardwareKey& key, const SimulatorFolders& folders) {
  const auto library = rtl_library(folders);
  if (!library) return library.error();
  const auto netlist = library->synthesize(key.entity(), key.generics());
  if (!netlist) return netlist.error();
  return mend_netlist(*netlist);
}

}  // namespace halfway
