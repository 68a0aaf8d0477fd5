// SPDX-License-Identifier: Apache-2.0
// Compares the highlight test with densely sampled radiance: errors in accepted triangles, and unnecessary
// splits.
#include "setup/highlight_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "setup/proved_bound.hpp"
#include "setup/quadratic_setup.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

constexpr double c_threshold = 2.0;

struct Case {
  Scene scene;
  ScreenTriangle triangle{};

  SurfacePoint surface(glm::dvec3 barycentric) const { return surface_point(triangle, barycentric); }
  glm::dvec3 radiance_at(glm::dvec3 barycentric) const {
    const SurfacePoint p = surface(barycentric);
    return radiance(scene, scene.materials[0], p.position_world, p.normal_world);
  }
};

SampledTriangle sampled(const Case& c) {
  const std::array<glm::dvec3, 6> at = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}};
  SampledTriangle t;
  for (std::size_t i = 0; i < 6; ++i) {
    t.surface[i] = c.surface(at[i]);
    t.radiance[i] = c.radiance_at(at[i]);
  }
  return t;
}

double centroid_test(const Case& c, const SampledTriangle& t) {
  return centroid_error(t, c.radiance_at(glm::dvec3(1.0 / 3.0)));
}

/// Largest error of the quadratic in colour steps. Both values are clamped as in the frame, and samples as in
/// the setup.
double dense_error(const Case& c, const SampledTriangle& t) {
  constexpr int c_divisions = 40;
  std::array<glm::dvec3, 6> r = t.radiance;
  for (glm::dvec3& sample : r) sample = glm::min(sample, glm::dvec3(c_largest_sample / 255.0));
  double worst = 0.0;
  for (int i = 0; i <= c_divisions; ++i)
    for (int j = 0; i + j <= c_divisions; ++j) {
      const glm::dvec3 b = glm::dvec3(i, j, c_divisions - i - j) / double(c_divisions);
      const glm::dvec3 quadratic = r[0] * b.x * (2 * b.x - 1) + r[1] * b.y * (2 * b.y - 1) +
                                   r[2] * b.z * (2 * b.z - 1) +
                                   4.0 * (r[3] * b.x * b.y + r[4] * b.x * b.z + r[5] * b.y * b.z);
      const glm::dvec3 exact = c.radiance_at(b);
      const glm::dvec3 off = glm::abs(glm::clamp(quadratic, 0.0, 1.0) - glm::clamp(exact, 0.0, 1.0));
      worst = std::max({worst, 255.0 * off.x, 255.0 * off.y, 255.0 * off.z});
    }
  return worst;
}

