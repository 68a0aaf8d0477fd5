// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfway {

namespace {

PlanePoint projected(const glm::dvec3& corner, int axis) {
  return {corner[(axis + 1) % 3], corner[(axis + 2) % 3]};
}

/// For three points on one line: true if b is strictly between the others.
bool is_between(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return b != a && b != c && std::min(a.x, c.x) <= b.x && b.x <= std::max(a.x, c.x) &&
         std::min(a.y, c.y) <= b.y && b.y <= std::max(a.y, c.y);
}

}  // namespace

PolygonKind Triangulator::divide(std::span<const glm::dvec3> corners, std::vector<Triangle>& triangles) {
  // Link the corners to a ring, without those at the same place as the one before.
  nodes_.clear();
  for (std::uint32_t corner = 0; corner < corners.size(); ++corner) {
    const std::size_t before = (corner == 0 ? corners.size() : corner) - 1;
    if (corners[corner] != corners[before]) nodes_.push_back({.corner = corner});
  }
  if (nodes_.size() < 3 || is_collinear(corners)) return PolygonKind::no_area;
  if (!project(corners)) return PolygonKind::crossing;
  const auto count = static_cast<std::uint32_t>(nodes_.size());
  for (std::uint32_t node = 0; node < count; ++node) {
    nodes_[node].previous = (node == 0 ? count : node) - 1;
    nodes_[node].next = node + 1 == count ? 0 : node + 1;
  }
  for (std::uint32_t node = 0; node < count; ++node) set_turn(node);

  // Divide a convex polygon into a fan.
  const std::size_t first = triangles.size();
  if (is_convex()) {
    for (std::uint32_t node = 1; node + 1 < count; ++node) {
      triangles.push_back({nodes_[0].corner, nodes_[node].corner, nodes_[node + 1].corner});
    }
    return PolygonKind::divided;
  }

  // Clip the ears of any other. The sum of the triangles' outlines is the polygon's outline, and no triangle
  // is turned over. So the triangles cover each point as often as the outline winds around it, whichever ears
  // were clipped: they overlap if and only if the outline crosses or overlaps itself.
  const bool is_clipped = clip_all(triangles);
  const bool is_crossing = !is_clipped || overlap(std::span(triangles).subspan(first));
  if (!is_crossing && work_ <= c_max_work) return PolygonKind::divided;
  triangles.resize(first);
  return work_ > c_max_work ? PolygonKind::out_of_work : PolygonKind::crossing;
}

/// Project the ring so that its area is positive. False if the area is zero.
bool Triangulator::project(std::span<const glm::dvec3> corners) {
  // Find the projection with the largest area.
  int largest = 0;
  std::array<ExactSum, 3> areas;
  for (int axis = 0; axis < 3; ++axis) {
    ExactSum& area = areas[static_cast<std::size_t>(axis)];
    PlanePoint from = projected(corners[nodes_.back().corner], axis);
    for (const Node& node : nodes_) {
      const PlanePoint to = projected(corners[node.corner], axis);
      area.add_product(from.x, to.y);
      area.add_product(-from.y, to.x);
      from = to;
    }
    if (std::abs(area.value()) > std::abs(areas[static_cast<std::size_t>(largest)].value())) largest = axis;
  }
  const int sign = areas[static_cast<std::size_t>(largest)].sign();

  plane_.resize(corners.size());
  for (Node& node : nodes_) {
    PlanePoint at = projected(corners[node.corner], largest);
    if (sign < 0) std::swap(at.x, at.y);
    node.at = plane_[node.corner] = at;
  }
  return sign != 0;
}

bool Triangulator::is_collinear(std::span<const glm::dvec3> corners) const {
  for (int axis = 0; axis < 3; ++axis) {
    const PlanePoint a = projected(corners[nodes_[0].corner], axis);
    const PlanePoint b = projected(corners[nodes_[1].corner], axis);
    for (const Node& node : nodes_) {
      if (orientation(a, b, projected(corners[node.corner], axis)) != 0) return false;
    }
  }
  return true;
}

/// True if every corner turns left and the outline goes around once.
bool Triangulator::is_convex() const {
  int reversals = 0;
  const auto goes_right = [this](const Node& node) {
    const PlanePoint& to = nodes_[node.next].at;
    return to.x > node.at.x || (to.x == node.at.x && to.y > node.at.y);
  };
  for (const Node& node : nodes_) {
    if (node.turn <= 0) return false;
    if (goes_right(node) != goes_right(nodes_[node.previous])) ++reversals;
  }
  return reversals == 2;
}

