// SPDX-License-Identifier: Apache-2.0
// What a scene calls for and why, and that keys of different hardware are told apart.
#include "plan/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "golden/cosine_tables.hpp"
#include "plan/effects.hpp"

namespace halfway {
namespace {

using ::testing::AllOf, ::testing::HasSubstr, ::testing::IsEmpty;

// Everything grey, one triangle, no light yet. Exponent 2: the bell is cos^2 itself.
Scene grey_scene() {
  Scene scene;
  scene.name = "s";
  scene.materials = {{.name = "plain", .exponent = 2.0}};
  scene.positions_world = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals_world = {{0, 0, 1}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}};
  return scene;
}

Scene lit_scene() {
  Scene scene = grey_scene();
  scene.directional.push_back({});
  return scene;
}

void wear(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  scene.triangles.push_back(scene.triangles[0]);
  scene.triangles.back().material = static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Plan planned(const Scene& scene, const PlanRequest& request) {
  const auto plan = plan_scene(scene, request);
  EXPECT_TRUE(plan) << plan.error().message;
  return plan ? *plan : Plan{};
}
Plan spherical(const Scene& scene, Preset preset = Preset::exact) {
  return planned(scene, {.shader = Shader::spherical, .preset = preset});
}

const PlannedEffect& effect(const Plan& plan, std::string_view name) {
  for (const PlannedEffect& e : plan.effects)
    if (e.name == name) return e;
  ADD_FAILURE() << "no effect '" << name << "'";
  static const PlannedEffect none{};
  return none;
}
bool has_effect(const Plan& plan, std::string_view name) {
  return std::ranges::find(plan.effects, name, &PlannedEffect::name) != plan.effects.end();
}

TEST(Plan, OneChannelWhereEverythingSeenIsGrey) {
  for (const Shader shader : {Shader::quadratic, Shader::spherical})
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const PlanRequest request{.shader = shader, .preset = preset};
      const auto channels = [&](const Scene& scene) { return planned(scene, request).key.channels; };
      const auto why = [&](const Scene& scene) { return effect(planned(scene, request), "colour channels"); };
      const Scene grey = lit_scene();
      EXPECT_EQ(channels(grey), 1U);
      EXPECT_FALSE(why(grey).called_for);
      EXPECT_THAT(why(grey).why, HasSubstr("grey"));

      Scene scene = grey;
      scene.ambient = {0.2, 0.2, 0.3};
      EXPECT_EQ(channels(scene), 3U);
      EXPECT_TRUE(why(scene).called_for);
      EXPECT_THAT(why(scene).why, HasSubstr("ambient"));

      scene = grey;
      scene.positional.resize(2);
      scene.positional[1].intensity = {0.0, 1.0, 0.0};
      EXPECT_EQ(channels(scene), 3U);
      EXPECT_THAT(why(scene).why, HasSubstr("positional light 2"));

      scene = grey;
      scene.spots.push_back({.intensity = {0.0, 0.0, 0.5}});
      EXPECT_EQ(channels(scene), 3U);
      EXPECT_THAT(why(scene).why, HasSubstr("spot light 1"));

      scene = grey;
      wear(scene, {.name = "rust", .colour = {0.6, 0.3, 0.1}});
      EXPECT_EQ(channels(scene), 3U);
      EXPECT_THAT(why(scene).why, HasSubstr("'rust'"));

      scene = grey;
      wear(scene, {.name = "gold", .specular_colour = {1.0, 0.8, 0.3}});
      EXPECT_EQ(channels(scene), 3U);
      EXPECT_THAT(why(scene).why, HasSubstr("'gold'"));
      scene.materials.back().specular = 0.0;  // a highlight of no strength has no colour
      EXPECT_EQ(channels(scene), 1U);

      scene = grey;
      scene.materials.push_back({.name = "unworn", .colour = {1.0, 0.0, 0.0}});
      scene.background = {0.1, 0.2, 0.3};  // what no triangle covers is not shaded
      EXPECT_EQ(channels(scene), 1U);
    }
}

TEST(Plan, EdgesAndDepthFollowThePreset) {
  for (const Shader shader : {Shader::quadratic, Shader::spherical})
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const Plan plan = planned(lit_scene(), {.shader = shader, .preset = preset});
      EXPECT_EQ(plan.key.shader, shader);
      EXPECT_EQ(plan.key.preset, preset);
      EXPECT_TRUE(effect(plan, "depth").called_for);
      EXPECT_EQ(effect(plan, "exact edges").called_for, preset == Preset::exact);
      EXPECT_FALSE(plan.key.probe);
      for (const PlannedEffect& e : plan.effects) EXPECT_FALSE(e.why.empty()) << e.name;
    }
}