double angle(glm::dvec3 a, glm::dvec3 b) {
  return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

/// The light of a case. A new kind of light gets a place of its own: then the random cases of the others
/// stay.
enum class LightPlace {
  near_highlight,  ///< directional, positional or spot: most patches have a highlight in or next to them
  grazing,         ///< positional, close to the horizon of the patch
};

/// Curved patches, eyes and lights near and far.
class RandomCases {
 public:
  explicit RandomCases(unsigned seed, LightPlace place = LightPlace::near_highlight)
      : random_(seed), place_(place) {}

  Case next(Brdf brdf) {
    for (;;)
      if (Case c; fill(c, brdf)) return c;
  }

 private:
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double of_any_size(double low, double high) { return std::exp(within(std::log(low), std::log(high))); }
  bool chance(double p) { return within(0, 1) < p; }
  glm::dvec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random_), normal(random_), normal(random_)));
  }

  bool fill(Case& c, Brdf brdf) {
    const double size = of_any_size(0.05, 2.0), largest_edge = glm::radians(of_any_size(1.0, 60.0));
    std::array<glm::dvec3, 3> p, slope, n;
    for (glm::dvec3& v : p) v = size * glm::dvec3(within(-1, 1), within(-1, 1), 0);
    if (std::abs(glm::cross(p[1] - p[0], p[2] - p[0]).z) < 0.1 * size * size) return false;
    // Two curvatures along two axes (spherical, cylindrical or saddle), then tilted.
    const double first = within(-1, 1), second = chance(0.4) ? first : within(-1, 1),
                 turn = within(0, 3.1416);
    const glm::dvec3 u(std::cos(turn), std::sin(turn), 0), v(-u.y, u.x, 0),
        up = glm::dvec3(0, 0, 1) + within(0, 0.5) * direction();
    for (std::size_t i = 0; i < 3; ++i)
      slope[i] = (first * glm::dot(p[i], u) * u + second * glm::dot(p[i], v) * v) / size;
    const auto edge = [&](double bend) {
      for (std::size_t i = 0; i < 3; ++i) n[i] = glm::normalize(up + bend * slope[i]);
      return std::max({angle(n[0], n[1]), angle(n[0], n[2]), angle(n[1], n[2])});
    };
    double low = 0, high = 50;
    if (edge(high) < largest_edge) return false;
    for (int i = 0; i < 40; ++i) (edge(0.5 * (low + high)) < largest_edge ? low : high) = 0.5 * (low + high);

    glm::dvec3 to_eye = direction();
    to_eye.z = std::abs(to_eye.z);
    const double distance = size * (chance(0.5) ? of_any_size(1.5, 6) : of_any_size(6, 100));
    const glm::dvec3 eye = distance * to_eye, axis = glm::normalize(eye - (p[0] + p[1] + p[2]) / 3.0);
    c.scene.camera.eye_world = eye;
    for (std::size_t i = 0; i < 3; ++i) {
      const double w = glm::dot(eye - p[i], axis);
      if (to_eye.z < 0.1 || w < 0.05 * distance) return false;
      c.triangle.vertex[i] = {0, 0, 0.5, 1.0 / w, p[i], n[i]};
    }

    Material m;
    m.brdf = brdf;
    m.exponent = of_any_size(1, 1000);
    m.roughness = of_any_size(0.05, 1);
    m.colour = {within(0, 1), within(0, 1), within(0, 1)};
    m.diffuse = within(0, 0.8);
    m.specular = within(0.1, 0.8);
    c.scene.materials = {m};

    glm::dvec3 b(within(0, 1), within(0, 1), within(0, 1));
    b /= b.x + b.y + b.z;
    if (chance(0.3)) b += within(-1, 1) * glm::dvec3(0.4, -0.2, -0.2);  // outside the triangle
    const SurfacePoint peak = c.surface(b);
    const glm::dvec3 peak_to_eye = glm::normalize(eye - peak.position_world);
    const glm::dvec3 about =
        glm::normalize(peak.normal_world +
                       direction() * (chance(0.7) ? within(0, 3) / std::sqrt(m.exponent) : within(0, 1)));
    const glm::dvec3 to_light =
        chance(0.05) ? direction() : 2 * glm::dot(about, peak_to_eye) * about - peak_to_eye;
    const glm::dvec3 intensity(within(0.3, 1), within(0.3, 1), within(0.3, 1));
    const glm::dvec3 light =
        peak.position_world + to_light * size * (chance(0.5) ? of_any_size(0.3, 3) : of_any_size(3, 100));
    if (place_ == LightPlace::grazing) {
      const glm::dvec3 outward = peak.normal_world, across = glm::normalize(glm::cross(outward, direction()));
      const glm::dvec3 grazing = glm::normalize(across + within(-0.1, 0.1) * outward);
      c.scene.positional.push_back({peak.position_world + grazing * size * of_any_size(0.3, 5), intensity});
      return true;
    }
    const double kind = within(0, 1);
    if (kind < 0.4) {
      c.scene.directional.push_back({to_light, intensity});
    } else if (kind < 0.75) {
      c.scene.positional.push_back({light, intensity});
    } else {
      const double outer = of_any_size(0.02, 1.4);
      c.scene.spots.push_back({light, glm::normalize(within(0, 0.6) * direction() - to_light),
                               std::cos(outer * within(0, 0.95)), std::cos(outer), intensity});
    }
    return true;
  }

  std::mt19937_64 random_;
  LightPlace place_;
};

