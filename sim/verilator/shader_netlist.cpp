// SPDX-License-Identifier: Apache-2.0
#include "sim/verilator/shader_netlist.hpp"

#include "sim/verilator/netlist.hpp"

namespace halfway {
namespace {

Result<GhdlLibrary> library_of(const SimulatorFolders& folders) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  const auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  return GhdlLibrary::for_synthesis(*tool, *sources, folders.cache);
}

}  // namespace

Result<std::string> netlist_of(const HardwareKey& key, const SimulatorFolders& folders) {
  const auto library = library_of(folders);
  if (!library) return library.error();
  const auto netlist = library->synthesize(key.entity(), key.generics());
  if (!netlist) return netlist.error();
  return mend_netlist(*netlist);
}

Result<std::string> vhdl_netlist_of(const HardwareKey& key, const SimulatorFolders& folders) {
  const auto library = library_of(folders);
  if (!library) return library.error();
  return library->synthesize_vhdl(key.entity(), key.generics());
}

}  // namespace halfway
