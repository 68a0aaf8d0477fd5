// SPDX-License-Identifier: Apache-2.0
// The spherical shader where its formulas are 0/0, its angles are almost half a turn, its words are almost
// full, and its bells differ from the exact power.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "golden_run/test/spherical_drawing.hpp"
#include "scene/test/random_scenes.hpp"
#include "specification/hard_cases/hard_case.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {
namespace {

constexpr double c_pi = std::numbers::pi;

struct Shown {
  std::uint64_t fragments = 0;
  int brightest = 0, published_brightest = 0;  ///< of the red channel
  SetupCounts counts{};
};

struct ShowOptions {
  FrameSize frame = c_stage_frame;
  int least_red = 0;  ///< least red of the brightest pixel
  std::optional<words::CosineSize> published_tables{};
};

// Draws the scene in preset exact, with ends on the surface. Compares each fragment's largest channel error
// with the bound that setup's threshold, bells and tables guarantee (promised_steps), in colour steps.
// Compares the same pixels of preset published with the same bound. Ends by slerp cover the same pixels.
Shown show(Trial& trial, const Scene& scene, const std::string& name, const ShowOptions& options = {}) {
  DrawOptions draw{.plan = {.shader = Shader::spherical, .all_effects = true, .lights = 3},
                   .frame = options.frame};
  const Drawing exact = trial.draw(scene, draw);
  trial.require(!exact.golden.empty(), [&] { return name + ": nothing is drawn"; });
  const double bound = promised_steps(scene, exact.key, draw.setup.spherical.threshold);
  const Truth truth(scene, options.frame);

  Shown shown{.fragments = exact.golden.size(), .counts = exact.counts};
  std::map<std::tuple<std::uint32_t, int, int>, LongVec> there;
  const auto where = [&](const Fragment& f) { return fmt::format("{}, pixel {}, {}", name, f.x, f.y); };
  for (const Fragment& f : exact.golden) {
    const LongVec radiance = there[{f.triangle, f.x, f.y}] = truth.radiance_at(f.triangle, f.x, f.y);
    trial.ours(colour_error(f, radiance), bound, [&] { return where(f); });
    shown.brightest = std::max(shown.brightest, int{f.red});
  }

  trial.require(shown.brightest >= options.least_red, [&] { return name + ": too dark"; });

  draw.setup.spherical.ends = SpanEnds::slerped_along_edges;
  const Drawing slerped = trial.draw(scene, draw);
  trial.require(slerped.golden.size() == exact.golden.size(),
                [&] { return name + ": ends by slerp cover other pixels"; });

  draw.plan.preset = Preset::published;
  draw.plan.tables = options.published_tables;
  const Drawing published = trial.draw(scene, draw);
  for (const Fragment& f : published.golden) {
    trial.require(f.x < options.frame.width && f.y < options.frame.height,
                  [&] { return where(f) + ": preset published draws outside the frame"; });
    shown.published_brightest = std::max(shown.published_brightest, int{f.red});
    // Vertices on whole pixels: along the edges the pixels differ from the exact ones.
    const auto found = there.find({f.triangle, f.x, f.y});
    if (found != there.end())
      trial.published(colour_error(f, found->second), bound, [&] { return where(f); });
  }
  return shown;
}

// The surface of the first triangle at a pixel's centre, as in setup.
SurfacePoint surface_at(const Scene& scene, FrameSize frame, std::int64_t x, std::int64_t y) {
  const ScreenTriangle t = Pieces(scene, frame).all().at(0);
  return surface_point(t,
                       barycentric_screen(t, (2 * x + 1) << c_subpixel_bits, (2 * y + 1) << c_subpixel_bits));
}

// ---- Bells

// In the last scenes N.H is about 1/2: its power underflows, and only diffuse light is left.
void exponents(Trial& trial) {
  for (const Brdf brdf : {Brdf::blinn, Brdf::phong})
    for (const double exponent : {1.0, 1.5, 2.0, 5.0, 20.0, 500.0, 1e6, 1e9, 1e300}) {
      if (trial.quick() && (brdf == Brdf::phong) != (exponent == 1.5 || exponent == 500.0)) continue;
      Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
      scene.materials[0].exponent = exponent;
      scene.materials[0].brdf = brdf;
      scene.directional.push_back({glm::normalize(glm::dvec3(0.05, 0.02, 1.0)), glm::dvec3(0.9)});
      show(trial, scene, fmt::format("exponent {:g}", exponent));
    }
  for (const double exponent : {1e3, 1e6}) {
    Scene scene = stage({{{0.0, 1.6, 1}, {0.3, 1.7, 1}, {0.1, 1.8, 1}}});
    scene.materials[0].exponent = exponent;
    scene.directional.push_back({{0, 0, 1}, glm::dvec3(1.0)});
    show(trial, scene, fmt::format("underflow, exponent {:g}", exponent), {.least_red = 41});
  }
}

void past_the_bell(Trial& trial) {
  for (const double exponent : {50.0, 200.0, 500.0, 1e4}) {
    Scene scene = stage({{{1.2, 0, 1}, {-1.2, 0, 1}, {0, 0, 1}}});
    scene.materials[0].diffuse = 0.0;
    scene.materials[0].specular = 1.0;
    scene.materials[0].exponent = exponent;
    scene.directional.push_back({{0, 0, 1}, glm::dvec3(1.0)});
    show(trial, scene, fmt::format("exponent {:g}", exponent));
  }
}

// A highlight smaller than a pixel is visible if it contains a pixel's centre.
void narrow_bells(Trial& trial) {
  constexpr FrameSize c_small_frame{40, 30};
  for (const double exponent : {1e4, 1e5, 1e6})
    for (int i = 0; i < trial.rounds(2, 200); ++i) {
      RandomScenes random(static_cast<unsigned>(200 + i));
      Scene scene = stage({{{1, 0.6, 1}, {-1, 0.7, 1}, {0, -1, 1}}});
      scene.materials[0].exponent = exponent;
      const SurfacePoint p = surface_at(scene, c_small_frame, random.whole(17, 23), random.whole(13, 17));
      const glm::dvec3 v = glm::normalize(scene.camera.eye_world - p.position_world);
      // The peak is at the centre of one pixel.
      scene.directional.push_back({2.0 * glm::dot(p.normal_world, v) * p.normal_world - v, glm::dvec3(1.0)});
      show(trial, scene, fmt::format("exponent {:g}, place {}", exponent, i),
           {.frame = c_small_frame, .least_red = 201});
    }
}

void four_bit_tables(Trial& trial) {
  // Exponent 2 is cos^2 itself, so that only the table's error is visible.
  for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
    Scene scene = stage({{{0.8, 0.1, 1}, {-0.8, 0.2, 1}, {0, -0.8, 1}}});
    scene.materials[0] = {
        .name = "m", .brdf = brdf, .ambient = 0.0, .diffuse = 0.0, .specular = 1.0, .exponent = 2.0};
    scene.directional.push_back({glm::normalize(glm::dvec3(0.05, 0.02, 1.0)), glm::dvec3(1.0)});
    show(trial, scene, brdf == Brdf::blinn ? "blinn" : "phong",
         {.published_tables = words::CosineSize{4, 4}});
  }
}