struct Outcome {
  int cases = 0, followed = 0, passed = 0, split_in_vain = 0;
  double worst = 0.0;  // error of accepted triangles, in thresholds
  // Accepted by the published test alone, with an error above twice the threshold.
  int wrong_centroid = 0;
  double worst_centroid = 0.0;  // in colour steps
};

Outcome outcome(Brdf brdf, unsigned seed, int cases, LightPlace place = LightPlace::near_highlight) {
  RandomCases random(seed, place);
  Outcome o;
  for (; o.cases < cases; ++o.cases) {
    const Case c = random.next(brdf);
    const SampledTriangle t = sampled(c);
    const double centroid = centroid_test(c, t), error = dense_error(c, t);
    const bool pass =
        centroid <= c_threshold && missed_highlight_bound(c.scene, c.scene.materials[0], t) <= c_threshold;
    o.followed += error <= c_threshold;
    o.passed += pass;
    o.split_in_vain += !pass && error <= c_threshold;
    if (pass) o.worst = std::max(o.worst, error / c_threshold);
    if (centroid <= c_threshold) {
      o.wrong_centroid += error > 2 * c_threshold;
      o.worst_centroid = std::max(o.worst_centroid, error);
    }
  }
  return o;
}

// Accepted triangles have an error of at most twice the threshold. The test must not split everything.
TEST(HighlightTest, AcceptedTrianglesAreWithinTwiceTheThreshold) {
  for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
    const Outcome o = outcome(brdf, 1, 25000);
    EXPECT_LE(o.worst, 2.0);
    EXPECT_GT(o.worst, 0.5) << "needlessly strict";
    EXPECT_LT(o.split_in_vain, 0.33 * o.followed);
    EXPECT_GT(o.wrong_centroid, 1000) << "the published test alone should not do";
    EXPECT_GT(o.worst_centroid, 100.0);
  }
}

// If a light is just above the horizon of a patch, all six samples may be dark and a highlight, cut off by
// the terminator, may lie between them.
TEST(HighlightTest, AHighlightAtTheTerminatorIsNotMissed) {
  for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
    const Outcome o = outcome(brdf, 3, 20000, LightPlace::grazing);
    EXPECT_LE(o.worst, 2.0);
    EXPECT_GT(o.passed, 500);
    EXPECT_GT(o.worst_centroid, 100.0);
  }
}

// The limit for Cook-Torrance at grazing angles is wider.
TEST(HighlightTest, CookTorrancePassesWithinThreeThresholds) {
  const Outcome o = outcome(Brdf::cook_torrance, 2, 12000);
  EXPECT_LE(o.worst, 3.0);
  EXPECT_LT(o.split_in_vain, 0.35 * o.followed);
}

// The error is nowhere above the proved bound, and the bound is not much above the error.
TEST(ProvedBound, IsNotExceeded) {
  for (const auto& [place, count] :
       {std::pair{LightPlace::near_highlight, 3000}, {LightPlace::grazing, 1000}})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong, Brdf::cook_torrance}) {
      RandomCases random(5, place);
      int accepted = 0;
      double worst = 0.0;
      for (int i = 0; i < count; ++i) {
        const Case c = random.next(brdf);
        const SampledTriangle t = sampled(c);
        const double error = dense_error(c, t),
                     bound = proved_bound(c.scene, lights_of(c.scene), c.scene.materials[0], t);
        ASSERT_LE(error, bound + 1e-9) << "case " << i;
        accepted += bound <= 4 * c_threshold;
        if (error > 0.1) worst = std::max(worst, error / bound);
      }
      EXPECT_GT(accepted, count / 10);
      EXPECT_GT(worst, 0.4);
    }
}

