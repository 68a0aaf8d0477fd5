// SPDX-License-Identifier: Apache-2.0
// The illumination model at one point. The doubles of the reference renderer and of the host are compared
// with long double, for directions without length, cosines outside of [0, 1], and scenes that are much too
// large or too small.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "scene/lights.hpp"
#include "setup/test/random_scenes.hpp"
#include "shading/shade.hpp"
#include "stability/hard_case.hpp"
#include "stability/measure.hpp"
#include "stability/specification.hpp"
#include "stability/spherical_trial.hpp"
#include "stability/trial.hpp"

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

// ---- Error bounds of doubles

// All roundings are counted, in units of half an epsilon. A direction has an error of 7 (difference, scale,
// square, root, quotient), and a dot product adds 3. In epsilons: a sum of two directions has an error of 8,
// so H has 16/|L + V| and N.H 20/|L + V|; R has 16 and R.V 21.
struct CosineErrors {
  double light = 5 * c_epsilon;  // N.L
  double highlight;              // N.H or R.V
  explicit CosineErrors(const Material& m, long double l_plus_v)
      : highlight(m.brdf == Brdf::phong ? 21 * c_epsilon
                                        : 20 * c_epsilon / static_cast<double>(std::min(l_plus_v, 2.0L))) {}
};

// The error of the factor of k_s: at most 1 for a power, possibly infinite for Cook and Torrance.
long double specular_error(const Material& m, const LongVec& n, const LongVec& l, const LongVec& v) {
  const long double length = glm::length(l + v);
  const CosineErrors errors(m, length);
  const long double h_error = errors.highlight;
  if (m.brdf != Brdf::cook_torrance)  // d cos^n = n cos^(n - 1) d cos
    return std::min(1.0L, (long double)m.exponent * h_error) + 2 * c_epsilon;
  // Relative errors of P and of min{...}/(4 N.V), and the error of F.
  const long double n_dot_l = glm::dot(n, l), n_dot_v = glm::dot(n, v);
  if (!(n_dot_l > errors.light) || !(n_dot_v > errors.light) || !(length > 0)) return c_infinity;
  const LongVec h = (l + v) / length;
  const long double cosine = glm::dot(n, h), sine = glm::length(glm::cross(n, h)),
                    m2 = m.roughness * m.roughness;
  const long double q = sine * sine / (cosine * cosine * m2);
  const long double q_error = (2 * sine * h_error + h_error * h_error) / (cosine * cosine * m2) +
                              2 * q * h_error / cosine + 8 * c_epsilon * q;
  const long double relative = std::expm1(q_error) + 4 * h_error / cosine + 3 * errors.light / n_dot_l +
                               3 * errors.light / n_dot_v + 2 * h_error + 16 * c_epsilon;
  Material mirror = m;  // F = 1
  mirror.reflectance = 1.0;
  return relative * specular(m, n, l, v) + 40 * c_epsilon * specular(mirror, n, l, v) * (1 + relative);
}

// The error of the radiance in colour steps.
double radiance_error(const Scene& scene, const Material& m, const LongVec& position, const LongVec& normal) {
  const LongVec to_eye = LongVec(scene.camera.eye_world) - position;
  const LongVec v = glm::length(to_eye) > 0 ? glm::normalize(to_eye) : normal;
  long double error = 0;
  const auto add = [&](const LongVec& l, const glm::dvec3& intensity) {
    if (!(glm::dot(normal, l) > -5 * c_epsilon)) return;
    // Below the horizon there is no highlight. A cosine that is rounded to above the horizon may give a full
    // one.
    const long double highlight =
        glm::dot(normal, l) < 5 * c_epsilon ? 1.0L + c_epsilon : specular_error(m, normal, l, v);
    error += (long double)std::max({intensity.x, intensity.y, intensity.z}) *
             ((long double)m.diffuse * 5 * c_epsilon + (long double)m.specular * highlight);
  };
  for_each_light(scene, [&](const Light& light) {
    const LongVec from(light.point.xyz_world);
    add(light.point.w == 0.0 ? from : glm::normalize(from - position), light.intensity);
  });
  const LongVec sum = radiance(scene, m, position, normal);
  return static_cast<double>(255 * (error + 8 * c_epsilon * std::max({sum.x, sum.y, sum.z})));
}

