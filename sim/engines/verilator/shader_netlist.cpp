// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/verilator/shader_netlist.hpp"

#include "sim/engines/verilator/netlist.hpp"
#include "sim/os/must.hpp"

namespace halfway {

Result<GhdlLibrary> rtl_library(const SimulatorFolders& folders) try {
  const GhdlTool tool = must(GhdlTool::find());
  return GhdlLibrary::for_synthesis(tool, must(read_rtl_sources(folders.source)), folders.cache);
} catch (const Failure& failure) {
  return failure.error;
}

Result<std::string> netlist_of(const HardwareKey& key, const SimulatorFolders& folders) try {
  return mend_netlist(must(must(rtl_library(folders)).synthesize(key.entity(), key.generics())));
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway
