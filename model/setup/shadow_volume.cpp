// SPDX-License-Identifier: Apache-2.0
#include "setup/shadow_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "scene/camera.hpp"
#include "scene/lights.hpp"
#include "scene/mesh.hpp"

namespace halfway {
namespace {

// Volumes are longer than needed by this fraction, so that rounding never ends a volume in front of a
// surface.
constexpr double c_extent_slack = 0.01;

/// One use of an edge by a triangle. Equal positions have one vertex number.
struct EdgeUse {
  std::uint32_t low, high;
  std::uint32_t triangle;
  bool upward;  ///< from low to high

  auto edge() const { return std::pair(low, high); }
};

class EdgeTable {
 public:
  explicit EdgeTable(const Scene& scene) : positions_world_(scene.positions_world) {
    const auto& position = positions_world_;
    std::vector<std::uint32_t> by_place(position.size()), vertex(position.size());
    std::iota(by_place.begin(), by_place.end(), 0u);
    const auto place = [&](std::uint32_t i) { return std::tie(position[i].x, position[i].y, position[i].z); };
    std::sort(by_place.begin(), by_place.end(),
              [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    for (std::size_t i = 0; i < by_place.size(); ++i) {
      const bool is_known = i > 0 && place(by_place[i]) == place(by_place[i - 1]);
      vertex[by_place[i]] = is_known ? vertex[by_place[i - 1]] : by_place[i];
    }
    edges_.reserve(3 * scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      for (int side = 0; side < 3; ++side) {
        const std::uint32_t from = vertex[scene.triangles[t].position[side]];
        const std::uint32_t to = vertex[scene.triangles[t].position[(side + 1) % 3]];
        if (from != to) edges_.push_back({std::min(from, to), std::max(from, to), t, from < to});
      }
    }
    std::sort(edges_.begin(), edges_.end(),
              [](const EdgeUse& a, const EdgeUse& b) { return a.edge() < b.edge(); });
  }

  /// Calls found(from_world, to_world, times) for each boundary edge of some of the triangles. `times` is the
  /// number of uses in this direction minus those in the other.
  template <class Found>
  void for_each_boundary_edge(const std::vector<bool>& is_in, Found&& found) const {
    for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
      int upward = 0;
      for (; end < edges_.size() && edges_[end].edge() == edges_[begin].edge(); ++end)
        if (is_in[edges_[end].triangle]) upward += edges_[end].upward ? 1 : -1;
      if (upward == 0) continue;
      const glm::dvec3 &low = positions_world_[edges_[begin].low],
                       &high = positions_world_[edges_[begin].high];
      found(upward > 0 ? low : high, upward > 0 ? high : low, std::abs(upward));
    }
  }

 private:
  const std::vector<glm::dvec3>& positions_world_;
  std::vector<EdgeUse> edges_;
};

double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = b - a;
  const double squared = glm::dot(way, way);
  const double t = squared > 0.0 ? std::clamp(glm::dot(point - a, way) / squared, 0.0, 1.0) : 0.0;
  return glm::length(point - (a + t * way));
}

double distance_to_triangle(const glm::dvec3& point, const CornersWorld& corners_world) {
  const auto& [a, b, c] = corners_world;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const auto is_inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, point - from), normal) > 0.0;
  };
  if (is_inside(a, b) && is_inside(b, c) && is_inside(c, a))
    return std::abs(glm::dot(point - a, normal)) / glm::length(normal);
  return std::min(
      {distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

/// A length with which every volume ends beyond the whole scene and the eye.
double extent_of(const Scene& scene, const LightPoint& light, const std::vector<std::uint32_t>& averted) {
  BoundingSphere sphere = bounding_sphere(scene);
  sphere.radius = std::max(sphere.radius, glm::length(scene.camera.eye_world - sphere.centre_world));
  if (light.w == 0.0) return 2.0 * sphere.radius * (1.0 + c_extent_slack);
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : averted)
    nearest =
        std::min(nearest, distance_to_triangle(light.xyz_world, corners_world(scene, scene.triangles[t])));
  const double farthest = glm::length(light.xyz_world - sphere.centre_world) + sphere.radius;
  const double ratio = farthest / nearest * (1.0 + c_extent_slack);
  return ratio < c_largest_extent ? ratio : c_largest_extent;
}

/// Gives the same result for all triangles that share the point. The volumes of a positional light are cones:
/// a triangle scaled about the light has the same outline as the triangle, for any angle that it spans.
glm::dvec3 far_end(const glm::dvec3& point_world, const LightPoint& light, double extent) {
  const glm::dvec3 away = -light.way_from(point_world);
  return light.w == 0.0 ? point_world + extent * away : light.xyz_world + extent * away;
}

/// Number of triangles that face away from the light between a point and the light.
std::uint32_t volumes_around(const Scene& scene, const glm::dvec3& point_world, const LightPoint& light) {
  if (light.way_from(point_world) == glm::dvec3(0.0)) return 0;
  const LightRay ray(point_world, light);
  std::uint32_t count = 0;
  for (const SceneTriangle& triangle : scene.triangles)
    count += ray.hit(corners_world(scene, triangle)).crossing == Crossing::enters;
  return count;
}

bool is_in_a_mesh(const Scene& scene, const glm::dvec3& point_world) {
  // The direction is arbitrary.
  const LightRay ray(point_world, {{0.36, 0.48, 0.8}, 0.0});
  int meshes = 0;
  for (const SceneTriangle& triangle : scene.triangles) {
    const Crossing crossing = ray.hit(corners_world(scene, triangle)).crossing;
    meshes += (crossing == Crossing::leaves) - (crossing == Crossing::enters);
  }
  return meshes != 0;
}

/// True if the eye may see the inside of a triangle.
bool shows_insides(const Scene& scene, const Projector& projector) {
  if (open_edges(scene.triangles) > 0 || is_in_a_mesh(scene, scene.camera.eye_world)) return true;
  std::vector<TwoSidedTriangle> cut_off;
  ProjectionCounts ignored;
  for (const SceneTriangle& triangle : scene.triangles)
    projector.project_two_sided(corners_world(scene, triangle), 0, DepthSlice::before_near, cut_off, ignored);
  return !cut_off.empty();
}

CornersWorld turned_round(const CornersWorld& corners_world) {
  return {corners_world[0], corners_world[2], corners_world[1]};
}

}  // namespace

