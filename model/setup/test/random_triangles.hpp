// SPDX-License-Identifier: Apache-2.0
// For tests: random triangles on the screen as input of setup, and the header words of their init vectors.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "projection/edge.hpp"
#include "setup/walk.hpp"
#include "setup/walk_header.hpp"
#include "words/init_vector.hpp"

namespace halfway {

using Points = std::array<ScreenPoint, 3>;

enum class TriangleKind {
  any,              ///< of the frame's size, partly outside it
  small,            ///< a few pixels
  subpixel,         ///< within one pixel
  one_line,         ///< one line high, any width
  sliver,           ///< one unit from degenerate, of the frame's size
  horizontal_edge,  ///< flat at the top or the bottom
  on_centres,       ///< vertices on pixel centres
  crossing,         ///< over the whole guard band, mostly outside the frame
  thin_across,      ///< over the whole guard band, a few units thick
  outside           ///< outside the frame
};
inline constexpr std::array c_triangle_kinds = {TriangleKind::any,         TriangleKind::small,
                                                TriangleKind::subpixel,    TriangleKind::one_line,
                                                TriangleKind::sliver,      TriangleKind::horizontal_edge,
                                                TriangleKind::on_centres,  TriangleKind::crossing,
                                                TriangleKind::thin_across, TriangleKind::outside};

class RandomTriangles {
 public:
  explicit RandomTriangles(unsigned seed) : random_(seed) {}

  /// In 1/2^unit_bits pixels, vertices in any order. `level` is the level of subdivision: per level the range
  /// of 8191 pixels of the guard band is halved, as for setup's triangles.
  Points next(TriangleKind kind, int unit_bits, FrameSize frame, int level = 0) {
    const int unit = 1 << unit_bits, reach = 8191 >> level;
    const int width = static_cast<int>(frame.width), height = static_cast<int>(frame.height);
    // Choose an origin such that all points within `reach` lie in the guard band.
    const int left = level == 0 ? -2048 : within(-reach, width - 1),
              top = level == 0 ? -2048 : within(-reach, height - 1);
    const auto anywhere = [&] {
      return ScreenPoint{left * unit + within(0, reach * unit), top * unit + within(0, reach * unit)};
    };
    const auto about_frame = [&] {
      const int w = std::min(width, reach / 2), h = std::min(height, reach / 2);
      return ScreenPoint{within(-w / 4 * unit - unit, (w + w / 4) * unit + unit),
                         within(-h / 4 * unit - unit, (h + h / 4) * unit + unit)};
    };
    const auto nearby = [&](ScreenPoint p, int by) {
      return ScreenPoint{p.x + within(-by, by), p.y + within(-by, by)};
    };
    Points p = {about_frame(), about_frame(), about_frame()};
    switch (kind) {
      case TriangleKind::any:
        break;
      case TriangleKind::small:
        p = {p[0], nearby(p[0], 4 * unit), nearby(p[0], 4 * unit)};
        break;
      case TriangleKind::subpixel:
        p = {p[0], nearby(p[0], unit / 2), nearby(p[0], unit / 2)};
        break;
      case TriangleKind::one_line: {
        p = {anywhere(), anywhere(), anywhere()};
        const int line = within(-1, height);
        for (ScreenPoint& q : p) q.y = line * unit + within(0, unit);
        break;
      }
      case TriangleKind::sliver:
      case TriangleKind::thin_across: {
        if (kind == TriangleKind::thin_across) p = {anywhere(), anywhere(), anywhere()};
        const std::int64_t t = within(0, 64);
        const ScreenPoint on_edge = {static_cast<std::int32_t>(p[0].x + t * (p[1].x - p[0].x) / 64),
                                     static_cast<std::int32_t>(p[0].y + t * (p[1].y - p[0].y) / 64)};
        p[2] = nearby(on_edge, kind == TriangleKind::sliver ? 1 : 20);
        break;
      }
      case TriangleKind::horizontal_edge:
        p[1].y = p[0].y;
        break;
      case TriangleKind::on_centres:
        for (ScreenPoint& q : p) q = {floor_to(q.x, unit) + unit / 2, floor_to(q.y, unit) + unit / 2};
        break;
      case TriangleKind::crossing:
        p = {anywhere(), anywhere(), anywhere()};
        break;
      case TriangleKind::outside: {
        const bool across = random_() % 2, past = random_() % 2;
        const int room = std::min(reach / 2, 2000);
        for (ScreenPoint& q : p) {
          const std::int32_t by =
              past ? (across ? width : height) * unit + within(0, room * unit) : -within(0, room * unit);
          (across ? q.x : q.y) = by;
        }
        break;
      }
    }
    std::shuffle(p.begin(), p.end(), random_);
    return p;
  }

  int within(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

 private:
  static std::int32_t floor_to(std::int32_t v, int unit) {
    return static_cast<std::int32_t>(floor_divide(v, unit).quotient) * unit;
  }
  std::mt19937 random_;
};

/// The header of the init vector of a walk, without triangle and depth.
inline std::vector<std::uint32_t> header_of(const Walk& walk) {
  std::vector<std::uint32_t> words;
  InitVector init(words, words::Exact::c_init_header_bits);
  put_header(init, 0, walk, {});
  return words;
}

}  // namespace halfway