// Compares the reference renderer's radiance with the specification. The bound is that of the counted
// roundings, or 0 with `is_exact`.
void compare(Trial& trial, const Scene& scene, const Material& m, glm::dvec3 position, glm::dvec3 normal,
             const std::function<std::string()>& where, bool is_exact = false) {
  const LongVec truth = radiance(scene, m, LongVec(position), LongVec(normal));
  const LongVec off = 255.0L * glm::abs(LongVec(radiance(scene, m, position, normal)) - truth);
  trial.ours(or_infinity(std::max({off.x, off.y, off.z})),
             is_exact ? 0.0 : radiance_error(scene, m, LongVec(position), LongVec(normal)), where);
}

Scene dark() {
  Scene scene;
  scene.ambient = glm::dvec3(0.0);
  return scene;
}

// The same with one positional light. Also compares the printed formula with the same bound.
void compare_light(Trial& trial, const Material& m, glm::dvec3 position, glm::dvec3 normal,
                   glm::dvec3 light_world, glm::dvec3 eye_world, const std::function<std::string()>& where) {
  Scene scene = dark();
  scene.positional.push_back({light_world, glm::dvec3(1.0)});
  scene.camera.eye_world = eye_world;
  const bool is_exact = light_world == position;
  compare(trial, scene, m, position, normal, where, is_exact);
  const double printed = reflected_as_printed(m, normal, unit_as_printed(light_world - position),
                                              unit_as_printed(eye_world - position));
  const LongVec truth = radiance(scene, m, LongVec(position), LongVec(normal));
  trial.published(or_infinity(255.0L * std::fabs(printed - truth.x)),
                  is_exact ? 0.0 : radiance_error(scene, m, LongVec(position), LongVec(normal)), where);
}

Material shiny(double exponent, Brdf brdf = Brdf::blinn) {
  return {.name = "m", .brdf = brdf, .ambient = 0.0, .diffuse = 0.5, .specular = 0.5, .exponent = exponent};
}

// ---- Normals

ScreenTriangle flat_triangle(const std::array<glm::dvec3, 3>& normals) {
  ScreenTriangle t{};
  constexpr std::array<glm::dvec3, 3> c_places{
      {{-1, -1, 0}, {0, 1, 0}, {1, -1, 0}}};  // clockwise on the screen
  for (std::size_t i = 0; i < 3; ++i)
    t.vertex[i] = {.x = 16 * static_cast<int>(i),
                   .y = i == 1 ? 0 : 32,
                   .z = 0.5,
                   .inverse_w = 1.0,
                   .position_world = c_places[i],
                   .normal_world = normals[i]};
  return t;
}

