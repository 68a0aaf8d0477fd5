// SPDX-License-Identifier: Apache-2.0
// For tests: the vectors along a span of pixels by the papers' formulas, in long double and independent of
// the setup.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "projection/project.hpp"
#include "scene/lights.hpp"
#include "setup/test/pixels.hpp"
#include "shading/effects.hpp"

namespace halfway::paper {

using Real = long double;
inline constexpr Real c_pi = std::numbers::pi_v<Real>;
using Vector = glm::vec<3, Real>;

inline Vector slerp_of(Vector a, Vector b, Real t) {
  const Real angle = 2 * std::atan2(glm::length(b - a), glm::length(b + a));
  if (angle < 1e-9L) return glm::normalize(a + t * (b - a));
  return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

struct LightThere {
  Vector l, u, v;
  Real spot;
};
struct There {
  Vector normal, to_eye;
  std::vector<LightThere> light;  ///< in the order of shining_lights
  Real doubt = 0;                 ///< error of the directions in double, radians
};

inline There vectors_there(const Scene& scene, const Material& material, const SurfacePoint& point) {
  const Vector p(point.position_world), n(point.normal_world);
  const Vector to_eye = glm::normalize(Vector(scene.camera.eye_world) - p);
  There out;
  out.normal = n;
  out.to_eye = to_eye;
  const auto add = [&](Vector l, Real spot) {
    const Vector sum = l + to_eye;
    // A few roundings. The error of H is inversely proportional to |L + V|.
    out.doubt = std::max(out.doubt, 4e-15L / std::min<Real>(1, glm::length(sum)));
    if (material.brdf == Brdf::phong)
      out.light.push_back({l, 2 * glm::dot(n, l) * n - l, to_eye, spot});
    else
      out.light.push_back({l, n, glm::normalize(sum), spot});
  };
  for (const LightRef ref : shining_lights(scene)) switch (ref.kind) {
      case LightKind::directional:
        add(Vector(scene.directional[ref.index].to_light_world), 1);
        break;
      case LightKind::positional:
        add(glm::normalize(Vector(scene.positional[ref.index].position_world) - p), 1);
        break;
      case LightKind::spot: {
        const SpotLight& s = scene.spots[ref.index];
        const Vector l = glm::normalize(Vector(s.position_world) - p);
        const Real across = Real{s.cos_inner} - s.cos_outer;
        const Real t = std::clamp<Real>((-glm::dot(l, Vector(s.axis_world)) - s.cos_outer) / across, 0, 1);
        add(l, t * t * (3 - 2 * t));
        break;
      }
    }
  return out;
}

inline There slerped(const There& a, const There& b, Real t) {
  There out;
  out.normal = slerp_of(a.normal, b.normal, t);
  out.to_eye = slerp_of(a.to_eye, b.to_eye, t);
  out.doubt = std::max(a.doubt, b.doubt);
  for (std::size_t i = 0; i < a.light.size(); ++i) {
    const LightThere &p = a.light[i], &q = b.light[i];
    out.light.push_back({slerp_of(p.l, q.l, t), slerp_of(p.u, q.u, t), slerp_of(p.v, q.v, t),
                         p.spot + t * (q.spot - p.spot)});
  }
  return out;
}

// The ends of a span. Its first pixel is at t = first; each further pixel is one `step` ahead.
struct SpanThere {
  There begin, end;
  Real first = 0, step = 0;
  Real doubt = 0;  ///< of t
};

inline SurfacePoint pixel_point(const ScreenTriangle& t, std::int64_t x, std::int64_t y) {
  return surface_point(t, barycentric_at_centre(t, c_subpixel_bits, x, y));
}

// First and last pixel in drawing order.
struct Span {
  std::int64_t first, last, y;
  bool upper_half = false;  ///< preset published
  int steps() const { return static_cast<int>(std::abs(last - first)); }
  int way() const { return first <= last ? 1 : -1; }
};

class Ends {
 public:
  Ends(const Scene& scene, const Material& material, const ScreenTriangle& triangle)
      : scene_(scene), material_(material), t_(triangle) {
    for (std::size_t i = 0; i < 3; ++i)
      vertex_[i] = vectors_there(scene, material, surface_point(triangle, barycentric_at_vertex(i)));
    std::ranges::sort(down_, [&](std::size_t a, std::size_t b) { return t_.vertex[a].y < t_.vertex[b].y; });
  }
  SpanThere on_surface(const Span& s) const {
    SpanThere span{vectors_there(scene_, material_, pixel_point(t_, s.first, s.y)),
                   vectors_there(scene_, material_, pixel_point(t_, s.last, s.y))};
    if (s.steps() > 0) span.step = Real{1} / s.steps();
    return span;
  }
  SpanThere along_edges(const Span& s) const {
    struct Crossing {
      Real x;
      There there;
    };
    std::vector<Crossing> crossing;
    const Real unit = 1 << c_subpixel_bits, centre = (s.y + 0.5L) * unit;
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {0, 2}}) {
      const std::size_t top = down_[i], bottom = down_[j];
      const ScreenVertex &a = t_.vertex[top], &b = t_.vertex[bottom];
      if (a.y == b.y || centre < a.y || centre > b.y) continue;
      const Real t = (centre - a.y) / (b.y - a.y);
      crossing.push_back({(a.x + t * (b.x - a.x)) / unit, slerped(vertex_[top], vertex_[bottom], t)});
    }
    auto [from, to] = std::ranges::minmax_element(crossing, {}, &Crossing::x);
    if (s.way() < 0) std::swap(from, to);
    const Real length = to->x - from->x;
    return {from->there, to->there, (s.first + 0.5L - from->x) / length, s.way() / length,
            4e-12L / std::fabs(length)};
  }
  // A line is at y of whole pixels. The span's ends lie on the edges.
  SpanThere published(const Span& s) const {
    const auto at = [&](std::size_t top, std::size_t bottom) {
      const Real t = Real(s.y - t_.vertex[top].y) / (t_.vertex[bottom].y - t_.vertex[top].y);
      return slerped(vertex_[top], vertex_[bottom], t);
    };
    There of_long = at(down_[0], down_[2]),
          of_short = s.upper_half ? at(down_[0], down_[1]) : at(down_[1], down_[2]);
    const ScreenVertex &a = t_.vertex[down_[0]], &b = t_.vertex[down_[1]], &c = t_.vertex[down_[2]];
    const bool middle_is_right =
        std::int64_t{b.x - a.x} * (c.y - a.y) > std::int64_t{c.x - a.x} * (b.y - a.y);
    SpanThere span{of_long, of_short};
    if (!middle_is_right) std::swap(span.begin, span.end);
    if (s.steps() == 0)
      span.end = span.begin;
    else
      span.step = Real{1} / s.steps();
    return span;
  }
  /// True if the lines from y on are those above the middle vertex.
  bool upper_half(std::int64_t y) const {
    return y == t_.vertex[down_[0]].y && t_.vertex[down_[0]].y != t_.vertex[down_[1]].y;
  }

 private:
  const Scene& scene_;
  const Material& material_;
  const ScreenTriangle& t_;
  std::array<There, 3> vertex_;
  std::array<std::size_t, 3> down_ = {0, 1, 2};
};

}  // namespace halfway::paper