void Triangulator::set_turn(std::uint32_t index) {
  Node& node = nodes_[index];
  node.turn = orientation(nodes_[node.previous].at, node.at, nodes_[node.next].at);
}

/// List the nodes that do not turn left, by x.
void Triangulator::list_reflex() {
  reflex_.clear();
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (!nodes_[node].is_removed && nodes_[node].turn <= 0) reflex_.push_back(node);
  }
  std::sort(reflex_.begin(), reflex_.end(),
            [this](std::uint32_t a, std::uint32_t b) { return nodes_[a].at.x < nodes_[b].at.x; });
  no_longer_reflex_ = 0;
  work_ += nodes_.size();
}

/// True if the triangle of a node and its neighbours contains no other part of the outline.
bool Triangulator::is_ear(std::uint32_t tip) {
  const Node& b = nodes_[tip];
  if (b.turn <= 0) return false;
  const Node& a = nodes_[b.previous];
  const Node& c = nodes_[b.next];
  const auto [low_x, high_x] = std::minmax({a.at.x, b.at.x, c.at.x});
  const auto [low_y, high_y] = std::minmax({a.at.y, b.at.y, c.at.y});
  // If the triangle contains corners, one of them does not turn left.
  const auto first = std::lower_bound(reflex_.begin(), reflex_.end(), low_x,
                                      [this](std::uint32_t node, double x) { return nodes_[node].at.x < x; });
  for (auto reflex = first; reflex != reflex_.end(); ++reflex) {
    const std::uint32_t index = *reflex;
    const Node& node = nodes_[index];
    const PlanePoint& p = node.at;
    if (p.x > high_x) break;
    ++work_;
    if (p.y < low_y || p.y > high_y || node.is_removed || node.turn > 0) continue;
    if (index == tip || index == b.previous || index == b.next) continue;
    // Where the outline touches one of the three corners, it must not enter the triangle there.
    if (p == a.at) {
      if (enters(index, b.previous, tip, b.next)) return false;
    } else if (p == b.at) {
      if (enters(index, tip, b.next, b.previous)) return false;
    } else if (p == c.at) {
      if (enters(index, b.next, b.previous, tip)) return false;
    } else if (orientation(a.at, b.at, p) >= 0 && orientation(b.at, c.at, p) >= 0 &&
               orientation(c.at, a.at, p) >= 0) {
      return false;
    }
  }
  return true;
}

/// True if an edge of the node goes into the angle at the apex, which is at the same place.
bool Triangulator::enters(std::uint32_t node, std::uint32_t apex, std::uint32_t right,
                          std::uint32_t left) const {
  const auto is_inside = [&](std::uint32_t neighbour) {
    const PlanePoint& p = nodes_[neighbour].at;
    return orientation(nodes_[apex].at, nodes_[right].at, p) > 0 &&
           orientation(nodes_[apex].at, p, nodes_[left].at) > 0;
  };
  return is_inside(nodes_[node].previous) || is_inside(nodes_[node].next);
}

/// True if the outline turns back at this node: it may be clipped at any time, for its triangle has no area.
bool Triangulator::is_spike(std::uint32_t tip) const {
  const Node& node = nodes_[tip];
  return node.turn == 0 && !is_between(nodes_[node.previous].at, node.at, nodes_[node.next].at);
}

/// Add the triangle of a node and its neighbours, and remove the node.
void Triangulator::clip(std::uint32_t tip, std::vector<Triangle>& triangles) {
  Node& node = nodes_[tip];
  triangles.push_back({nodes_[node.previous].corner, node.corner, nodes_[node.next].corner});
  node.is_removed = true;
  --remaining_;
  nodes_[node.previous].next = node.next;
  nodes_[node.next].previous = node.previous;

  // Keep the list of nodes that do not turn left at most twice as long as needed.
  if (node.turn <= 0) ++no_longer_reflex_;
  bool is_new_reflex = false;
  for (const std::uint32_t neighbour : {node.previous, node.next}) {
    const bool was_reflex = nodes_[neighbour].turn <= 0;
    set_turn(neighbour);
    const bool is_reflex = nodes_[neighbour].turn <= 0;
    if (was_reflex && !is_reflex) ++no_longer_reflex_;
    is_new_reflex |= !was_reflex && is_reflex;
    add_candidate(neighbour);
  }
  if (is_new_reflex || 2 * no_longer_reflex_ > reflex_.size()) list_reflex();
}