std::vector<ShadowVolumes> make_shadow_volumes(const Scene& scene, std::span<const LightRef> lights) {
  const EdgeTable edges(scene);
  std::vector<ShadowVolumes> result;
  std::vector<bool> averted(scene.triangles.size());
  for (const LightRef& light : lights) {
    const LightPoint point = light_of(scene, light).point;
    ShadowVolumes volumes{.light = light};
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      averted[t] = is_averted(corners_world(scene, scene.triangles[t]), point);
      if (averted[t]) volumes.averted.push_back(t);
    }
    volumes.extent = extent_of(scene, point, volumes.averted);
    edges.for_each_boundary_edge(averted, [&](const glm::dvec3& from, const glm::dvec3& to, int times) {
      const glm::dvec3 far_from = far_end(from, point, volumes.extent);
      const glm::dvec3 far_to = far_end(to, point, volumes.extent);
      for (int i = 0; i < times; ++i) {
        volumes.sides.push_back({from, to, far_to});
        volumes.sides.push_back({from, far_to, far_from});
      }
    });
    volumes.around_eye = volumes_around(scene, scene.camera.eye_world, point);
    result.push_back(std::move(volumes));
  }
  return result;
}

std::vector<CornersWorld> closed_surface(const Scene& scene, const ShadowVolumes& volumes) {
  std::vector<CornersWorld> surface = volumes.sides;
  const LightPoint light = light_of(scene, volumes.light).point;
  for (const std::uint32_t t : volumes.averted) {
    const CornersWorld near = corners_world(scene, scene.triangles[t]);
    CornersWorld far;
    for (int i = 0; i < 3; ++i) far[i] = far_end(near[i], light, volumes.extent);
    surface.push_back(turned_round(near));
    surface.push_back(far);
  }
  return surface;
}

std::vector<ShadowPolygon> shadow_polygons(const Scene& scene, const Projector& projector,
                                           std::span<const ShadowVolumes> volumes, ProjectionCounts& counts) {
  const bool has_caps = shows_insides(scene, projector);
  std::vector<ShadowPolygon> polygons;
  std::vector<TwoSidedTriangle> pieces;
  for (std::uint32_t light = 0; light < volumes.size(); ++light) {
    std::uint32_t source = 0;
    for (const CornersWorld& side : volumes[light].sides) {
      pieces.clear();
      projector.project_two_sided(side, source, DepthSlice::visible, pieces, counts);
      projector.project_two_sided(side, source, DepthSlice::before_near, pieces, counts);
      for (const TwoSidedTriangle& piece : pieces)
        polygons.push_back({piece.triangle, light, piece.faces_eye});
      ++source;
    }
    if (!has_caps) continue;
    for (const std::uint32_t t : volumes[light].averted) {
      const CornersWorld cap = turned_round(corners_world(scene, scene.triangles[t]));
      pieces.clear();
      projector.project_two_sided(cap, source, DepthSlice::visible, pieces, counts);
      // Visible caps that close a volume coincide with a drawn triangle: discard them.
      std::erase_if(pieces, [](const TwoSidedTriangle& piece) { return !piece.faces_eye; });
      projector.project_two_sided(cap, source, DepthSlice::before_near, pieces, counts);
      for (const TwoSidedTriangle& piece : pieces)
        polygons.push_back({piece.triangle, light, piece.faces_eye});
      ++source;
    }
  }
  return polygons;
}

}  // namespace halfway
