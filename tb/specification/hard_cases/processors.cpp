// SPDX-License-Identifier: Apache-2.0
// The shading processors: halfway vectors, unit vectors, perspective, and the ranges of their words. Every
// scene runs through both forms of the processors, folded and unrolled, which must emit the same fragments.
#include <fmt/format.h>

#include <glm/trigonometric.hpp>

#include "projection/project.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/test/random_scenes.hpp"
#include "specification/hard_cases/hard_case.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {
namespace {

struct Shade {
  Preset preset = Preset::exact;
  FrameSize frame{48, 36};
  unsigned lights = 3;  ///< of the hardware
  bool all_effects = true;
  bool in_rtl = true;
};

PlanRequest request_of(const Shade& how, ProcessorForm form) {
  PlanRequest request{.shader = Shader::processors, .preset = how.preset, .form = form};
  request.all_effects = how.all_effects;
  if (how.all_effects) request.lights = how.lights;
  return request;
}

Drawing draw(Trial& trial, const Scene& scene, const Shade& how) {
  Drawing drawing;
  for (const ProcessorForm form : c_forms)
    drawing = trial.draw(scene, {.plan = request_of(how, form), .frame = how.frame, .in_rtl = how.in_rtl});
  return drawing;
}

void shade(Trial& trial, const Scene& scene, std::string_view name, Shade how = {}) {
  for (const Preset preset : {Preset::exact, Preset::published}) {
    how.preset = preset;
    measure_shading(trial, preset, scene, how.frame, draw(trial, scene, how).golden, name);
  }
}

Scene lit(Material material = {}) {
  Scene scene;
  scene.name = "case";
  material.name = "m";
  scene.materials = {material};
  scene.camera.eye_world = {0.0, 0.0, 3.0};
  return scene;
}

const Material c_shiny{.colour = {0.9, 0.6, 0.3}, .diffuse = 0.5, .specular = 0.5, .exponent = 60.0};

// Corners counter-clockwise, with one normal each.
void add_quad(Scene& scene, const std::array<glm::dvec3, 4>& corners,
              const std::array<glm::dvec3, 4>& normals) {
  const auto p = static_cast<std::uint32_t>(scene.positions_world.size());
  scene.positions_world.insert(scene.positions_world.end(), corners.begin(), corners.end());
  scene.normals_world.insert(scene.normals_world.end(), normals.begin(), normals.end());
  for (const std::array<std::uint32_t, 3>& t : {std::array{p, p + 1, p + 2}, std::array{p, p + 2, p + 3}})
    scene.triangles.push_back({t, t, 0});
}

void add_wall(Scene& scene, const std::array<glm::dvec3, 4>& normals, double z = 0.0) {
  add_quad(scene, {glm::dvec3(-1, -1, z), {1, -1, z}, {1, 1, z}, {-1, 1, z}}, normals);
}
Scene wall(const Material& material) {
  Scene scene = lit(material);
  const glm::dvec3 n(0.0, 0.0, 1.0);
  add_wall(scene, {n, n, n, n});
  return scene;
}

// Normals that turn about the vertical by this number of degrees from one side to the other.
Scene bent(const Material& material, double degrees) {
  Scene scene = lit(material);
  const double half = glm::radians(degrees) / 2;
  const glm::dvec3 left(-std::sin(half), 0.0, std::cos(half)), right(std::sin(half), 0.0, std::cos(half));
  add_wall(scene, {left, right, right, left});
  return scene;
}

glm::dvec3 unit(double x, double y, double z) {
  return glm::normalize(glm::dvec3(x, y, z));
}

void halfway_vectors(Trial& trial) {
  for (const double distance : {0.1, 1.0, 8.0, 100.0}) {
    if (trial.quick() && distance != 0.1 && distance != 100.0) continue;
    Scene scene = wall(c_shiny);
    scene.positional = {{{0.2, 0.1, distance}, glm::dvec3(1.0)}};
    shade(trial, scene, fmt::format("a light {} before a wall of 2", distance));
  }
}

void normals(Trial& trial) {
  for (const double degrees : {10.0, 30.0, 60.0, 120.0, 170.0})
    for (const double exponent : {5.0, 200.0}) {
      if (trial.quick() && degrees != 30.0 && degrees != 170.0) continue;
      Material material = c_shiny;
      material.exponent = exponent;
      Scene scene = bent(material, degrees);
      scene.directional = {{unit(0.1, 0.1, 1.0), glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("an edge of {} degrees, exponent {}", degrees, exponent));
    }
  const glm::dvec3 n(0.0, 0.0, 1.0), zero(0.0);
  for (const auto& corners : {std::array<glm::dvec3, 4>{n, -n, n, -n},
                              {n, n, -n, -n},
                              {n, -n, zero, n},
                              {zero, zero, zero, zero},
                              {unit(1, 0, 1e-6), unit(-1, 0, 1e-6), unit(-1, 0, 1e-6), unit(1, 0, 1e-6)}}) {
    Scene scene = lit(c_shiny);
    add_wall(scene, corners);
    scene.directional = {{unit(0.1, 0.2, 1.0), glm::dvec3(0.5)}};
    scene.positional = {{{0.5, 0.5, 1.0}, glm::dvec3(0.5)}};
    shade(trial, scene, "opposed normals");
  }
}

// A floor; and surfaces at distances from a thousandth of the scene's size on, with lights just as near.
void perspective(Trial& trial) {
  for (const double length : {10.0, 100.0, 1000.0}) {
    Scene scene = lit(c_shiny);
    const glm::dvec3 near_normal = unit(0.2, 1.0, 0.3), far_normal = unit(-0.2, 1.0, -0.3);
    add_quad(scene, {glm::dvec3(-3, -1, 2), {3, -1, 2}, {3, -1, 2 - length}, {-3, -1, 2 - length}},
             {near_normal, near_normal, far_normal, far_normal});
    scene.positional = {{{1.0, 0.5, -4.0}, glm::dvec3(0.9)}};
    scene.spots = {{{0.0, 3.0, 0.0}, unit(0.0, -1.0, -0.5), 0.9, 0.7, glm::dvec3(0.8)}};
    shade(trial, scene, fmt::format("a floor of {}", length));
  }
  RandomScenes random(4);
  for (int i = 0; i < trial.rounds(4, 200); ++i) {
    Scene scene = lit(c_shiny);
    random.add_triangles(scene, 12, 0.8, 0.6);
    random.add_lights(scene, 2, RandomScenes::any, 1.0, false);
    scene.camera.eye_world = random.within(0.3, 1.2) * random.unit();
    scene.camera.target_world = random.cube();
    scene.camera.near = random.log_within(1e-3, 0.5);
    scene.camera.far = 10.0;
    if (!scene.positional.empty())
      scene.positional[0].position_world =
          scene.camera.eye_world + random.log_within(1e-6, 0.1) * random.unit();
    shade(trial, scene, fmt::format("scene {}", i));
  }
}

// A light at the point of a pixel, at increasing distances from it, and at the eye.
void light_at_the_surface(Trial& trial) {
  Scene scene = bent(c_shiny, 40.0);
  constexpr Shade c_how{};
  const LongVec point = surface(Pieces(scene, c_how.frame).all()[0], c_subpixel_bits, 30, 20).position_world;
  for (const double above : {0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4, 1e-2, 3.0})
    for (const bool spot : {false, true}) {
      if (trial.quick() && (above == 1e-9 || above == 1e-6 || above == 1e-4)) continue;
      scene.positional.clear();
      scene.spots.clear();
      const glm::dvec3 place =
          above == 3.0 ? scene.camera.eye_world : glm::dvec3(point) + glm::dvec3(0.0, 0.0, above);
      if (spot)
        scene.spots = {{place, {0.0, 0.0, -1.0}, 0.9, 0.2, glm::dvec3(0.9)}};
      else
        scene.positional = {{place, glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("a {} {} above a pixel's point", spot ? "spot" : "light", above),
            c_how);
    }
}

// A light 2^0 to 2^33 away, with components of both signs: the place is shifted right by every shift of a
// light. The shift must be arithmetic. A logical shift, which GHDL's synthesis makes from shift_right, gives
// 19 instead of -13 in six bits. Lights farther away are directional.
void far_light(Trial& trial) {
  for (int exponent = 0; exponent <= 33; ++exponent) {
    if (trial.quick() && exponent % 3 != 0) continue;
    Scene scene = bent(c_shiny, 60.0);
    scene.positional = {
        {std::ldexp(1.0, exponent) * glm::dvec3(exponent % 2 ? 0.4 : -0.4, exponent % 3 ? -0.3 : 0.3, 0.6),
         glm::dvec3(0.9)}};
    shade(trial, scene, fmt::format("a light 2^{} away", exponent), {.frame = {16, 12}});
  }
  for (const double far : {1e12, 1e30, 1e300})
    for (const double z : {0.8, -0.1}) {
      Scene scene = bent(c_shiny, 60.0);
      scene.positional = {{far * glm::dvec3(0.3, 0.5, z), glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("a light {} away", far));
    }
}

// Normals that face away from the eye: a light behind the surface shines on them.
void no_halfway(Trial& trial) {
  for (const double turned : {95.0, 120.0, 179.0})
    for (const double exponent : {1.0, 60.0, 8000.0}) {
      Material material = c_shiny;
      material.exponent = exponent;
      Scene scene = lit(material);
      const double angle = glm::radians(turned);
      const glm::dvec3 n(std::sin(angle), 0.0, std::cos(angle));
      add_wall(scene, {n, n, n, n});
      // A pixel's centre, the eye and the sun on one line.
      scene.camera.eye_world = {0.03, 0.02, 3.0};
      scene.camera.target_world = {0.03, 0.02, 0.0};
      scene.directional = {{{0.0, 0.0, -1.0}, glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("normals turned by {} degrees, exponent {}", turned, exponent),
            {.frame = {49, 37}});
    }
}

void below_the_horizon(Trial& trial) {
  for (const double over : {-0.5, -0.05, -1e-4, 0.0, 1e-4, 0.05})
    for (const double exponent : {1.0, 3.0, 30.0}) {
      if (trial.quick() && exponent == 3.0) continue;
      Material material = c_shiny;
      material.exponent = exponent;
      Scene scene = bent(material, 20.0);
      scene.directional = {{unit(0.7, 0.7, over), glm::dvec3(0.9)}};
      scene.positional = {{{3.0, 0.0, over}, glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("lights {} above the horizon, exponent {}", over, exponent));
    }
}

void exponents(Trial& trial) {
  for (const double exponent : {1.0, 1.5, 2.0, 7.0, 50.0, 1000.0, 8191.0, 8191.99, 8192.0, 1e4, 1e6}) {
    if (trial.quick() && (exponent == 1.5 || exponent == 7.0 || exponent == 8191.0)) continue;
    Material material = c_shiny;
    material.exponent = exponent;
    Scene scene = bent(material, 3.0);
    scene.directional = {{unit(0.002, 0.001, 1.0), glm::dvec3(0.9)}};
    const std::string name = fmt::format("exponent {}", exponent);
    shade(trial, scene, name);
    const auto drawn = draw_golden(scene, {.plan = request_of({}, ProcessorForm::unrolled)});
    trial.require(drawn && drawn->notes.empty() == (exponent < 8192.0),
                  [&] { return name + ": a note of clamped values is missing or superfluous"; });
  }
}

// A spot that shines on the middle of a wall; its cone fills a large part of the wall.
Scene narrow_spot(double inner, double outer) {
  const double radius = 3.0 * std::tan(glm::radians(outer));
  Scene scene = lit({.ambient = 0.0, .diffuse = 1.0, .specular = 0.0});
  const glm::dvec3 n(0.0, 0.0, 1.0);
  add_quad(scene,
           {radius * glm::dvec3(-2, -2, 0), radius * glm::dvec3(2, -2, 0), radius * glm::dvec3(2, 2, 0),
            radius * glm::dvec3(-2, 2, 0)},
           {n, n, n, n});
  scene.camera.eye_world = radius * glm::dvec3(1.0, 0.5, 6.0);
  const glm::dvec3 place(0.9, 1.2, 2.6);
  scene.spots = {
      {place, glm::normalize(-place), std::cos(glm::radians(inner)), std::cos(glm::radians(outer))}};
  return scene;
}

void spots(Trial& trial) {
  for (const double outer : {0.1, 0.3, 0.5, 0.63, 0.7, 1.0, 3.0, 10.0, 45.0})
    for (const double part : {0.0, 0.7, 1.0}) {
      if (trial.quick() && (outer == 0.3 || outer == 0.5 || outer == 0.7 || outer == 3.0)) continue;
      const Scene scene = narrow_spot(part * outer, outer);
      shade(trial, scene, fmt::format("a cone of {} degrees within one of {}", part * outer, outer));
    }
}

Scene many_lights(int count, double each) {
  Scene scene = bent(
      {.colour = {1.0, 0.8, 0.5}, .ambient = 1.0, .diffuse = 0.7, .specular = 0.7, .exponent = 3.0}, 30.0);
  scene.ambient = glm::dvec3(each);
  for (int i = 0; i < count; ++i) {
    const double way = 0.3 * i;
    const glm::dvec3 place(std::sin(way), std::cos(way), 1.5 + 0.1 * i);
    if (i % 3 == 0)
      scene.directional.push_back({glm::normalize(place), glm::dvec3(each)});
    else if (i % 3 == 1)
      scene.positional.push_back({place, glm::dvec3(each)});
    else
      scene.spots.push_back({place, glm::normalize(-place), 0.95, 0.6, glm::dvec3(each)});
  }
  return scene;
}

void past_white(Trial& trial) {
  const auto add_up = [&](int count, std::initializer_list<double> sums) {
    for (const double sum : sums)
      shade(trial, many_lights(count, sum / count), fmt::format("{} lights of {}", count, sum / count),
            {.lights = static_cast<unsigned>(count), .in_rtl = count <= 8});
  };
  add_up(3, {0.32, 0.96, 0.992, 3.2, 4.16, 16.0, 1024.0});
  // The RTL of sixteen lights, in two presets and forms, takes a quarter of an hour to build.
  if (!trial.quick())
    for (const int count : {8, 16}) add_up(count, {0.992, 1024.0});
  for (const double k : {1.0, 4.0, 16.0, 100.0})
    for (const double intensity : {1.0, 16.0, 64.0, 65.0, 1000.0}) {
      if (trial.quick() && (k == 4.0 || intensity == 16.0)) continue;
      Scene scene = bent(
          {.colour = {1.0, 0.3, 0.01}, .ambient = 0.0, .diffuse = k, .specular = k, .exponent = 500.0}, 10.0);
      // Use a hundredth of the light, so that a clamped intensity is visible.
      scene.directional = {{unit(1.0, 0.0, 0.01), glm::dvec3(intensity)}};
      shade(trial, scene, fmt::format("k {} of a light of {}", k, intensity));
    }
}

void scales(Trial& trial) {
  RandomScenes random(2);
  for (int i = 0; i < trial.rounds(1, 10); ++i)
    for (const double scale : {1e-30, 1e-9, 1e-3, 1e3, 1e9, 1e30}) {
      Scene scene = lit(c_shiny);
      add_mesh(scene, make_uv_sphere(9, 7, 1.0));
      scene.camera.eye_world = {0.0, 0.3, 3.4};
      random.add_lights(scene, 2, RandomScenes::any, 1.0, false);
      shade(trial, scaled(scene, scale), fmt::format("scene {} scaled by {}", i, scale));
    }
}

constexpr HardCase c_cases[] = {{"halfway_vectors", halfway_vectors},
                                {"normals", normals},
                                {"perspective", perspective},
                                {"light_at_the_surface", light_at_the_surface},
                                {"far_light", far_light},
                                {"no_halfway", no_halfway},
                                {"below_the_horizon", below_the_horizon},
                                {"exponents", exponents},
                                {"spots", spots},
                                {"past_white", past_white},
                                {"scales", scales}};
INSTANTIATE_TEST_SUITE_P(processors, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace
}  // namespace halfway::stability
