// SPDX-License-Identifier: Apache-2.0
#include "shading/shade.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "common/test/big_real.hpp"

namespace halfway {
namespace {

using RealVector = std::array<BigReal, 3>;
RealVector real(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}
BigReal dot(const RealVector& a, const RealVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Equation 7 of the spherical paper as printed, times N.L.
double cook_torrance_as_printed(const Material& material, const RealVector& n, const RealVector& l,
                                const RealVector& v) {
  RealVector h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
  const BigReal length = sqrt(dot(h, h));
  for (BigReal& x : h) x = x / length;
  const BigReal nh = dot(n, h), nl = dot(n, l), nv = dot(n, v), vh = dot(v, h), lh = dot(l, h);
  const BigReal m2 = BigReal(material.roughness) * material.roughness, cos2 = nh * nh;
  const BigReal density =
      exp(BigReal(0.0) - (BigReal(1.0) - cos2) / (cos2 * m2)) / (BigReal::pi() * m2 * cos2 * cos2);
  const BigReal x = BigReal(1.0) - lh;
  const BigReal fresnel =
      BigReal(material.reflectance) + (BigReal(1.0) - material.reflectance) * x * x * x * x * x;
  const BigReal mask = min(min(BigReal(2.0) * nh * nv / vh, BigReal(2.0) * nh * nl / lh), BigReal(1.0));
  return static_cast<double>(nl * density * fresnel / (BigReal(4.0) * nl * nv) * mask);
}

glm::dvec3 at(double cosine, double angle) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

Material cook_torrance(double roughness, double reflectance) {
  Material material;
  material.brdf = Brdf::cook_torrance;
  material.roughness = roughness;
  material.reflectance = reflectance;
  return material;
}

constexpr glm::dvec3 c_up{0.0, 0.0, 1.0};

TEST(Shade, CookTorranceEqualsThePrintedFormulaDownToTheHorizon) {
  int compared = 0;
  for (double nl : {1e-300, 1e-40, 1e-17, 1e-8, 1e-3, 0.1, 0.5, 0.9, 1.0})
    for (double nv : {1e-300, 1e-40, 1e-17, 1e-8, 1e-3, 0.1, 0.5, 0.9, 1.0})
      for (double angle : {0.0, 0.3, 1.5, 2.5, 3.0})
        for (double roughness : {0.05, 0.3, 1.0})
          for (double reflectance : {0.0, 0.05, 1.0}) {
            const Material material = cook_torrance(roughness, reflectance);
            const glm::dvec3 l = at(nl, 0.0), v = at(nv, angle);
            const double expected = cook_torrance_as_printed(material, real(c_up), real(l), real(v));
            const double factor = specular_factor(material, c_up, l, v);
            // If L = V, F = (1 - L.H)^5 is close to zero and has few accurate digits: its error is absolute.
            const double slack = expected * (reflectance == 0.0 ? 1e-6 : 1e-11) + 1e-60;
            if (expected > c_largest_specular)
              EXPECT_EQ(factor, c_largest_specular);
            else
              EXPECT_NEAR(factor, expected, slack) << nl << ' ' << nv << ' ' << angle << ' ' << roughness;
            compared += expected > 1e-6;
          }
  EXPECT_GT(compared, 500);
}

TEST(Shade, CookTorranceKeepsItsDigitsInANarrowHighlight) {
  const Material material = cook_torrance(1e-4, 0.05);
  for (double sine : {0.0, 1e-5, 1e-4, 2e-4, 5e-4}) {
    const glm::dvec3 l{sine, 0.0, std::sqrt(1.0 - sine * sine)};
    const double expected = cook_torrance_as_printed(material, real(c_up), real(l), real(c_up));
    EXPECT_NEAR(specular_factor(material, c_up, l, c_up), expected, 1e-11 * expected) << sine;
  }
}

TEST(Shade, CookTorranceFromOppositeHorizonsIsBounded) {
  const double cosine = 1e-4, m = 0.5;
  const Material material = cook_torrance(m, 0.2);
  const double x = 1.0 - cosine, fresnel = 0.2 + 0.8 * x * x * x * x * x;
  EXPECT_NEAR(specular_factor(material, c_up, at(cosine, 0.0), at(cosine, std::numbers::pi)),
              fresnel / (std::numbers::pi * m * m) / (4.0 * cosine), 1e-6);
  EXPECT_EQ(specular_factor(material, c_up, at(1e-12, 0.0), at(1e-12, std::numbers::pi)), c_largest_specular);
  EXPECT_EQ(specular_factor(material, c_up, {1, 0, 0}, {-1, 0, 0}), 0.0);
}

TEST(Shade, LightsBelowTheHorizonContributeNothing) {
  for (Brdf brdf : {Brdf::blinn, Brdf::phong, Brdf::cook_torrance}) {
    Material material = cook_torrance(0.9, 0.9);
    material.brdf = brdf;
    material.exponent = 1.0;
    EXPECT_EQ(specular_factor(material, c_up, at(-1e-9, 0.0), c_up), 0.0);
    EXPECT_EQ(specular_factor(material, c_up, at(0.0, 0.0), c_up), 0.0);
    EXPECT_GT(specular_factor(material, c_up, at(0.5, 0.0), c_up), 0.0);
  }
  EXPECT_EQ(specular_factor(cook_torrance(0.9, 0.9), c_up, c_up, at(-1e-9, 0.0)), 0.0);
  EXPECT_EQ(specular_factor(cook_torrance(0.9, 0.9), c_up, c_up, at(0.0, 0.0)), 0.0);
}

TEST(Shade, BlinnWithoutAHalfwayVectorIsZero) {
  const Material material;
  const glm::dvec3 n = glm::normalize(glm::dvec3(1.0, 0.0, 1.0));
  EXPECT_EQ(specular_factor(material, n, c_up, -c_up), 0.0);
}

TEST(Shade, BeckmannIsAProjectedDensity) {
  // The integral over the hemisphere, weighted by the cosine, is one.
  for (double m : {0.1, 0.3, 1.0}) {
    double sum = 0.0;
    constexpr int c_angles = 200000;
    for (int i = 0; i < c_angles; ++i) {
      const double angle = (i + 0.5) / c_angles * std::numbers::pi / 2;
      sum +=
          beckmann(std::cos(angle), std::sin(angle) * std::sin(angle), m) * std::cos(angle) * std::sin(angle);
    }
    EXPECT_NEAR(sum * 2 * std::numbers::pi * (std::numbers::pi / 2) / c_angles, 1.0, 1e-6) << m;
  }
  EXPECT_EQ(beckmann(0.0, 1.0, 0.3), 0.0);
  EXPECT_EQ(beckmann(1e-200, 1.0, 0.3), 0.0);
}

TEST(Shade, RadianceIsFiniteForEveryScene) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto pick = [&](const std::vector<double>& values) { return values[random() % values.size()]; };
  const std::vector<double> scale{0.0, 1e-300, 1e-12, 1.0, 1e12, 1e300};
  const auto vector = [&] {
    return pick({0.0, 1e-200, 1e-9, 1.0, 1e9, 1e200}) * glm::dvec3(unit(random), unit(random), unit(random));
  };
  const auto direction = [&] {
    return random() % 4 == 0 ? glm::dvec3(0, 0, random() % 2 ? 1 : -1)
                             : glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
  };
  for (int i = 0; i < 20000; ++i) {
    Scene scene;
    const glm::dvec3 position = vector(), colour(pick(scale), pick(scale), pick(scale));
    scene.camera.eye_world = random() % 8 ? vector() : position;
    scene.ambient = colour;
    scene.directional = {{direction(), colour}};
    scene.positional = {{random() % 8 ? vector() : position, colour}};
    const double cosine = unit(random);
    scene.spots = {{random() % 8 ? vector() : position, direction(), cosine,
                    cosine - (random() % 2 ? 1.0 : 0.0), colour}};
    Material material;
    material.brdf = std::array{Brdf::blinn, Brdf::phong, Brdf::cook_torrance}[random() % 3];
    material.ambient = pick(scale);
    material.diffuse = pick(scale);
    material.specular = pick(scale);
    material.colour = material.specular_colour = colour;
    material.exponent = pick({1.0, 20.0, 500.0, 1e6, 1e300});
    material.roughness = pick({1e-300, 1e-100, 1e-9, 0.01, 0.3, 1.0});
    material.reflectance = pick({0.0, 0.05, 1.0});
    const glm::dvec3 result = radiance(scene, material, position, direction());
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(result[k], 0.0);
      ASSERT_LE(result[k], c_largest_radiance);
    }
  }
}

}  // namespace
}  // namespace halfway
