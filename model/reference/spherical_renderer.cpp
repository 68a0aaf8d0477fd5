// SPDX-License-Identifier: Apache-2.0
#include "reference/spherical_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "projection/edge.hpp"
#include "projection/project.hpp"
#include "reference/visible_pixels.hpp"
#include "scene/lights.hpp"
#include "shading/arc.hpp"
#include "shading/bell.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

/// Vectors of one light at a point of the surface. An undefined vector is zero.
struct LightVectors {
  glm::dvec3 to_light;
  glm::dvec3 u, v;  ///< the highlight is (u.v)^n
  double spot;
};

struct PointVectors {
  glm::dvec3 normal, to_eye;
  std::vector<LightVectors> lights;  ///< directional, positional, spot
};

void take_vectors(const Scene& scene, const Material& material, const SurfacePoint& point,
                  PointVectors& out) {
  out.normal = point.normal_world;
  out.to_eye = direction(point.position_world, scene.camera.eye_world);
  if (out.to_eye == glm::dvec3(0.0)) out.to_eye = out.normal;
  out.lights.clear();
  const auto add = [&](glm::dvec3 to_light, double spot) {
    LightVectors light{to_light, out.normal, glm::dvec3(0.0), spot};
    if (material.brdf == Brdf::phong) {
      light.u = 2.0 * glm::dot(out.normal, to_light) * out.normal - to_light;
      light.v = out.to_eye;
    } else {
      const glm::dvec3 sum = to_light + out.to_eye;
      if (const double length = glm::length(sum); length > 0.0) light.v = sum / length;
    }
    out.lights.push_back(light);
  };
  for_each_light(scene, [&](const Light& light) {
    const glm::dvec3 to_light = direction_to(light, point.position_world);
    add(to_light, cone_share(light, to_light));
  });
}

double mix(double a, double b, double t) {
  return a + t * (b - a);
}

void slerp_vectors(const PointVectors& a, const PointVectors& b, double t, PointVectors& out) {
  out.normal = slerp(a.normal, b.normal, t);
  out.to_eye = slerp(a.to_eye, b.to_eye, t);
  out.lights.clear();
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    const LightVectors &p = a.lights[i], &q = b.lights[i];
    out.lights.push_back(
        {slerp(p.to_light, q.to_light, t), slerp(p.u, q.u, t), slerp(p.v, q.v, t), mix(p.spot, q.spot, t)});
  }
}

/// Two vectors that turn along a span.
struct TurningPair {
  glm::dvec3 u1, u2, v1, v2;
  CosineArc arc;

  TurningPair(glm::dvec3 u_begin, glm::dvec3 u_end, glm::dvec3 v_begin, glm::dvec3 v_end)
      : u1(u_begin), u2(u_end), v1(v_begin), v2(v_end), arc(cosine_arc(u1, u2, v1, v2)) {}

  double cosine(VectorScheme scheme, double t) const {
    return scheme == VectorScheme::one_fixed ? arc.at(t) : glm::dot(slerp(u1, u2, t), slerp(v1, v2, t));
  }
};

/// The bell that approximates cos^n, at an angle.
double squared_cosine(double angle, double scale) {
  const double x = scale * std::abs(angle);
  if (!(x < std::numbers::pi / 2)) return 0.0;
  const double cosine = std::cos(x);
  return cosine * cosine;
}

class SphericalShader {
 public:
  SphericalShader(const Scene& scene, std::span<const ScreenTriangle> triangles, const RenderOptions& options,
                  const SphericalMethod& method, std::span<const double> scales)
      : scene_(scene),
        triangles_(triangles),
        options_(options),
        method_(method),
        scales_(scales),
        lights_(lights_of(scene)) {}

