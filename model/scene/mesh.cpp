// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace halfway {

namespace {

constexpr double c_min_height = 1e-12;
constexpr double c_min_normal_length = 1e-9;
// Relative to the sum of the terms' sizes: a volume below it is rounding, as that of two sheets back to back.
constexpr double c_volume_rounding = 1e-12;

struct PositionHash {
  std::size_t operator()(const glm::dvec3& position) const {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(position[axis])) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

// Returns the item that represents the group of an item: a corner, with the number 3 t + c for corner c of
// triangle t, or a triangle.
std::uint32_t group_of(std::vector<std::uint32_t>& parent, std::uint32_t item) {
  while (parent[item] != item) {
    parent[item] = parent[parent[item]];
    item = parent[item];
  }
  return item;
}

void join_groups(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t group_a = group_of(parent, a);
  const std::uint32_t group_b = group_of(parent, b);
  parent[std::max(group_a, group_b)] = std::min(group_a, group_b);
}

glm::dvec3 face_normal(const std::vector<glm::dvec3>& positions, const SceneTriangle& triangle) {
  const glm::dvec3& a = positions[triangle.position[0]];
  // Scale by the longest side first: the squares of very small or very large edges would exceed double's
  // range.
  const glm::dvec3 ab = positions[triangle.position[1]] - a;
  const glm::dvec3 ac = positions[triangle.position[2]] - a;
  const glm::dvec3 largest = glm::max(glm::abs(ab), glm::abs(ac));
  const double size = std::max({largest.x, largest.y, largest.z});
  return glm::normalize(glm::cross(ab / size, ac / size));
}

double corner_angle(const Mesh& mesh, const SceneTriangle& triangle, int corner) {
  const glm::dvec3& apex = mesh.positions[triangle.position[corner]];
  const glm::dvec3 left = glm::normalize(mesh.positions[triangle.position[(corner + 1) % 3]] - apex);
  const glm::dvec3 right = glm::normalize(mesh.positions[triangle.position[(corner + 2) % 3]] - apex);
  return std::atan2(glm::length(glm::cross(left, right)), glm::dot(left, right));
}

// One use of an edge by a triangle.
struct EdgeUse {
  std::uint32_t low, high;  // position indices
  std::uint32_t triangle;
  int way;  // 1 from low to high, -1 from high to low

  auto edge() const { return std::pair(low, high); }
};

std::vector<EdgeUse> sorted_edge_uses(std::span<const SceneTriangle> triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const std::uint32_t from = triangles[t].position[side], to = triangles[t].position[(side + 1) % 3];
      if (from != to) uses.push_back({std::min(from, to), std::max(from, to), t, from < to ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.edge() < b.edge(); });
  return uses;
}

// Calls found(uses of the edge) for each edge.
template <class Found>
void for_each_edge(std::span<const SceneTriangle> triangles, Found&& found) {
  const std::vector<EdgeUse> uses = sorted_edge_uses(triangles);
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].edge() == uses[begin].edge()) ++end;
    found(std::span(uses).subspan(begin, end - begin));
  }
}

// 0 if the edge is used as often in one direction as in the other.
int unmatched(std::span<const EdgeUse> uses) {
  int sum = 0;
  for (const EdgeUse& use : uses) sum += use.way;
  return std::abs(sum);
}