TEST(Plan, QuadraticHasNoLights) {
  Scene scene = lit_scene();
  scene.positional.resize(40);
  wear(scene, {.brdf = Brdf::cook_torrance});
  const Plan plan = planned(scene, {});
  EXPECT_EQ(plan.key.spherical.lights, 0U);
  EXPECT_FALSE(has_effect(plan, "lights"));
}

TEST(Plan, LightsFromNoneToOneTooMany) {
  for (const Preset preset : {Preset::exact, Preset::published})
    for (unsigned lights = 0; lights <= 17; ++lights) {
      Scene scene = grey_scene();
      for (unsigned i = 0; i < lights; ++i) switch (i % 3) {
          case 0:
            scene.directional.push_back({});
            break;
          case 1:
            scene.positional.push_back({});
            break;
          default:
            scene.spots.push_back({});
        }
      const auto plan = plan_scene(scene, {.shader = Shader::spherical, .preset = preset});
      if (lights > c_most_lights) {
        ASSERT_FALSE(plan);
        EXPECT_EQ(plan.error().code, ExitCode::bad_input);
        EXPECT_THAT(plan.error().message, AllOf(HasSubstr("17 lights"), HasSubstr("up to 16")));
        continue;
      }
      ASSERT_TRUE(plan) << plan.error().message;
      const SphericalUnits& units = plan->key.spherical;
      EXPECT_EQ(units.lights, lights);
      EXPECT_EQ(units.records(), lights > 0);
      EXPECT_EQ(units.diffuse, lights > 0);
      EXPECT_EQ(units.specular, lights > 0);
      EXPECT_EQ(effect(*plan, "lights").called_for, lights > 0);
      EXPECT_THAT(effect(*plan, "lights").why,
                  HasSubstr(lights == 0 ? "no light shines" : std::to_string(lights)));
      EXPECT_EQ(has_effect(*plan, "cosine tables"), lights > 0);
      if (lights == 0)
        for (const char* name : {"diffuse", "specular"}) {
          EXPECT_FALSE(effect(*plan, name).called_for);
          EXPECT_EQ(effect(*plan, name).why, "no light shines");
        }
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
  scene.directional[1].intensity = scene.positional[0].intensity = scene.spots[7].intensity = dark;
  EXPECT_THAT(shining_lights(scene), IsEmpty());
  EXPECT_FALSE(spherical(scene).key.spherical.records());
}

TEST(Plan, EffectsThatNoMaterialShowsAreLeftOut) {
  struct Case {
    Material material;
    bool diffuse, specular;
    const char *why_diffuse, *why_specular;
  };
  const std::vector<Case> cases = {
      {{.name = "both"}, true, true, "'both' has k_d 0.6", "'both' has k_s 0.4"},
      {{.name = "matt", .specular = 0.0}, true, false, "'matt' has k_d", "every k_s is 0"},
      {{.name = "dark", .specular_colour = glm::dvec3(0.0)}, true, false, "'dark'", "every k_s is 0"},
      {{.name = "coat", .diffuse = 0.0}, false, true, "every k_d is 0", "'coat' has k_s"},
      {{.name = "soot", .colour = glm::dvec3(0.0)}, false, true, "every k_d is 0", "'soot' has k_s"},
      {{.name = "dull", .diffuse = 0.0, .specular = 0.0}, false, false, "every k_d is 0", "every k_s is 0"},
  };
  for (const Case& c : cases) {
    Scene scene = lit_scene();
    scene.materials[0] = c.material;
    scene.materials.push_back({.name = "unworn"});
    const Plan plan = spherical(scene);
    const SphericalUnits& units = plan.key.spherical;
    SCOPED_TRACE(c.material.name);
    EXPECT_EQ(units.diffuse, c.diffuse);
    EXPECT_EQ(units.specular, c.specular);
    EXPECT_EQ(units.lights, c.diffuse || c.specular ? 1U : 0U);
    EXPECT_EQ(effect(plan, "lights").called_for, units.records());
    EXPECT_EQ(effect(plan, "diffuse").called_for, c.diffuse);
    EXPECT_THAT(effect(plan, "diffuse").why, HasSubstr(c.why_diffuse));
    EXPECT_EQ(effect(plan, "specular").called_for, c.specular);
    EXPECT_THAT(effect(plan, "specular").why, HasSubstr(c.why_specular));
    EXPECT_EQ(has_effect(plan, "cosine powers"), c.specular);
    EXPECT_EQ(has_effect(plan, "highlight colour"), c.specular);
    EXPECT_EQ(units.powers != 0, c.specular);
  }
  // Lights without measure, and nothing to reflect them.
  Scene scene = lit_scene();
  scene.materials[0].diffuse = scene.materials[0].specular = 0.0;
  scene.directional.resize(100);
  EXPECT_EQ(spherical(scene).key.spherical.lights, 0U);
  EXPECT_EQ(effect(spherical(scene), "lights").why, "no material reflects them");
}

TEST(Plan, CookTorranceIsRefusedWhereItsHighlightWouldShow) {
  Scene scene = lit_scene();
  wear(scene, {.name = "copper", .brdf = Brdf::cook_torrance});
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const auto plan = plan_scene(scene, {.shader = Shader::spherical, .preset = preset});
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().code, ExitCode::bad_input);
    EXPECT_THAT(plan.error().message, AllOf(HasSubstr("'copper'"), HasSubstr("quadratic shader")));
  }
  Scene matt = scene, unworn = scene, unlit = scene;
  matt.materials.back().specular = 0.0;
  unworn.triangles.pop_back();
  unlit.directional.clear();
  for (const Scene& s : {matt, unworn, unlit}) EXPECT_TRUE(plan_scene(s, {.shader = Shader::spherical}));
}

