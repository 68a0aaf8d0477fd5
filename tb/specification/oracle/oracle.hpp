// SPDX-License-Identifier: Apache-2.0
// Computes the picture of a scene from its equations only, as an independent check of projection, coverage,
// depth, illumination and shadows. The oracle shares no code with model/; it only reads the plain fields of
// a scene. It is slow and simple: every pixel tests every triangle. Screen geometry is in integers.
// Everything else is in long double, with a rounding 2000 times finer than that of the tested code.
//
// Equations, besides those of specification.hpp. Each is repeated where it is used.
//  perspective and depth          Akenine-Moller, Haines, Hoffman: Real-Time Rendering, 4th ed.,
//                                 sections 4.7 and 23.7
//  perspective correction         Heckbert, Moreton: Interpolation for Polygon Texture Mapping and Shading
//                                 (1991)
//  ray against triangle           Moller, Trumbore: Fast, Minimum Storage Ray/Triangle Intersection (1997)
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "specification/oracle/specification.hpp"

namespace halfway::oracle {

/// A corner on the screen: its position in 1/16 pixel, and the reciprocal of its distance along the viewing
/// axis.
struct ScreenCorner {
  std::int64_t x, y;
  Real inverse_w;
};
using ScreenTriangle = std::array<ScreenCorner, 3>;

class Oracle {
 public:
  /// The scene must outlive the oracle, and its camera must give near and far.
  Oracle(const Scene& scene, unsigned width, unsigned height, Fault fault = {});

  /// The triangle on the screen; empty if it is seen from behind or edge-on. No corner may be nearer than the
  /// near plane: see is_clipped.
  const std::optional<ScreenTriangle>& on_screen(std::size_t triangle) const { return screen_[triangle]; }
  /// A corner lies outside of what the oracle projects: before the near plane or beyond the far plane.
  bool is_clipped() const { return clipped_; }
  /// Number of corners with a coordinate in doubt between two steps of 1/16 pixel.
  std::size_t doubtful_corners() const { return doubtful_corners_; }

  /// Returns whether the triangle covers the pixel. Exact.
  bool covers(std::size_t triangle, int x, int y) const;
  /// Depth of the triangle's plane at the pixel's centre, in steps: 0 at the near plane, 2^24 - 1 at the far
  /// plane. The weights of the corners are exact.
  Real depth_steps(std::size_t triangle, int x, int y) const;

  /// The point of a triangle at a pixel's centre.
  struct Surface {
    Vector position{}, normal{};
  };
  Surface surface(std::size_t triangle, int x, int y) const;
  /// Sets `doubtful` if a decision (a horizon, a shadow's edge) is in doubt.
  Vector radiance(std::size_t triangle, const Surface& surface, bool& doubtful) const;

  struct Pixel {
    std::optional<std::size_t> triangle;  ///< the nearest
    Vector colour{};
    std::array<std::uint8_t, 3> byte{};
    std::array<bool, 3> doubtful{};  ///< rounding may give the next byte
  };
  Pixel pixel(int x, int y) const;

 private:
  bool has(Fault fault) const { return fault_ == fault; }
  void project(std::size_t triangle);
  Vector position(std::size_t triangle, int corner) const;
  Real distance(const Vector& position) const;
  Real depth_of(const Vector& position) const;
  bool is_shadowed(std::size_t triangle, const Vector& from, const Light& light, bool& doubtful) const;

  const Scene& scene_;
  unsigned width_, height_;
  Fault fault_;
  Vector eye_, right_, up_, forward_;
  Real pixels_per_slope_;
  Real radius_ = 0;
  bool clipped_ = false;
  std::size_t doubtful_corners_ = 0;
  std::vector<std::optional<ScreenTriangle>> screen_;
};

}  // namespace halfway::oracle