// Taylor remainders about the best y, on a grid of x and y; a bend at every place and in every direction.
TEST(ProvedBound, ConstantsOfInterpolation) {
  constexpr int c_divisions = 30;
  using Vec = glm::dvec3;
  const std::array<Vec, 6> node = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}}};
  std::vector<Vec> grid;
  for (int i = 0; i <= c_divisions; ++i)
    for (int j = 0; i + j <= c_divisions; ++j)
      grid.push_back(Vec(i, j, c_divisions - i - j) / double(c_divisions));
  const auto size = [](Vec d) { return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}); };
  double third = 0, second = 0, sum = 0, midpoints = 0, bend = 0;
  for (const Vec& x : grid) {
    std::array<double, 6> weight;
    for (int i = 0; i < 3; ++i) weight[i] = x[i] * (2 * x[i] - 1);
    weight[3] = 4 * x.x * x.y, weight[4] = 4 * x.x * x.z, weight[5] = 4 * x.y * x.z;
    double best_third = 1, best_second = 1, all = 0;
    for (const Vec& y : grid) {
      double third_at = std::pow(size(x - y), 3) / 6, second_at = std::pow(size(x - y), 2) / 2;
      for (int i = 0; i < 6; ++i) {
        third_at += std::abs(weight[i]) * std::pow(size(node[i] - y), 3) / 6;
        second_at += std::abs(weight[i]) * std::pow(size(node[i] - y), 2) / 2;
      }
      best_third = std::min(best_third, third_at), best_second = std::min(best_second, second_at);
    }
    third = std::max(third, best_third), second = std::max(second, best_second);
    for (const double w : weight) all += std::abs(w);
    sum = std::max(sum, all), midpoints = std::max(midpoints, weight[3] + weight[4] + weight[5]);
    for (int turn = 0; turn < 24; ++turn)
      for (int at = 1; at < 50; ++at) {
        // x from 0 at one vertex to 1 at another
        const Vec plane(0, turn / 23.0, 1);
        const auto bent = [&](const Vec& p) { return std::max(0.0, glm::dot(plane, p) - at / 50.0); };
        double through = 0;
        for (int i = 0; i < 6; ++i) through += weight[i] * bent(node[i]);
        bend = std::max(bend, std::abs(through - bent(x)));
      }
  }
  const auto expect_just_below = [](double value, double constant) {
    EXPECT_LE(value, constant + 1e-12);
    EXPECT_GT(value, 0.96 * constant);
  };
  expect_just_below(third, c_of_third);
  expect_just_below(second, c_of_second);
  expect_just_below(sum, c_weights);
  expect_just_below(midpoints, c_midpoint_weights);
  expect_just_below(bend, c_of_bend);
}

// A triangle of a sphere. The normals of its vertices are `degrees` apart; eye and light are far away.
Case sphere_patch(double degrees, double exponent, glm::dvec3 light_barycentric) {
  Case c;
  const double circumradius = std::asin(2.0 / std::sqrt(3.0) * std::sin(glm::radians(degrees) / 2));
  for (int i = 0; i < 3; ++i) {
    const double turn = 2.0 * 3.14159265358979 * i / 3;
    const glm::dvec3 n(std::sin(circumradius) * std::cos(turn), std::sin(circumradius) * std::sin(turn),
                       std::cos(circumradius));
    c.triangle.vertex[static_cast<std::size_t>(i)] = {0, 0, 0.5, 1.0, n, n};
  }
  c.scene.camera.eye_world = {0, 0, 1e6};
  c.scene.materials.emplace_back();
  c.scene.materials[0].diffuse = 0.0;
  c.scene.materials[0].specular = 1.0;
  c.scene.materials[0].exponent = exponent;
  const glm::dvec3 halfway = c.surface(light_barycentric).normal_world;
  c.scene.directional.push_back({2.0 * halfway.z * halfway - glm::dvec3(0, 0, 1), glm::dvec3(1.0)});
  return c;
}

TEST(HighlightTest, CentroidErrorIsTheQuadraticsAgainstTheRadiance) {
  SampledTriangle t{};
  for (std::size_t i = 0; i < 6; ++i) t.radiance[i] = glm::dvec3(i < 3 ? 0.2 : 0.5, 0.1, 0.3);
  // (4 * 1.5 - 0.6)/9 = 0.6. Constant values stay the same.
  EXPECT_NEAR(centroid_error(t, {0.6, 0.1, 0.3}), 0.0, 1e-12);
  EXPECT_NEAR(centroid_error(t, {0.6, 0.2, 0.3}), 25.5, 1e-12);
  EXPECT_NEAR(centroid_error(t, {0.5, 0.1, 0.1}), 51.0, 1e-12);
  for (glm::dvec3& r : t.radiance) r *= 100.0;
  EXPECT_EQ(centroid_error(t, glm::dvec3(7.0)), 0.0) << "over-exposed is over-exposed";
}

