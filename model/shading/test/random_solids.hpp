// SPDX-License-Identifier: Apache-2.0
// For tests of shadows: scenes of closed solids, and the crossings of a ray to a light, in long double and
// without any of the code under test.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>
#include <vector>

#include "scene/builtin_meshes.hpp"
#include "scene/mesh.hpp"
#include "scene/test/add_mesh.hpp"
#include "shading/light_ray.hpp"

namespace halfway {

using LongVec = glm::vec<3, long double>;

class RandomSolids {
 public:
  explicit RandomSolids(unsigned seed) : random_(seed) {}

  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::uint32_t whole(std::uint32_t low, std::uint32_t high) {
    return std::uniform_int_distribution<std::uint32_t>(low, high)(random_);
  }
  glm::dvec3 cube(double half) { return {within(-half, half), within(-half, half), within(-half, half)}; }
  glm::dvec3 unit() {
    for (;;)
      if (const glm::dvec3 v = cube(1.0); glm::dot(v, v) > 0.01 && glm::dot(v, v) <= 1.0)
        return glm::normalize(v);
  }

  /// A rotated and scaled sphere or box of about this radius.
  Mesh solid(double radius) {
    Mesh mesh = whole(0, 1) == 0
                    ? make_uv_sphere(whole(3, 9), whole(2, 7), radius)
                    : make_box(radius * glm::dvec3(within(0.3, 1.6), within(0.3, 1.6), within(0.3, 1.6)),
                               whole(1, 2));
    glm::dmat4 place = glm::rotate(glm::dmat4(1.0), within(0.0, 6.28), unit());
    place = glm::scale(place, {within(0.5, 1.0), within(0.5, 1.0), within(0.5, 1.0)});
    transform(mesh, place);
    return mesh;
  }

  /// Solids around the origin, nested and intersecting, with one light of each kind. The eye looks at them.
  Scene scene(int solids) {
    Scene scene;
    scene.shadows = true;
    scene.materials.emplace_back();
    for (int i = 0; i < solids; ++i) {
      Mesh mesh = solid(within(0.3, 0.9));
      transform(mesh, glm::translate(glm::dmat4(1.0), cube(1.2)));
      add_mesh(scene, mesh);
    }
    scene.directional = {{unit(), glm::dvec3(0.4)}};
    scene.positional = {{within(1.0, 6.0) * unit(), glm::dvec3(0.3)}};
    const glm::dvec3 place = within(2.0, 4.0) * unit();
    scene.spots = {{place, -glm::normalize(place), 0.9, 0.5, glm::dvec3(0.3)}};
    scene.camera.eye_world = within(3.5, 6.0) * unit();
    scene.camera.up_world = unit();
    return scene;
  }

  /// Solids that stand on a floor.
  Scene on_a_floor(int solids) {
    Scene made = scene(solids);
    Mesh floor = make_box({30.0, 0.5, 30.0}, 2);
    for (glm::dvec3& p : floor.positions) p.y -= 1.5;
    add_mesh(made, floor);
    glm::dvec3& to_light_world = made.directional[0].to_light_world;
    to_light_world.y = std::abs(to_light_world.y) + 0.1;
    to_light_world = glm::normalize(to_light_world);
    made.camera.up_world = {0.1, 1.0, 0.1};
    return made;
  }

 private:
  std::mt19937 random_;
};

/// Crossings of a straight ray, and their margin.
struct Crossings {
  int enters = 0, leaves = 0;
  /// Least distance of any deciding value from its threshold: barycentric coordinates, and fractions of the
  /// way from 0 and 1.
  long double margin = std::numeric_limits<long double>::infinity();
};

template <class Triangles>  // of CornersWorld
Crossings crossings(const Triangles& triangles, const glm::dvec3& from_world, const LightPoint& light) {
  Crossings found;
  const LongVec from(from_world), way(light.way_from(from_world));
  for (const CornersWorld& corners : triangles) {
    const LongVec a(corners[0]), ab = LongVec(corners[1]) - a, ac = LongVec(corners[2]) - a;
    const LongVec normal = glm::cross(ab, ac);
    const long double slope = glm::dot(normal, way);
    if (slope == 0.0L) continue;
    const LongVec offset = glm::cross(from - a, way);
    const std::array<long double, 2> weight{glm::dot(ac, offset) / -slope, glm::dot(ab, offset) / slope};
    const long double t = glm::dot(a - from, normal) / slope;
    // Positive inside, negative outside.
    long double inside = std::min({weight[0], weight[1], 1.0L - weight[0] - weight[1], t});
    if (light.w != 0.0) inside = std::min(inside, 1.0L - t);
    found.margin = std::min(found.margin, std::abs(inside));
    if (inside > 0.0L) ++(slope < 0.0L ? found.enters : found.leaves);
  }
  return found;
}

inline std::vector<CornersWorld> all_corners(const Scene& scene) {
  std::vector<CornersWorld> all;
  for (const SceneTriangle& triangle : scene.triangles) all.push_back(corners_world(scene, triangle));
  return all;
}

}  // namespace halfway
