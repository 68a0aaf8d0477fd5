// SPDX-License-Identifier: Apache-2.0
// The form of halfway.core. FuseSoC is no package of Debian 12: the hosted CI runs it.
#include "sim/generator/core_file.hpp"

#include <gtest/gtest.h>

namespace halfway::tables {
namespace {

TEST(CoreFile, ListsTheFilesInTheirOrder) {
  EXPECT_EQ(core_text("b/x_pkg.vhd\n# comment\n\na/words_to_fragments.vhd\n", "1.2.3"),
            "CAPI=2:\n"
            "# SPDX-License-Identifier: Apache-2.0\n"
            "# For FuseSoC. Made by `make tables` from rtl/files.f: change that file.\n"
            "name: ::halfway:1.2.3\n"
            "description: Shading hardware between Gouraud and Phong, with AXI4-Stream ports\n\n"
            "filesets:\n"
            "  rtl:\n"
            "    file_type: vhdlSource-2008\n"
            "    logical_name: halfway\n"
            "    files:\n"
            "      - rtl/b/x_pkg.vhd\n"
            "      - rtl/a/words_to_fragments.vhd\n\n"
            "targets:\n"
            "  default:\n"
            "    filesets: [rtl]\n"
            "  # Analyses all files in their order and elaborates a top.\n"
            "  check:\n"
            "    default_tool: ghdl\n"
            "    filesets: [rtl]\n"
            "    toplevel: halfway.words_to_fragments\n");
}

}  // namespace
}  // namespace halfway::tables