  glm::dvec3 operator()(std::uint32_t index, std::uint32_t x, std::uint32_t y) {
    if (index != index_ || y != y_) {
      if (index != index_) begin_triangle(index);
      begin_line(y);
    }
    const double t = std::clamp((x + 0.5 - x_begin_) / length_, 0.0, 1.0);
    const ScreenTriangle& triangle = triangles_[index];
    const Material& material = scene_.materials[triangle.material];
    const SurfaceColours colours(material);

    glm::dvec3 sum = ambient_radiance(scene_, material);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const double spot = mix(begin_.lights[i].spot, end_.lights[i].spot, t);
      sum += spot * lights_[i].intensity *
             reflected(
                 lights_[i].ref.kind, colours, diffuse_[i].cosine(method_.vectors, t), [] { return true; },
                 [&] { return specular(triangle, i, t); });
    }
    return sum;
  }

 private:
  void begin_triangle(std::uint32_t index) {
    index_ = index;
    if (method_.ends == SpanEnds::on_surface) return;
    const ScreenTriangle& triangle = triangles_[index];
    for (std::size_t i = 0; i < 3; ++i)
      take_vectors(scene_, scene_.materials[triangle.material],
                   surface_point(triangle, barycentric_at_vertex(i)), vertex_[i]);
  }

  void begin_line(std::uint32_t y) {
    y_ = y;
    if (method_.ends == SpanEnds::on_surface)
      ends_on_surface();
    else
      ends_along_edges();
    diffuse_.clear();
    specular_.clear();
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const LightVectors &a = begin_.lights[i], &b = end_.lights[i];
      diffuse_.emplace_back(begin_.normal, end_.normal, a.to_light, b.to_light);
      specular_.emplace_back(a.u, b.u, a.v, b.v);
    }
  }

  void ends_on_surface() {
    const ScreenTriangle& triangle = triangles_[index_];
    const std::int32_t shift = static_cast<std::int32_t>(y_) << options_.subpixel_bits;
    std::array<ScreenPoint, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = {triangle.vertex[i].x, triangle.vertex[i].y - shift};
    std::uint32_t first = 0, last = 0;
    for_each_span(corners, options_.subpixel_bits, {options_.frame.width, 1},
                  [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
                    first = begin;
                    last = end - 1;
                  });
    const auto take = [&](std::uint32_t x, PointVectors& out) {
      take_vectors(scene_, scene_.materials[triangle.material],
                   surface_point(triangle, barycentric_at_centre(triangle, options_.subpixel_bits, x, y_)),
                   out);
    };
    take(first, begin_);
    take(last, end_);
    x_begin_ = first + 0.5;
    length_ = std::max(1u, last - first);
  }

  void ends_along_edges() {
    const ScreenTriangle& triangle = triangles_[index_];
    std::array<int, 3> down{0, 1, 2};
    std::sort(down.begin(), down.end(),
              [&](int a, int b) { return triangle.vertex[a].y < triangle.vertex[b].y; });
    const std::int64_t middle = first_line(triangle.vertex[down[1]].y, options_.subpixel_bits);
    const double unit = 1 << options_.subpixel_bits, centre = (y_ + 0.5) * unit;
    const auto cross = [&](int top, int bottom, PointVectors& out) {
      const ScreenVertex &a = triangle.vertex[top], &b = triangle.vertex[bottom];
      const double t = (centre - a.y) / (b.y - a.y);
      slerp_vectors(vertex_[top], vertex_[bottom], t, out);
      return mix(a.x, b.x, t) / unit;
    };
    // The span starts at the long edge, in either direction. The result is the same from the other end.
    x_begin_ = cross(down[0], down[2], begin_);
    const double x_end = y_ < middle ? cross(down[0], down[1], end_) : cross(down[1], down[2], end_);
    length_ = x_end - x_begin_;
  }

  double specular(const ScreenTriangle& triangle, std::size_t light, double t) const {
    const Material& material = scene_.materials[triangle.material];
    if (material.brdf == Brdf::cook_torrance)
      return specular_factor(material, slerp(begin_.normal, end_.normal, t),
                             slerp(begin_.lights[light].to_light, end_.lights[light].to_light, t),
                             slerp(begin_.to_eye, end_.to_eye, t));
    const TurningPair& pair = specular_[light];
    if (method_.curve == HighlightCurve::power)
      return highlight_power(pair.cosine(method_.vectors, t), material.exponent);
    const double scale = scales_[triangle.material];
    if (method_.vectors == VectorScheme::one_fixed)
      return highlight_power(pair.arc.amplitude, material.exponent) *
             squared_cosine(t * pair.arc.sweep - pair.arc.phase, scale);
    return squared_cosine(std::acos(std::clamp(pair.cosine(method_.vectors, t), -1.0, 1.0)), scale);
  }

  const Scene& scene_;
  std::span<const ScreenTriangle> triangles_;
  const RenderOptions& options_;
  const SphericalMethod& method_;
  std::span<const double> scales_;  ///< published_scale of each material
  std::vector<Light> lights_;

  // For the triangle and line of the last call.
  std::uint32_t index_ = std::numeric_limits<std::uint32_t>::max(), y_ = 0;
  std::array<PointVectors, 3> vertex_;
  PointVectors begin_, end_;
  double x_begin_ = 0.0, length_ = 1.0;  ///< in pixels; negative for a span to the left
  std::vector<TurningPair> diffuse_, specular_;
};

}  // namespace

ReferenceImage render_spherical(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                const RenderOptions& options, const SphericalMethod& method) {
  std::vector<double> scales;
  if (method.curve == HighlightCurve::squared_cosine)
    for (const Material& material : scene.materials) scales.push_back(published_scale(material.exponent));
  return render_visible(scene, triangles, options,
                        [&] { return SphericalShader(scene, triangles, options, method, scales); });
}

}  // namespace halfway
