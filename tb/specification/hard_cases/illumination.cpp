// SPDX-License-Identifier: Apache-2.0
// The illumination model at one point: directions without length, cosines outside of [0, 1], grazing light;
// and scenes with numbers that are none, much too large or too small.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "golden_run/golden_run.hpp"
#include "reference/renderer.hpp"
#include "scene/check_numbers.hpp"
#include "scene/lights.hpp"
#include "scene/test/random_scenes.hpp"
#include "shading/shade.hpp"
#include "sim/os/must.hpp"
#include "specification/hard_cases/hard_case.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/specification.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {
namespace {

constexpr double c_epsilon = std::numeric_limits<double>::epsilon();

// ---- The printed formulas in double

glm::dvec3 unit_as_printed(glm::dvec3 v) {
  return v / std::sqrt(glm::dot(v, v));
}

// I_in (k_s (N.H)^n + k_d (N.L)) of one light, H = (L + V)/|L + V|.
double reflected_as_printed(const Material& m, glm::dvec3 n, glm::dvec3 l, glm::dvec3 v) {
  const glm::dvec3 h = unit_as_printed(l + v);
  return m.specular * std::pow(glm::dot(n, h), m.exponent) + m.diffuse * glm::dot(n, l);
}

// ---- Directions

// The error of the reference renderer's radiance of one positional light, in colour steps. All roundings are
// counted, in units of half an epsilon. A direction has an error of 7 (difference, scale, square, root,
// quotient), and a dot product adds 3. In epsilons: a sum of two directions has an error of 8, so H has 16/|L
// + V| and N.H 20/|L + V|. d cos^n = n cos^(n - 1) d cos.
long double radiance_error(const Material& m, const LongVec& n, const LongVec& l, const LongVec& v,
                           long double radiance) {
  constexpr long double c_cosine = 5 * c_epsilon;  // N.L
  const long double n_dot_l = glm::dot(n, l);
  long double error = 0;
  if (n_dot_l > -c_cosine) {
    const long double n_dot_h = 20 * c_epsilon / std::min(glm::length(l + v), 2.0L);
    // Below the horizon there is no highlight. A cosine that is rounded to above the horizon may give a full
    // one.
    const long double highlight =
        n_dot_l < c_cosine ? 1.0L + c_epsilon : std::min(1.0L, m.exponent * n_dot_h) + 2 * c_epsilon;
    error = m.diffuse * c_cosine + m.specular * highlight;
  }
  return 255 * (error + 8 * c_epsilon * radiance);
}

// Compares the reference renderer's radiance and the printed formula with the specification.
void compare_light(Trial& trial, const Material& m, glm::dvec3 position, glm::dvec3 normal,
                   glm::dvec3 light_world, glm::dvec3 eye_world, const std::string& name) {
  Scene scene;
  scene.ambient = glm::dvec3(0.0);
  scene.positional.push_back({light_world, glm::dvec3(1.0)});
  scene.camera.eye_world = eye_world;
  const LongVec n(normal), p(position), to_light = LongVec(light_world) - p;
  const long double truth = radiance(scene, m, p, n).x;
  const long double bound =
      light_world == position
          ? 0.0L
          : radiance_error(m, n, glm::normalize(to_light), glm::normalize(LongVec(eye_world) - p), truth);
  const double printed = reflected_as_printed(m, normal, unit_as_printed(light_world - position),
                                              unit_as_printed(eye_world - position));
  const auto off = [&](double ours) { return or_infinity(255.0L * std::fabs(ours - truth)); };
  trial.ours(off(radiance(scene, m, position, normal).x), bound, [&] { return name; });
  trial.published(off(printed), bound, [&] { return name; });
}

Material shiny(double exponent, Brdf brdf = Brdf::blinn) {
  return {.name = "m", .brdf = brdf, .ambient = 0.0, .diffuse = 0.5, .specular = 0.5, .exponent = exponent};
}

// Lights at any distance from the point, behind the surface, and behind the eye.
void directions(Trial& trial) {
  RandomScenes random(24);
  for (int i = 0; i < trial.rounds(500, 50'000); ++i) {
    const Material m = shiny(random.one_in(2) ? random.whole(1, 51) : random.log_within(1.0, 1000.0));
    const glm::dvec3 n = random.unit(), p = random.cube(), v = random.unit(), origin(0.0);
    for (const double distance : {0.0, 5e-324, 1e-310, 1e-300, 1e-200, 1e-160, 1e-100, 1e-12, 1e3, 1e6, 1e12,
                                  1e100, 1e155, 1e200, 1e300, 1e308})
      compare_light(trial, m, distance < 1 ? origin : p, n, distance * random.unit(),
                    (distance < 1 ? origin : p) + 3.0 * v, fmt::format("light {:g} away", distance));
    glm::dvec3 away = random.unit();
    if (glm::dot(away, n) > 0) away = -away;
    compare_light(trial, m, p, n, p + 3.0 * away, p + 3.0 * v, fmt::format("light {} behind the surface", i));
    for (const double aside : {0.0, 1e-17, 1e-16, 1e-12, 1e-8, 1e-3}) {
      const glm::dvec3 light = -2.0 * v + aside * random.cube();
      // Skip lights at the horizon: a rounding decides whether they shine.
      if (std::fabs(glm::dot(glm::normalize(LongVec(light)), LongVec(n))) < 1e-6L) continue;
      compare_light(trial, m, origin, n, light, 2.0 * v,
                    fmt::format("light {:g} from opposed to the eye", aside));
    }
    // A direction with itself, normalized in different ways.
    const double cosine = glm::dot(glm::normalize(random.log_within(1e-3, 1e3) * v), v),
                 exponent = random.log_within(1.0, 1e15);
    trial.require(highlight_power(cosine, exponent) <= 1.0, [&] {
      return fmt::format("cosine 1 + {:.3g}, exponent {:.3g}: brighter than the light", cosine - 1.0,
                         exponent);
    });
  }
}

// Light and eye graze the surface from opposite sides. The printed quotient by N.L N.V is not bounded.
void grazing(Trial& trial) {
  RandomScenes random(28);
  for (int i = 0; i < trial.rounds(2000, 200'000); ++i) {
    Material m = shiny(1.0, Brdf::cook_torrance);
    m.roughness = random.log_within(1e-300, 1.0);
    m.reflectance = random.within(0.0, 1.0);
    const auto above = [&] { return random.one_in(8) ? 0.0 : random.log_within(1e-320, 1.0); };
    const glm::dvec3 n(0, 0, 1),
        l = glm::normalize(glm::dvec3(1, 0, above())),
        v = glm::normalize(glm::dvec3(-1, random.one_in(2) ? 0.0 : random.within(-1, 1), above()));
    const auto where = [&] {
      return fmt::format("N.L {:.3g}, N.V {:.3g}, roughness {:.3g}", l.z, v.z, m.roughness);
    };
    const double ours = specular_factor(m, n, l, v);
    trial.ours(or_infinity(ours), c_largest_specular, where);
    trial.require(ours >= 0.0, [&] { return where() + ": takes light away"; });
    const glm::dvec3 h = unit_as_printed(l + v);
    const double nh = glm::dot(n, h), vh = glm::dot(v, h), tan2 = (1.0 - nh * nh) / (nh * nh),
                 density = std::exp(-tan2 / (m.roughness * m.roughness)) /
                           (std::numbers::pi * m.roughness * m.roughness * nh * nh * nh * nh),
                 shadowed = std::min({2 * nh * v.z / vh, 2 * nh * l.z / vh, 1.0});
    trial.published(or_infinity(density * schlick(m.reflectance, vh) / (4 * l.z * v.z) * shadowed * l.z),
                    c_largest_specular, where);
  }
}

// ---- Numbers

// Each with both signs.
constexpr double c_magnitudes[] = {std::numeric_limits<double>::quiet_NaN(),
                                   c_infinity,
                                   1.7976931348623157e308,
                                   1e155,
                                   1e100,
                                   1e15,
                                   0x1p64,
                                   0x1p63,
                                   0x1p32,
                                   0x1p31,
                                   5e-324,
                                   1e-310,
                                   0.0,
                                   0.5};
constexpr FrameSize c_frame{33, 25};
// The hardware of the spherical family.
const PlanRequest c_spherical{.shader = Shader::spherical, .all_effects = true, .lights = 3};

Scene base_scene() {
  Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
  scene.materials[0].ambient = 0.1;
  scene.camera.near = 1.0;
  scene.camera.far = 100.0;
  add_side_lights(scene);
  return scene;
}

struct Number {
  std::string name;
  double* value;
};
std::vector<Number> numbers_of(Scene& scene) {
  std::vector<Number> all;
  const auto vector = [&](const std::string& name, glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) all.push_back({fmt::format("{}.{}", name, "xyz"[i]), &v[i]});
  };
  vector("eye", scene.camera.eye_world);
  vector("target", scene.camera.target_world);
  vector("up", scene.camera.up_world);
  all.push_back({"fov", &scene.camera.vertical_fov_degrees});
  all.push_back({"near", &scene.camera.near});
  all.push_back({"far", &scene.camera.far});
  vector("ambient", scene.ambient);
  vector("background", scene.background);
  vector("to_light", scene.directional[0].to_light_world);
  vector("directional intensity", scene.directional[0].intensity);
  vector("position", scene.positional[0].position_world);
  vector("positional intensity", scene.positional[0].intensity);
  vector("spot position", scene.spots[0].position_world);
  vector("spot axis", scene.spots[0].axis_world);
  vector("spot intensity", scene.spots[0].intensity);
  all.push_back({"cos_inner", &scene.spots[0].cos_inner});
  all.push_back({"cos_outer", &scene.spots[0].cos_outer});
  Material& m = scene.materials[0];
  vector("colour", m.colour);
  vector("specular_colour", m.specular_colour);
  all.push_back({"k_a", &m.ambient});
  all.push_back({"k_d", &m.diffuse});
  all.push_back({"k_s", &m.specular});
  all.push_back({"exponent", &m.exponent});
  all.push_back({"roughness", &m.roughness});
  all.push_back({"reflectance", &m.reflectance});
  vector("vertex", scene.positions_world[1]);
  vector("normal", scene.normals_world[1]);
  return all;
}

// Fragments outside of the frame.
double outside(const std::vector<Fragment>& fragments) {
  return static_cast<double>(std::ranges::count_if(
      fragments, [](const Fragment& f) { return f.x >= c_frame.width || f.y >= c_frame.height; }));
}

// Runs set-up and golden model without the plan's checks. Returns the number of fragments outside of the
// frame.
double fragments_outside(const Scene& scene, const HardwareKey& key) {
  return outside(must(whole_stream(scene, c_frame, key, {.check = false})).golden);
}

// The spherical shader draws the illumination model, or counts what it leaves out. Radiance above white is
// clamped and counted; the bound then does not apply.
void draw_number(Trial& trial, const Scene& scene, const std::string& name) {
  const Drawing drawing = trial.draw(scene, {.plan = c_spherical, .frame = c_frame});
  const ProjectionCounts& c = drawing.counts.projection;
  if (drawing.golden.empty()) {
    trial.check(c.back_facing + c.behind_near + c.outside + c.degenerate + c.unrepresentable > 0,
                [&] { return name + ": lost in silence"; });
    return;
  }
  const double bound = promised_steps(scene, drawing.key, 2.0);
  if (drawing.counts.overexposed > 0 || !std::isfinite(bound)) {
    trial.require(drawing.counts.overexposed > 0, [&] { return name + ": past white in silence"; });
    return;
  }
  const Truth truth(scene, c_frame);
  for (const Fragment& f : drawing.golden)
    trial.ours(colour_error(f, truth.radiance_at(f.triangle, f.x, f.y)), bound,
               [&] { return fmt::format("{}, pixel {}, {}", name, f.x, f.y); });
}

// The reference draws each covered pixel, with shadows too.
void render_number(Trial& trial, Scene scene, const std::string& name) {
  scene.shadows = true;
  const auto triangles = Projector(scene, c_frame, {.subpixel_bits = c_subpixel_bits}).project_all();
  const ReferenceImage image = render_reference(scene, triangles, {.frame = c_frame});
  std::ptrdiff_t covered = 0;
  for (const ScreenTriangle& t : triangles)
    for_each_covered(screen_points(t), c_subpixel_bits, c_frame, [&](auto, auto) { ++covered; });
  trial.check(covered == std::ranges::count(image.mask, std::uint8_t{1}),
              [&] { return name + ", reference"; });
}

// Each number of a scene that no loader has checked, replaced by each hostile one.
void numbers(Trial& trial) {
  Scene base = base_scene();
  const std::size_t count = numbers_of(base).size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < 2 * std::size(c_magnitudes); ++j) {
      if (trial.quick() && (i + j) % 6 != 0) continue;
      const double hostile = j % 2 == 0 ? c_magnitudes[j / 2] : -c_magnitudes[j / 2];
      Scene scene = base_scene();
      const Number number = numbers_of(scene)[i];
      *number.value = hostile;
      const std::string name = fmt::format("{} {:g}", number.name, hostile);
      const bool sound = bool(check_numbers(scene));
      trial.check(!sound || std::isfinite(hostile), [&] { return name + ": not checked"; });
      for (const Shader shader : c_shaders)
        for (const Preset preset : {Preset::exact, Preset::published}) {
          const PlanRequest request{.shader = shader, .preset = preset};
          const auto plan = plan_scene(scene, request);
          if (!sound)
            trial.check(!plan && plan.error().code == ExitCode::bad_input &&
                            plan.error().message.starts_with("stage: "),
                        [&] { return name + ": accepted"; });
          // Without the plan nothing leaves the frame.
          const auto key = plan ? plan : plan_scene(base, request);
          trial.ours(fragments_outside(scene, key->key), 0, [&] { return name + ": outside"; });
        }
      if (sound) draw_number(trial, scene, name);
      render_number(trial, scene, name);
    }
}

// All lengths times a power of two: the picture stays the same, or the triangle is left out and counted.
void sizes(Trial& trial) {
  Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
  add_side_lights(scene);
  const DrawOptions options{.plan = c_spherical, .frame = c_stage_frame};
  const std::vector<Fragment> one = trial.draw(scene, options).golden;
  trial.require(one.size() > 500, [] { return "too little is drawn"; });
  for (const int exponent : {-1074, -1000, -520, -320, -100, -30, 30, 100, 320, 520, 1000, 1021}) {
    if (trial.quick() && std::abs(exponent) != 1000 && std::abs(exponent) != 320) continue;
    const Drawing drawing = trial.draw(scaled(scene, std::ldexp(1.0, exponent)), options);
    trial.check(
        drawing.golden.empty() ? drawing.counts.projection.unrepresentable == 1 : drawing.golden == one,
        [&] { return fmt::format("scaled by 2^{}", exponent); });
  }
}

void hostile_scenes(Trial& trial) {
  numbers(trial);
  sizes(trial);
}

constexpr HardCase c_cases[] = {
    {"directions", directions}, {"grazing", grazing}, {"hostile_scenes", hostile_scenes}};
INSTANTIATE_TEST_SUITE_P(illumination, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace
}  // namespace halfway::stability