TEST(Plan, WhiteHighlightsTakeOneMultiplier) {
  const auto highlight_channels = [](const Scene& scene) {
    const Plan plan = spherical(scene);
    EXPECT_EQ(effect(plan, "highlight colour").called_for, plan.key.spherical.highlight_channels != 1);
    return plan.key.spherical.highlight_channels;
  };
  const auto why = [](const Scene& scene) { return effect(spherical(scene), "highlight colour").why; };
  Scene scene = lit_scene();
  EXPECT_EQ(highlight_channels(scene), 1U);
  wear(scene, {.name = "red", .colour = {0.8, 0.1, 0.1}});
  EXPECT_EQ(spherical(scene).key.channels, 3U);
  EXPECT_EQ(highlight_channels(scene), 1U);
  EXPECT_THAT(why(scene), HasSubstr("one multiplier"));

  Scene gold = scene;
  gold.materials[1].specular_colour = {1.0, 0.8, 0.3};
  EXPECT_EQ(highlight_channels(gold), 3U);
  EXPECT_THAT(why(gold), HasSubstr("'red'"));
  gold.triangles.pop_back();
  EXPECT_EQ(highlight_channels(gold), 1U);

  Scene sunset = scene;
  sunset.positional.push_back({.intensity = {1.0, 0.5, 0.2}});
  EXPECT_EQ(highlight_channels(sunset), 3U);
  EXPECT_THAT(why(sunset), HasSubstr("positional light 1"));
  // No highlight, so none that is coloured.
  for (Material& m : sunset.materials) m.specular = 0.0;
  EXPECT_EQ(spherical(sunset).key.spherical.highlight_channels, 1U);
}

TEST(Plan, PowersAreThoseOfTheExponentsInUse) {
  const auto powers = [](const std::vector<double>& exponents, Preset preset = Preset::exact) {
    Scene scene = lit_scene();
    scene.materials[0].exponent = exponents[0];
    for (std::size_t i = 1; i < exponents.size(); ++i) wear(scene, {.exponent = exponents[i]});
    // None of these is seen.
    scene.materials.push_back({.name = "unworn", .exponent = 4.0});
    wear(scene, {.name = "matt", .specular = 0.0, .exponent = 4.0});
    const Plan plan = spherical(scene, preset);
    std::string tables;
    for (unsigned power = 1; power <= 16; power *= 2)
      if ((plan.key.spherical.powers & power) != 0)
        tables += (tables.empty() ? "cos^" : ", cos^") + std::to_string(power);
    EXPECT_EQ(effect(plan, "cosine powers").why, tables + " for the exponents in use");
    return plan.key.spherical.powers;
  };
  for (const unsigned power : {1U, 2U, 4U, 8U, 16U}) EXPECT_EQ(powers({double(power)}), power);
  EXPECT_EQ(powers({1.0, 16.0}), 17U);
  EXPECT_EQ(powers({2.0, 4.0, 8.0, 2.0}), 14U);
  for (const double large : {100.0, 1e6, 1e9, 1e300}) EXPECT_EQ(powers({large}), 16U);
  EXPECT_EQ(powers({1.0, 300.0}, Preset::published), 2U);
}