// Distance of a normal from unit length, where the interpolated normal is short, vanishes, or was zero
// before.
void normals_that_vanish(Trial& trial) {
  RandomScenes random(21);
  const auto measure = [&](const ScreenTriangle& t, glm::dvec3 barycentric, const std::string& name) {
    const auto where = [&] { return name; };
    const glm::dvec3 ours = surface_point(t, barycentric).normal_world;
    trial.ours(or_infinity(std::abs(glm::length(ours) - 1.0)), 4 * c_epsilon, where);
    const glm::dvec3 sum = barycentric.x * t.vertex[0].normal_world +
                           barycentric.y * t.vertex[1].normal_world +
                           barycentric.z * t.vertex[2].normal_world;
    trial.published(or_infinity(std::abs(glm::length(unit_as_printed(sum)) - 1.0)), 4 * c_epsilon, where);
  };
  for (int i = 0; i < trial.rounds(1000, 100'000); ++i) {
    const glm::dvec3 n = random.unit(), other = random.unit();
    for (const double apart : {0.0, 1e-17, 1e-15, 1e-12, 1e-9, 1e-6})
      measure(flat_triangle({n, glm::normalize(apart * other - n), other}), {0.5, 0.5, 0.0},
              fmt::format("normals {:g} from opposed", apart));
    for (const double length : {0.0, 5e-324, 1e-310, 1e-200, 1e-9})
      measure(flat_triangle({length * n, length * n, length * n}), {0.25, 0.25, 0.5},
              fmt::format("normals of length {:g}", length));
  }
  measure(flat_triangle({glm::dvec3(0), glm::dvec3(0), glm::dvec3(0)}), {1, 0, 0}, "no normals");
}

void normals_that_vanish_drawn(Trial& trial) {
  for (const double length : {0.0, 1e-310, 1e-200}) {
    Scene scene = stage();
    for (glm::dvec3& n : scene.normals_world) n *= length;
    add_side_lights(scene);
    show(trial, scene, fmt::format("normals of length {:g}", length), {.least_red = 101});
  }
}

// The middle of an edge between normals up to 60 degrees apart, where N.H is 1.
void normals_not_made_unit(Trial& trial) {
  for (const double degrees : {1.0, 5.0, 10.0, 20.0, 30.0, 45.0, 60.0})
    for (const double exponent : {1.0, 10.0, 50.0, 200.0, 1000.0, 1e6}) {
      const double half = 0.5 * degrees * std::numbers::pi / 180.0;
      const ScreenTriangle t = flat_triangle(
          {{{std::sin(half), 0, std::cos(half)}, {-std::sin(half), 0, std::cos(half)}, {0, 0, 1}}});
      const glm::dvec3 middle(0.5, 0.5, 0.0), towards(0, 0, 1);
      const double bound = exponent * 4 * c_epsilon;
      const auto where = [&] { return fmt::format("{} degrees, exponent {:g}", degrees, exponent); };
      const glm::dvec3 unit = surface_point(t, middle).normal_world,
                       chord = 0.5 * (t.vertex[0].normal_world + t.vertex[1].normal_world);
      trial.ours(std::abs(highlight_power(glm::dot(unit, towards), exponent) - 1.0), bound, where);
      trial.published(std::abs(std::pow(glm::dot(chord, towards), exponent) - 1.0), 0.5 / 255, where);
    }
}

// ---- Cosines

// Cosines of a direction with itself, normalized in different ways.
void cosines_past_one(Trial& trial) {
  RandomScenes random(22);
  for (int i = 0; i < trial.rounds(20'000, 2'000'000); ++i) {
    const glm::dvec3 v = random.unit(), n = glm::normalize(random.log_within(1e-3, 1e3) * v);
    const double cosine = glm::dot(n, v), exponent = random.log_within(1.0, 1e15);
    const auto where = [&] {
      return fmt::format("cosine 1 + {:.3g}, exponent {:.3g}", cosine - 1.0, exponent);
    };
    trial.both(std::max(highlight_power(cosine, exponent) - 1.0, 0.0),
               std::max(std::pow(cosine, exponent) - 1.0, 0.0), 0.0, where);
  }
}

// Lights behind the surface, and highlights with a negative N.H.
void cosines_below_zero(Trial& trial) {
  RandomScenes random(23);
  for (int i = 0; i < trial.rounds(5000, 500'000); ++i) {
    const Material m = shiny(random.one_in(2) ? random.whole(1, 51) : random.within(1.0, 51.0));
    const glm::dvec3 n = random.unit(), p = random.cube();
    glm::dvec3 away = random.unit();
    if (glm::dot(away, n) > 0) away = -away;
    compare_light(trial, m, p, n, p + 3.0 * away, p + 3.0 * random.unit(),
                  [&] { return fmt::format("light {}, exponent {:.3g}", i, m.exponent); });
  }
}

// ---- Positions

// A light at each of the distances from a point; with `at_origin` the point is the origin.
void light_at_distances(Trial& trial, unsigned seed, std::span<const double> distances, bool at_origin) {
  RandomScenes random(seed);
  for (int i = 0; i < trial.rounds(200, 20'000); ++i)
    for (const double distance : distances) {
      const Material m = shiny(random.log_within(1.0, 1000.0));
      const glm::dvec3 n = random.unit(), p = at_origin ? glm::dvec3(0.0) : random.cube(),
                       light = distance * random.unit();
      compare_light(trial, m, p, n, light, p + 3.0 * random.unit(),
                    [&] { return fmt::format("light {:g} away", distance); });
    }
}

void light_at_the_point(Trial& trial) {
  constexpr double c_near[] = {0.0, 5e-324, 1e-310, 1e-300, 1e-200, 1e-160, 1e-100, 1e-12};
  light_at_distances(trial, 24, c_near, true);
}

constexpr double c_far[] = {1e3, 1e6, 1e12, 1e100, 1e155, 1e200, 1e300, 1e308};

void light_far_away(Trial& trial) {
  light_at_distances(trial, 25, c_far, false);
}

// The result must be that of a directional light.
void light_far_away_drawn(Trial& trial) {
  for (const double distance : c_far) {
    if (trial.quick() && distance != 1e6 && distance != 1e12 && distance != 1e308) continue;
    Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, 0.2, 1.0));
    scene.positional.push_back({distance * towards, glm::dvec3(0.5)});
    scene.spots.push_back({distance * towards, -towards, 0.99, 0.98, glm::dvec3(0.5)});
    show(trial, scene, fmt::format("lights {:g} away", distance), {.least_red = 151});
  }
}

void light_behind_the_eye(Trial& trial) {
  RandomScenes random(26);
  for (int i = 0; i < trial.rounds(300, 30'000); ++i)
    for (const double aside : {0.0, 1e-17, 1e-16, 1e-12, 1e-8, 1e-3}) {
      const Material m = shiny(random.log_within(1.0, 1000.0));
      const glm::dvec3 n = random.unit(), v = random.unit(), light = -2.0 * v + aside * random.cube();
      // Skip lights at the horizon: a rounding decides whether they shine.
      if (std::fabs(glm::dot(glm::normalize(LongVec(light)), LongVec(n))) < 1e-6L) continue;
      compare_light(trial, m, glm::dvec3(0.0), n, light, 2.0 * v,
                    [&] { return fmt::format("light {:g} from opposed to the eye", aside); });
    }
}

// Any lights, points and materials: the error of the reference renderer's doubles.
void reference_renderer(Trial& trial) {
  RandomScenes random(27);
  for (int i = 0; i < trial.rounds(20'000, 2'000'000); ++i) {
    Scene scene;
    Material m = random.material(false, false, 1e15);
    m.brdf = random.one_in(3) ? Brdf::cook_torrance : m.brdf;
    m.roughness = random.log_within(1e-3, 1.0);
    m.reflectance = random.one_in(4) ? 0.0 : random.within(0.0, 1.0);
    const double scale = random.log_within(1e-6, 1e6);
    const glm::dvec3 n = random.unit(), p = scale * random.cube();
    const auto place = [&] { return p + scale * random.log_within(1e-6, 1e6) * random.unit(); };
    scene.camera.eye_world = place();
    scene.directional.push_back({random.unit(), random.log_within(1e-3, 1e3) * random.colour(false)});
    scene.positional.push_back({place(), random.log_within(1e-3, 1e3) * random.colour(false)});
    compare(trial, scene, m, p, n, [&] {
      return fmt::format("point {}, exponent {:.3g}, roughness {:.3g}", i, m.exponent, m.roughness);
    });
  }
}

// ---- Cook and Torrance, spots

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

// The factor is a step if both edges of the cone are equal. Nothing is divided by their distance.
void spots_without_an_edge(Trial& trial) {
  RandomScenes random(29);
  for (int i = 0; i < trial.rounds(20'000, 2'000'000); ++i) {
    const double outer = random.within(-1.0, 1.0),
                 width = random.one_in(2) ? 0.0 : random.log_within(1e-320, 1.0),
                 inner = std::min(outer + width, 1.0),
                 cosine = random.one_in(3)   ? inner
                          : random.one_in(2) ? outer
                                             : random.within(-1.0, 1.0);
    const LightCone cone{.axis_world = {0, 0, 1}, .cos_inner = inner, .cos_outer = outer};
    const long double t = inner > outer ? ((long double)cosine - outer) / ((long double)inner - outer) : 0.0L;
    const long double truth = cosine >= inner ? 1.0L : cosine <= outer ? 0.0L : t * t * (3 - 2 * t);
    const auto where = [&] { return fmt::format("cosine {} between {} and {}", cosine, outer, inner); };
    // Two differences, a quotient, and a polynomial of slope 3/2 at most: 8 roundings.
    const double printed = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    const auto off = [&](double share) { return or_infinity(std::fabs(share - truth)); };
    trial.both(off(cone_share(cone, cosine)), off(printed * printed * (3 - 2 * printed)), 8 * c_epsilon,
               where);
  }
}

// ---- Size

// All lengths times a power of two: the picture stays the same, or the triangle is left out and counted.
void sizes(Trial& trial) {
  Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
  add_side_lights(scene);
  const auto scaled = [&](int exponent) {
    const double by = std::ldexp(1.0, exponent);
    Scene s = scene;
    for (glm::dvec3& p : s.positions_world) p *= by;
    for (PositionalLight& light : s.positional) light.position_world *= by;
    for (SpotLight& light : s.spots) light.position_world *= by;
    s.camera.eye_world *= by;
    return s;
  };
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const DrawOptions options{
        .plan = {.shader = Shader::spherical, .preset = preset, .all_effects = true, .lights = 3},
        .frame = c_stage_frame};
    const std::vector<Fragment> one = trial.draw(scene, options).fragments;
    trial.require(one.size() > 500, [] { return "too little is drawn"; });
    for (const int exponent :
         {-1074, -1060, -1000, -700, -520, -340, -320, -100, -30, 30, 100, 320, 340, 520, 700, 1000, 1021}) {
      if (trial.quick() && exponent != -1000 && exponent != -320 && exponent != 320 && exponent != 1000)
        continue;
      const Drawing drawing = trial.draw(scaled(exponent), options);
      const auto where = [&] { return fmt::format("2^{}, preset {}", exponent, to_string(preset)); };
      double wrong = 0;
      if (drawing.fragments.empty())
        wrong = drawing.counts.projection.unrepresentable == 1 ? 0 : 1;
      else if (drawing.fragments.size() != one.size())
        wrong = static_cast<double>(std::max(drawing.fragments.size(), one.size()));
      else
        for (std::size_t i = 0; i < one.size(); ++i) wrong += !(drawing.fragments[i] == one[i]);
      trial.measure(preset, wrong, 0, where);
    }
  }
}

constexpr std::string_view c_rounding =
    "the reference renderer compared with long double, within the counted roundings";

constexpr HardCase c_cases[] = {
    {"normals_that_vanish", "Normals that vanish",
     "spherical, equation 10: N/‖N‖ is 0/0 between opposed ones",
     "the normal of the triangle where the sum is shorter than 10⁻⁸", "a normal has length 1",
     "of its length", PublishedForm::breaks, normals_that_vanish},
    {"normals_that_vanish_drawn", "Normals that vanish, drawn", "spherical, equation 10", "the same",
     "the illumination model, within the threshold and the errors of fit and table", "colour steps",
     PublishedForm::breaks, normals_that_vanish_drawn},
    {"normals_not_made_unit", "Interpolated normals that are not normalized",
     "processors, section 3, version I: N·H is scaled by the cosine of half the edge's angle",
     "normalized before the dot product", "the highlight in the middle of an edge", "of a highlight",
     PublishedForm::breaks, normals_not_made_unit},
    {"cosines_past_one", "N·H above 1 by rounding", "spherical, equation 5: (N·H)ⁿ for n to 10¹⁵",
     "N·H is clamped to 1", "no highlight is brighter than its light", "of a highlight",
     PublishedForm::breaks, cosines_past_one},
    {"cosines_below_zero", "N·L or N·H below 0",
     "spherical, equations 2 and 5: negative light, and NaN for an n that is no integer",
     "a light below the horizon adds 0", c_rounding, "colour steps", PublishedForm::breaks,
     cosines_below_zero},
    {"light_at_the_point", "Light at the point",
     "processors, equation 3: (P_p − P)/‖P_p − P‖ is 0/0, squares underflow",
     "vectors are scaled before squaring; no light at the point itself", c_rounding, "colour steps",
     PublishedForm::breaks, light_at_the_point},
    {"light_far_away", "Light at a distance of 10³ to 10³⁰⁸", "processors, equation 3: squares overflow",
     "vectors are scaled before squaring", c_rounding, "colour steps", PublishedForm::breaks, light_far_away},
    {"light_far_away_drawn", "Light at a distance of 10³ to 10³⁰⁸, drawn", "processors, equation 3",
     "the same", "the illumination model, within the threshold and the errors of fit and table",
     "colour steps", PublishedForm::breaks, light_far_away_drawn},
    {"light_behind_the_eye", "H = 0/0", "spherical, equation 6: L = −V", "no highlight there", c_rounding,
     "colour steps", PublishedForm::breaks, light_behind_the_eye},
    {"reference_renderer", "Random points, lights and materials", "spherical, equations 1 to 7",
     "sums in double", c_rounding, "colour steps", PublishedForm::silent, reference_renderer},
    {"grazing", "Cook–Torrance at grazing angles", "spherical, equation 7: 1/(N·L N·V)",
     "N·L and N·V are cancelled; the result is clamped to 10⁶", "finite and not negative", "of a light",
     PublishedForm::breaks, grazing},
    {"spots_without_an_edge", "Spot without a soft edge", "smoothstep over cos_inner − cos_outer = 0",
     "a step function", "smoothstep, compared with long double", "of a light", PublishedForm::breaks,
     spots_without_an_edge},
    {"sizes", "Scenes of any size", "lengths are scaled by 2⁻¹⁰⁷⁴ to 2¹⁰²¹",
     "vectors are scaled before squaring; triangles that are too large are omitted and counted",
     "the same fragments, or none", "fragments", PublishedForm::holds, sizes},
};

INSTANTIATE_TEST_SUITE_P(illumination, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace

}  // namespace halfway::stability
