// SPDX-License-Identifier: Apache-2.0
// The error bound of preset exact's shading processors: the range of colours that a pixel may have if every
// unit and every format has its stated error, in long double. Errors of vectors are converted to errors of
// colours by intervals. This includes the effect of a small error at the edge of a light, at a horizon or on
// the flank of a highlight.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "projection/project.hpp"
#include "projection/screen_triangle.hpp"
#include "scene/camera.hpp"
#include "scene/lights.hpp"
#include "scene/scene.hpp"
#include "setup/walk_header.hpp"
#include "shading/effects.hpp"
#include "specification/hard_cases/specification.hpp"

namespace halfway::stability {

/// A point of the screen in 1/32 pixels.
struct HalfUnits {
  Wide x, y;
  friend bool operator==(const HalfUnits&, const HalfUnits&) = default;
};

struct Interval {
  long double low, high;
  friend Interval operator+(Interval a, Interval b) { return {a.low + b.low, a.high + b.high}; }
  /// Both intervals must not be negative.
  friend Interval operator*(Interval a, Interval b) { return {a.low * b.low, a.high * b.high}; }
};
inline Interval about(long double value, long double error) {
  return {value - error, value + error};
}
inline Interval clamped(Interval i, long double low, long double high) {
  return {std::clamp(i.low, low, high), std::clamp(i.high, low, high)};
}

/// In colour steps, before the rounding to eight bits.
struct Promise {
  std::array<long double, 3> exact;  ///< by the illumination model, for values that the formats can represent
  std::array<Interval, 3> range;
  /// The greatest distance of an eight-bit colour from exact.
  long double bound(std::size_t c) const {
    return std::max(range[c].high - exact[c], exact[c] - range[c].low) + 0.5L;
  }
};

class ShadingBound {
 public:
  /// The scene must outlive it. The triangles' coordinates are in 1/16 of a pixel.
  ShadingBound(const Scene& scene, FrameSize frame) : scene_(scene), lights_(reflected_lights(scene)) {
    const double height = std::tan(0.5 * glm::radians(scene.camera.vertical_fov_degrees));
    // A power of two that is at least half of the largest possible scale.
    ray_scale_ = 0.5L / std::max({1.0, height, height * frame.width / frame.height});
    const ViewBasis basis = view_basis(scene.camera);
    const DepthRange range = Projector(scene, frame, {}).range();
    double nearest = range.far;
    for (const SceneTriangle& t : scene.triangles)
      for (const std::uint32_t corner : t.position)
        nearest = std::min(
            nearest, -glm::dot(basis.backward_world, scene.positions_world[corner] - scene.camera.eye_world));
    distance_scale_ = 0.5L * std::max(nearest, range.near);
  }

  const std::vector<LightRef>& lights() const { return lights_; }

