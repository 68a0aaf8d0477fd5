// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/vcd.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class VcdTest : public FolderTest {
 protected:
  // The clock rises at 5 and 15. q changes with it, d in between.
  const std::filesystem::path file_ =
      write("t.vcd",
            "$date\n  today\n$end\n$timescale\n  1 fs\n$end\n$scope module tb $end\n"
            "$var reg 1 ! clk $end\n$var reg 4 \" d[3:0] $end\n$scope module dut $end\n"
            "$var reg 4 # q[3:0] $end\n$upscope $end\n$upscope $end\n$enddefinitions $end\n"
            "#0\n0!\nb0001 \"\nbUUUU #\n#5\n1!\nb0001 #\n#10\n0!\nb0010 \"\n#15\n1!\nb0010 #\n#20\n0!\n");
};

TEST_F(VcdTest, SamplesTheValueBeforeTheEdge) {
  const auto sampled = must(sample_vcd(file_, "tb/clk", {"tb/d", "tb/dut/q"}, 10));
  EXPECT_EQ(sampled.edges, 2U);
  EXPECT_THAT(sampled.values.at("tb/d"), ElementsAre("0001", "0010"));
  EXPECT_THAT(sampled.values.at("tb/dut/q"), ElementsAre("UUUU", "0001"));
  EXPECT_EQ(sample_vcd(file_, "tb/clk", {"tb/d"}, 1)->values.at("tb/d").size(), 1U);
}

TEST_F(VcdTest, ReportsAMissingSignal) {
  EXPECT_THAT(sample_vcd(file_, "tb/clk", {"tb/q"}, 1).error().message, HasSubstr("no signal tb/q"));
  EXPECT_THAT(sample_vcd(file_, "tb/clock", {"tb/d"}, 1).error().message, HasSubstr("no clock tb/clock"));
}

}  // namespace
}  // namespace halfway
