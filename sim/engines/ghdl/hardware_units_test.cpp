// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/hardware_units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/plan.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

using testing::IsEmpty;
using testing::Not;

constexpr const char* c_netlist =
    "module box_4\n  (input  a);\n  assign b = a;\nendmodule\n"
    "module pair_9\n  (input  a);\n  box_4 left (\n    .a(a));\n  box_4 right (\n    .a(a));\nendmodule\n"
    "module top\n  (input  a);\n  pair_9 units_n1_first (\n    .a(a));\n  pair_9 units_n2_first (\n    "
    ".a(a));\n"
    "  box_4 units_n10_last (\n    .a(a));\n  big_box_2 single (\n    .a(a));\n  assign c = box_4 (\n  "
    "wire_4 w (\n"
    "endmodule\n";

InstanceTree tree() {
  return {c_netlist, {"box", "big_box", "pair", "top"}};
}

TEST(InstanceTree, CountsInstancesAtEveryDepth) {
  EXPECT_EQ(tree().count("top"), (UnitCounts{{"big_box", 1}, {"box", 5}, {"pair", 2}}));
  EXPECT_EQ(tree().count("pair_9"), (UnitCounts{{"box", 2}}));
  EXPECT_THAT(tree().count("box_4"), IsEmpty());
}

TEST(InstanceTree, CountsNamedInstancesAndWhatIsBelowThem) {
  EXPECT_EQ(tree().count("top", {"pair"}), (UnitCounts{{"box", 4}, {"pair", 2}}));
  EXPECT_EQ(tree().count("top", {"units_n1"}), (UnitCounts{{"box", 2}, {"pair", 1}}));
  EXPECT_EQ(tree().count("top", {"left", "single"}), (UnitCounts{{"big_box", 1}, {"box", 2}}));
  EXPECT_THAT(tree().count("top", {"none"}), IsEmpty());
}

Plan plan_of(const std::string& name, Shader shader, Preset preset) {
  return must(plan_scene(built_in_scene(name), {.shader = shader, .preset = preset}));
}

class HardwareUnits : public ::testing::Test {
 protected:
  UnitCounts units(const HardwareKey& key) { return counter_.count(key); }
  UnitCounts units(const Plan& plan, Effect of) {
    return counter_.count(plan.key, plan.effects.at(static_cast<std::size_t>(of)));
  }
  UnitCounter counter_ = must(UnitCounter::open(c_checkout));
};

TEST_F(HardwareUnits, OfEffectsOfTheProcessors) {
  const Plan plan = plan_of("spheres", Shader::processors, Preset::published);
  const UnitCounts all = units(plan.key), ambient = units(plan, Effect::ambient);
  EXPECT_EQ(ambient.at("unrolled_shading_processor"), 1);
  EXPECT_GT(all.at("unrolled_shading_processor"), 2);
  const UnitCounts powers = units(plan, Effect::exponents);
  EXPECT_EQ(powers.at("power"), all.at("power"));
  EXPECT_EQ(powers.at("function_rom"), 2 * powers.at("power"));
}

TEST_F(HardwareUnits, ContainOnlyWhatTheSceneNeeds) {
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const auto expect_none = [&](const HardwareKey& key, const std::vector<std::string>& entities) {
      for (const std::string& entity : entities)
        EXPECT_FALSE(units(key).contains(entity)) << key.name() << " has a " << entity;
    };
    const Plan quadratic = plan_of("matte", Shader::quadratic, preset);
    EXPECT_EQ(units(quadratic.key).at("quadratic_interpolator"), 1);
    EXPECT_EQ(units(quadratic, Effect::colour).at("quadratic_interpolator"), 2);
    Plan spherical = plan_of("matte", Shader::spherical, preset);
    expect_none(spherical.key, {"specular_slice", "quadratic_interpolator"});
    EXPECT_TRUE(units(spherical.everything).contains("specular_slice"));
    // No light and no reflection.
    spherical.key.spherical.lights = 0;
    spherical.key.spherical.diffuse = false;
    expect_none(spherical.key,
                {"specular_slice", "diffuse_slice", "cosine_rom", "angle_address", "multiplier"});
    for (const ProcessorForm form : {ProcessorForm::folded, ProcessorForm::unrolled}) {
      Plan processors = plan_of("matte", Shader::processors, preset);
      processors.called_for.processors.form = processors.everything.processors.form = form;
      const std::vector<std::string> of_effects = {"power", "spot_cone"};
      expect_none(processors.called_for, of_effects);
      expect_none(processors.everything, {"object_processor"});
      for (const std::string& entity : of_effects)
        EXPECT_TRUE(units(processors.everything).contains(entity)) << entity;
      // Version I of the paper does not normalize vectors.
      if (preset == Preset::published)
        expect_none(processors.called_for,
                    {"reciprocal_root", "vector_shift", "function_rom", "unit_vector"});
    }
  }
}

// An elaborated effect has units. Adding another effect adds units.
TEST_F(HardwareUnits, BelongToEveryEffectOfTheHardware) {
  for (const Shader shader : c_shaders)
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const Plan plan = plan_of("spheres", shader, preset);
      for (const PlannedEffect& e : plan.effects) {
        SCOPED_TRACE(plan.key.name() + ": " + to_string(e.effect));
        if (e.elaborated || e.other)
          EXPECT_THAT(units(plan, e.effect), Not(IsEmpty()));
        else
          EXPECT_THAT(units(plan, e.effect), IsEmpty());
      }
    }
}

}  // namespace
}  // namespace halfway
