// SPDX-License-Identifier: Apache-2.0
// Draws a small frame with the netlist after synthesis: lookup tables, flip-flops, multipliers.
// Every fragment must be equal to the golden model's.
#include <gtest/gtest.h>

#include <ostream>

#include "plan/plan.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/driver/limits.hpp"
#include "sim/engines/verilator/verilator_simulator.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::synth {
namespace {

constexpr FrameSize c_frame{16, 12};

struct Drawn {
  const char* scene;
  Shader shader;
  Preset preset;
  std::uint32_t stall_seed;  ///< 0: full speed
  ProcessorForm form = ProcessorForm::unrolled;
  const Family* family = &c_ice40;
};
void PrintTo(const Drawn& drawn, std::ostream* out) {
  *out << drawn.scene << ' ' << to_string(drawn.shader) << ' ' << to_string(drawn.preset) << ' '
       << drawn.family->name;
}

class MappedFrame : public ::testing::TestWithParam<Drawn> {};

TEST_P(MappedFrame, EqualsTheGoldenModels) {
  ASSERT_FALSE(find_program("yosys").empty()) << "no yosys: " << c_install_tools;
  const std::filesystem::path source = HALFWAY_SOURCE_DIR;
  const SimulatorFolders folders{source, HALFWAY_CACHE_DIR};
  const Scene scene = must(load_scene(GetParam().scene, source / "sim" / "scenes"));
  PlanRequest request{.shader = GetParam().shader, .preset = GetParam().preset};
  if (request.shader == Shader::processors) request.form = GetParam().form;
  const HardwareKey key = must(plan_scene(scene, request)).key;

  const std::string netlist =
      Synthesizer::open(folders.cache, false, *GetParam().family).simulated(design_of(key, folders.source));
  const auto simulator = must(shared_engine(VerilatorSimulator::open(
      key, folders, {.stall_seed = GetParam().stall_seed, .idle_limit = c_idle_limit, .netlist = netlist})));

  FrameDriver driver(scene, c_frame, key, {simulator});
  must(driver.draw());
  ASSERT_GT(driver.fragments(), 20U);
  must(driver.equal());
}

INSTANTIATE_TEST_SUITE_P(Small, MappedFrame,
                         ::testing::Values(Drawn{"matte", Shader::quadratic, Preset::exact, 7},
                                           Drawn{"matte", Shader::quadratic, Preset::published, 7}));
INSTANTIATE_TEST_SUITE_P(Whole, MappedFrame,
                         ::testing::Values(Drawn{"spheres", Shader::spherical, Preset::published, 0},
                                           Drawn{"spheres", Shader::spherical, Preset::exact, 7},
                                           Drawn{"spheres", Shader::quadratic, Preset::exact, 0},
                                           Drawn{"spheres", Shader::quadratic, Preset::published, 0},
                                           Drawn{"matte", Shader::processors, Preset::published, 7,
                                                 ProcessorForm::folded}));
// The spherical shader of preset exact has RAMs there, for which Yosys has no model.
INSTANTIATE_TEST_SUITE_P(
    WholeEcp5, MappedFrame,
    ::testing::Values(
        Drawn{"spheres", Shader::quadratic, Preset::exact, 0, ProcessorForm::unrolled, &c_ecp5},
        Drawn{"spheres", Shader::spherical, Preset::published, 7, ProcessorForm::unrolled, &c_ecp5},
        Drawn{"matte", Shader::processors, Preset::published, 7, ProcessorForm::folded, &c_ecp5},
        Drawn{"matte", Shader::processors, Preset::published, 0, ProcessorForm::unrolled, &c_ecp5}));

}  // namespace
}  // namespace halfway::synth