TEST(Plan, TablesAreThePresetsOrThoseThatAreThere) {
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const bool exact = preset == Preset::exact;
    const golden::CosineSize usual = exact ? golden::c_exact_cosine_size : golden::c_published_cosine_size;
    const Plan plan = spherical(lit_scene(), preset);
    EXPECT_EQ(plan.key.spherical.tables, (TableSize{usual.address_bits, usual.data_bits}));
    EXPECT_THAT(effect(plan, "cosine tables").why,
                AllOf(HasSubstr(std::to_string(usual.address_bits) + " address bits"),
                      HasSubstr(std::to_string(usual.data_bits) + " data bits")));
    for (const golden::CosineTable& table : golden::c_cosine_tables) {
      const TableSize size{table.address_bits, table.data_bits};
      const auto other =
          plan_scene(lit_scene(), {.shader = Shader::spherical, .preset = preset, .tables = size});
      if (table.exact == exact) {
        ASSERT_TRUE(other) << other.error().message;
        EXPECT_EQ(other->key.spherical.tables, size);
      }
    }
    const auto unknown =
        plan_scene(lit_scene(), {.shader = Shader::spherical, .preset = preset, .tables = TableSize{12, 3}});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ExitCode::bad_input);
    EXPECT_THAT(unknown.error().message,
                AllOf(HasSubstr("12 address and 3 data bits"),
                      HasSubstr(std::to_string(usual.address_bits) + "/" + std::to_string(usual.data_bits)),
                      HasSubstr(std::string("make tables PRESET=") + to_string(preset) +
                                " ADDRESS_BITS=12 DATA_BITS=3")));
  }
  // A size of one preset is not there for the other.
  const golden::CosineSize published = golden::c_published_cosine_size;
  EXPECT_FALSE(plan_scene(lit_scene(), {.shader = Shader::spherical,
                                        .tables = TableSize{published.address_bits, published.data_bits}}));
  const auto quadratic = plan_scene(lit_scene(), {.tables = TableSize{9, 8}});
  ASSERT_FALSE(quadratic);
  EXPECT_THAT(quadratic.error().message, HasSubstr("only the spherical shader"));
}

// All the hardware there is, up to what a plan may ask for.
std::vector<HardwareKey> every_key() {
  std::vector<HardwareKey> keys;
  for (const Preset preset : {Preset::exact, Preset::published})
    for (const unsigned channels : {1U, 3U})
      for (const bool probe : {false, true}) {
        keys.push_back({.preset = preset, .channels = channels, .probe = probe});
        const auto spherical = [&](const SphericalUnits& units) {
          keys.push_back({.shader = Shader::spherical,
                          .preset = preset,
                          .channels = channels,
                          .probe = probe,
                          .spherical = units});
        };
        spherical({.tables = {9, 8}});
        for (const unsigned lights : {1U, 2U, 11U, 16U})
          for (const TableSize tables : {TableSize{9, 8}, {6, 6}, {8, 9}}) {
            spherical({.lights = lights, .diffuse = true, .tables = tables});
            for (const bool diffuse : {false, true})
              for (unsigned highlight_channels = 1; highlight_channels <= channels; highlight_channels += 2)
                for (unsigned powers = 1; powers < 32; ++powers)
                  spherical({lights, diffuse, true, highlight_channels, powers, tables});
          }
      }
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

TEST(HardwareKey, GenericsAreTheKey) {
  const HardwareKey key{.shader = Shader::spherical,
                        .preset = Preset::exact,
                        .channels = 3,
                        .probe = true,
                        .spherical = {.lights = 5,
                                      .diffuse = true,
                                      .specular = true,
                                      .highlight_channels = 1,
                                      .powers = 18,
                                      .tables = {10, 7}}};
  using Map = std::map<std::string, std::string>;
  const auto generics = key.generics();
  EXPECT_EQ(Map(generics.begin(), generics.end()), (Map{{"g_exact", "true"},
                                                        {"g_channels", "3"},
                                                        {"g_lights", "5"},
                                                        {"g_diffuse", "true"},
                                                        {"g_specular", "true"},
                                                        {"g_highlight_channels", "1"},
                                                        {"g_powers", "18"},
                                                        {"g_address_bits", "10"},
                                                        {"g_data_bits", "7"},
                                                        {"g_probe", "true"}}));
  EXPECT_EQ(key.entity(), "spherical_shader");
  EXPECT_EQ(key.name(), "spherical_shader-exact-c3-l5-d-s1-cos2.16-rom10x7-probe");
  const golden::SphericalConfig config = golden_config(key);
  EXPECT_EQ(config.lights, 5);
  EXPECT_EQ(config.channels, 3);
  EXPECT_EQ(config.highlight_channels, 1);
  EXPECT_EQ(config.powers, 18U);
  EXPECT_EQ(config.address_bits, 10);
  EXPECT_EQ(config.data_bits, 7);
  EXPECT_TRUE(config.diffuse && config.specular);

  const HardwareKey quadratic{.preset = Preset::published, .channels = 1};
  const auto few = quadratic.generics();
  EXPECT_EQ(Map(few.begin(), few.end()),
            (Map{{"g_exact", "false"}, {"g_channels", "1"}, {"g_probe", "false"}}));
  EXPECT_EQ(quadratic.name(), "quadratic_shader-published-c1");
}

}  // namespace
}  // namespace halfway
