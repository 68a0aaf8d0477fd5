// SPDX-License-Identifier: Apache-2.0
// Polygons as triangles, by ear clipping with exactly decided orientations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "mesh_files/exact_sum.hpp"

namespace halfway {

enum class PolygonKind {
  divided,      ///< triangles were appended
  no_area,      ///< all corners are on one line; no triangles
  crossing,     ///< the outline crosses or overlaps itself; no triangles
  out_of_work,  ///< the limit on the work was reached; no triangles
};

/// Divides polygons into triangles. The polygon may be concave, have corners on straight edges and repeated
/// corners, and touch itself at corners or along edges, as the bridge to a hole does. It must not cross
/// itself or wind around any point twice. It need not be planar: what counts is its projection along the axis
/// on which it has the largest area.
class Triangulator {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Append triangles of corner indices in the polygon's direction. Their projections have no negative area
  /// and do not overlap, and together they cover the inside of the outline. A triangle has zero area only if
  /// the outline touches itself along an edge, or is not planar.
  PolygonKind divide(std::span<const glm::dvec3> corners, std::vector<Triangle>& triangles);

  /// Limit on the comparisons of a corner or a triangle with another, summed over all polygons. It bounds the
  /// time by about half a minute.
  static constexpr std::uint64_t c_max_work = std::uint64_t{1} << 31;

 private:
  struct Node {
    PlanePoint at;
    std::uint32_t corner;
    std::uint32_t previous, next;
    int turn;  ///< orientation of the previous node, this node and the next node
    bool is_removed;
    std::size_t last_candidate;  ///< its last index in candidates_
  };

  bool project(std::span<const glm::dvec3> corners);
  bool is_collinear(std::span<const glm::dvec3> corners) const;
  bool is_convex() const;
  void set_turn(std::uint32_t node);
  void list_reflex();
  bool is_ear(std::uint32_t tip);
  bool enters(std::uint32_t node, std::uint32_t apex, std::uint32_t right, std::uint32_t left) const;
  bool is_spike(std::uint32_t tip) const;
  void clip(std::uint32_t tip, std::vector<Triangle>& triangles);
  void add_candidate(std::uint32_t node);
  void clip_each(bool spikes_only, std::vector<Triangle>& triangles);
  bool clip_all(std::vector<Triangle>& triangles);
  bool overlap(std::span<const Triangle> triangles);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> reflex_;      ///< nodes whose turn was not positive, by x
  std::size_t no_longer_reflex_ = 0;       ///< nodes of this list that were removed or turn left now
  std::vector<std::uint32_t> candidates_;  ///< nodes whose corner is to be tested
  std::vector<PlanePoint> plane_;          ///< of each corner
  std::size_t remaining_ = 0;              ///< nodes that are not removed
  std::uint64_t work_ = 0;
};

}  // namespace halfway
