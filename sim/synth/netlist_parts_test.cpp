// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/netlist_parts.hpp"

#include <gtest/gtest.h>

namespace halfway::synth {
namespace {

// The top contains `middle` and `other`; `middle` contains `leaf_4`.
constexpr const char* c_parts_netlist =
    "module leaf_4\n  (input  x);\nendmodule\n\nmodule other\n  (input  x);\nendmodule\n\n"
    "module middle\n  (input  x);\n  leaf_4 inner (\n    .x(x));\nendmodule\n\n"
    "module top\n  (input  x);\n  other first (\n    .x(x));\n  middle second (\n    .x(x));\nendmodule\n\n";

TEST(NetlistParts, ContainWhatTheyInstantiate) {
  const auto parts = parts_of(c_parts_netlist);
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts[0].module, "leaf_4");
  EXPECT_EQ(parts[1].netlist, "module other\n  (input  x);\nendmodule\n\n");
  EXPECT_EQ(parts[2].module, "middle");
  EXPECT_EQ(parts[2].netlist,
            parts[0].netlist + "module middle\n  (input  x);\n  leaf_4 inner (\n    .x(x));\nendmodule\n\n");
  EXPECT_EQ(parts[3].netlist, c_parts_netlist);
}

}  // namespace
}  // namespace halfway::synth