// ---- Scenes

// Normals that are equal except for rounding, with lights near and far.
void near_vectors(Trial& trial) {
  RandomScenes random(1);
  for (const double apart : {0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3}) {
    if (trial.quick() && apart != 0.0 && apart != 1e-16 && apart != 1e-9) continue;
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
      if (trial.quick() && (apart == 0.0) != (brdf == Brdf::blinn)) continue;
      Scene scene = stage();
      scene.materials[0].brdf = brdf;
      for (glm::dvec3& n : scene.normals_world) n = glm::normalize(n + apart * random.cube());
      add_side_lights(scene);
      const std::string name = fmt::format("normals {:g} apart", apart);
      show(trial, scene, name, {.least_red = 101});
      // Also move light and eye far away: then no vector turns.
      scene.positional.clear();
      scene.spots.clear();
      move_eye_away(scene);
      show(trial, scene, name + ", light and eye far away");
    }
  }
}

// The result must be that of a directional light.
void far_lights(Trial& trial) {
  for (const double distance : {1e3, 1e6, 1e12, 1e100, 1e155, 1e200, 1e300, 1e308}) {
    if (trial.quick() && distance != 1e6 && distance != 1e308) continue;
    Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, 0.2, 1.0));
    scene.positional.push_back({distance * towards, glm::dvec3(0.5)});
    scene.spots.push_back({distance * towards, -towards, 0.99, 0.98, glm::dvec3(0.5)});
    show(trial, scene, fmt::format("lights {:g} away", distance), {.least_red = 151});
  }
}

