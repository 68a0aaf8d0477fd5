// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/design.hpp"

#include <gtest/gtest.h>

#include <map>
#include <regex>

namespace halfway::synth {
namespace {

// The top contains `middle` and `leaf_8`; `middle` contains `leaf_4_0a`, which GHDL writes after it.
const std::string c_leaf =
    "module leaf_4_0a\n  (input  x);\n  wire n7_o;\n  assign n7_o = n7_o & n9;\nendmodule\n";
const std::string c_middle = "module middle\n  (input  x);\n  leaf_4_0a inner (\n    .x(n7_o));\nendmodule\n";
const std::string c_other = "module leaf_8\n  (input  x);\n  assign n3_q = 8'b00000001;\nendmodule\n";
const std::string c_top =
    "module top\n  (input  x);\n  leaf_8 first (\n    .x(x));\n  middle second (\n    .x(x));\nendmodule\n";

std::string with(const std::string& text, const std::string& from, const std::string& to) {
  return std::regex_replace(text, std::regex(from), to);
}

TEST(NetlistIdentity, IgnoresNumbersAndNamesOfModules) {
  const std::string netlist = c_middle + c_leaf + c_other + c_top, identity = netlist_identity(netlist);
  EXPECT_EQ(netlist_identity(with(netlist, "n7_o", "n123_o")), identity);
  EXPECT_EQ(netlist_identity(with(netlist, "leaf_4_0a", "leaf_4_ff")), identity);
  // The same number in two modules is two nets.
  EXPECT_EQ(netlist_identity(c_middle + with(c_leaf, "n7_o", "n1_o") + c_other + c_top), identity);
}

TEST(NetlistIdentity, DistinguishesHardware) {
  const std::string netlist = c_middle + c_leaf + c_other + c_top, identity = netlist_identity(netlist);
  for (const auto& [from, to] : std::map<std::string, std::string>{{"n7_o & n9", "n9 & n7_o"},
                                                                   {"n7_o & n9", "n7_o & n7_o"},
                                                                   {"n7_o & n9", "n7_o | n9"},
                                                                   {"00001;", "00011;"},
                                                                   {"  leaf_8 first", "  middle first"},
                                                                   {"\\(input  x\\)", "(input  y)"}})
    EXPECT_NE(netlist_identity(with(netlist, from, to)), identity) << from << " -> " << to;
}

}  // namespace
}  // namespace halfway::synth
