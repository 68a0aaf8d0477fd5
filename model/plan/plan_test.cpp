// SPDX-License-Identifier: Apache-2.0
// Which hardware a scene needs, the reasons given, and that different hardware has different keys.
#include "plan/plan.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "common/test/is_error.hpp"
#include "plan/test/planned.hpp"
#include "sim/os/file.hpp"

namespace halfway {
namespace {

using ::testing::HasSubstr, ::testing::IsEmpty, ::testing::Not;

Plan spherical(const Scene& scene, Preset preset = Preset::exact) {
  return planned(scene, {.shader = Shader::spherical, .preset = preset});
}

// A scene with one grey material and one light, changed: whether an effect is needed, and why. Hardware that
// has what the scene needs, and no more, is tested by AllEffects/EachShader.
TEST(Plan, SaysWhichEffectsASceneNeedsAndWhy) {
  struct Case {
    Effect effect;
    bool called_for;
    const char* why;
    void (*change)(Scene&);
  };
  const auto none = [](Scene&) {};
  const auto gold = [](Scene& s) { wear(s, {.name = "gold", .specular_colour = {1.0, 0.8, 0.3}}); };
  const auto dull = [](Scene& s) { s.materials[0].specular = 0.0; };
  const Case cases[] = {
      {Effect::ambient, true, "material 'plain' has k_a 0.1", none},
      {Effect::ambient, false, "every k_a is 0", [](Scene& s) { s.materials[0].ambient = 0.0; }},
      {Effect::ambient, false, "the ambient light is 0", [](Scene& s) { s.ambient = glm::dvec3(0.0); }},
      {Effect::ambient, true, "'plain' emits light", [](Scene& s) { s.materials[0].emission.y = 0.5; }},
      {Effect::diffuse, true, "'plain' has k_d 0.6", none},
      {Effect::diffuse, false, "every k_d is 0", [](Scene& s) { s.materials[0].diffuse = 0.0; }},
      {Effect::diffuse, false, "every k_d is 0", [](Scene& s) { s.materials[0].colour = glm::dvec3(0.0); }},
      {Effect::specular, true, "'plain' has k_s 0.4", none},
      {Effect::specular, false, "every k_s is 0", dull},
      {Effect::specular, false, "every k_s is 0",
       [](Scene& s) { s.materials[0].specular_colour = glm::dvec3(0.0); }},
      {Effect::exponents, false, "there is no highlight", dull},
      {Effect::highlight_colour, false, "there is no highlight", dull},
      {Effect::highlight_colour, false, "every highlight is white", none},
      {Effect::highlight_colour, true, "'gold'", gold},
      {Effect::highlight_colour, true, "positional light 1",
       [](Scene& s) { s.positional.push_back({.intensity = {1.0, 0.5, 0.2}}); }},
      {Effect::directional, false, "no material reflects them",
       [](Scene& s) { s.materials[0].diffuse = s.materials[0].specular = 0.0; }},
      {Effect::positional, true, "9 of 10 lights", [](Scene& s) { s.positional.resize(9); }},
      {Effect::spot, false, "the scene has no spot light", none},
      {Effect::spot, false, "their intensity is 0",
       [](Scene& s) { s.spots.assign(20, {.intensity = glm::dvec3(0.0)}); }},
      {Effect::shadow, false, "the scene has no shadows", none},
      {Effect::shadow, true, "", [](Scene& s) { s.shadows = true; }},
      {Effect::shadow, false, "no light that casts shadows shines",
       [](Scene& s) { s.shadows = true, s.directional.clear(); }},
      {Effect::colour, false, "grey", none},
      // Pixels without a triangle are not shaded.
      {Effect::colour, false, "grey", [](Scene& s) { s.background = {0.1, 0.2, 0.3}; }},
      {Effect::colour, false, "grey",
       [](Scene& s) { wear(s, {.specular_colour = {1.0, 0.8, 0.3}, .specular = 0.0}); }},
      {Effect::colour, true, "ambient", [](Scene& s) { s.ambient = {0.2, 0.2, 0.3}; }},
      {Effect::colour, true, "positional light 2",
       [](Scene& s) { s.positional = {{}, {.intensity = {0.0, 1.0, 0.0}}}; }},
      {Effect::colour, true, "spot light 1",
       [](Scene& s) { s.spots.push_back({.intensity = {0.0, 0.0, 0.5}}); }},
      {Effect::colour, true, "'rust'",
       [](Scene& s) { wear(s, {.name = "rust", .colour = {0.6, 0.3, 0.1}}); }},
      {Effect::colour, true, "'gold'", gold},
      {Effect::colour, true, "'lamp'",
       [](Scene& s) { wear(s, {.name = "lamp", .emission = {0.5, 0.4, 0.3}}); }},
  };
  for (const Case& c : cases) {
    Scene scene = with_lights(1);
    scene.materials.push_back({.name = "unworn", .colour = {1.0, 0.0, 0.0}});
    c.change(scene);
    for (const Shader shader : c_shaders) {
      const Plan plan = planned(scene, {.shader = shader});
      SCOPED_TRACE(plan.key.name() + ": " + to_string(c.effect));
      EXPECT_EQ(effect(plan, c.effect).called_for, c.called_for);
      EXPECT_THAT(effect(plan, c.effect).why, HasSubstr(c.why));
      EXPECT_EQ(plan.key.channels == 3, effect(plan, Effect::colour).called_for);
    }
    const Plan plan = spherical(scene);
    const SphericalUnits& units = plan.key.spherical;
    EXPECT_EQ(units.diffuse, effect(plan, Effect::diffuse).called_for);
    EXPECT_EQ(units.specular, effect(plan, Effect::specular).called_for);
    EXPECT_EQ(units.powers != 0, units.specular);
    EXPECT_EQ(units.highlight_channels == 3, effect(plan, Effect::highlight_colour).called_for);
    EXPECT_EQ(units.lights, reflected_lights(scene).size());
  }
}

TEST(Plan, NamesEveryEffectOnceWithItsReason) {
  for (const Shader shader : c_shaders)
    for (const Preset preset : {Preset::exact, Preset::published})
      for (const bool all_effects : {false, true})
        for (const Scene& scene : {grey_scene(), with_lights(1)}) {
          const Plan plan = planned(scene, {.shader = shader, .preset = preset, .all_effects = all_effects});
          EXPECT_EQ(plan.key.shader, shader);
          EXPECT_EQ(plan.key.preset, preset);
          EXPECT_TRUE(effect(plan, Effect::depth).called_for);
          ASSERT_EQ(plan.effects.size(), c_effects);
          std::set<std::string> names;
          for (std::size_t i = 0; i < c_effects; ++i) {
            const PlannedEffect& e = plan.effects[i];
            EXPECT_EQ(e.effect, static_cast<Effect>(i));
            EXPECT_TRUE(names.insert(to_string(e.effect)).second) << to_string(e.effect);
            EXPECT_THAT(e.why, Not(IsEmpty())) << to_string(e.effect);
            if (e.by == DoneBy::hardware) {
              EXPECT_TRUE(e.elaborated || !e.called_for) << to_string(e.effect);
            } else {
              EXPECT_THAT(e.how, Not(IsEmpty())) << to_string(e.effect);
              EXPECT_FALSE(e.elaborated || e.other) << to_string(e.effect);
            }
          }
          EXPECT_EQ(effect(plan, Effect::shadow).how == "not by this shader", shader != Shader::processors);
        }
}

TEST(Plan, QuadraticLeavesLightsToTheHost) {
  Scene scene = with_lights(1);
  scene.positional.resize(40);
  wear(scene, {.brdf = Brdf::cook_torrance});
  const Plan plan = planned(scene, {});
  EXPECT_EQ(plan.key.spherical.lights, 0U);
  for (const Effect e : {Effect::diffuse, Effect::specular, Effect::directional, Effect::positional}) {
    EXPECT_TRUE(effect(plan, e).called_for) << to_string(e);
    EXPECT_EQ(effect(plan, e).by, DoneBy::host) << to_string(e);
  }
}

TEST(Plan, ColoursOfMaterialsAreNumbersFromZero) {
  for (const double value : {-0.5, std::numeric_limits<double>::quiet_NaN()})
    for (const auto& [colour, name] : {std::pair{&Material::colour, "a material's colour"},
                                       {&Material::specular_colour, "a material's specular colour"},
                                       {&Material::emission, "a material's emission"}}) {
      Scene scene = with_lights(1);
      (scene.materials[0].*colour).y = value;
      EXPECT_TRUE(is_error(plan_scene(scene, {}), name));
    }
}

TEST(Plan, KnowsTheMostLightsOfTheHardware) {
  const auto vhdl = must(read_file(HALFWAY_SOURCE_DIR "/rtl/shaders/processors_pkg.vhd"));
  EXPECT_THAT(vhdl, HasSubstr(fmt::format("constant c_most_lights : positive := {};", c_most_lights)));
}

TEST(Plan, SeventeenLightsAreTooMany) {
  EXPECT_EQ(spherical(with_lights(6, 5, 5)).key.spherical.lights, 16U);
  for (const Shader shader : {Shader::spherical, Shader::processors}) {
    const auto refused = plan_scene(with_lights(6, 6, 5), {.shader = shader});
    EXPECT_TRUE(is_error(refused, ExitCode::bad_input, "17 lights"));
    EXPECT_TRUE(is_error(refused, "up to 16"));
  }
}

TEST(Plan, DarkLightsAreLeftOut) {
  Scene scene = grey_scene();
  const glm::dvec3 dark(0.0);
  scene.directional = {{.intensity = dark}, {.intensity = glm::dvec3(0.5)}, {.intensity = dark}};
  scene.positional = {{.intensity = glm::dvec3(0.25)}, {.intensity = dark}};
  scene.spots.assign(20, {.intensity = dark});
  scene.spots[7].intensity = {0.0, 0.0, 0.1};
  const std::vector<LightRef> shining = {
      {LightKind::directional, 1}, {LightKind::positional, 0}, {LightKind::spot, 7}};
  EXPECT_EQ(shining_lights(scene), shining);
  EXPECT_EQ(spherical(scene).key.spherical.lights, 3U);
}

TEST(Plan, CookTorranceIsRefusedIfItsHighlightIsVisible) {
  Scene scene = with_lights(1);
  wear(scene, {.name = "copper", .brdf = Brdf::cook_torrance});
  const auto refused = plan_scene(scene, {.shader = Shader::spherical});
  EXPECT_TRUE(is_error(refused, ExitCode::bad_input, "'copper'"));
  EXPECT_TRUE(is_error(refused, "quadratic shader"));
  Scene matt = scene, unworn = scene, unlit = scene;
  matt.materials.back().specular = 0.0;
  unworn.triangles.pop_back();
  unlit.directional.clear();
  for (const Scene& s : {matt, unworn, unlit}) EXPECT_TRUE(plan_scene(s, {.shader = Shader::spherical}));
}

TEST(Plan, PowersAreThoseOfTheExponentsInUse) {
  const auto powers = [](const std::vector<double>& exponents, Preset preset = Preset::exact) {
    Scene scene = with_lights(1);
    scene.materials[0].exponent = exponents[0];
    for (std::size_t i = 1; i < exponents.size(); ++i) wear(scene, {.exponent = exponents[i]});
    // None of these is visible.
    scene.materials.push_back({.name = "unworn", .exponent = 4.0});
    wear(scene, {.name = "matt", .specular = 0.0, .exponent = 4.0});
    const Plan plan = spherical(scene, preset);
    std::string tables;
    for (unsigned power = 1; power <= 16; power *= 2)
      if ((plan.key.spherical.powers & power) != 0)
        tables += (tables.empty() ? "cos^" : ", cos^") + std::to_string(power);
    const PlannedEffect& e = effect(plan, Effect::exponents);
    if (preset == Preset::exact) {
      EXPECT_TRUE(e.why.ends_with(": " + tables)) << e.why;
      EXPECT_EQ(e.called_for, tables.find(',') != std::string::npos);
    } else {
      EXPECT_EQ(e.by, DoneBy::host);
    }
    return plan.key.spherical.powers;
  };
  for (const unsigned power : {1U, 2U, 4U, 8U, 16U}) EXPECT_EQ(powers({double(power)}), power);
  EXPECT_EQ(powers({1.0, 16.0}), 17U);
  EXPECT_EQ(powers({2.0, 4.0, 8.0, 2.0}), 14U);
  for (const double large : {100.0, 1e6, 1e9, 1e300}) EXPECT_EQ(powers({large}), 16U);
  EXPECT_EQ(powers({100.0, 1e6}), 16U);  // two exponents, one table
  EXPECT_EQ(powers({1.0, 300.0}, Preset::published), 2U);
}

TEST(Plan, TablesAreThePresetsOrOtherExistingOnes) {
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const bool exact = preset == Preset::exact;
    const words::CosineSize usual = exact ? words::c_exact_cosine_size : words::c_published_cosine_size;
    const Plan plan = spherical(with_lights(1), preset);
    EXPECT_EQ(plan.key.spherical.tables, usual);
    EXPECT_THAT(plan.key.name(), HasSubstr("-rom" + to_string(usual)));
    for (const words::CosineTable& table : words::c_cosine_tables) {
      const words::CosineSize size = table.size;
      const auto other =
          plan_scene(with_lights(1), {.shader = Shader::spherical, .preset = preset, .tables = size});
      if (table.exact == exact) {
        ASSERT_TRUE(other) << other.error().message;
        EXPECT_EQ(other->key.spherical.tables, size);
      }
    }
    const auto unknown = plan_scene(
        with_lights(1), {.shader = Shader::spherical, .preset = preset, .tables = words::CosineSize{12, 3}});
    EXPECT_TRUE(is_error(unknown, ExitCode::bad_input, "12x3 address x data bits"));
    EXPECT_TRUE(is_error(unknown, fmt::format("make tables PRESET={} COSINE=12x3", to_string(preset))));
  }
  // A table size of one preset is not available for the other.
  const words::CosineSize published = words::c_published_cosine_size;
  EXPECT_FALSE(plan_scene(with_lights(1), {.shader = Shader::spherical, .tables = published}));
  EXPECT_TRUE(
      is_error(plan_scene(with_lights(1), {.tables = words::CosineSize{9, 8}}), "only the spherical shader"));
}

// The counterpart of an effect differs only in the units that the effect needs, whether it adds or removes
// it.
TEST(Plan, OtherKeysDifferInOneEffect) {
  Scene scene = with_lights(1);
  scene.positional.resize(2);
  wear(scene,
       {.name = "gold", .colour = {0.8, 0.6, 0.2}, .specular_colour = {1.0, 0.8, 0.3}, .exponent = 16.0});
  const Plan rich = spherical(scene), poor = spherical(grey_scene());
  const auto other = [](const Plan& plan, Effect e) { return effect(plan, e).other->name(); };
  EXPECT_EQ(rich.key.name(), "spherical_shader-exact-c3-l3-d-s3-cos2.16-rom9x8");
  EXPECT_EQ(other(rich, Effect::diffuse), "spherical_shader-exact-c3-l3-s3-cos2.16-rom9x8");
  EXPECT_EQ(other(rich, Effect::specular), "spherical_shader-exact-c3-l3-d-rom9x8");
  EXPECT_EQ(other(rich, Effect::highlight_colour), "spherical_shader-exact-c3-l3-d-s1-cos2.16-rom9x8");
  EXPECT_EQ(other(rich, Effect::exponents), "spherical_shader-exact-c3-l3-d-s3-cos16-rom9x8");
  EXPECT_EQ(other(rich, Effect::directional), "spherical_shader-exact-c3-l2-d-s3-cos2.16-rom9x8");
  EXPECT_EQ(other(rich, Effect::positional), "spherical_shader-exact-c3-l1-d-s3-cos2.16-rom9x8");
  EXPECT_EQ(other(rich, Effect::spot), "spherical_shader-exact-c3-l4-d-s3-cos2.16-rom9x8");
  EXPECT_EQ(other(rich, Effect::colour), "spherical_shader-exact-c1-l3-d-s1-cos2.16-rom9x8");
  EXPECT_EQ(poor.key.name(), "spherical_shader-exact-c1-l0");
  EXPECT_EQ(other(poor, Effect::diffuse), "spherical_shader-exact-c1-l1-d-rom9x8");
  EXPECT_EQ(other(poor, Effect::specular), "spherical_shader-exact-c1-l1-s1-cos2-rom9x8");
  EXPECT_EQ(other(poor, Effect::spot), "spherical_shader-exact-c1-l1-d-rom9x8");
  EXPECT_EQ(other(poor, Effect::colour), "spherical_shader-exact-c3-l0");
  // Removing the only light also removes its effects.
  EXPECT_EQ(other(spherical(with_lights(1)), Effect::directional), "spherical_shader-exact-c1-l0");
  for (const Plan& plan : {rich, poor})
    for (const PlannedEffect& e : plan.effects)
      if (e.other) {
        const SphericalUnits& other_units = e.other->spherical;
        EXPECT_EQ(other_units.powers != 0, other_units.specular) << to_string(e.effect);
        EXPECT_EQ(other_units.lights != 0, other_units.records()) << to_string(e.effect);
      }
}

TEST(Plan, AllEffectsSelectsAllOfTheShadersHardware) {
  using Lights = std::optional<unsigned>;
  const auto key = [](const Scene& scene, Preset preset, Lights lights = {}) {
    const Plan plan = planned(
        scene, {.shader = Shader::spherical, .preset = preset, .all_effects = true, .lights = lights});
    EXPECT_EQ(plan.key.name(), plan.everything.name());
    EXPECT_EQ(plan.called_for.name(), spherical(scene, preset).key.name());
    return plan.key.name();
  };
  Scene three = with_lights(1);
  three.spots.resize(2);
  const std::string all = "-d-s3-cos1.2.4.8.16-rom9x8";
  EXPECT_EQ(key(grey_scene(), Preset::exact), "spherical_shader-exact-c3-l1" + all);
  EXPECT_EQ(key(three, Preset::exact), "spherical_shader-exact-c3-l3" + all);
  EXPECT_EQ(key(three, Preset::exact, 16), "spherical_shader-exact-c3-l16" + all);
  EXPECT_EQ(key(three, Preset::published), "spherical_shader-published-c3-l3-d-s3-cos2-rom6x6");
  // Lights that no material reflects do not count here either.
  Scene dull = grey_scene();
  dull.materials[0].diffuse = dull.materials[0].specular = 0.0;
  dull.directional.resize(100);
  EXPECT_EQ(key(dull, Preset::exact), "spherical_shader-exact-c3-l1" + all);
  for (const Lights lights : {0U, 2U, 17U})
    EXPECT_TRUE(
        is_error(plan_scene(three, {.shader = Shader::spherical, .all_effects = true, .lights = lights}),
                 fmt::format("--lights: {} is not 3 to 16", *lights)));
  EXPECT_EQ(planned(grey_scene(), {.all_effects = true}).key.name(), "quadratic_shader-exact-c3");
  EXPECT_EQ(planned(grey_scene(), {}).everything.name(), "quadratic_shader-exact-c3");
  EXPECT_FALSE(plan_scene(grey_scene(), {.all_effects = true, .lights = 2}));
  // With all effects, effects that the scene does not need are present. Another light may not fit.
  const Plan most = planned(grey_scene(), {.shader = Shader::spherical, .all_effects = true, .lights = 16});
  for (const Effect e :
       {Effect::diffuse, Effect::specular, Effect::highlight_colour, Effect::exponents, Effect::colour}) {
    EXPECT_FALSE(effect(most, e).called_for) << to_string(e);
    EXPECT_TRUE(effect(most, e).elaborated) << to_string(e);
  }
  EXPECT_EQ(effect(most, Effect::exponents).why, "there is no highlight");
  EXPECT_FALSE(effect(most, Effect::spot).other);
}

// All hardware up to the limits of a plan.
std::vector<HardwareKey> every_key() {
  std::vector<HardwareKey> keys;
  for (const Preset preset : {Preset::exact, Preset::published})
    for (const unsigned channels : {1U, 3U}) {
      keys.push_back({.preset = preset, .channels = channels});
      const auto spherical = [&](const SphericalUnits& units) {
        keys.push_back(
            {.shader = Shader::spherical, .preset = preset, .channels = channels, .spherical = units});
      };
      spherical({.tables = {9, 8}});
      for (const unsigned lights : {1U, 2U, 11U, 16U})
        for (const words::CosineSize tables : {words::CosineSize{9, 8}, {6, 6}, {8, 9}}) {
          spherical({.lights = lights, .diffuse = true, .tables = tables});
          for (const bool diffuse : {false, true})
            for (unsigned highlight_channels = 1; highlight_channels <= channels; highlight_channels += 2)
              for (unsigned powers = 1; powers < 32; ++powers)
                spherical({lights, diffuse, true, highlight_channels, powers, tables});
        }
    }
  for (const unsigned objects : {0U, 1U, 12U})
    for (const unsigned subpixels : {1U, 4U, 16U})
      if (objects > 0 || subpixels == 1)
        keys.push_back(
            {.shader = Shader::processors, .processors = {.objects = objects, .subpixels = subpixels}});
  return keys;
}

TEST(HardwareKey, DifferentHardwareHasDifferentNamesAndGenerics) {
  std::set<std::string> names;
  std::set<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> hardware;
  const std::vector<HardwareKey> keys = every_key();
  for (const HardwareKey& key : keys) {
    EXPECT_TRUE(names.insert(key.name()).second) << key.name() << " twice";
    EXPECT_TRUE(hardware.insert({key.entity(), key.generics()}).second) << key.name();
    EXPECT_THAT(key.name(), ::testing::MatchesRegex("[a-z0-9_.-]+")) << "names files";
  }
  EXPECT_GT(keys.size(), 2000U);
}

TEST(HardwareKey, OnlyTheQuadraticShaderHasDegrees) {
  const Plan planes = planned(grey_scene(), {.degree = 1});
  EXPECT_EQ(planes.key.name(), "quadratic_shader-exact-c1-planes");
  EXPECT_EQ(planes.everything.name(), "quadratic_shader-exact-c3-planes");
  EXPECT_EQ(planned(grey_scene(), {.degree = 2}).key.name(), "quadratic_shader-exact-c1");
  for (const Shader shader : {Shader::spherical, Shader::processors})
    EXPECT_FALSE(plan_scene(grey_scene(), {.shader = shader, .degree = 1}));
}

}  // namespace
}  // namespace halfway