// The simpler bound decides as the whole one, and decides often.
TEST(HighlightTest, MayMissHighlightComparesTheBound) {
  RandomCases random(31);
  int above = 0, cases = 0;
  for (int i = 0; i < 60'000; ++i) {
    const Case c = random.next(i % 3 == 0 ? Brdf::phong : Brdf::blinn);
    const SampledTriangle t = sampled(c);
    const double bound = missed_highlight_bound(c.scene, c.scene.materials[0], t);
    for (const double steps : {0.25, 1.0, 2.0, 8.0, 0.999 * bound, bound}) {
      const bool is_above = bound > steps;
      ASSERT_EQ(may_miss_highlight(c.scene, c.scene.materials[0], t, steps), is_above)
          << "case " << i << ", bound " << bound << ", steps " << steps;
      above += is_above;
      ++cases;
    }
  }
  EXPECT_GT(above, cases / 10);
  EXPECT_LT(above, 9 * cases / 10);
}

TEST(HighlightTest, BoundIsZeroWithoutLightAndInTheDark) {
  Case c = sphere_patch(20, 100, {0.3, 0.5, 0.2});
  const SampledTriangle t = sampled(c);
  EXPECT_GT(missed_highlight_bound(c.scene, c.scene.materials[0], t), 50.0);
  c.scene.directional[0].to_light_world = {0, 0, -1};
  EXPECT_EQ(missed_highlight_bound(c.scene, c.scene.materials[0], t), 0.0);
  c.scene.directional.clear();
  EXPECT_EQ(missed_highlight_bound(c.scene, c.scene.materials[0], t), 0.0);
}

// Also for rough surfaces, whose density is greatest off the normal.
TEST(HighlightTest, TheFactorIsWithinItsBound) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const auto unit = [&] {
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  };
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 n = unit(), l = unit(), v = unit();
    Material m;
    m.brdf = std::array{Brdf::blinn, Brdf::phong, Brdf::cook_torrance}[i % 3];
    m.roughness = std::uniform_real_distribution<double>(0.05, 1)(random);
    const double apart =
        m.brdf == Brdf::phong ? angle(2 * glm::dot(n, l) * n - l, v) : angle(n, glm::normalize(l + v));
    for (const double least : {0.0, 0.5, 0.999})
      ASSERT_LE(specular_factor(m, n, l, v),
                factor_bound(m, least * apart, angle(l, v), glm::dot(n, v)) * (1 + 1e-9))
          << "case " << i;
  }
}

// Eye or light in the triangle, at a corner, normals in all directions: the bound is a number and large.
TEST(HighlightTest, DegenerateDirectionsGiveALargeBound) {
  const Case base = sphere_patch(20, 100, {0.3, 0.5, 0.2});
  const SampledTriangle t = sampled(base);
  const auto expect_large = [&](const Scene& scene, const SampledTriangle& triangle) {
    const double bound = missed_highlight_bound(scene, scene.materials[0], triangle);
    EXPECT_TRUE(std::isfinite(bound));
    EXPECT_GT(bound, 50.0);
  };
  for (const std::size_t i : {0u, 3u, 5u})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong, Brdf::cook_torrance}) {
      Scene scene = base.scene;
      scene.materials[0].brdf = brdf;
      scene.camera.eye_world = t.surface[i].position_world;
      expect_large(scene, t);
      scene = base.scene;
      scene.materials[0].brdf = brdf;
      scene.directional.clear();
      scene.positional = {{t.surface[i].position_world, glm::dvec3(1.0)}};
      expect_large(scene, t);
    }
  SampledTriangle all_ways = t;
  for (std::size_t i = 0; i < 3; ++i)
    all_ways.surface[i].normal_world = {std::cos(2.0944 * double(i)), std::sin(2.0944 * double(i)), 0.0};
  expect_large(base.scene, all_ways);
}

}  // namespace
}  // namespace halfway
