// SPDX-License-Identifier: Apache-2.0
// Compares reference renderer, illumination model, setup and golden model with the oracle. Three comparisons:
//  picture    each byte of the reference picture, and its mask: equal. Exception: the oracle's real number
//             is within 1e-9 of the limit between two bytes, of a horizon or of a shadow's edge, where double
//             may round differently.
//  radiance   the illumination model in double at the oracle's surface points: within 1e-9 of the oracle's.
//  fragments  the golden model's fragments of preset exact: the pixels of each triangle equal; the depth
//             within 0.5 + 0.19 steps of the exact one: rounding to whole steps, and the error bound of
//             depth_sum in formats.
// One of them must detect each fault that is put into the oracle.
#include "specification/oracle/oracle.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <set>

#include "plan/plan.hpp"
#include "projection/project.hpp"
#include "reference/renderer.hpp"
#include "scene/scene.hpp"
#include "scene/test/random_scenes.hpp"
#include "setup/setup.hpp"
#include "shading/shade.hpp"
#include "shading/test/random_solids.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/load_scene.hpp"

namespace halfway {
namespace {

using oracle::Fault;
using oracle::Oracle;
using oracle::Real;

constexpr double c_radiance_tolerance = 1e-9;
constexpr Real c_depth_tolerance = 0.5L + 0.19L;

/// Result of a comparison.
struct Findings {
  std::uint64_t compared = 0, wrong = 0, doubtful = 0;
  double largest = 0.0;  ///< greatest difference
  std::string first;     ///< the first wrong element
  void note_wrong(const std::string& what) {
    if (wrong++ == 0) first = what;
  }
  Findings& operator+=(const Findings& other) {
    if (wrong == 0) first = other.first;
    compared += other.compared;
    wrong += other.wrong;
    doubtful += other.doubtful;
    largest = std::max(largest, other.largest);
    return *this;
  }
};

Findings compare_picture(const Scene& scene, FrameSize size, const Oracle& oracle) {
  const ReferenceImage reference =
      render_reference(scene, Projector(scene, size, {}).project_all(), {.frame = size, .subpixel_bits = 4});
  Findings found;
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const Oracle::Pixel pixel = oracle.pixel(static_cast<int>(x), static_cast<int>(y));
      const std::size_t at = reference.frame.offset(x, y);
      ++found.compared;
      if ((reference.mask[at / 3] != 0) != pixel.triangle.has_value())
        found.note_wrong(fmt::format("pixel {},{}: the reference {} it", x, y,
                                     reference.mask[at / 3] != 0 ? "covers" : "does not cover"));
      bool doubtful = false;
      for (int c = 0; c < 3; ++c) {
        const int difference = std::abs(int{reference.frame.rgb[at + c]} - int{pixel.byte[c]});
        doubtful |= pixel.doubtful[c];
        if (difference != 0 && !pixel.doubtful[c])
          found.note_wrong(fmt::format("pixel {},{}, channel {}: reference {}, oracle {}", x, y, c,
                                       reference.frame.rgb[at + c], pixel.byte[c]));
      }
      found.doubtful += doubtful;
    }
  return found;
}

Findings compare_radiance(const Scene& scene, FrameSize size, const Oracle& oracle) {
  Findings found;
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const auto triangle = oracle.pixel(static_cast<int>(x), static_cast<int>(y)).triangle;
      if (!triangle) continue;
      const auto surface = oracle.surface(*triangle, static_cast<int>(x), static_cast<int>(y));
      bool doubtful = false;
      const glm::dvec3 expected = glm::dvec3(oracle.radiance(*triangle, surface, doubtful));
      const glm::dvec3 got = radiance(scene, scene.materials[scene.triangles[*triangle].material],
                                      glm::dvec3(surface.position), glm::dvec3(surface.normal));
      ++found.compared;
      found.doubtful += doubtful;
      if (doubtful) continue;
      for (int c = 0; c < 3; ++c) {
        const double difference = std::abs(got[c] - expected[c]) / std::max(1.0, std::abs(expected[c]));
        found.largest = std::max(found.largest, difference);
        if (!(difference <= c_radiance_tolerance))
          found.note_wrong(
              fmt::format("pixel {},{}, channel {}: radiance {}, oracle {}", x, y, c, got[c], expected[c]));
      }
    }
  return found;
}