  /// For the surface at the pixel's centre. lit(i): lights()[i] reaches it.
  template <class Lit>
  Promise at(const ScreenTriangle& t, std::int64_t x, std::int64_t y, Lit&& lit) const {
    const HalfUnits pixel{centre(x, c_bits), centre(y, c_bits)};
    return between(t, pixel, pixel, lit);
  }
  /// For the surface at `seen`, if the colour is computed at `shaded`: the errors of N, V and each L contain
  /// their changes from one point to the other.
  template <class Lit>
  Promise between(const ScreenTriangle& t, HalfUnits seen, HalfUnits shaded, Lit&& lit) const {
    const Material& m = scene_.materials[t.material];
    const Surface computed = surface_of(t, shaded);
    Surface surface = surface_of(t, seen);
    surface.normal_error = computed.normal_error + glm::length(computed.normal - surface.normal);
    surface.eye_error = computed.eye_error + glm::length(computed.to_eye - surface.to_eye);
    surface.w = computed.w;
    surface.computed_at = computed.position;
    Promise promise{};
    for (int c = 0; c < 3; ++c)
      add(promise, c, m.ambient * m.colour[c], scene_.ambient[c], 1.0L, {1.0L, 1.0L});
    for (std::size_t i = 0; i < lights_.size(); ++i)
      if (lit(i)) add_light(promise, m, surface, lights_[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      promise.exact[c] = std::min(promise.exact[c], c_white);
      promise.range[c] = clamped(promise.range[c], 0.0L, c_white);
    }
    return promise;
  }
  Promise at(const ScreenTriangle& t, std::int64_t x, std::int64_t y) const {
    return at(t, x, y, [](std::size_t) { return true; });
  }

 private:
  static constexpr long double c_white = 255.0L, c_root3 = 1.7320508075688772935L;
  // unit_vector.vhd: length and angle.
  static constexpr long double c_unit = 0x1.6ap-20L + 0x1.26p-21L;
  // A component of a direction, rounded to 2^-22, and a cosine.
  static constexpr long double c_direction = c_root3 * 0x1p-23L, c_cosine = 0x1p-23L;
  // A step of format vector, and the error of a plane's value that is cut to it (formats.hpp, plane_sum).
  static constexpr long double c_step = 0x1p-28L, c_plane = 0.9L * c_step;
  // Errors of a component of the offset to a light: last bit of its place, errors of distance and ray,
  // rounding of the product, bits dropped by the shift.
  static constexpr long double c_way = c_root3 * (2.0L * c_step + c_plane + 0.5L * c_step + c_plane + c_step);
  static constexpr long double c_nothing_known = 2.0L;  // greatest possible error of a unit vector

  struct Surface {
    LongVec position, normal, to_eye;  // to_eye is unit
    LongVec computed_at;               // position for which the hardware computes L
    long double normal_error, eye_error, w;
  };

  Surface surface_of(const ScreenTriangle& t, HalfUnits point) const {
    const ExactSurface s = exact_surface(t, point.x, point.y);
    Surface out{};
    out.position = s.position_world;
    const auto weight = barycentric(screen_points(t), point.x, point.y).real();
    long double inverse_w = 0.0L, most = 0.0L;
    for (std::size_t i = 0; i < 3; ++i) {
      inverse_w += weight[i] * (long double)t.vertex[i].inverse_w;
      most =
          std::max(most, (long double)t.vertex[i].inverse_w * glm::length(LongVec(t.vertex[i].normal_world)));
    }
    out.w = 1.0L / inverse_w;
    const auto& corner = scene_.triangles[t.source];
    const bool flat = scene_.normals_world[corner.normal[0]] == scene_.normals_world[corner.normal[1]] &&
                      scene_.normals_world[corner.normal[0]] == scene_.normals_world[corner.normal[2]];
    const long double length = glm::length(s.normal_world);
    if (length > 0.0L) {
      out.normal = s.normal_world / length;
      // The normals are scaled so that the largest component at a vertex is 1/2 to 1.
      out.normal_error =
          std::min(c_unit + c_root3 * c_plane * 2.0L * most / (length * inverse_w), c_nothing_known);
    } else {
      const LongVec a(scene_.positions_world[corner.position[0]]),
          b(scene_.positions_world[corner.position[1]]), c(scene_.positions_world[corner.position[2]]);
      out.normal = glm::normalize(glm::cross(b - a, c - a));
      out.normal_error = flat ? c_unit : c_nothing_known;
    }
    const LongVec to_eye = LongVec(scene_.camera.eye_world) - s.position_world;
    out.to_eye = glm::normalize(to_eye);
    out.eye_error = c_unit + c_root3 * c_plane / ray_scale_;
    return out;
  }

  void add_light(Promise& promise, const Material& m, const Surface& s, LightRef ref) const {
    const Light light = light_of(scene_, ref);
    const LongVec in(light.intensity);
    LongVec to_light(0.0L);
    long double light_error = c_direction;
    if (light.point.w == 0.0) {
      to_light = LongVec(light.point.xyz_world);
    } else {
      const LongVec place(light.point.xyz_world);
      const LongVec way = place - s.computed_at;
      const long double distance = glm::length(way),
                        from_eye = glm::length(place - LongVec(scene_.camera.eye_world));
      const auto direction = [](const LongVec& v) {
        const long double length = glm::length(v);
        return length > 0.0L ? v / length : LongVec(0.0L);
      };
      to_light = direction(place - s.position);
      const long double scale = std::min(ray_scale_, distance_scale_ / (2.0L * from_eye)) / s.w;
      light_error =
          distance > 0.0L ? std::min(c_unit + c_way / (scale * distance), c_nothing_known) : c_nothing_known;
      light_error += glm::length(direction(way) - to_light);
    }
    const long double n_dot_l = glm::dot(s.normal, to_light);
    const Interval lambert = about(n_dot_l, s.normal_error + light_error + c_cosine);
    long double share = 1.0L;
    Interval share_range{1.0L, 1.0L};
    if (light.cone)
      share_of(*light.cone, -glm::dot(to_light, LongVec(light.cone->axis_world)), light_error + c_direction,
               share, share_range);
    const Interval diffuse_range =
        clamped(clamped(lambert, 0.0L, 1.0L) + Interval{-c_half_weight, c_half_weight}, 0.0L, 1.0L);
    const LongVec half = to_light + s.to_eye;
    const long double half_length = glm::length(half);
    const long double n_dot_h = half_length > 0.0L ? glm::dot(s.normal, half) / half_length : 0.0L;
    const long double m_held = std::min((long double)m.exponent, c_most_exponent);
    const bool faces = n_dot_l > 0.0L;
    const long double highlight = faces && n_dot_h > 0.0L ? std::pow(std::min(n_dot_h, 1.0L), m_held) : 0.0L;
    const Interval highlight_range =
        highlight_of(n_dot_h, half_length, light_error + s.eye_error, s.normal_error, lambert, m_held);
    for (int c = 0; c < 3; ++c) {
      if (has_diffuse(m))
        add(promise, c, m.diffuse * m.colour[c], in[c], faces ? share * std::min(n_dot_l, 1.0L) : 0.0L,
            coned(diffuse_range, share_range));
      if (has_specular(m))
        add(promise, c, m.specular * m.specular_colour[c], in[c], share * highlight,
            coned(highlight_range, share_range));
    }
  }

  static Interval coned(Interval weight, Interval share) {
    return clamped(weight * share + Interval{-2.0L * c_half_weight, 0.0L}, 0.0L, 1.0L);
  }

  Interval highlight_of(long double n_dot_h, long double half_length, long double half_error,
                        long double normal_error, Interval lambert, long double exponent) const {
    if (lambert.high <= 0.0L) return {0.0L, 0.0L};
    // The direction of a sum whose error is below half of its length.
    const long double turned =
        half_length > 2.0L * half_error ? 1.2L * half_error / half_length + c_unit : c_nothing_known;
    const Interval cosine = clamped(about(n_dot_h, normal_error + turned + c_cosine), 0.0L, 1.0L);
    // The bound of power.vhd. An exponent is rounded to 2^-8.
    const long double power_error = 0x1p-15L + exponent * 0x1p-23L;
    Interval range = clamped({std::pow(cosine.low, exponent + 0x1p-9L) - power_error,
                              std::pow(cosine.high, std::max(exponent - 0x1p-9L, 0.0L)) + power_error},
                             0.0L, 1.0L);
    if (lambert.low <= 0.0L) range.low = 0.0L;
    return range;
  }

  // spot_cone.vhd: t^2 (3 - 2 t), with an error of 3.5 2^-16, and more for the steepest slopes. The
  // reciprocal of the width is rounded to 2^-6 and clamped to 2^18.
  static void share_of(const LightCone& spot, long double cosine, long double error, long double& share,
                       Interval& range) {
    const auto smooth = [](long double t) {
      t = std::clamp(t, 0.0L, 1.0L);
      return t * t * (3.0L - 2.0L * t);
    };
    const long double width = (long double)spot.cos_inner - (long double)spot.cos_outer;
    const long double over = cosine - (long double)spot.cos_outer;
    const Interval near = about(over, error + c_cosine);
    constexpr long double c_steepest = 0x1p18L;
    if (cosine >= spot.cos_inner)
      share = 1.0L;
    else
      share = width > 0.0L ? smooth(over / width) : 0.0L;
    const long double slope = width > 0.0L ? std::min(1.0L / width, c_steepest) : c_steepest;
    const long double cubic = 3.5L * 0x1p-16L + 1.5L * 0x1p-28L * slope;
    range.low = near.low > 0.0L ? smooth(near.low * (slope - 0x1p-7L)) - cubic : 0.0L;
    range.high = near.high > 0.0L
                     ? (width > 0.0L ? smooth(near.high * (1.0L / width + 0x1p-7L)) : 1.0L) + cubic
                     : 0.0L;
    range = clamped(range, 0.0L, 1.0L);
  }

  // k I weight, in colour steps: k in 2^-16, I in 2^-4, k I in 2^-8, and the term is cut to 2^-12.
  static void add(Promise& promise, int channel, long double k, long double in, long double weight,
                  Interval weight_range) {
    const auto c = static_cast<std::size_t>(channel);
    const long double k_held = std::min(k, c_most_k), in_held = std::min(c_white * in, c_most_intensity);
    promise.exact[c] += std::min(k_held * in_held, c_most_reflected) * weight;
    Interval reflected = clamped(about(k_held, 0x1p-17L), 0.0L, c_most_k) *
                             clamped(about(in_held, 0x1p-5L), 0.0L, c_most_intensity) +
                         Interval{-0x1p-9L, 0x1p-9L};
    reflected = clamped(reflected, 0.0L, c_most_reflected);
    const Interval term = reflected * weight_range;
    promise.range[c].low += std::max(term.low - 0x1p-12L, 0.0L);
    promise.range[c].high += term.high;
  }

  static constexpr long double c_half_weight = 0x1p-17L, c_most_exponent = 0x1p13L - 0x1p-8L,
                               c_most_k = 16.0L - 0x1p-16L, c_most_intensity = 0x1p14L - 0x1p-4L,
                               c_most_reflected = 0x1p14L - 0x1p-8L;

  const Scene& scene_;
  static constexpr int c_bits = 4;  ///< below a pixel
  std::vector<LightRef> lights_;
  long double ray_scale_ = 0.5L, distance_scale_ = 1.0L;
};

}  // namespace halfway::stability
