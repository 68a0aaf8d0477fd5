// SPDX-License-Identifier: Apache-2.0
// A triangle on the screen: snapped coordinates, and the data from which the surface point at any pixel is
// computed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace halfway {

/// Screen space: x points right, y down. The centre of pixel (x, y) is at (x + 1/2, y + 1/2) pixels.
struct ScreenVertex {
  std::int32_t x, y;  ///< in 1/2^subpixel_bits of a pixel
  double z;           ///< depth in [0, 1], 0 at the near plane; linear in screen space
  double inverse_w;   ///< 1 / view-space distance along the viewing axis, > 0; linear in screen space
  glm::dvec3 position_world;
  glm::dvec3 normal_world;  ///< as interpolated; not unit after clipping
};

/// Not degenerate after snapping. The vertices are ordered so that twice_area() > 0. The back of a triangle
/// that is drawn from both sides comes as a front: with reversed vertices and normals turned to the eye.
struct ScreenTriangle {
  std::uint32_t source;    ///< number of the scene's triangle
  std::uint32_t material;  ///< index into Scene::materials
  std::array<ScreenVertex, 3> vertex;
  /// True if the vertices are the corners 0, 2, 1 of the scene's triangle, with its normals. False if it may
  /// have been clipped, or turned to the eye.
  bool is_whole = false;
  bool is_back = false;  ///< true: the eye sees the back of the scene's triangle

  /// (x2-x1)(y3-y1) - (y2-y1)(x3-x1), in squared subpixels.
  std::int64_t twice_area() const {
    const auto& [a, b, c] = vertex;
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
  }
};

/// A triangle that is visible from both sides.
struct TwoSidedTriangle {
  ScreenTriangle triangle;  ///< ordered as if front-facing
  bool faces_eye;           ///< true if it was given counter-clockwise
};

}  // namespace halfway
