// SPDX-License-Identifier: Apache-2.0
// For tests: scenes for the spherical shader, with all kinds of lights.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <random>

#include "scene/scene.hpp"
#include "scene/test/add_mesh.hpp"

namespace halfway {

class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double log_within(double low, double high) { return std::exp(within(std::log(low), std::log(high))); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return whole(1, n) == 1; }
  glm::dvec3 cube() { return {within(-1, 1), within(-1, 1), within(-1, 1)}; }
  glm::dvec3 unit() {
    for (;;)
      if (const glm::dvec3 v = cube(); glm::dot(v, v) > 0.01 && glm::dot(v, v) <= 1.0)
        return glm::normalize(v);
  }
  glm::dvec3 colour(bool grey) {
    return grey ? glm::dvec3(within(0.3, 1.0)) : glm::dvec3(within(0, 1), within(0, 1), within(0, 1));
  }

  /// Blinn or Phong.
  Material material(bool grey, bool white_highlights, double largest_exponent = 1000.0) {
    Material m;
    m.name = "m";
    m.brdf = one_in(2) ? Brdf::blinn : Brdf::phong;
    m.colour = colour(grey);
    m.specular_colour = white_highlights ? glm::dvec3(1.0) : colour(grey);
    m.ambient = within(0.0, 0.2);
    m.diffuse = within(0.2, 0.7);
    m.specular = within(0.2, 0.8);
    m.exponent = log_within(1.0, largest_exponent);
    return m;
  }

  enum Lights { directional, positional, spots, any };

  /// Adds lights around a mesh of about this radius at the origin, on the eye's side (+z). Their distances
  /// range from close to the surface to a few times the radius.
  void add_lights(Scene& scene, int count, Lights kind, double radius, bool grey) {
    for (int i = 0; i < count; ++i) {
      const int which = kind == any ? whole(0, 2) : static_cast<int>(kind);
      const glm::dvec3 intensity = within(0.3, 1.0) * colour(grey);
      glm::dvec3 towards = unit();
      towards.z = std::abs(towards.z) + 0.2;
      towards = glm::normalize(towards);
      const glm::dvec3 position = radius * (1.0 + log_within(0.05, 3.0)) * towards;
      if (which == 0) {
        scene.directional.push_back({towards, intensity});
      } else if (which == 1) {
        scene.positional.push_back({position, intensity});
      } else {
        const double inner = within(0.02, 0.6);
        scene.spots.push_back({position, glm::normalize(0.7 * radius * cube() - position), std::cos(inner),
                               std::cos(inner + within(0.02, 0.3)), intensity});
      }
    }
  }

  /// Triangles over the middle of the view of an eye at (0, 0, 4), with normals up to `spread` apart.
  void add_triangles(Scene& scene, int count, double size, double spread) {
    scene.camera.eye_world = {0.0, 0.0, 4.0};
    for (int k = 0; k < count; ++k) {
      const auto p = static_cast<std::uint32_t>(scene.positions_world.size());
      const glm::dvec3 centre = (1.2 - 0.6 * size) * cube(),
                       normal = glm::normalize(glm::dvec3(within(-0.5, 0.5), within(-0.5, 0.5), 1.0));
      for (int i = 0; i < 3; ++i) {
        scene.positions_world.push_back(centre + size * cube());
        scene.normals_world.push_back(glm::normalize(normal + spread * cube()));
      }
      const auto& v = scene.positions_world;
      const bool front =
          glm::dot(glm::cross(v[p + 1] - v[p], v[p + 2] - v[p]), scene.camera.eye_world - v[p]) > 0;
      const std::array<std::uint32_t, 3> corner = {p, front ? p + 1 : p + 2, front ? p + 2 : p + 1};
      scene.triangles.push_back({corner, corner, 0});
    }
  }

 private:
  std::mt19937 random_;
};

}  // namespace halfway