Findings compare_fragments(const Scene& scene, FrameSize size, const Oracle& oracle, Shader shader) {
  const auto plan = plan_scene(scene, {.shader = shader});
  EXPECT_TRUE(plan) << plan.error().message;
  Findings found;
  if (!plan) return found;
  const auto stream = whole_stream(scene, size, plan->key);
  EXPECT_TRUE(stream) << stream.error().message;
  if (!stream) return found;
  std::vector<Fragment> fragments = stream->golden;
  std::ranges::sort(fragments, {}, [](const Fragment& f) { return std::tuple(f.triangle, f.y, f.x); });

  auto fragment = fragments.begin();
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    for (std::uint32_t y = 0; y < size.height; ++y)
      for (std::uint32_t x = 0; x < size.width; ++x) {
        const bool covered = oracle.covers(t, static_cast<int>(x), static_cast<int>(y));
        int drawn = 0;
        for (; fragment != fragments.end() && fragment->triangle == t && fragment->y == y && fragment->x == x;
             ++fragment, ++drawn) {
          if (!covered) continue;
          const Real exact = oracle.depth_steps(t, static_cast<int>(x), static_cast<int>(y));
          const double difference = static_cast<double>(std::abs(Real(fragment->z) - exact));
          found.largest = std::max(found.largest, difference);
          if (!(difference <= c_depth_tolerance))
            found.note_wrong(fmt::format("{}, triangle {}, pixel {},{}: depth {}, oracle {}",
                                         to_string(shader), t, x, y, fragment->z,
                                         static_cast<double>(exact)));
        }
        found.compared += covered;
        if (drawn != (covered ? 1 : 0))
          found.note_wrong(fmt::format("{}, triangle {}, pixel {},{}: drawn {} times, covered {}",
                                       to_string(shader), t, x, y, drawn, covered));
      }
  if (fragment != fragments.end()) found.note_wrong("a fragment of a triangle that does not exist");
  return found;
}

// Scenes.

// A new kind comes last: then the random scenes of the others stay.
enum class Lights { ambient, directional, positional, spot, hard_spot, all, emission };
constexpr const char* c_light_names[] = {"ambient",   "directional", "positional", "spot",
                                         "hard_spot", "all",         "emission"};
constexpr const char* c_brdf_names[] = {"blinn", "phong", "cook_torrance"};

// Solids with holes, and one light of the kind, or of each kind, around and between them.
Scene random_scene(unsigned seed, Brdf brdf, Lights lights, bool shadows) {
  Scene scene = RandomSolids(seed).scene(5);
  RandomScenes random(seed);
  for (int i = 0; i < 20; ++i)
    scene.triangles.erase(scene.triangles.begin() + random.whole(0, int(scene.triangles.size()) - 1));
  scene.positional[0].position_world = random.within(0.3, 1.5) * random.unit();
  scene.name = "random";
  scene.camera.vertical_fov_degrees = random.within(28, 50);
  scene.camera.near = 0.3;
  scene.camera.far = 11.0;
  scene.ambient = random.colour(false);
  scene.background = 0.3 * random.colour(false);
  scene.shadows = shadows;
  const auto keep = [&](Lights kind, auto& of_kind) {
    if (lights != Lights::all && lights != kind) of_kind.clear();
    for (auto& light : of_kind) light.intensity = random.colour(false);
  };
  keep(Lights::directional, scene.directional);
  keep(Lights::positional, scene.positional);
  if (lights == Lights::hard_spot) scene.spots[0].cos_outer = scene.spots[0].cos_inner;
  keep(lights == Lights::hard_spot ? lights : Lights::spot, scene.spots);
  scene.materials.clear();
  for (int i = 0; i < 2; ++i) {
    Material& m = scene.materials.emplace_back(random.material(false, false, 150.0));
    m.brdf = brdf;
    m.roughness = random.within(0.15, 0.6);
    m.reflectance = random.within(0.02, 0.9);
    if (lights == Lights::emission) m.emission = random.colour(false);
  }
  for (std::size_t i = 0; i < scene.triangles.size(); ++i)
    scene.triangles[i].material = static_cast<std::uint32_t>(i % 2);
  return scene;
}