// Normals that are opposite along the lowest edge, that are all three opposite across it, and that have no
// length.
void opposed_normals(Trial& trial) {
  RandomScenes random(2);
  for (const double apart : {0.0, 1e-16, 1e-12, 1e-6, 1e-2}) {
    if (trial.quick() && apart != 0.0 && apart != 1e-12) continue;
    for (const auto& normals : {std::array<glm::dvec3, 3>{{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}},
                                {{{0, 0, 1}, {0, 0, -1}, {0, 1, 0}}},
                                {{{0, 0.6, 0.8}, {0, -0.6, -0.8}, {0, 0.6, 0.8}}},
                                {{{0, 0, -1}, {0, 0, -1}, {0, 0, 1}}}}) {
      Scene scene = stage(normals);
      for (glm::dvec3& n : scene.normals_world) n = glm::normalize(n + apart * random.cube());
      add_side_lights(scene);
      show(trial, scene, fmt::format("normals {:g} from opposed", apart));
    }
  }
  for (const double length : {0.0, 1e-310, 1e-200}) {
    if (trial.quick() && length == 1e-310) continue;
    Scene scene = stage();
    for (glm::dvec3& n : scene.normals_world) n *= length;
    add_side_lights(scene);
    show(trial, scene, fmt::format("normals of length {:g}", length), {.least_red = 101});
  }
}

// At a pixel of a line, or between two pixels: L turns by half a turn from one to the next.
void light_in_the_surface(Trial& trial) {
  for (const double height : {0.0, 1e-15, 1e-9, 1e-6, 1e-3, 1e-2})
    for (const double between : {0.5, 0.25, 1e-3, 1e-9}) {
      if (trial.quick() && ((height != 0.0 && height != 1e-9) || between > 0.3)) continue;
      Scene scene = stage({{{0.1, 0, 1}, {-0.1, 0, 1}, {0, 0.1, 1}}});
      const glm::dvec3 p = surface_at(scene, c_stage_frame, 32, 24).position_world,
                       q = surface_at(scene, c_stage_frame, 33, 24).position_world;
      scene.positional.push_back({p + between * (q - p) + glm::dvec3(0, 0, height), glm::dvec3(0.8)});
      show(trial, scene,
           fmt::format("light {:g} above the surface, {:g} from a pixel to the next", height, between));
    }
  const Scene dark = stage({{{0.6, 0, 1}, {-0.6, 0, 1}, {0, 0.1, 1}}});
  // On the line through the middle: its first pixels, one in the middle, its last.
  const ScreenTriangle t = Pieces(dark, c_stage_frame).all().at(0);
  int first = -1, last = -1;
  for (int x = 0; x < static_cast<int>(c_stage_frame.width); ++x)
    if (covers(screen_points(t), c_subpixel_bits, x, 24)) first = first < 0 ? x : first, last = x;
  trial.require(first >= 0 && first + 8 < last, [] { return "the line is too short"; });
  for (const int x : {first, first + 1, 32, last})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong})
      for (const bool spot : {false, true}) {
        if (trial.quick() && ((brdf == Brdf::phong) != spot || x == first + 1)) continue;
        Scene scene = dark;
        scene.materials[0].brdf = brdf;
        const glm::dvec3 there = surface_at(scene, c_stage_frame, x, 24).position_world;
        if (spot)
          scene.spots.push_back({there, {1, 0, 0}, 0.9, 0.8, glm::dvec3(1.0)});
        else
          scene.positional.push_back({there, glm::dvec3(1.0)});
        show(trial, scene, fmt::format("{} at pixel {}", spot ? "spot" : "light", x));
      }
}

// N turns in a plane perpendicular to L: N.L = 0, and L is the axis of the turn.
void amplitude_zero(Trial& trial) {
  Scene scene = stage({{{0, -0.5, 1}, {0, 0, 1}, {0, 0.5, 1}}});
  scene.directional.push_back({{1, 0, 0}, glm::dvec3(1.0)});
  for (const double exponent : {1.0, 2.0, 1000.0}) {
    scene.materials[0].exponent = exponent;
    const std::string name = fmt::format("light grazes, exponent {:g}", exponent);
    const Shown shown = show(trial, scene, name);
    trial.require(shown.brightest == 0, [&] { return name + ": is not dark"; });
  }
  // Only the highlight's amplitude is zero: R is perpendicular to V everywhere.
  Scene mirror = stage();
  mirror.materials[0].brdf = Brdf::phong;
  move_eye_away(mirror);
  mirror.directional.push_back({glm::normalize(glm::dvec3(1, 0, 1)), glm::dvec3(1.0)});
  for (glm::dvec3& n : mirror.normals_world) n = glm::normalize(glm::dvec3(std::tan(-c_pi / 8), 0, 1));
  show(trial, mirror, "R across V");
}