// -1 for the triangles that are wound against the first one of their surface, 1 for the others.
std::vector<double> winding_signs(std::span<const SceneTriangle> triangles) {
  // `against` compares a triangle with its parent.
  std::vector<std::uint32_t> parent(triangles.size());
  std::vector<bool> against(triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root_of = [&](std::uint32_t triangle) {
    bool flipped = false;
    while (parent[triangle] != triangle) {
      const std::uint32_t above = parent[triangle];
      against[triangle] = against[triangle] != against[above];
      parent[triangle] = parent[above];
      flipped = flipped != against[triangle];
      triangle = parent[triangle];
    }
    return std::pair(triangle, flipped);
  };
  for_each_edge(triangles, [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const auto [a, a_flipped] = root_of(uses[0].triangle);
    const auto [b, b_flipped] = root_of(uses[1].triangle);
    if (a == b) return;
    const bool is_conflict = uses[0].way == uses[1].way;
    parent[std::max(a, b)] = std::min(a, b);
    against[std::max(a, b)] = (a_flipped != b_flipped) != is_conflict;
  });
  std::vector<double> signs(triangles.size());
  for (std::uint32_t t = 0; t < signs.size(); ++t) signs[t] = root_of(t).second ? -1.0 : 1.0;
  return signs;
}

// Groups the corners that share a normal.
std::vector<std::uint32_t> smooth_groups(const Mesh& mesh, const std::vector<glm::dvec3>& face_normals,
                                         double crease_degrees) {
  std::vector<std::uint32_t> parent(3 * mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  if (crease_degrees >= 180.0) {
    std::vector<std::uint32_t> first(mesh.positions.size(), UINT32_MAX);
    for (std::uint32_t corner = 0; corner < parent.size(); ++corner) {
      std::uint32_t& owner = first[mesh.triangles[corner / 3].position[corner % 3]];
      if (owner == UINT32_MAX) owner = corner;
      parent[corner] = owner;
    }
    return parent;
  }
  struct Edge {
    std::uint32_t low, high;  // position indices
    std::uint32_t corner_at_low, corner_at_high;
  };
  std::vector<Edge> edges;
  edges.reserve(parent.size());
  for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t next = (side + 1) % 3;
      Edge edge{mesh.triangles[triangle].position[side], mesh.triangles[triangle].position[next],
                3 * triangle + side, 3 * triangle + next};
      if (edge.low > edge.high) {
        std::swap(edge.low, edge.high);
        std::swap(edge.corner_at_low, edge.corner_at_high);
      }
      edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  const double cos_crease = std::cos(glm::radians(crease_degrees));
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const Edge& a = edges[i - 1];
    const Edge& b = edges[i];
    if (a.low != b.low || a.high != b.high) continue;
    if (glm::dot(face_normals[a.corner_at_low / 3], face_normals[b.corner_at_low / 3]) < cos_crease) continue;
    join_groups(parent, a.corner_at_low, b.corner_at_low);
    join_groups(parent, a.corner_at_high, b.corner_at_high);
  }
  for (std::uint32_t corner = 0; corner < parent.size(); ++corner) parent[corner] = group_of(parent, corner);
  return parent;
}

}  // namespace

void join_positions(Mesh& mesh) {
  std::unordered_map<glm::dvec3, std::uint32_t, PositionHash> known;
  known.reserve(mesh.positions.size());
  std::vector<std::uint32_t> new_index(mesh.positions.size());
  std::vector<glm::dvec3> joined;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 position = mesh.positions[i] + 0.0;  // -0 becomes 0
    const auto [entry, is_new] = known.try_emplace(position, static_cast<std::uint32_t>(joined.size()));
    if (is_new) joined.push_back(position);
    new_index[i] = entry->second;
  }
  for (SceneTriangle& triangle : mesh.triangles) {
    for (std::uint32_t& index : triangle.position) index = new_index[index];
  }
  mesh.positions = std::move(joined);
}

void transform(Mesh& mesh, const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const double determinant = glm::determinant(linear);
  // The matrix of cofactors is the inverse transpose times the determinant. Only the determinant's sign
  // matters, because normals are normalized again.
  const double side = determinant < 0.0 ? -1.0 : 1.0;
  const glm::dmat3 cofactors(side * glm::cross(linear[1], linear[2]), side * glm::cross(linear[2], linear[0]),
                             side * glm::cross(linear[0], linear[1]));
  for (glm::dvec3& position : mesh.positions) position = linear * position + glm::dvec3(matrix[3]);
  for (glm::dvec3& normal : mesh.normals) {
    const glm::dvec3 moved = cofactors * normal;
    const double length = glm::length(moved);
    normal = length > 0.0 ? moved / length : glm::dvec3(0.0);
  }
  if (determinant < 0.0) {
    for (SceneTriangle& triangle : mesh.triangles) {
      std::swap(triangle.position[1], triangle.position[2]);
      std::swap(triangle.normal[1], triangle.normal[2]);
    }
  }
}

std::size_t drop_zero_area(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [&mesh](const SceneTriangle& triangle) {
    const glm::dvec3& a = mesh.positions[triangle.position[0]];
    const glm::dvec3& b = mesh.positions[triangle.position[1]];
    const glm::dvec3& c = mesh.positions[triangle.position[2]];
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    if (!(longest > 0.0)) return true;
    return !(glm::length(glm::cross((b - a) / longest, (c - a) / longest)) > c_min_height);
  });
}

