// SPDX-License-Identifier: Apache-2.0
#include "reference/spherical_renderer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "projection/project.hpp"
#include "scene/lights.hpp"
#include "scene/test/add_mesh.hpp"
#include "setup/test/paper_spans.hpp"
#include "shading/bell.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

using paper::Ends, paper::LightThere, paper::Real, paper::Span, paper::SpanThere, paper::There, paper::Vector,
    paper::slerp_of;

constexpr FrameSize c_spherical_frame{70, 53};

std::vector<SphericalMethod> all_methods() {
  std::vector<SphericalMethod> methods;
  for (VectorScheme vectors : {VectorScheme::one_fixed, VectorScheme::both_interpolated})
    for (SpanEnds ends : {SpanEnds::on_surface, SpanEnds::slerped_along_edges})
      for (HighlightCurve curve : {HighlightCurve::power, HighlightCurve::squared_cosine})
        methods.push_back({vectors, ends, curve});
  return methods;
}

/// One triangle that may extend beyond the frame, normals up to a right angle apart, and a light of each
/// kind.
Scene one_triangle(std::mt19937& random, Brdf brdf) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  Scene scene;
  scene.background = {0.2, 0.4, 0.6};
  scene.materials.resize(2);
  Material& material = scene.materials[1];
  material.brdf = brdf;
  material.colour = {1.0, 0.5, 0.2};
  material.exponent = std::exp(2.0 * (unit(random) + 1.0));
  material.specular = 0.7;
  material.roughness = 0.5;
  material.reflectance = 0.5;
  scene.materials[0].exponent = 400.0;
  scene.directional = {{glm::normalize(glm::dvec3(1, 2, 3)), {0.5, 0.6, 0.7}}};
  scene.positional = {{{-2, 2, 3}, {0.3, 0.4, 0.5}}, {{1.5, 0.5, -0.5}, {0.6, 0.3, 0.1}}};
  scene.spots = {{{0, 0, 4}, {0, 0, -1}, 0.99, 0.9, {0.4, 0.2, 0.5}}};
  for (int k = 0; k < 3; ++k) {
    scene.positions_world.push_back(2.2 * point());
    scene.normals_world.push_back(glm::normalize(point() + glm::dvec3(0, 0, 1.2)));
  }
  scene.triangles = {{{0, 1, 2}, {0, 1, 2}, 1}, {{0, 2, 1}, {0, 2, 1}, 1}};  // one of them faces the eye
  return scene;
}

// The method written pixel by pixel with the paper's own formulas.

struct Cosine {
  Real value, amplitude;
};

Cosine cosine_between(VectorScheme scheme, Vector u1, Vector u2, Vector v1, Vector v2, Real t) {
  if (scheme == VectorScheme::both_interpolated)
    return {glm::dot(slerp_of(u1, u2, t), slerp_of(v1, v2, t)), 1};
  const Vector c = glm::cross(v1, v2);
  const Real cosine = glm::dot(v1, v2);
  const Vector u2_back = cosine * u2 - glm::cross(c, u2) + glm::dot(c, u2) / (1 + cosine) * c;
  // The amplitude is the length of v1's projection onto the plane in which u turns.
  const Vector across = glm::cross(u1, u2_back);
  const Real length = glm::length(across), value = glm::dot(slerp_of(u1, u2_back, t), v1);
  if (length < 1e-9L) return {value, std::abs(value)};
  const Real out_of_plane = glm::dot(across, v1) / length;
  return {value, std::sqrt(std::max<Real>(0, 1 - out_of_plane * out_of_plane))};
}

glm::dvec3 expected(const Scene& scene, const SphericalMethod& method, const SpanThere& span, Real t) {
  const Material& m = scene.materials[1];
  const There &begin = span.begin, &end = span.end, here = slerped(begin, end, t);
  const std::vector<LightRef> lights = shining_lights(scene);
  glm::dvec3 sum = scene.ambient * m.ambient * m.colour;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightThere &a = begin.light[i], &b = end.light[i];
    const auto n_dot_l =
        static_cast<double>(cosine_between(method.vectors, begin.normal, end.normal, a.l, b.l, t).value);
    if (n_dot_l <= 0.0) continue;
    const Cosine c = cosine_between(method.vectors, a.u, b.u, a.v, b.v, t);
    auto highlight = static_cast<double>(std::pow(std::max<Real>(0, c.value), m.exponent));
    if (m.brdf == Brdf::cook_torrance) {
      highlight =
          specular_factor(m, glm::dvec3(here.normal), glm::dvec3(here.light[i].l), glm::dvec3(here.to_eye));
    } else if (method.curve == HighlightCurve::squared_cosine) {
      const Real x = published_scale(m.exponent) * std::acos(std::clamp<Real>(c.value / c.amplitude, -1, 1));
      highlight = static_cast<double>(
          x < std::numbers::pi / 2 ? std::pow(c.amplitude, m.exponent) * std::cos(x) * std::cos(x) : 0);
    }
    sum += static_cast<double>(here.light[i].spot) * light_of(scene, lights[i]).intensity *
           (m.diffuse * n_dot_l * m.colour + m.specular * highlight * m.specular_colour);
  }
  return sum;
}

TEST(SphericalRenderer, MatchesTheFormulas) {
  std::mt19937 random(1);
  std::uint64_t pixels = 0, lit = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene =
        one_triangle(random, std::array{Brdf::blinn, Brdf::phong, Brdf::cook_torrance}[i % 3]);
    const auto triangles = Projector(scene, c_spherical_frame, {}).project_all();
    if (triangles.size() != 1) continue;
    const Ends ends(scene, scene.materials[1], triangles[0]);
    for (const SphericalMethod& method : all_methods()) {
      const ReferenceImage image = render_spherical(scene, triangles, {.frame = c_spherical_frame}, method);
      for (std::uint32_t y = 0; y < c_spherical_frame.height; ++y) {
        const auto line = image.mask.begin() + y * c_spherical_frame.width;
        const auto first = std::find(line, line + c_spherical_frame.width, 1) - line;
        const auto count = std::count(line, line + c_spherical_frame.width, 1);
        if (count == 0) continue;
        const Span span{first, first + count - 1, y};
        const SpanThere there =
            method.ends == SpanEnds::on_surface ? ends.on_surface(span) : ends.along_edges(span);
        for (auto x = first; x < first + count; ++x) {
          ASSERT_EQ(line[x], 1);
          const glm::dvec3 colour = expected(scene, method, there, there.first + (x - first) * there.step);
          ++pixels;
          lit += colour.x > 0.1;
          for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(image.frame.rgb[3 * (y * c_spherical_frame.width + x) + k],
                        255.0 * std::min(1.0, colour[k]), 0.5 + 1e-6)
                << "triangle " << i << " pixel " << x << ',' << y << " scheme " << int(method.vectors)
                << " ends " << int(method.ends) << " curve " << int(method.curve);
        }
      }
    }
  }
  EXPECT_GT(pixels, 100'000u);
  EXPECT_GT(lit, 50'000u);
}

}  // namespace
}  // namespace halfway
