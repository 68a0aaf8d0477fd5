// SPDX-License-Identifier: Apache-2.0
#include "scene/builtin_meshes.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "common/sine_cosine.hpp"

namespace halfway {

namespace {

/// Control points, [row along the profile][point around the axis]. Newell's own space: z up, spout towards
/// +x.
using Patch = std::array<std::array<glm::dvec3, 4>, 4>;

/// A circle of the pot's profile. Its quarter runs from +x to -y and has four points. The inner two points
/// lie on the tangents of the outer two, at the distance `tangent` times the radius. Newell uses 0.56. The
/// best approximation of a circle is 0.5523.
struct Circle {
  double radius, z;
  double tangent = 0.56;
};

/// A cross-section of handle or spout, symmetric in y: from (x1, 0, z1) past y = -half_width to (x2, 0, z2).
struct Section {
  double x1, z1, x2, z2, half_width;
};

// Newell's figures. Each profile runs from top to bottom, so that the outside of every patch is on the same
// side.
constexpr std::array<Circle, 7> c_lid = {
    {{0.0, 3.15}, {0.8, 3.15, 0.5625}, {0.0, 2.85}, {0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}};
constexpr std::array<Circle, 13> c_pot = {{{1.4, 2.4},
                                           {1.3375, 2.53125},
                                           {1.4375, 2.53125},
                                           {1.5, 2.4},
                                           {1.75, 1.875},
                                           {2.0, 1.35},
                                           {2.0, 0.9},
                                           {2.0, 0.45},
                                           {1.5, 0.225},
                                           {1.5, 0.15},
                                           {1.5, 0.075},
                                           {1.425, 0.0},
                                           {0.0, 0.0}}};
constexpr std::array<Section, 7> c_handle = {{{-1.6, 2.025, -1.5, 2.25, 0.3},
                                              {-2.3, 2.025, -2.5, 2.25, 0.3},
                                              {-2.7, 2.025, -3.0, 2.25, 0.3},
                                              {-2.7, 1.8, -3.0, 1.8, 0.3},
                                              {-2.7, 1.575, -3.0, 1.35, 0.3},
                                              {-2.5, 1.125, -2.65, 0.9375, 0.3},
                                              {-2.0, 0.9, -1.9, 0.6, 0.3}}};
constexpr std::array<Section, 7> c_spout = {{{1.7, 1.425, 1.7, 0.6, 0.66},
                                             {2.6, 1.425, 3.1, 0.825, 0.66},
                                             {2.3, 2.1, 2.4, 2.025, 0.25},
                                             {2.7, 2.4, 3.3, 2.4, 0.25},
                                             {2.8, 2.475, 3.525, 2.49375, 0.25},
                                             {2.9, 2.475, 3.45, 2.5125, 0.15},
                                             {2.8, 2.4, 3.2, 2.4, 0.15}}};

std::array<glm::dvec3, 4> control_row(const Circle& circle) {
  const auto [radius, z, tangent] = circle;
  return {
      {{radius, 0.0, z}, {radius, -tangent * radius, z}, {tangent * radius, -radius, z}, {0.0, -radius, z}}};
}

std::array<glm::dvec3, 4> control_row(const Section& section) {
  const auto [x1, z1, x2, z2, half_width] = section;
  return {{{x1, 0.0, z1}, {x1, -half_width, z1}, {x2, -half_width, z2}, {x2, 0.0, z2}}};
}

/// Weights of a cubic's four control points, and of its derivative, at step / steps. At both ends the weights
/// are exactly 0 and 1. Patches that share a row of points therefore have bit-identical points there.
struct Bernstein {
  Bernstein(std::uint32_t step, std::uint32_t steps) {
    const double t = static_cast<double>(step) / steps;
    const double s = static_cast<double>(steps - step) / steps;
    value = {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
    const double q0 = s * s, q1 = 2.0 * s * t, q2 = t * t;
    slope = {-3.0 * q0, 3.0 * (q0 - q1), 3.0 * (q1 - q2), 3.0 * q2};
  }
  std::array<double, 4> value;
  std::array<double, 4> slope;
};

using Row = std::array<glm::dvec3, 4>;

glm::dvec3 blend(const std::array<double, 4>& weight, const Row& row) {
  return weight[0] * row[0] + weight[1] * row[1] + weight[2] * row[2] + weight[3] * row[3];
}

glm::dvec3 point(const Bernstein& at, const Row& row) {
  glm::dvec3 result = blend(at.value, row);
  // The sum of the weights is 1 except for rounding. Copy equal coordinates, so that rounding cannot split a
  // pole into several points or bend a rim.
  for (int axis = 0; axis < 3; ++axis) {
    const double first = row[0][axis];
    if (first == row[1][axis] && first == row[2][axis] && first == row[3][axis]) result[axis] = first;
  }
  return result;
}

Row points(const Bernstein& across, const Patch& patch) {
  return {point(across, patch[0]), point(across, patch[1]), point(across, patch[2]), point(across, patch[3])};
}

Row slopes(const Bernstein& across, const Patch& patch) {
  return {blend(across.slope, patch[0]), blend(across.slope, patch[1]), blend(across.slope, patch[2]),
          blend(across.slope, patch[3])};
}

/// Unit normal. (across x along) points outwards for every patch above.
glm::dvec3 patch_normal(const Bernstein& across, const Bernstein& along, const Patch& patch) {
  glm::dvec3 d_across = blend(along.value, slopes(across, patch));
  const glm::dvec3 d_along = blend(along.slope, points(across, patch));
  if (glm::length(d_across) < 1e-9) {
    // At a pole the row is a single point and the derivative across it is zero. Close to the pole this
    // derivative is proportional to the distance from the pole, so the mixed derivative has its direction.
    // The sign is reversed where the row closes instead of opens.
    const bool opens = along.value[0] == 1.0;
    d_across = (opens ? 1.0 : -1.0) * blend(along.slope, slopes(across, patch));
  }
  return glm::normalize(glm::cross(d_across, d_along));
}

class TeapotBuilder {
 public:
  explicit TeapotBuilder(std::uint32_t divisions) : divisions_(divisions) {}

  template <class Outline>
  void add_piece(std::span<const Outline> rows, bool mirror_x) {
    for (std::size_t first = 0; first + 3 < rows.size(); first += 3) {
      Patch patch;
      for (std::size_t row = 0; row < 4; ++row) patch[row] = control_row(rows[first + row]);
      add_patch(patch, {1.0, 1.0, 1.0});
      add_patch(patch, {1.0, -1.0, 1.0});
      if (!mirror_x) continue;
      add_patch(patch, {-1.0, 1.0, 1.0});
      add_patch(patch, {-1.0, -1.0, 1.0});
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  using Corner = std::pair<std::uint32_t, std::uint32_t>;  // indices of position and normal

  void add_patch(const Patch& patch, const glm::dvec3& mirror) {
    std::vector<Corner> corners;
    corners.reserve((divisions_ + 1) * (divisions_ + 1));
    for (std::uint32_t i = 0; i <= divisions_; ++i) {
      const Bernstein along(i, divisions_);
      for (std::uint32_t j = 0; j <= divisions_; ++j) {
        const Bernstein across(j, divisions_);
        corners.push_back(add_corner(mirror * point(along, points(across, patch)),
                                     mirror * patch_normal(across, along, patch)));
      }
    }
    const bool is_turned = mirror.x * mirror.y < 0.0;
    const auto corner = [&](std::uint32_t i, std::uint32_t j) { return corners[i * (divisions_ + 1) + j]; };
    for (std::uint32_t i = 0; i < divisions_; ++i) {
      for (std::uint32_t j = 0; j < divisions_; ++j) {
        add_triangle(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), is_turned);
        add_triangle(corner(i, j), corner(i + 1, j + 1), corner(i + 1, j), is_turned);
      }
    }
  }

  Corner add_corner(const glm::dvec3& position_z_up, const glm::dvec3& normal_z_up) {
    const auto to_y_up = [](const glm::dvec3& v) { return glm::dvec3(v.x, v.z, -v.y) + 0.0; };  // no -0
    const glm::dvec3 position = to_y_up(position_z_up);
    const glm::dvec3 normal = to_y_up(normal_z_up);
    auto& [index, normals] = known_[{position.x, position.y, position.z}];
    if (normals.empty()) {
      index = static_cast<std::uint32_t>(mesh_.positions.size());
      mesh_.positions.push_back(position);
    }
    // Normals of neighbouring patches on a shared edge differ only by rounding. Use one normal for both.
    for (const std::uint32_t other : normals) {
      if (glm::length(mesh_.normals[other] - normal) < 1e-9) return {index, other};
    }
    normals.push_back(static_cast<std::uint32_t>(mesh_.normals.size()));
    mesh_.normals.push_back(normal);
    return {index, normals.back()};
  }

  void add_triangle(Corner a, Corner b, Corner c, bool is_turned) {
    if (is_turned) std::swap(b, c);
    if (a.first == b.first || b.first == c.first || c.first == a.first) return;
    mesh_.triangles.push_back({{a.first, b.first, c.first}, {a.second, b.second, c.second}, 0});
  }

  std::uint32_t divisions_;
  Mesh mesh_;
  std::map<std::tuple<double, double, double>, std::pair<std::uint32_t, std::vector<std::uint32_t>>> known_;
};

}  // namespace

Mesh make_uv_sphere(std::uint32_t slices, std::uint32_t stacks, double radius) {
  Mesh mesh;
  const auto add_vertex = [&](const glm::dvec3& normal) {
    mesh.normals.push_back(glm::normalize(normal));
    mesh.positions.push_back(radius * mesh.normals.back());
  };
  const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({{a, b, c}, {a, b, c}, 0});
  };
  add_vertex({0.0, 1.0, 0.0});
  for (std::uint32_t stack = 1; stack < stacks; ++stack) {
    const auto [sin_polar, cos_polar] = sine_cosine(std::numbers::pi * stack / stacks);
    for (std::uint32_t slice = 0; slice < slices; ++slice) {
      const auto [sin_azimuth, cos_azimuth] = sine_cosine(2.0 * std::numbers::pi * slice / slices);
      add_vertex({sin_polar * cos_azimuth, cos_polar, -sin_polar * sin_azimuth});
    }
  }
  add_vertex({0.0, -1.0, 0.0});

  const std::uint32_t south = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
  const auto ring = [&](std::uint32_t stack, std::uint32_t slice) {
    return 1 + (stack - 1) * slices + slice % slices;
  };
  for (std::uint32_t slice = 0; slice < slices; ++slice) {
    add_triangle(0, ring(1, slice), ring(1, slice + 1));
    for (std::uint32_t stack = 1; stack + 1 < stacks; ++stack) {
      add_triangle(ring(stack, slice), ring(stack + 1, slice), ring(stack + 1, slice + 1));
      add_triangle(ring(stack, slice), ring(stack + 1, slice + 1), ring(stack, slice + 1));
    }
    add_triangle(ring(stacks - 1, slice), south, ring(stacks - 1, slice + 1));
  }
  return mesh;
}

Mesh make_teapot(std::uint32_t divisions) {
  TeapotBuilder builder(divisions);
  builder.add_piece(std::span<const Circle>(c_pot), true);
  builder.add_piece(std::span<const Circle>(c_lid), true);
  builder.add_piece(std::span<const Section>(c_handle), false);
  builder.add_piece(std::span<const Section>(c_spout), false);
  return builder.take();
}

Mesh make_box(const glm::dvec3& size, std::uint32_t divisions) {
  Mesh mesh;
  // Identify a vertex by its lattice steps from the lowest corner along x, y and z. Faces that meet then
  // share the vertices of their edge.
  using Lattice = std::array<std::uint32_t, 3>;
  std::map<Lattice, std::uint32_t> known;
  const auto vertex = [&](const Lattice& at) {
    const auto [entry, is_new] = known.try_emplace(at, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) {
      glm::dvec3 position;
      for (int axis = 0; axis < 3; ++axis)
        position[axis] = 0.5 * size[axis] * ((2.0 * at[axis] - divisions) / divisions);
      mesh.positions.push_back(position);
    }
    return entry->second;
  };
  for (std::uint32_t face = 0; face < 6; ++face) {
    const std::uint32_t normal_axis = face / 2;
    const bool is_upper = face % 2 == 1;
    // Choose the axes right-handed about the outward normal.
    const std::uint32_t u_axis = (normal_axis + (is_upper ? 1 : 2)) % 3;
    const std::uint32_t v_axis = (normal_axis + (is_upper ? 2 : 1)) % 3;
    glm::dvec3 normal(0.0);
    normal[static_cast<int>(normal_axis)] = is_upper ? 1.0 : -1.0;
    mesh.normals.push_back(normal);
    const auto at = [&](std::uint32_t u, std::uint32_t v) {
      Lattice lattice;
      lattice[normal_axis] = is_upper ? divisions : 0;
      lattice[u_axis] = u;
      lattice[v_axis] = v;
      return vertex(lattice);
    };
    for (std::uint32_t u = 0; u < divisions; ++u) {
      for (std::uint32_t v = 0; v < divisions; ++v) {
        const std::uint32_t a = at(u, v), b = at(u + 1, v), c = at(u + 1, v + 1), d = at(u, v + 1);
        mesh.triangles.push_back({{a, b, c}, {face, face, face}, 0});
        mesh.triangles.push_back({{a, c, d}, {face, face, face}, 0});
      }
    }
  }
  return mesh;
}

}  // namespace halfway
