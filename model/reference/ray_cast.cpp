// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_cast.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <utility>

#include "common/to_integer.hpp"
#include "scene/camera.hpp"
#include "scene/lights.hpp"

namespace halfway {
namespace {

constexpr std::uint32_t c_leaf_triangles = 4;
constexpr int c_bins = 16;
// Deeper than any reasonable tree. Below this depth the triangles are halved by number, at most 32 times.
constexpr int c_most_costed_depth = 60;
constexpr std::size_t c_most_depth = c_most_costed_depth + 34;
// Relative to the scene's radius: far larger than the error of a sheared vertex, far smaller than any box.
constexpr double c_box_margin = 1e-12;

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Box& box) {
    low = glm::min(low, box.low);
    high = glm::max(high, box.high);
  }
  double half_area() const {
    const glm::dvec3 size = high - low;
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
  glm::dvec3 centre() const { return 0.5 * low + 0.5 * high; }
  bool is_finite() const {
    constexpr double c_largest = std::numeric_limits<double>::max();
    return glm::all(glm::lessThanEqual(glm::abs(low), glm::dvec3(c_largest))) &&
           glm::all(glm::lessThanEqual(glm::abs(high), glm::dvec3(c_largest)));
  }
};

}  // namespace

/// Builds the tree top down, by the surface area heuristic over bins.
class ShadowRays::Builder {
 public:
  Builder(ShadowRays& rays, double margin) : rays_(rays), margin_(margin) {
    boxes_.reserve(rays.scene_->triangles.size());
    for (const SceneTriangle& triangle : rays.scene_->triangles) {
      Box box;
      for (const glm::dvec3& corner : corners_world(*rays.scene_, triangle)) box.add(corner);
      boxes_.push_back(box);
    }
    // Omit triangles without a finite box: no ray meets them.
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
      if (boxes_[i].is_finite()) rays.order_.push_back(i);
  }

  void build() {
    struct Task {
      std::uint32_t node, begin, end;
      int depth;
    };
    rays_.nodes_.emplace_back();
    std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(rays_.order_.size()), 0}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      Box box, centres;
      for (std::uint32_t i = task.begin; i < task.end; ++i) {
        box.add(boxes_[rays_.order_[i]]);
        centres.add(boxes_[rays_.order_[i]].centre());
      }
      Node& node = rays_.nodes_[task.node];
      node.low_world = box.low - margin_;
      node.high_world = box.high + margin_;
      if (task.end - task.begin <= c_leaf_triangles) {
        node.first = task.begin;
        node.count = task.end - task.begin;
        continue;
      }
      const std::uint32_t middle = split(task.begin, task.end, centres, task.depth);
      const auto child = static_cast<std::uint32_t>(rays_.nodes_.size());
      node.first = child;
      node.count = 0;
      rays_.nodes_.resize(rays_.nodes_.size() + 2);
      tasks.push_back({child, task.begin, middle, task.depth + 1});
      tasks.push_back({child + 1, middle, task.end, task.depth + 1});
    }
  }

 private:
  /// Partitions order_[begin, end) into two parts that are not empty.
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, const Box& centres, int depth) {
    const auto first = rays_.order_.begin() + begin, last = rays_.order_.begin() + end;
    const glm::dvec3 size = centres.high - centres.low;
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    if (size[axis] > 0.0 && depth < c_most_costed_depth) {
      const double scale = c_bins / size[axis];
      const auto bin_of = [&](std::uint32_t triangle) {
        const double place = (boxes_[triangle].centre()[axis] - centres.low[axis]) * scale;
        return std::min(to_integer<int>(place), c_bins - 1);
      };
      struct Bin {
        Box box;
        std::uint32_t count = 0;
      };
      std::array<Bin, c_bins> bins;
      for (auto it = first; it != last; ++it) {
        Bin& bin = bins[bin_of(*it)];
        bin.box.add(boxes_[*it]);
        ++bin.count;
      }
      const auto cost = [](const Bin& side) {
        return side.count == 0 ? 0.0 : side.count * side.box.half_area();
      };
      std::array<double, c_bins> left_cost;  // cost of the bins up to and including this one
      Bin sum;
      for (int i = 0; i < c_bins; ++i) {
        sum.box.add(bins[i].box);
        sum.count += bins[i].count;
        left_cost[i] = cost(sum);
      }
      sum = {};
      int best = -1;
      double best_cost = std::numeric_limits<double>::infinity();
      for (int i = c_bins - 1; i > 0; --i) {
        sum.box.add(bins[i].box);
        sum.count += bins[i].count;
        if (const double here = left_cost[i - 1] + cost(sum); here < best_cost) {
          best_cost = here;
          best = i;
        }
      }
      const auto middle = std::partition(first, last, [&](std::uint32_t t) { return bin_of(t) < best; });
      if (middle != first && middle != last) return static_cast<std::uint32_t>(middle - rays_.order_.begin());
    }
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(first, rays_.order_.begin() + middle, last, [&](std::uint32_t a, std::uint32_t b) {
      return boxes_[a].centre()[axis] < boxes_[b].centre()[axis];
    });
    return middle;
  }

  ShadowRays& rays_;
  double margin_;
  std::vector<Box> boxes_;
};

ShadowRays::ShadowRays(const Scene& scene) : scene_(&scene) {
  const double radius = bounding_sphere(scene).radius;
  touching_distance_ = c_touching * radius;
  Builder builder(*this, c_box_margin * radius);
  if (!order_.empty()) builder.build();
}

bool ShadowRays::reaches(LightRef light, const glm::dvec3& point_world, std::uint32_t triangle,
                         bool is_back) const {
  const LightPoint from = light_of(*scene_, light).point;
  CornersWorld corners = corners_world(*scene_, scene_->triangles[triangle]);
  if (is_back) std::swap(corners[1], corners[2]);
  if (is_averted(corners, from)) return false;
  const double length = glm::length(from.way_from(point_world));
  if (!(length > touching_distance_)) return true;
  return !is_blocked(LightRay(point_world, from), touching_distance_ / length);
}

bool ShadowRays::is_blocked(const LightRay& ray, double least_way) const {
  if (nodes_.empty()) return false;
  const glm::dvec3 inverse = 1.0 / ray.direction_world();
  // Written such that 0 * infinity, for a ray in the plane of a box's side, never rejects the box.
  const auto meets = [&](const Node& node) {
    double begin = 0.0, end = ray.greatest_way();
    for (int axis = 0; axis < 3; ++axis) {
      const bool falls = inverse[axis] < 0.0;
      const double origin = ray.from_world()[axis];
      const double in = ((falls ? node.high_world : node.low_world)[axis] - origin) * inverse[axis];
      const double out = ((falls ? node.low_world : node.high_world)[axis] - origin) * inverse[axis];
      if (in > begin) begin = in;
      if (out < end) end = out;
    }
    return begin <= end;
  };
  std::array<std::uint32_t, c_most_depth + 2> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const Node& node = nodes_[stack[--waiting]];
    if (!meets(node)) continue;
    if (node.count == 0) {
      stack[waiting++] = node.first;
      stack[waiting++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const CornersWorld corners = corners_world(*scene_, scene_->triangles[order_[i]]);
      if (ray.hit(corners, least_way).crossing == Crossing::enters) return true;
    }
  }
  return false;
}

}  // namespace halfway
