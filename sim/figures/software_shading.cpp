// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/software_shading.hpp"

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "projection/edge.hpp"
#include "projection/project.hpp"
#include "shading/shade.hpp"
#include "sim/figures/six_point_fit.hpp"
#include "sim/os/seconds.hpp"

namespace halfway::figures {
namespace {

constexpr int c_subpixel_bits = 4;

/// A value that is linear on the screen: its value at a pixel's centre and its step to the right.
template <class Value>
struct Plane {
  Value origin, dx, dy;

  Plane(const std::array<Value, 3>& at, glm::dvec2 p1, glm::dvec2 p2, glm::dvec2 p3) {
    const glm::dvec2 a = p2 - p1, b = p3 - p1;
    const double inverse = 1.0 / (a.x * b.y - a.y * b.x);
    const Value d2 = at[1] - at[0], d3 = at[2] - at[0];
    dx = (d2 * b.y - d3 * a.y) * inverse;
    dy = (d3 * a.x - d2 * b.x) * inverse;
    origin = at[0] - dx * p1.x - dy * p1.y;
  }
  Value at(double x, double y) const { return origin + dx * x + dy * y; }
};

class Renderer {
 public:
  Renderer(const Scene& scene, FrameSize size)
      : scene_(scene), frame_(size), depth_(Frame::pixels(size), 1.0) {
    for (std::size_t i = 0; i < frame_.pixels(); ++i) write(i, scene.background);
  }

  void draw(const ScreenTriangle& t, SoftwareShading shading) {
    std::array<glm::dvec2, 3> p;
    for (int i = 0; i < 3; ++i)
      p[i] = glm::dvec2(t.vertex[i].x, t.vertex[i].y) / double(1 << c_subpixel_bits);
    const Plane<double> depth({t.vertex[0].z, t.vertex[1].z, t.vertex[2].z}, p[0], p[1], p[2]);
    switch (shading) {
      case SoftwareShading::gouraud:
        draw_gouraud(t, p, depth);
        break;
      case SoftwareShading::quadratic:
        draw_quadratic(t, p, depth);
        break;
      case SoftwareShading::phong:
        draw_phong(t, p, depth);
        break;
    }
  }

  Frame take() { return std::move(frame_); }

 private:
  using Points = std::array<glm::dvec2, 3>;

  glm::dvec3 shaded(const ScreenTriangle& t, glm::dvec3 weights) const {
    const SurfacePoint point = surface_point(t, weights);
    return radiance(scene_, scene_.materials[t.material], point.position_world, point.normal_world);
  }

  void write(std::size_t pixel, const glm::dvec3& colour) {
    for (int c = 0; c < 3; ++c) frame_.rgb[3 * pixel + c] = to_byte(colour[c]);
  }

  // Call begin(x, y) at a line's first pixel, then colour() for each pixel and step() to move to the next.
  template <class Begin, class Colour, class Step>
  void walk(const ScreenTriangle& t, const Plane<double>& depth, const Begin& begin, const Colour& colour,
            const Step& step) {
    std::array<ScreenPoint, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = {t.vertex[i].x, t.vertex[i].y};
    for_each_span(corners, c_subpixel_bits, frame_.size,
                  [&](std::uint32_t y, std::uint32_t from, std::uint32_t to) {
                    double z = depth.at(from + 0.5, y + 0.5);
                    begin(from + 0.5, y + 0.5);
                    std::size_t pixel = std::size_t{y} * frame_.size.width + from;
                    for (std::uint32_t x = from; x < to; ++x, ++pixel, z += depth.dx, step())
                      if (z < depth_[pixel]) {
                        depth_[pixel] = z;
                        write(pixel, colour());
                      }
                  });
  }

  void draw_gouraud(const ScreenTriangle& t, const Points& p, const Plane<double>& depth) {
    const Plane<glm::dvec3> plane({shaded(t, {1, 0, 0}), shaded(t, {0, 1, 0}), shaded(t, {0, 0, 1})}, p[0],
                                  p[1], p[2]);
    glm::dvec3 value;
    walk(
        t, depth, [&](double x, double y) { value = plane.at(x, y); }, [&] { return value; },
        [&] { value += plane.dx; });
  }

  void draw_quadratic(const ScreenTriangle& t, const Points& p, const Plane<double>& depth) {
    const glm::dvec3 i1 = shaded(t, {1, 0, 0}), i2 = shaded(t, {0, 1, 0}), i3 = shaded(t, {0, 0, 1}),
                     i12 = shaded(t, {0.5, 0.5, 0}), i13 = shaded(t, {0.5, 0, 0.5}),
                     i23 = shaded(t, {0, 0.5, 0.5});
    const QuadraticCoefficients<glm::dvec3> q =
        fit_six_points(p[1].x - p[0].x, p[1].y - p[0].y, p[2].x - p[0].x, p[2].y - p[0].y,
                       std::array{i1, i2, i3, i12, i13, i23});
    glm::dvec3 value, dx;
    const glm::dvec3 dxx = 2.0 * q.t5;
    walk(
        t, depth,
        [&](double x_screen, double y_screen) {
          const double x = x_screen - p[0].x, y = y_screen - p[0].y;
          value = q.at(x, y);
          dx = q.t5 * (2.0 * x + 1.0) + q.t4 * y + q.t2;
        },
        [&] { return value; }, [&] { value += dx, dx += dxx; });
  }

  void draw_phong(const ScreenTriangle& t, const Points& p, const Plane<double>& depth) {
    const auto& [a, b, c] = t.vertex;
    const Plane<glm::dvec3> normals({a.normal_world, b.normal_world, c.normal_world}, p[0], p[1], p[2]);
    const Plane<glm::dvec3> positions({a.position_world, b.position_world, c.position_world}, p[0], p[1],
                                      p[2]);
    glm::dvec3 normal, position;
    const Material& material = scene_.materials[t.material];
    walk(
        t, depth, [&](double x, double y) { normal = normals.at(x, y), position = positions.at(x, y); },
        [&] { return radiance(scene_, material, position, glm::normalize(normal)); },
        [&] { normal += normals.dx, position += positions.dx; });
  }

  const Scene& scene_;
  Frame frame_;
  std::vector<double> depth_;
};

}  // namespace

SoftwareFrame shade_in_software(const Scene& scene, std::span<const ScreenTriangle> triangles, FrameSize size,
                                SoftwareShading shading) {
  Renderer renderer(scene, size);
  const double begin = thread_seconds();
  for (const ScreenTriangle& triangle : triangles) renderer.draw(triangle, shading);
  const double seconds = thread_seconds() - begin;
  return {renderer.take(), seconds};
}

}  // namespace halfway::figures
