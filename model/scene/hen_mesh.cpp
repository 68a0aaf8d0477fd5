// SPDX-License-Identifier: Apache-2.0
#include "scene/hen_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "common/to_integer.hpp"

namespace halfway {
namespace {

// The shape: approximate signed distance to its surface, negative inside.

double ellipsoid(glm::dvec3 p, glm::dvec3 centre, glm::dvec3 radii) {
  const glm::dvec3 q = p - centre;
  const double k = glm::length(q / radii), slope = glm::length(q / (radii * radii));
  return slope > 0.0 ? k * (k - 1.0) / slope : -std::min({radii.x, radii.y, radii.z});
}

/// A rod with round ends of different radii.
double rod(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, double radius_a, double radius_b) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - glm::mix(a, b, t)) - (radius_a + t * (radius_b - radius_a));
}

/// Smooth union: the smaller of two distances, blended within `width`.
double joined(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * h * h;
}

double hen(glm::dvec3 p) {
  p.z = std::abs(p.z);
  double d = ellipsoid(p, {0.0, 0.0, 0.0}, {1.0, 0.75, 0.72});
  d = joined(d, rod(p, {0.62, 0.25, 0.0}, {1.0, 1.05, 0.0}, 0.42, 0.24), 0.35);  // neck
  d = joined(d, ellipsoid(p, {1.06, 1.14, 0.0}, {0.32, 0.29, 0.27}), 0.15);      // head
  d = joined(d, rod(p, {1.3, 1.12, 0.0}, {1.62, 1.03, 0.0}, 0.13, 0.05), 0.08);  // beak
  for (const auto& [x, y] : {std::pair{0.9, 1.47}, {1.06, 1.54}, {1.22, 1.47}})  // comb
    d = joined(d, ellipsoid(p, {x, y, 0.0}, {0.11, 0.16, 0.09}), 0.08);
  d = joined(d, ellipsoid(p, {1.3, 0.85, 0.0}, {0.1, 0.16, 0.1}), 0.08);          // wattle
  d = joined(d, rod(p, {-0.7, 0.25, 0.0}, {-1.35, 0.95, 0.0}, 0.42, 0.2), 0.35);  // tail
  d = joined(d, rod(p, {-0.8, 0.1, 0.0}, {-1.5, 0.5, 0.0}, 0.35, 0.15), 0.25);
  d = joined(d, ellipsoid(p, {-0.12, 0.08, 0.66}, {0.62, 0.4, 0.17}), 0.12);       // wing
  d = joined(d, rod(p, {0.05, -0.55, 0.3}, {0.08, -1.3, 0.32}, 0.22, 0.11), 0.2);  // leg
  d = joined(d, rod(p, {0.0, -1.32, 0.32}, {0.45, -1.36, 0.36}, 0.12, 0.1), 0.1);  // foot
  return d;
}

glm::dvec3 slope(glm::dvec3 p) {
  constexpr double c_step = 1e-4;
  glm::dvec3 difference;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0.0);
    step[axis] = c_step;
    difference[axis] = (hen(p + step) - hen(p - step)) / (2.0 * c_step);
  }
  return difference;
}

const glm::dvec3 c_low{-2.0, -1.8, -1.2}, c_high{2.0, 2.0, 1.2};

/// Surface nets: a lattice of cells around the shape. Each cell that the surface crosses has one vertex, each
/// lattice edge that it crosses one square.
class Net {
 public:
  explicit Net(std::uint32_t cells) : cells_(cells) {
    for (int axis = 0; axis < 3; ++axis)
      count_[axis] = to_integer<int>(std::ceil((c_high[axis] - c_low[axis]) * cells)) + 1;
    values_.reserve(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2]);
    for (int z = 0; z < count_[2]; ++z)
      for (int y = 0; y < count_[1]; ++y)
        for (int x = 0; x < count_[0]; ++x) values_.push_back(hen(point({x, y, z})));
    vertex_.assign(values_.size(), 0);
  }

  Mesh take() {
    for_all([&](Place at) { add_vertex(at); });
    for_all([&](Place at) {
      for (int axis = 0; axis < 3; ++axis) add_square(at, axis);
    });
    return std::move(mesh_);
  }

 private:
  using Place = std::array<int, 3>;

  template <class Work>
  void for_all(const Work& work) const {
    for (int z = 0; z + 1 < count_[2]; ++z)
      for (int y = 0; y + 1 < count_[1]; ++y)
        for (int x = 0; x + 1 < count_[0]; ++x) work({x, y, z});
  }
  std::size_t index(Place at) const {
    return (static_cast<std::size_t>(at[2]) * count_[1] + at[1]) * count_[0] + at[0];
  }
  glm::dvec3 point(Place at) const { return c_low + glm::dvec3(at[0], at[1], at[2]) / double(cells_); }
  static Place moved(Place at, int axis, int by = 1) {
    at[axis] += by;
    return at;
  }

  // Take the mean of the crossings on the cell's edges and move it onto the surface.
  void add_vertex(Place at) {
    glm::dvec3 sum(0.0);
    int crossings = 0;
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 3; ++axis) {
        if (corner >> axis & 1) continue;
        Place a = at;
        for (int other = 0; other < 3; ++other) a[other] += corner >> other & 1;
        const Place b = moved(a, axis);
        const double va = values_[index(a)], vb = values_[index(b)];
        if ((va < 0.0) == (vb < 0.0)) continue;
        sum += glm::mix(point(a), point(b), va / (va - vb));
        ++crossings;
      }
    if (crossings == 0) return;
    const glm::dvec3 low = point(at), high = low + 1.0 / cells_;
    glm::dvec3 p = sum / double(crossings);
    for (int step = 0; step < 4; ++step) {
      const glm::dvec3 s = slope(p);
      p = glm::clamp(p - hen(p) / glm::dot(s, s) * s, low, high);
    }
    vertex_[index(at)] = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(p);
    mesh_.normals.push_back(glm::normalize(slope(p)));
  }

  // Connect the four cells that share the edge from this place along the axis.
  void add_square(Place at, int axis) {
    const bool inside = values_[index(at)] < 0.0;
    if (inside == (values_[index(moved(at, axis))] < 0.0)) return;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto cell = [&](int du, int dv) { return vertex_[index(moved(moved(at, u, -du), v, -dv))]; };
    std::array<std::uint32_t, 4> corner{cell(1, 1), cell(0, 1), cell(0, 0), cell(1, 0)};
    if (!inside) std::swap(corner[1], corner[3]);
    // Split along the shorter diagonal.
    const auto length = [&](int a, int b) {
      return glm::distance(mesh_.positions[corner[a]], mesh_.positions[corner[b]]);
    };
    if (length(1, 3) < length(0, 2)) corner = {corner[1], corner[2], corner[3], corner[0]};
    for (const auto& [a, b, c] :
         {std::array{corner[0], corner[1], corner[2]}, std::array{corner[0], corner[2], corner[3]}})
      mesh_.triangles.push_back({{a, b, c}, {a, b, c}, 0});
  }

  std::uint32_t cells_;
  Place count_{};
  std::vector<double> values_;
  std::vector<std::uint32_t> vertex_;  // index of the vertex of each cell that the surface crosses
  Mesh mesh_;
};

}  // namespace

Mesh make_hen(std::uint32_t cells) {
  return Net(cells).take();
}

}  // namespace halfway