/// Triangles with corners on whole and half pixels, so that edges pass through pixel centres.
Scene half_pixel_scene(unsigned seed, FrameSize size) {
  RandomScenes random(seed);
  Scene scene = random_scene(seed, Brdf::blinn, Lights::directional, false);
  scene.triangles.clear();
  scene.positions_world.clear();
  scene.normals_world.clear();
  scene.camera = {.eye_world = {0, 0, 2}, .vertical_fov_degrees = 53.0, .near = 0.5, .far = 4.0};
  const double slope = 2 * std::tan(53.0 / 360.0 * 3.14159265358979323846) / size.height;
  for (std::uint32_t i = 0; i < 120; ++i) {
    const double x = std::floor(random.within(2, 2.0 * size.width - 2)) / 2,
                 y = std::floor(random.within(2, 2.0 * size.height - 2)) / 2;
    const double distance = random.within(0.8, 3.5);
    scene.positions_world.emplace_back((x - 0.5 * size.width) * slope * distance,
                                       (0.5 * size.height - y) * slope * distance, 2 - distance);
    scene.normals_world.push_back(random.unit());
    if (i % 3 == 2) scene.triangles.push_back({{i - 2, i - 1, i}, {i - 2, i - 1, i}, 0});
  }
  return scene;
}

struct Case {
  std::string name;
  std::shared_ptr<const Scene> scene;
  FrameSize size;
};

std::vector<Case> random_cases(unsigned seeds) {
  std::vector<Case> cases;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong, Brdf::cook_torrance})
      for (const Lights lights : {Lights::ambient, Lights::directional, Lights::positional, Lights::spot,
                                  Lights::hard_spot, Lights::all, Lights::emission})
        for (const bool shadows : {false, true}) {
          if (shadows && (lights == Lights::ambient || lights == Lights::emission)) continue;
          const unsigned number =
              6 * static_cast<unsigned>(lights) + 2 * static_cast<unsigned>(brdf) + shadows;
          cases.push_back(
              {fmt::format("{} {}{}, seed {}", c_brdf_names[static_cast<int>(brdf)],
                           c_light_names[static_cast<int>(lights)], shadows ? " shadows" : "", seed),
               std::make_shared<Scene>(random_scene(1000 * seed + number, brdf, lights, shadows)),
               {31 + number % 7, 27 + number % 5}});
        }
    const FrameSize size{33, 29};
    cases.push_back({fmt::format("half pixels, seed {}", seed),
                     std::make_shared<Scene>(half_pixel_scene(seed, size)), size});
  }
  return cases;
}

std::vector<Case> builtin_cases() {
  const std::filesystem::path folder = std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim/scenes";
  std::vector<Case> cases;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    auto scene = load_scene(entry.path().string(), folder);
    EXPECT_TRUE(scene) << scene.error().message;
    if (!scene) continue;
    // Set near and far: the oracle has no rule for their default values.
    scene->camera.near = 1.0;
    scene->camera.far = 100.0;
    cases.push_back({entry.path().stem().string(), std::make_shared<Scene>(std::move(*scene)), {61, 47}});
  }
  return cases;
}

bool is_compared(const Scene& scene, Shader shader) {
  // With shadows the processors draw several surfaces per pixel, and triangles of shadow volumes.
  if (shader == Shader::processors && scene.shadows) return false;
  return static_cast<bool>(plan_scene(scene, {.shader = shader}));
}

struct AllFindings {
  Findings picture, radiance, fragments;
  std::map<Shader, std::size_t> scenes;  ///< whose fragments are compared
  bool wrong() const { return picture.wrong + radiance.wrong + fragments.wrong != 0; }
};

void compare_all(const Case& one, AllFindings& found) {
  const Oracle oracle(*one.scene, one.size.width, one.size.height);
  ASSERT_FALSE(oracle.is_clipped());
  ASSERT_EQ(oracle.doubtful_corners(), 0U) << "take another size or seed";
  AllFindings here;
  here.picture = compare_picture(*one.scene, one.size, oracle);
  // radiance() does not compute shadows.
  Scene lit = *one.scene;
  lit.shadows = false;
  here.radiance = compare_radiance(*one.scene, one.size, Oracle(lit, one.size.width, one.size.height));
  for (const Shader shader : c_shaders)
    if (is_compared(*one.scene, shader)) {
      here.fragments += compare_fragments(*one.scene, one.size, oracle, shader);
      ++found.scenes[shader];
    }
  EXPECT_EQ(here.picture.wrong, 0U) << "picture: " << here.picture.first;
  EXPECT_EQ(here.radiance.wrong, 0U) << "radiance: " << here.radiance.first;
  EXPECT_EQ(here.fragments.wrong, 0U) << "fragments: " << here.fragments.first;
  EXPECT_GT(here.fragments.compared, 0U);
  found.picture += here.picture;
  found.radiance += here.radiance;
  found.fragments += here.fragments;
}