// L = -V in the middle of the frame, on a surface that is seen from behind its normals.
void halfway_of_zero(Trial& trial) {
  for (const double aside : {0.0, 1e-16, 1e-12, 1e-6})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
      if (trial.quick() && aside == 1e-16) continue;
      Scene scene = stage({{{0.2, 0, -1}, {-0.2, 0.1, -1}, {0, -0.2, -1}}});
      scene.materials[0].brdf = brdf;
      const glm::dvec3 v =
          direction(surface_at(scene, c_stage_frame, 32, 24).position_world, scene.camera.eye_world);
      scene.directional.push_back(
          {aside == 0.0 ? -v : glm::normalize(glm::dvec3(aside, 0, 0) - v), glm::dvec3(1.0)});
      show(trial, scene, fmt::format("light {:g} from opposed to the eye", aside), {.least_red = 101});
    }
}

void eye_at_the_surface(Trial& trial) {
  for (const double height : {1e-3, 1e-6, 1e-9}) {
    Scene scene = stage();
    add_side_lights(scene);
    scene.camera.eye_world = {0.01, 0.02, height};
    scene.camera.target_world = {0.01, 0.02, 0.0};
    scene.camera.near = 0.5 * height;
    scene.camera.far = 10.0;
    show(trial, scene, fmt::format("eye {:g} above the surface", height));
  }
}

void one_pixel_spans(Trial& trial) {
  RandomScenes random(3);
  Scene scene = stage();
  add_side_lights(scene);
  scene.positions_world.clear();
  scene.normals_world.clear();
  scene.triangles.clear();
  for (std::uint32_t i = 0; i < 24; ++i) {  // slivers, from top to bottom
    const double x = -1.5 + 0.125 * i, width = 0.005 + 0.0037 * i;
    for (const glm::dvec3& p :
         {glm::dvec3(x, -1.4, 0), glm::dvec3(x + width, -1.3, 0), glm::dvec3(x, 1.4, 0)}) {
      scene.positions_world.push_back(p);
      scene.normals_world.push_back(glm::normalize(glm::dvec3(0, 0, 1) + 0.7 * random.cube()));
    }
    scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, {3 * i, 3 * i + 1, 3 * i + 2}, 0});
  }
  const Shown shown = show(trial, scene, "slivers");
  trial.require(
      3 * shown.fragments > shown.counts.records && shown.fragments < 2 * shown.counts.records, [&] {
        return fmt::format("{} fragments on {} lines: not one each", shown.fragments, shown.counts.records);
      });
}

// N.L < 0 < N.H: preset exact hides the highlight, preset published shows it.
void behind_the_horizon(Trial& trial) {
  for (const double diffuse : {0.5, 0.0}) {
    Scene scene = stage({{{-0.5, 0, 1}, {-0.5, 0.05, 1}, {-0.5, -0.05, 1}}});
    scene.materials[0].diffuse = diffuse;
    scene.materials[0].exponent = 4.0;
    scene.directional.push_back({glm::normalize(glm::dvec3(1, 0, 0.3)), glm::dvec3(1.0)});
    const std::string name = fmt::format("k_d {}", diffuse);
    const Shown shown = show(trial, scene, name);
    trial.require(shown.brightest == 0 && shown.published_brightest > 10, [&] {
      return name + ": no highlight below the horizon in preset published, or one in preset exact";
    });

    // The horizon crosses the triangle: the highlight must end abruptly at the right pixel.
    Scene half = stage({{{-0.6, 0, 1}, {0.8, 0.1, 1}, {0, -0.1, 1}}});
    half.materials[0].diffuse = diffuse;
    half.materials[0].exponent = 1.0;
    half.directional.push_back({glm::normalize(glm::dvec3(1, 0, 0.1)), glm::dvec3(1.0)});
    half.positional.push_back({{1.5, 0.0, 0.2}, glm::dvec3(0.5)});
    show(trial, half, name + ", horizon across the triangle", {.least_red = 101});
  }
}

void spots_that_end_at_once(Trial& trial) {
  for (const double cosine : {0.999, 0.98, 0.9}) {
    Scene scene = stage({{{0.1, 0, 1}, {-0.1, 0, 1}, {0, 0.1, 1}}});
    scene.spots.push_back(
        {{0.3, 0.1, 2.0}, glm::normalize(glm::dvec3(-0.3, -0.2, -2.0)), cosine, cosine, glm::dvec3(1.0)});
    show(trial, scene, fmt::format("cosine {}", cosine), {.least_red = 101});
  }
}

