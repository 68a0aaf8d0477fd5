// SPDX-License-Identifier: Apache-2.0
// The shading processors: halfway vectors, unit vectors, perspective, and the ranges of their words. Every
// scene runs through both forms of the processors, folded and unrolled, which must emit the same fragments.
#include <fmt/format.h>

#include <glm/trigonometric.hpp>

#include "golden/processors_layout.hpp"
#include "golden/word.hpp"
#include "golden_run/golden_run.hpp"
#include "scene/builtin_meshes.hpp"
#include "setup/project.hpp"
#include "setup/test/random_scenes.hpp"
#include "stability/hard_case.hpp"
#include "stability/measure.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {
namespace {

struct Shade {
  Preset preset = Preset::exact;
  FrameSize frame{48, 36};
  unsigned lights = 3;  ///< of the hardware
  bool all_effects = true;
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
    drawing = trial.draw(scene, {.plan = request_of(how, form), .frame = how.frame});
  return drawing;
}

void shade(Trial& trial, const Scene& scene, std::string_view name, Shade how = {}) {
  for (const Preset preset : {Preset::exact, Preset::published}) {
    how.preset = preset;
    measure_shading(trial, preset, scene, how.frame, draw(trial, scene, how).fragments, name);
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

// Colour steps. Half a step is the rounding to eight bits.
constexpr double c_conditioned = 1.0;

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
    Scene scene = wall(c_shiny);
    scene.positional = {{{0.2, 0.1, distance}, glm::dvec3(1.0)}};
    shade(trial, scene, fmt::format("a light {} before a wall of 2", distance));
  }
}

void unnormalized(Trial& trial) {
  for (const double degrees : {10.0, 30.0, 60.0, 120.0, 170.0})
    for (const double exponent : {5.0, 200.0}) {
      Material material = c_shiny;
      material.exponent = exponent;
      Scene scene = bent(material, degrees);
      scene.directional = {{unit(0.1, 0.1, 1.0), glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("an edge of {} degrees, exponent {}", degrees, exponent));
    }
}

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
}

// A light at the point of a pixel, and at increasing distances from it.
void light_at_the_surface(Trial& trial) {
  constexpr FrameSize c_frame{48, 36};
  Scene scene = bent(c_shiny, 40.0);
  const LongVec point = surface(Pieces(scene, c_frame).all()[0], c_subpixel_bits, 30, 20).position_world;
  for (const double above : {0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4, 1e-2})
    for (const bool spot : {false, true}) {
      scene.positional.clear();
      scene.spots.clear();
      const glm::dvec3 place = glm::dvec3(point) + glm::dvec3(0.0, 0.0, above);
      if (spot)
        scene.spots = {{place, {0.0, 0.0, -1.0}, 0.9, 0.2, glm::dvec3(0.9)}};
      else
        scene.positional = {{place, glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("a {} {} above a pixel's point", spot ? "spot" : "light", above),
            {.frame = c_frame});
    }
}

void far_light(Trial& trial) {
  for (const double far : {1e3, 1e6, 1e9, 1e12, 1e30, 1e300})
    for (const double z : {0.8, -0.1}) {
      Scene scene = bent(c_shiny, 60.0);
      scene.positional = {{far * glm::dvec3(0.3, 0.5, z), glm::dvec3(0.9)}};
      shade(trial, scene, fmt::format("a light {} away", far));
    }
}

void light_at_the_eye(Trial& trial) {
  for (const double scale : {1e-12, 1.0, 1e12}) {
    Scene scene = bent(c_shiny, 60.0);
    for (glm::dvec3& p : scene.positions_world) p *= scale;
    scene.camera.eye_world *= scale;
    scene.positional = {{scene.camera.eye_world, glm::dvec3(0.9)}};
    shade(trial, scene, fmt::format("scaled by {}", scale));
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

void opposed_normals(Trial& trial) {
  const glm::dvec3 n(0.0, 0.0, 1.0), zero(0.0);
  const std::array<std::array<glm::dvec3, 4>, 5> all = {
      {{n, -n, n, -n},
       {n, n, -n, -n},
       {n, -n, zero, n},
       {zero, zero, zero, zero},
       {unit(1, 0, 1e-6), unit(-1, 0, 1e-6), unit(-1, 0, 1e-6), unit(1, 0, 1e-6)}}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    Scene scene = lit(c_shiny);
    add_wall(scene, all[i]);
    scene.directional = {{unit(0.1, 0.2, 1.0), glm::dvec3(0.5)}};
    scene.positional = {{{0.5, 0.5, 1.0}, glm::dvec3(0.5)}};
    shade(trial, scene, fmt::format("normals {}", i));
  }
}

void below_the_horizon(Trial& trial) {
  for (const double over : {-0.5, -0.05, -1e-4, 0.0, 1e-4, 0.05})
    for (const double exponent : {1.0, 3.0, 30.0}) {
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

void shade_spots(Trial& trial, std::initializer_list<double> inner_parts) {
  for (const double outer : {0.1, 0.3, 0.5, 0.63, 0.7, 1.0, 3.0, 10.0, 45.0})
    for (const double inner : inner_parts) {
      const Scene scene = narrow_spot(inner * outer, outer);
      shade(trial, scene, fmt::format("a cone of {} degrees within one of {}", inner * outer, outer));
    }
}
void narrow_spots(Trial& trial) {
  shade_spots(trial, {0.0});
}
void hard_spots(Trial& trial) {
  shade_spots(trial, {0.7, 1.0});
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

void sums_past_white(Trial& trial) {
  // Sixteen lights need 33 processors, which take minutes to build.
  const int count = trial.rounds(3, 16);
  for (const double sum : {0.32, 0.96, 0.992, 3.2, 4.16, 16.0, 1024.0})
    shade(trial, many_lights(count, sum / count), fmt::format("{} lights of {}", count, sum / count),
          {.lights = static_cast<unsigned>(count)});
}

void clamped_products(Trial& trial) {
  for (const double k : {1.0, 4.0, 16.0, 100.0})
    for (const double intensity : {1.0, 16.0, 64.0, 65.0, 1000.0}) {
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
      RandomScenes::set_mesh(scene, make_uv_sphere(9, 7, 1.0));
      scene.camera.eye_world = {0.0, 0.3, 3.4};
      random.add_lights(scene, 2, RandomScenes::any, 1.0, false);
      for (glm::dvec3& p : scene.positions_world) p *= scale;
      for (PositionalLight& l : scene.positional) l.position_world *= scale;
      for (SpotLight& l : scene.spots) l.position_world *= scale;
      scene.camera.eye_world *= scale;
      shade(trial, scene, fmt::format("scene {} scaled by {}", i, scale));
    }
}

// Surfaces at distances from a thousandth of the scene's size on, and lights just as near.
void near_the_eye(Trial& trial) {
  RandomScenes random(4);
  for (int i = 0; i < trial.rounds(6, 200); ++i) {
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

// Without shadows every object of a pixel is shaded.
void objects_at_a_pixel(Trial& trial) {
  for (const int layers : {1, 2, 64}) {
    Scene scene = lit(c_shiny);
    for (int i = 0; i < layers; ++i) {
      const glm::dvec3 n = unit(std::sin(i), std::cos(i), 2.0);
      add_wall(scene, {n, n, n, n}, -0.01 * (i % 7));
    }
    scene.directional = {{unit(0.1, 0.2, 1.0), glm::dvec3(0.9)}};
    shade(trial, scene, fmt::format("{} objects at a pixel", layers),
          {.frame = {12, 9}, .all_effects = false});
  }
}

using Request = golden::Exact::request_header_at;

struct Frame {
  HardwareKey key;
  Stream stream;
};

Frame frame_of(const Scene& scene, FrameSize size, Preset preset, ProcessorForm form) {
  const auto plan = plan_scene(scene, request_of({.preset = preset}, form));
  if (!plan) return {};
  return {plan->key, stream_of(*make_setup(scene, size, plan->key, {}))};
}

// A frame after another frame must be equal to the frame on its own, for any lights before.
void lights_between_frames(Trial& trial) {
  constexpr FrameSize c_frame{24, 18};
  RandomScenes random(7);
  const auto with_lights = [&](int count) {
    Scene scene = bent(c_shiny, 60.0);
    scene.ambient = random.colour(false);
    random.add_lights(scene, count, RandomScenes::any, 1.0, false);
    return scene;
  };
  for (const Preset preset : {Preset::exact, Preset::published})
    for (const ProcessorForm form : c_forms)
      for (int i = 0; i < trial.rounds(2, 20); ++i) {
        const Frame a = frame_of(with_lights(2), c_frame, preset, form),
                    b = frame_of(with_lights(2), c_frame, preset, form),
                    dark = frame_of(with_lights(0), c_frame, preset, form);
        const std::size_t size = a.stream.vector_words();
        // The vectors of the lights with another command. They follow new_frame and the ambient light.
        const auto command = [&](std::vector<std::uint32_t> words, golden::Command c) {
          for (std::size_t at = size; at < words.size(); at += size)
            golden::set_bits(std::span(words).subspan(at, size), Request::command,
                             static_cast<std::uint32_t>(c));
          return words;
        };
        std::vector<std::uint32_t> all;
        std::vector<Fragment> wanted;
        const auto add = [&](const std::vector<std::uint32_t>& prologue, const Frame& frame) {
          all.insert(all.end(), prologue.begin(), prologue.end());
          all.insert(all.end(), frame.stream.units.begin(), frame.stream.units.end());
          const std::vector<Fragment> alone = trial.draw(frame.key, frame.stream.words());
          wanted.insert(wanted.end(), alone.begin(), alone.end());
        };
        add(a.stream.prologue, a);
        add(command(b.stream.prologue, golden::Command::redefine), b);
        add(b.stream.prologue, b);
        // Remove all lights but the ambient one, then redefine them: a removed light is not redefined.
        std::vector<std::uint32_t> gone = dark.stream.prologue;
        for (const golden::Command c : {golden::Command::remove, golden::Command::redefine}) {
          const auto words = command(a.stream.prologue, c);
          gone.insert(gone.end(), words.begin() + std::ptrdiff_t(2 * size), words.end());
        }
        add(gone, dark);
        add(a.stream.prologue, a);
        trial.measure(preset, trial.draw(a.key, all) != wanted, 0,
                      [&] { return fmt::format("{}, scenes {}", a.key.name(), i); });
      }
}

constexpr HardCase c_cases[] = {
    {"halfway_vectors", "Distance of a light in the half vector",
     "processors, table 2 and equation 3: (E + P_p − P)/abs(E + P_p − P) adds a unit vector to a vector as "
     "long as the light is distant",
     "L is normalized before V is added", "the illumination model, within the errors of the units",
     "colour steps", PublishedForm::breaks, halfway_vectors},
    {"unnormalized", "Normals that are not normalized",
     "processors, version I: N.H is scaled by cos(edge/2), its power by cos(edge/2)^m",
     "N is normalized where it is not constant", "the illumination model, within the errors of the units",
     "colour steps", PublishedForm::breaks, unnormalized},
    {"perspective", "N and P across a floor", "processors, section 5: N and P are linear on the screen",
     "N/w, the view ray and 1/w are interpolated", "the illumination model, within the errors of the units",
     "colour steps", PublishedForm::breaks, perspective},
    {"light_at_the_surface", "A light at a point of the surface", "processors: (P_p − P)/abs(P_p − P) is 0/0",
     "block shift before the square; a zero vector remains zero",
     "the illumination model, within the errors of the units; at the point itself any share of the light",
     "colour steps", PublishedForm::breaks, light_at_the_surface, c_conditioned},
    {"far_light", "A light at 10^3 to 10^300 times the size of the scene",
     "processors: P_p − P in words of one fixed scale",
     "each light's position has its own power of two; above 2^31 the light is drawn as directional, with a "
     "note",
     "the illumination model, within the errors of the units", "colour steps", PublishedForm::breaks,
     far_light},
    {"light_at_the_eye", "A light at the eye", "processors: E is constant",
     "V of each point, computed from the view ray", "the illumination model, within the errors of the units",
     "colour steps", PublishedForm::breaks, light_at_the_eye},
    {"no_halfway", "L = −V: the half vector is 0/0", "spherical, equation 6: (L + V)/abs(L + V)",
     "a zero vector remains zero: no highlight", "the illumination model, within the errors of the units",
     "colour steps", PublishedForm::breaks, no_halfway},
    {"opposed_normals", "Opposed normals, zero normals", "processors: N/abs(N) is 0/0",
     "a zero vector remains zero; a flat face has its own normal",
     "the illumination model, within the errors of the units; where N is zero any colour", "colour steps",
     PublishedForm::breaks, opposed_normals, c_conditioned},
    {"below_the_horizon", "Highlights below the horizon",
     "processors: I_out = I_in + k I (N.H)^m for every N.L", "no highlight where N.L <= 0",
     "the illumination model, within the errors of the units", "colour steps", PublishedForm::breaks,
     below_the_horizon},
    {"exponents", "Exponents from 1 to above 8191", "processors, section 3.1: the power by a table",
     "log2 and 2^-x by interpolated tables; exponents are clamped to 8192, with a note",
     "the illumination model, within the errors of the units", "colour steps", PublishedForm::breaks,
     exponents},
    {"narrow_spots", "Spots as narrow as 0.1 degrees",
     "processors: no spots; the units resolve a cosine to 2^-7",
     "cosines are accurate to 2^-19, the edge's slope is up to 2^18; a note for cones below 0.63 degrees",
     "the illumination model, within the errors of the units, which a narrow cone magnifies", "colour steps",
     PublishedForm::breaks, narrow_spots, c_conditioned},
    {"hard_spots", "Spots with a hard edge", "processors: no spots; the units resolve a cosine to 2^-7",
     "cosines are accurate to 2^-19, the edge's slope is up to 2^18",
     "the illumination model, within the errors of the units; at pixels of the edge any share of the light",
     "colour steps", PublishedForm::breaks, hard_spots, c_conditioned},
    {"sums_past_white", "Sums above white over 33 processors",
     "processors, equation 5 and section 3.1: I_out = I_in + k I (N.A)^x in integers",
     "saturating sums of 22 bits", "the illumination model, clamped to white", "colour steps",
     PublishedForm::breaks, sums_past_white},
    {"clamped_products", "k and I out of range", "processors: intensities and coefficients are integers",
     "k up to 16, I and k I up to 64 times white; larger values are clamped, with a note",
     "the illumination model of the clamped values", "colour steps", PublishedForm::breaks, clamped_products},
    {"scales", "Scenes from 10^-30 to 10^30", "processors: a unit E added to P_p − P",
     "each scale is a power of two", "the illumination model, within the errors of the units", "colour steps",
     PublishedForm::breaks, scales},
    {"near_the_eye", "Surfaces and lights close to the eye", "processors: N and P are linear on the screen",
     "clipping at the near plane; planes have a range of 2^13 times the drawn values",
     "the illumination model, within the errors of the units", "colour steps", PublishedForm::breaks,
     near_the_eye},
    {"objects_at_a_pixel", "Many objects at one pixel", "processors, section 3.2: new object",
     "each token contains its N and material", "the illumination model, within the errors of the units",
     "colour steps", PublishedForm::breaks, objects_at_a_pixel},
    {"lights_between_frames", "Lights redefined and deleted between frames",
     "processors, section 3.2: redefine, delete", "one valid bit per light",
     "each frame equals the same frame drawn alone", "frames that differ", PublishedForm::holds,
     lights_between_frames},
};

INSTANTIATE_TEST_SUITE_P(processors, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace

}  // namespace halfway::stability