void compare_all(const std::vector<Case>& cases) {
  AllFindings found;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    compare_all(one, found);
  }
  fmt::print(
      "{} scenes: {} pixels of pictures, {} in doubt; {} radiances within {:.1e}, {} in doubt; {} fragments, "
      "depths within "
      "{:.4f} steps\n",
      cases.size(), found.picture.compared, found.picture.doubtful, found.radiance.compared,
      found.radiance.largest, found.radiance.doubtful, found.fragments.compared, found.fragments.largest);
  EXPECT_LE(1000 * found.picture.doubtful, found.picture.compared)
      << "the oracle doubts too much to find anything";
  EXPECT_LE(1000 * found.radiance.doubtful, found.radiance.compared);
  for (const Shader shader : c_shaders) EXPECT_GT(found.scenes[shader], 0U) << to_string(shader);
}

TEST(Oracle, AgreesOnRandomScenes) {
  compare_all(random_cases(2));
}

TEST(Oracle, AgreesOnBuiltInScenes) {
  const auto cases = builtin_cases();
  EXPECT_GE(cases.size(), 6U);
  compare_all(cases);
}

// Faults that are put into the oracle. A fault in it is equivalent to the same fault in everything that is
// compared with it.
constexpr Fault c_faults[] = {
    // Projection
    "mirrored",               // right and left are exchanged
    "upside_down",            // y increases upwards
    "fov_is_horizontal",      // the angle of view is that of the width
    "fov_is_half",            // the angle is measured from the axis
    "snapped_down",           // rounded down to 1/16 pixel instead of to the nearest
    "depth_of_distance",      // linear in the distance instead of in its reciprocal
    "depth_one_step_deeper",  // by 2^-24
    // Coverage
    "bottom_right_rule",  // pixels on bottom and right edges instead of on top and left edges
    "closed_edges",       // pixels on every edge
    "pixel_corners",      // a pixel's sample is its top left corner
    "back_faces_shown",
    "last_of_depth",  // the farthest triangle is visible
    // Interpolation
    "linear_on_screen",  // without perspective correction
    "normal_not_unit",
    "flat_normal",  // normal of the first corner
    // Illumination
    "ambient_missing",
    "emission_missing",
    "diffuse_unclamped",        // lights below the horizon reduce the radiance
    "highlight_below_horizon",  // also where N.L <= 0
    "eye_at_infinity",          // V is the viewing axis
    "halfway_not_unit",
    "halfway_of_normal",  // N + V instead of L + V
    "phong_by_light",     // L.V instead of R.V
    "exponent_plus_one",
    "beckmann_without_pi",
    "beckmann_squared_cosine",  // cos^2 instead of cos^4
    "fresnel_of_fourth_power",
    "masking_missing",          // G = 1
    "specular_takes_colour",    // highlights have the diffuse colour
    "diffuse_in_all_channels",  // all channels have the red coefficient
    // Lights
    "positional_is_directional",
    "falls_off_by_distance",
    "spot_backwards",
    "spot_linear",        // no smoothstep
    "spot_without_edge",  // a step at the outer cone
    "second_light_missing",
    // Shadows
    "shadows_missing",
    "lit_faces_cast",        // triangles that face the light cast shadows
    "averted_faces_lit",     // a triangle averted from the light is lit if its normal faces the light
    "shadows_beyond_light",  // triangles beyond the light cast shadows
    // Frame
    "truncated_to_byte",
};

class OracleFault : public ::testing::TestWithParam<Fault> {};

TEST_P(OracleFault, IsFound) {
  static const std::vector<Case> c_cases = random_cases(1);
  const auto any = [&](auto&& compare) {
    return std::ranges::any_of(c_cases, [&](const Case& one) {
      return compare(one, Oracle(*one.scene, one.size.width, one.size.height, GetParam())).wrong != 0;
    });
  };
  // Compare depth, which the picture does not show, if the picture is right.
  EXPECT_TRUE(any([](const Case& one, const Oracle& oracle) {
                return compare_picture(*one.scene, one.size, oracle);
              }) ||
              any([](const Case& one, const Oracle& oracle) {
                return compare_fragments(*one.scene, one.size, oracle, Shader::quadratic);
              }));
}

INSTANTIATE_TEST_SUITE_P(All, OracleFault, ::testing::ValuesIn(c_faults),
                         [](const auto& fault) { return std::string(fault.param); });

}  // namespace
}  // namespace halfway