// Pixels with a red above white. A table's last entry is 0, however bright the light, so pixels that the
// light grazes are not counted.
void over_exposure(Trial& trial) {
  constexpr long double c_clearly_white = 1.05L, c_grazing = 1.0L / 128;
  for (const double intensity : {10.0, 1e9, 1e306, 1.7e308}) {
    Scene scene = stage({{{-2.9, -0.3, 1}, {0.5, 0, 1}, {0, 0.1, 1}}});
    add_side_lights(scene);
    scene.directional[0].intensity = {intensity, 0.0, 0.0};
    scene.materials[0].colour = {0.9, 0.0, 0.9};  // inf * 0 is NaN
    const Truth truth(scene, c_stage_frame);
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const Drawing drawing = trial.draw(
          scene, {.plan = {.shader = Shader::spherical, .preset = preset, .all_effects = true, .lights = 3},
                  .frame = c_stage_frame});
      const std::string name = fmt::format("intensity {:g}, preset {}", intensity, to_string(preset));
      // Preset exact represents up to 10 times white.
      const bool clamped = preset == Preset::published || intensity > 10.0;
      trial.require((drawing.counts.overexposed > 0) == clamped,
                    [&] { return name + ": the count of clamped factors is wrong"; });
      trial.require(drawing.golden.size() > 300, [&] { return name + ": is not drawn"; });
      for (const Fragment& f : drawing.golden) {
        const auto where = [&] { return fmt::format("{}, pixel {}, {}", name, f.x, f.y); };
        trial.require(f.green < 255, [&] { return where() + ": the green is white too"; });
        if (glm::dot(truth.normal_at(0, f.x, f.y), LongVec(scene.directional[0].to_light_world)) <
                c_grazing ||
            truth.radiance_at(0, f.x, f.y).x < c_clearly_white)
          continue;
        trial.measure(preset, 255 - f.red, 0, where);
      }
    }
  }
}

void wide_triangles(Trial& trial) {
  for (const double size : {3.0, 100.0, 1e6}) {
    Scene scene = stage({{{0.4, 0, 1}, {-0.5, 0.2, 1}, {0, 0.6, 1}}});
    for (glm::dvec3& p : scene.positions_world) p *= size;
    scene.camera.near = 0.1;
    scene.camera.far = 1e7;
    add_side_lights(scene);
    const std::string name = fmt::format("{:g} times as wide", size);
    const Shown shown = show(trial, scene, name);
    trial.require(shown.fragments > 3000, [&] { return name + ": does not fill the frame"; });
  }
}

Scene lit_from_somewhere(RandomScenes& random, const std::array<glm::dvec3, 3>& positions_world) {
  Scene scene = stage();
  scene.positions_world.assign(positions_world.begin(), positions_world.end());
  scene.camera.vertical_fov_degrees = 0.25;
  for (glm::dvec3& n : scene.normals_world) n = glm::normalize(glm::dvec3(0, 0, 1) + 0.5 * random.cube());
  scene.directional.push_back(
      {glm::normalize(glm::dvec3(0.2, 0.1, 1) + 0.3 * random.cube()), glm::dvec3(1.0)});
  return scene;
}

// Twice as wide as the frame at 4096 by 24 pixels, and within the guard band, so not clipped.
constexpr std::array<glm::dvec3, 3> c_twice_as_wide{
    {{-2.944, 0.0815, 0}, {0, -4.355, 0}, {2.947, 0.0815, 0}}};
void long_spans(Trial& trial) {
  for (int i = 0; i < trial.rounds(1, 6); ++i) {
    RandomScenes random(static_cast<unsigned>(100 + 8 * i));
    const Scene scene = lit_from_somewhere(random, c_twice_as_wide);
    show(trial, scene, fmt::format("scene {}", i),
         {.frame = {trial.quick() ? 1024U : 4096U, trial.quick() ? 6U : 24U}});
  }
}

constexpr HardCase c_cases[] = {{"near_vectors", near_vectors},
                                {"opposed_normals", opposed_normals},
                                {"far_lights", far_lights},
                                {"light_in_the_surface", light_in_the_surface},
                                {"amplitude_zero", amplitude_zero},
                                {"exponents", exponents},
                                {"past_the_bell", past_the_bell},
                                {"narrow_bells", narrow_bells},
                                {"four_bit_tables", four_bit_tables},
                                {"long_spans", long_spans},
                                {"halfway_of_zero", halfway_of_zero},
                                {"eye_at_the_surface", eye_at_the_surface},
                                {"one_pixel_spans", one_pixel_spans},
                                {"behind_the_horizon", behind_the_horizon},
                                {"spots_that_end_at_once", spots_that_end_at_once},
                                {"over_exposure", over_exposure},
                                {"wide_triangles", wide_triangles}};
INSTANTIATE_TEST_SUITE_P(spherical, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace
}  // namespace halfway::stability
