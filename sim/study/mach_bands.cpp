// SPDX-License-Identifier: Apache-2.0
#include "sim/study/mach_bands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <utility>

#include "reference/visible_pixels.hpp"

namespace halfway::study {
namespace {

constexpr int c_subpixel_bits = 4;
constexpr double c_reach = 4.0;         // pixels from the edge
constexpr double c_least_length = 4.0;  // pixels; a shorter edge has too few pixels next to it
constexpr double c_end = 0.1;       // part of the edge's length ignored at either end, close to other edges
constexpr int c_least_pixels = 12;  // on each side
// Determinant limit of the fit's matrix, per pixel. Below it, the pixels are nearly collinear.
constexpr double c_least_spread = 0.05;
constexpr std::uint32_t c_nothing = std::numeric_limits<std::uint32_t>::max();

// The visible pixels of each scene triangle.
std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> seen_pixels(
    const Scene& scene, std::span<const ScreenTriangle> triangles, FrameSize size) {
  std::vector<std::uint32_t> owner(Frame::pixels(size), c_nothing);
  render_visible(scene, triangles, {.frame = size, .subpixel_bits = c_subpixel_bits}, [&] {
    return [&](std::uint32_t index, std::uint32_t x, std::uint32_t y) {
      owner[std::size_t{y} * size.width + x] = triangles[index].source;
      return glm::dvec3(0.0);
    };
  });
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> pixels(scene.triangles.size());
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x)
      if (const std::uint32_t source = owner[std::size_t{y} * size.width + x]; source != c_nothing)
        pixels[source].emplace_back(x, y);
  return pixels;
}

// Least-squares fit of brightness = a + b distance + c along, for two frames at once.
struct Fit {
  int count = 0;
  glm::dmat3 matrix{0.0};
  glm::dvec3 frame{0.0}, reference{0.0};

  void add(double distance, double along, double in_frame, double in_reference) {
    const glm::dvec3 basis{1.0, distance, along};
    ++count;
    matrix += glm::outerProduct(basis, basis);
    frame += in_frame * basis;
    reference += in_reference * basis;
  }
  // b of the frame and of the reference; std::nullopt if the fit is underdetermined.
  std::optional<glm::dvec2> slopes() const {
    if (count < c_least_pixels) return std::nullopt;
    const double n = count;
    const double spread = glm::determinant(matrix) / (n * n * n);
    if (!(spread > c_least_spread)) return std::nullopt;
    const glm::dmat3 inverse = glm::inverse(matrix);
    return glm::dvec2{(inverse * frame).y, (inverse * reference).y};
  }
};

double brightness(const Frame& frame, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* pixel = &frame.rgb[frame.offset(x, y)];
  return (double{1} * pixel[0] + pixel[1] + pixel[2]) / 3.0;
}

// The common edge of two triangles, by the scene's indices.
struct Corner {
  std::uint32_t position, normal;
  auto operator<=>(const Corner&) const = default;
};
using MeshEdge = std::pair<Corner, Corner>;

struct Sides {
  glm::dvec2 begin{0.0}, end{0.0};  ///< pixels
  std::vector<std::uint32_t> triangles;
};

glm::dvec2 on_screen(const ScreenVertex& v) {
  return glm::dvec2(v.x, v.y) / static_cast<double>(1 << c_subpixel_bits);
}

// Edges between triangles that are not clipped. Both triangles must have the same normals at the edge's
// corners. Otherwise the surface has a crease there, and a jump in brightness is intended.
std::map<MeshEdge, Sides> shared_edges(const Scene& scene, std::span<const ScreenTriangle> triangles) {
  std::map<MeshEdge, Sides> edges;
  for (const ScreenTriangle& t : triangles) {
    const SceneTriangle& source = scene.triangles[t.source];
    std::array<std::optional<glm::dvec2>, 3> corners;
    for (int i = 0; i < 3; ++i)
      for (const ScreenVertex& v : t.vertex)
        if (v.position_world == scene.positions_world[source.position[i]]) corners[i] = on_screen(v);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if (!corners[i] || !corners[j]) continue;
      Corner a{source.position[i], source.normal[i]}, b{source.position[j], source.normal[j]};
      glm::dvec2 begin = *corners[i], end = *corners[j];
      if (b < a) {
        std::swap(a, b);
        std::swap(begin, end);
      }
      Sides& sides = edges[{a, b}];
      sides.begin = begin;
      sides.end = end;
      sides.triangles.push_back(t.source);
    }
  }
  return edges;
}

}  // namespace

MachBands mach_bands(const Frame& frame, const Frame& reference, const Scene& scene,
                     std::span<const ScreenTriangle> triangles) {
  const auto pixels = seen_pixels(scene, triangles, frame.size);
  MachBands bands;
  double squares = 0.0;
  for (const auto& [edge, sides] : shared_edges(scene, triangles)) {
    const double length = glm::distance(sides.begin, sides.end);
    if (sides.triangles.size() != 2 || length < c_least_length) continue;
    const glm::dvec2 along = (sides.end - sides.begin) / length;
    const glm::dvec2 across{-along.y, along.x};
    glm::dvec2 jump{0.0};  // of the frame and of the reference
    int fitted = 0;
    for (const std::uint32_t triangle : sides.triangles) {
      Fit fit;
      for (const auto& [x, y] : pixels[triangle]) {
        const glm::dvec2 from = glm::dvec2(x + 0.5, y + 0.5) - sides.begin;
        const double distance = std::abs(glm::dot(from, across)), at = glm::dot(from, along);
        if (distance > c_reach || at < c_end * length || at > (1.0 - c_end) * length) continue;
        fit.add(distance, at / length, brightness(frame, x, y), brightness(reference, x, y));
      }
      // Distances are positive on both sides of the edge, so the jump is the sum of the two slopes.
      if (const auto slopes = fit.slopes()) {
        jump += *slopes;
        ++fitted;
      }
    }
    if (fitted != 2) continue;
    const double more = std::abs(jump.x - jump.y);
    ++bands.edges;
    squares += more * more;
    bands.largest = std::max(bands.largest, more);
  }
  if (bands.edges > 0) bands.rms = std::sqrt(squares / static_cast<double>(bands.edges));
  return bands;
}

}  // namespace halfway::study