/// Test a node after all other candidates. So ears next to each other are not clipped one after the other,
/// which would give long thin triangles.
void Triangulator::add_candidate(std::uint32_t node) {
  nodes_[node].last_candidate = candidates_.size();
  candidates_.push_back(node);
}

/// Test each node, and again after a neighbour is clipped. Clip spikes and, unless `spikes_only`, ears.
void Triangulator::clip_each(bool spikes_only, std::vector<Triangle>& triangles) {
  candidates_.clear();
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (!nodes_[node].is_removed) add_candidate(node);
  }
  for (std::size_t i = 0; i < candidates_.size() && remaining_ > 3 && work_ <= c_max_work; ++i) {
    const std::uint32_t node = candidates_[i];
    if (nodes_[node].is_removed || nodes_[node].last_candidate != i) continue;
    if (!is_spike(node) && (spikes_only || !is_ear(node))) continue;
    clip(node, triangles);
    // Clip the spikes that this leaves at once, because both sides of a spike may bound other ears.
    const auto is_spike_left = [this](std::uint32_t neighbour) {
      return remaining_ > 3 && is_spike(neighbour);
    };
    for (std::uint32_t last = node;;) {
      const Node& clipped = nodes_[last];
      if (!is_spike_left(clipped.previous) && !is_spike_left(clipped.next)) break;
      last = is_spike_left(clipped.previous) ? clipped.previous : clipped.next;
      clip(last, triangles);
    }
  }
}

/// Clip ears until nothing is left. False if there is no ear. An outline that does not touch itself always
/// has one.
bool Triangulator::clip_all(std::vector<Triangle>& triangles) {
  remaining_ = nodes_.size();
  list_reflex();
  clip_each(true, triangles);
  clip_each(false, triangles);
  while (remaining_ > 3 && work_ <= c_max_work) {
    // What is left of an outline that touches itself: clip a corner on a straight edge.
    const auto flat = std::find_if(nodes_.begin(), nodes_.end(),
                                   [](const Node& node) { return !node.is_removed && node.turn == 0; });
    if (flat == nodes_.end()) return false;
    clip(static_cast<std::uint32_t>(flat - nodes_.begin()), triangles);
    clip_each(false, triangles);
    work_ += nodes_.size();
  }
  const auto last =
      std::find_if(nodes_.begin(), nodes_.end(), [](const Node& node) { return !node.is_removed; });
  if (last->turn < 0) return false;
  triangles.push_back({nodes_[last->previous].corner, last->corner, nodes_[last->next].corner});
  return true;
}

/// True if two of the triangles have a common area.
bool Triangulator::overlap(std::span<const Triangle> triangles) {
  struct Box {
    std::array<PlanePoint, 3> corners;
    double low_x, high_x, low_y, high_y;
  };
  std::vector<Box> boxes;
  for (const Triangle& triangle : triangles) {
    const std::array<PlanePoint, 3> at{plane_[triangle[0]], plane_[triangle[1]], plane_[triangle[2]]};
    if (orientation(at[0], at[1], at[2]) == 0) continue;
    const auto [low_x, high_x] = std::minmax({at[0].x, at[1].x, at[2].x});
    const auto [low_y, high_y] = std::minmax({at[0].y, at[1].y, at[2].y});
    boxes.push_back({at, low_x, high_x, low_y, high_y});
  }
  // Two triangles have no common area if the line of an edge separates them.
  const auto is_outside_an_edge = [](const Box& a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::all_of(b.corners.begin(), b.corners.end(), [&](const PlanePoint& p) {
            return orientation(a.corners[i], a.corners[(i + 1) % 3], p) <= 0;
          }))
        return true;
    }
    return false;
  };
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.low_x < b.low_x; });
  for (std::size_t i = 0; i < boxes.size() && work_ <= c_max_work; ++i) {
    const Box& a = boxes[i];
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low_x < a.high_x; ++j) {
      const Box& b = boxes[j];
      ++work_;
      if (b.low_y >= a.high_y || b.high_y <= a.low_y) continue;
      if (!is_outside_an_edge(a, b) && !is_outside_an_edge(b, a)) return true;
    }
  }
  return false;
}

}  // namespace halfway
