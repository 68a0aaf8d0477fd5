// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/verilator/shader_netlist.hpp"

#include "sim/engines/verilator/netlist.hpp"
#include "sim/os/must.hpp"

namespace halfway {

GhdlLibrary rtl_library(const SimulatorFolders& folders) {
  return must(GhdlLibrary::for_synthesis(must(GhdlTool::find()), must(read_rtl_sources(folders.source)),
                                         folders.cache));
}

std::string netlist_of(const HardwareKey& key, const SimulatorFolders& folders) {
  return must(mend_netlist(must(rtl_library(folders).synthesize(key.entity(), key.generics()))));
}

}  // namespace halfway
