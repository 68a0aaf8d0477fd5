// SPDX-License-Identifier: Apache-2.0
// Tests of `halfway verilog`: the files, the comment at their start, and refused options. tb/project/verilog
// simulates them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/cli/command_test.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* c_scene = HALFWAY_SOURCE_DIR "/sim/report/timing.toml";

class VerilogCommand : public CommandTest {
 protected:
  std::string written(const std::string& file) const {
    return text_of("v/quadratic_shader-published-c1/" + file);
  }
  Outcome write_verilog(std::vector<std::string> more) const {
    more.insert(more.begin(), {"verilog", c_scene, "--preset", "published", "--out", "v"});
    return run(std::move(more));
  }
};

TEST_F(VerilogCommand, WritesTheShaderWithAListOfItsPorts) {
  EXPECT_THAT(
      write_verilog({}),
      Ends(0, HasSubstr("halfway_quadratic_shader.v: module halfway_quadratic_shader with 16 ports\n")));
  EXPECT_EQ(written("halfway_quadratic_shader.f"), "halfway_quadratic_shader.v\n");
  EXPECT_THAT(
      written("halfway_quadratic_shader.v"),
      AllOf(StartsWith("// SPDX-License-Identifier: Apache-2.0\n// halfway_quadratic_shader, hardware key "
                       "quadratic_shader-published-c1: written by Halfway "),
            HasSubstr("--shader quadratic --preset published\n"),
            HasSubstr("\n// Generics: g_exact=false g_channels=1 g_degree=2\n"),
            HasSubstr("\n// Ports, in this order:\n//   input       1  clk\n//   input       1  reset\n//   "
                      "input       1  init_valid\n"),
            HasSubstr("\n//   input     497  init_data\n"), HasSubstr("\n//   output      1  init_ready\n"),
            HasSubstr("\n//   output     12  fragment_y\n"),
            HasSubstr("\nmodule halfway_quadratic_shader\n")));
}

TEST_F(VerilogCommand, WritesTheTopWithAxiStreamPorts) {
  EXPECT_THAT(write_verilog({"--axi"}), Ends(0, ::testing::_));
  EXPECT_EQ(written("halfway_words_to_fragments.f"), "halfway_words_to_fragments.v\n");
  EXPECT_THAT(written("halfway_words_to_fragments.v"),
              AllOf(HasSubstr("--preset published --axi --multiplier-bits 18\n"),
                    HasSubstr("\n//   input      32  s_axis_tdata\n"),
                    HasSubstr("\n//   output    128  m_axis_tdata\n"),
                    HasSubstr("\nmodule halfway_words_to_fragments\n")));
}

TEST_F(VerilogCommand, WritesTheWholeCore) {
  EXPECT_THAT(write_verilog({"--core", "--format", "xrgb8888", "--bus", "32"}), Ends(0, ::testing::_));
  EXPECT_THAT(
      written("halfway_core.v"),
      AllOf(HasSubstr("--core --format xrgb8888 --bus 32 --multiplier-bits 18\n"),
            HasSubstr("g_true_colour=true g_bus_bits=32"), HasSubstr("\n//   output     32  m_axi_wdata\n"),
            HasSubstr("\nmodule halfway_core\n"), HasSubstr("\nmodule halfway_packet_reader")));
  EXPECT_THAT(write_verilog({"--axi", "--bus", "32"}), Ends(2, HasSubstr("--core")));
}

TEST_F(VerilogCommand, RefusesScenesAndShadersThatDoNotExist) {
  EXPECT_THAT(run({"verilog", "nothing"}), Ends(2, HasSubstr("nothing")));
  EXPECT_THAT(write_verilog({"--shader", "raytracer"}), Ends(2, HasSubstr("'raytracer'")));
  EXPECT_FALSE(std::filesystem::exists(at("v")));
}

}  // namespace
}  // namespace halfway
