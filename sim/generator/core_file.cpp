// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/core_file.hpp"

#include <fmt/format.h>

#include <sstream>

namespace halfway::tables {

std::string core_text(std::string_view files, std::string_view version) {
  std::string text = fmt::format(
      "CAPI=2:\n"
      "# SPDX-License-Identifier: Apache-2.0\n"
      "# For FuseSoC. Made by `make tables` from rtl/files.f: change that file.\n"
      "name: ::halfway:{}\n"
      "description: Shading hardware between Gouraud and Phong, with AXI4-Stream ports or as a core with "
      "AXI4\n\n"
      "filesets:\n"
      "  rtl:\n"
      "    file_type: vhdlSource-2008\n"
      "    logical_name: halfway\n"
      "    files:\n",
      version);
  std::istringstream lines{std::string(files)};
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line.front() != '#') text += fmt::format("      - rtl/{}\n", line);
  return text +
         "\ntargets:\n"
         "  default:\n"
         "    filesets: [rtl]\n"
         "  # Analyses all files in their order and elaborates the core, which contains words_to_fragments.\n"
         "  check:\n"
         "    default_tool: ghdl\n"
         "    filesets: [rtl]\n"
         "    toplevel: halfway.halfway_core\n";
}

}  // namespace halfway::tables