std::size_t fill_normals(Mesh& mesh, double crease_degrees, bool replace_all) {
  if (replace_all) {
    mesh.normals.assign(1, glm::dvec3(0.0));
    for (SceneTriangle& triangle : mesh.triangles) triangle.normal = {0, 0, 0};
  }
  // A normal whose length is far from 1 is rounding noise or an error in the file. Treat it as missing.
  for (glm::dvec3& normal : mesh.normals) {
    const double length = glm::length(normal);
    normal = std::isfinite(length) && length > c_min_normal_length ? normal / length : glm::dvec3(0.0);
  }
  const auto is_missing = [&mesh](std::uint32_t normal) { return mesh.normals[normal] == glm::dvec3(0.0); };
  const bool any_missing =
      std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const SceneTriangle& t) {
        return is_missing(t.normal[0]) || is_missing(t.normal[1]) || is_missing(t.normal[2]);
      });
  if (!any_missing) return 0;

  std::vector<glm::dvec3> face_normals;
  face_normals.reserve(mesh.triangles.size());
  const std::vector<double> sign = winding_signs(mesh.triangles);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    face_normals.push_back(sign[t] * face_normal(mesh.positions, mesh.triangles[t]));

  const std::vector<std::uint32_t> group = smooth_groups(mesh, face_normals, crease_degrees);
  std::vector<glm::dvec3> sum(group.size(), glm::dvec3(0.0));
  for (std::uint32_t corner = 0; corner < group.size(); ++corner) {
    const std::uint32_t triangle = corner / 3;
    sum[group[corner]] +=
        corner_angle(mesh, mesh.triangles[triangle], static_cast<int>(corner % 3)) * face_normals[triangle];
  }
  constexpr std::array<std::uint32_t, 2> c_none{UINT32_MAX, UINT32_MAX};
  std::vector<std::array<std::uint32_t, 2>> normals_of_group(group.size(), c_none);  // by sign
  std::size_t filled = 0;
  const auto add_normal = [&mesh](const glm::dvec3& normal) {
    mesh.normals.push_back(normal);
    return static_cast<std::uint32_t>(mesh.normals.size() - 1);
  };
  const std::size_t old_normals = mesh.normals.size();
  for (std::uint32_t corner = 0; corner < group.size(); ++corner) {
    std::uint32_t& normal = mesh.triangles[corner / 3].normal[corner % 3];
    if (normal >= old_normals || !is_missing(normal)) continue;
    ++filled;
    const double length = glm::length(sum[group[corner]]);
    if (length <= c_min_normal_length) {  // the faces cancel, as in two sheets back to back
      normal = add_normal(sign[corner / 3] * face_normals[corner / 3]);
      continue;
    }
    std::uint32_t& shared = normals_of_group[group[corner]][sign[corner / 3] < 0.0];
    if (shared == UINT32_MAX) shared = add_normal(sign[corner / 3] * sum[group[corner]] / length);
    normal = shared;
  }
  return filled;
}

std::vector<bool> shows_back(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<std::uint32_t> at_open_edge;
  for_each_edge(mesh.triangles, [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses.subspan(1)) join_groups(parent, uses[0].triangle, use.triangle);
    if (unmatched(uses) != 0) at_open_edge.push_back(uses[0].triangle);
  });
  std::vector<bool> is_open(parent.size());
  for (const std::uint32_t triangle : at_open_edge) is_open[group_of(parent, triangle)] = true;

  // Six times the volume of each surface, and the sum of its terms' sizes.
  struct Volume {
    double signed_sum = 0.0, size = 0.0;
  };
  std::vector<Volume> volumes(parent.size());
  for (std::uint32_t t = 0; t < parent.size(); ++t) {
    const std::uint32_t group = group_of(parent, t);
    const glm::dvec3& origin = mesh.positions[mesh.triangles[group].position[0]];
    const auto corner = [&](int i) { return mesh.positions[mesh.triangles[t].position[i]] - origin; };
    const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
    volumes[group].signed_sum += glm::dot(a, glm::cross(b, c));
    volumes[group].size += glm::length(a) * glm::length(b) * glm::length(c);
  }
  std::vector<bool> result(parent.size());
  for (std::uint32_t t = 0; t < parent.size(); ++t) {
    const std::uint32_t group = group_of(parent, t);
    const Volume& volume = volumes[group];
    result[t] = is_open[group] || volume.signed_sum < -c_volume_rounding * volume.size;
  }
  return result;
}

bool has_averted_normals(const Scene& scene, const SceneTriangle& triangle) {
  glm::dvec3 sum{0.0};
  for (const std::uint32_t normal : triangle.normal) sum += scene.normals_world[normal];
  return glm::dot(sum, face_normal(scene.positions_world, triangle)) < 0.0;
}

std::size_t open_edges(std::span<const SceneTriangle> triangles) {
  std::size_t open = 0;
  for_each_edge(triangles,
                [&](std::span<const EdgeUse> uses) { open += static_cast<std::size_t>(unmatched(uses)); });
  return open;
}

}  // namespace halfway
