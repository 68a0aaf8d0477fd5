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

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
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
  /// The camera's axes are found by Gram-Schmidt. The slope fills the frame: a point at distance w along the
  /// viewing axis and h above it is (h/w) (height/2) / tan(fov/2) pixels above the centre of the frame.
  Oracle(const Scene& scene, unsigned width, unsigned height, Fault fault = {})
      : scene_(scene), width_(width), height_(height), fault_(fault), eye_(scene.camera.eye_world) {
    forward_ = normalize(Vector(scene.camera.target_world) - eye_);
    const Vector up(scene.camera.up_world);
    up_ = normalize(up - dot(up, forward_) * forward_);
    right_ = cross(forward_, up_);
    if (has("mirrored")) right_ = -right_;
    if (has("upside_down")) up_ = -up_;
    const Real half_angle = Real(scene.camera.vertical_fov_degrees) * std::numbers::pi_v<Real> / 180 /
                            (has("fov_is_half") ? 1 : 2);
    const Real half_side = Real(has("fov_is_horizontal") ? width : height) / 2;
    pixels_per_slope_ = half_side / std::tan(half_angle);

    Vector low = eye_, high = eye_;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) low = min(low, position(t, i)), high = max(high, position(t, i));
    radius_ = length(high - low) / 2;
    screen_.resize(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) project(i);
  }

  /// A corner lies outside of what the oracle projects: before the near plane or beyond the far plane.
  bool is_clipped() const { return clipped_; }
  /// Number of corners with a coordinate in doubt between two steps of 1/16 pixel.
  std::size_t doubtful_corners() const { return doubtful_corners_; }

  /// Returns whether the triangle covers the pixel. Exact.
  bool covers(std::size_t triangle, int x, int y) const {
    return screen_[triangle] && oracle::covers(*screen_[triangle], c_unit_bits, x, y, fault_);
  }

  /// Depth of the triangle's plane at the pixel's centre, in steps: 0 at the near plane, 2^24 - 1 at the far
  /// plane. The weights of the corners are exact.
  Real depth_steps(std::size_t triangle, int x, int y) const {
    const auto weight =
        barycentric(*screen_[triangle], centre(x, c_unit_bits), centre(y, c_unit_bits)).real();
    Real depth = 0;
    for (int i = 0; i < 3; ++i) depth += weight[i] * depth_of(position(triangle, i));
    return depth * c_last_depth + (has("depth_one_step_deeper") ? 1 : 0);
  }

  /// The point of a triangle at a pixel's centre.
  struct Surface {
    Vector position{}, normal{};
  };
  /// An attribute that is linear on the surface is linear on the screen after division by w. The weights on
  /// the surface are those on the screen times 1/w, scaled to the sum 1.
  Surface surface(std::size_t triangle, int x, int y) const {
    const ScreenTriangle& t = *screen_[triangle];
    const auto weight = barycentric(t, centre(x, c_unit_bits), centre(y, c_unit_bits)).real();
    std::array<Real, 3> share;
    Real sum = 0;
    for (int i = 0; i < 3; ++i) {
      share[i] = weight[i] * (has("linear_on_screen") ? 1 : t[i].inverse_w);
      sum += share[i];
    }
    const auto normal = [&](int corner) {
      return Vector(scene_.normals_world[scene_.triangles[triangle].normal[corner]]);
    };
    Surface s;
    for (int i = 0; i < 3; ++i) {
      s.position += (share[i] / sum) * position(triangle, i);
      s.normal += (share[i] / sum) * normal(i);
    }
    if (has("flat_normal")) s.normal = normal(0);
    if (!has("normal_not_unit")) s.normal = normalize(s.normal);
    return s;
  }

  /// Sets `doubtful` if a decision (a horizon, a shadow's edge) is in doubt.
  Vector radiance(std::size_t triangle, const Surface& surface, bool& doubtful) const {
    const auto reaches = [&](const Light& light, bool& in_doubt) {
      return !scene_.shadows || has("shadows_missing") ||
             !is_shadowed(triangle, surface.position, light, in_doubt);
    };
    return oracle::radiance(scene_, scene_.materials[scene_.triangles[triangle].material], surface.position,
                            surface.normal, reaches, fault_, doubtful);
  }

  struct Pixel {
    std::optional<std::size_t> triangle;  ///< the nearest
    Vector colour{};
    std::array<std::uint8_t, 3> byte{};
    std::array<bool, 3> doubtful{};  ///< rounding may give the next byte
  };
  // The radiance of the nearest triangle as a byte: 255 times the radiance, rounded, halves up.
  Pixel pixel(int x, int y) const {
    Pixel pixel{.triangle = std::nullopt, .colour = Vector(scene_.background)};
    Real nearest = 0;
    bool doubtful = false;
    for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
      if (!covers(i, x, y)) continue;
      const Real depth = depth_steps(i, x, y) * (has("last_of_depth") ? -1 : 1);
      if (pixel.triangle && std::abs(depth - nearest) < 1e-3L) doubtful = true;
      if (pixel.triangle && !(depth < nearest)) continue;
      pixel.triangle = i;
      nearest = depth;
    }
    if (pixel.triangle) pixel.colour = radiance(*pixel.triangle, surface(*pixel.triangle, x, y), doubtful);
    for (int i = 0; i < 3; ++i) {
      const Real steps =
          255 * std::clamp(pixel.colour[i], Real(0), Real(1)) + (has("truncated_to_byte") ? 0 : 0.5L);
      pixel.byte[i] = static_cast<std::uint8_t>(std::floor(steps));
      pixel.doubtful[i] = doubtful || std::abs(steps - std::round(steps)) < c_doubt;
    }
    return pixel;
  }

 private:
  static constexpr int c_unit_bits = 4;  // of a pixel
  static constexpr Real c_last_depth = 16777215;

  bool has(Fault fault) const { return fault_ == fault; }
  Vector position(std::size_t triangle, int corner) const {
    return Vector(scene_.positions_world[scene_.triangles[triangle].position[corner]]);
  }

  // Corners snap to the nearest 1/16 pixel, halves up. Corners are counter-clockwise seen from outside. A
  // triangle is visible if they are counter-clockwise on the screen.
  void project(std::size_t triangle) {
    ScreenTriangle corners;
    for (int i = 0; i < 3; ++i) {
      const Vector from_eye = position(triangle, i) - eye_;
      const Real w = dot(from_eye, forward_);
      if (!(w >= scene_.camera.near && w <= scene_.camera.far)) {
        clipped_ = true;
        return;
      }
      const Real x = Real(width_) / 2 + pixels_per_slope_ * dot(from_eye, right_) / w;
      const Real y = Real(height_) / 2 - pixels_per_slope_ * dot(from_eye, up_) / w;
      const Real half = has("snapped_down") ? 0 : 0.5L;
      const auto snapped = [&](Real pixels) {
        const Real steps = std::ldexp(pixels, c_unit_bits) + half;
        if (std::abs(steps - std::round(steps)) < c_doubt) ++doubtful_corners_;
        return static_cast<std::int64_t>(std::floor(steps));
      };
      corners[i] = {snapped(x), snapped(y), 1 / w};
    }
    const auto& [a, b, c] = corners;
    // Twice the area in a frame with y downwards: negative for counter-clockwise corners.
    const std::int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area < 0 || (has("back_faces_shown") && area != 0)) screen_[triangle] = corners;
  }

  // 1/w is linear on the screen, and so is depth = far/(far - near) (1 - near/w). Depth is 0 at the near
  // plane and 1 at the far plane.
  Real depth_of(const Vector& position) const {
    const Real w = dot(position - eye_, forward_), near = scene_.camera.near, far = scene_.camera.far;
    if (has("depth_of_distance")) return (w - near) / (far - near);
    return far / (far - near) * (1 - near / w);
  }

  // A light reaches a point if the point's triangle faces the light and no triangle that is averted from the
  // light lies between.
  bool is_shadowed(std::size_t triangle, const Vector& from, const Light& light, bool& doubtful) const {
    const bool far = light.is_far();
    const auto doubt = [&](Real margin) { doubtful |= std::abs(margin) < c_doubt; };
    // Sine of the angle by which the outside faces the light.
    const auto facing = [&](std::size_t t) {
      const Vector a = position(t, 0), normal = cross(position(t, 1) - a, position(t, 2) - a);
      const Vector way = far ? light.place : light.place - a;
      return dot(normal, way) / (length(normal) * length(way));
    };
    const Real own = facing(triangle);
    doubt(own);
    if (own < 0 && !has("averted_faces_lit")) return true;

    // The ray from + s way, with s from 0 to 1, or without an upper limit.
    const Vector way = far ? light.place : light.place - from;
    bool shadowed = false;
    for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
      if (t == triangle || (facing(t) < 0) == has("lit_faces_cast")) continue;
      const Vector a = position(t, 0), e1 = position(t, 1) - a, e2 = position(t, 2) - a;
      const Vector p = cross(way, e2);
      const Real determinant = dot(e1, p);
      if (determinant == 0) continue;
      const Vector to = from - a;
      const Vector q = cross(to, e1);
      const Real u = dot(to, p) / determinant, v = dot(way, q) / determinant, s = dot(e2, q) / determinant;
      // The margin by which the ray passes inside (above 0) or outside.
      const Real least = s * length(way) / radius_, most = far || has("shadows_beyond_light") ? 1 : 1 - s;
      const Real margin = std::min({u, v, 1 - u - v, least - c_doubt, most});
      // If two triangles share an edge, the start may lie on the other one. Such touching triangles do not
      // count.
      doubt(std::min({u, v, 1 - u - v, most}) > -c_doubt && std::abs(least) < 100 * c_doubt ? 0 : margin);
      shadowed |= margin > 0;
    }
    return shadowed;
  }

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
