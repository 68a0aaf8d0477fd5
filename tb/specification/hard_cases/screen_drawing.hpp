// SPDX-License-Identifier: Apache-2.0
// Triangles given on the screen, drawn by the quadratic shader in both presets with the setup's own code.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "setup/test/random_triangles.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/specification.hpp"
#include "specification/hard_cases/trial.hpp"
#include "words/formats.hpp"

namespace halfway::stability {

/// A triangle or a piece of one, with samples of one channel in colour steps and depths in depth steps.
struct ScreenPiece {
  Points points{};  ///< in 1/2^unit_bits pixels
  int unit_bits = c_subpixel_bits;
  std::array<double, 6> sample{};
  std::array<double, 3> depth{1, 1, 1};
};

std::string name_of(const Points& points, int unit_bits);

/// Returns whether preset published can draw the piece without cutting it at the frame.
inline bool in_frame(const ScreenPiece& piece, FrameSize frame) {
  return std::ranges::all_of(piece.points, [&](ScreenPoint p) {
    return p.x >= 0 && p.y >= 0 && p.x < std::int64_t{frame.width} << piece.unit_bits &&
           p.y < std::int64_t{frame.height} << piece.unit_bits;
  });
}

/// The greatest number of forward-difference steps before a pixel of the piece: one per line, one per carry,
/// and the pixels of a span.
inline double most_steps(const ScreenPiece& piece, FrameSize frame) {
  const auto pixels = [&](std::int32_t ScreenPoint::* axis, std::uint32_t side) {
    const auto [least, greatest] =
        std::minmax({piece.points[0].*axis, piece.points[1].*axis, piece.points[2].*axis});
    return std::min<std::int64_t>(((greatest - least) >> piece.unit_bits) + 1, std::int64_t{side} - 1);
  };
  return static_cast<double>(2 * pixels(&ScreenPoint::y, frame.height) +
                             pixels(&ScreenPoint::x, frame.width));
}

/// Bound of the error of a colour: rounding, and k steps of second differences whose words have an error of
/// half of the preset's last bit each, (1 + k + k (k - 1) / 2) times that half. Samples are rounded in the
/// same way; the quadratic multiplies their error by 5/3 at most.
inline double colour_bound(Preset preset, double k) {
  const int fraction_bits = preset == Preset::exact ? words::Exact::c_intensity_fraction_bits
                                                    : words::Published::c_intensity_fraction_bits;
  return 0.5 + std::ldexp(1 + k + k * (k - 1) / 2 + 5.0 / 3, -fraction_bits - 1);
}
/// The same for a depth, which has only first differences.
inline double depth_bound(double k) {
  return 0.5 + std::ldexp(1 + k + 1, -words::Exact::c_depth_sum_fraction_bits - 1);
}

/// The quadratic through a piece's samples at a pixel's centre.
inline long double exact_colour(const ScreenPiece& piece, std::int64_t x, std::int64_t y) {
  std::array<long double, 6> sample;
  std::ranges::copy(piece.sample, sample.begin());
  return quadratic(barycentric(piece.points, centre(x, piece.unit_bits), centre(y, piece.unit_bits)).real(),
                   sample);
}

/// The four quarters of a triangle, with points in units of half the size, as in the setup's split.
inline std::array<Points, 4> quarters(const Points& p) {
  const auto middle = [](ScreenPoint a, ScreenPoint b) { return ScreenPoint{a.x + b.x, a.y + b.y}; };
  const ScreenPoint a = middle(p[0], p[0]), b = middle(p[1], p[1]), c = middle(p[2], p[2]),
                    ab = middle(p[0], p[1]), ac = middle(p[0], p[2]), bc = middle(p[1], p[2]);
  return {{{ab, bc, ac}, {a, ab, ac}, {ab, b, bc}, {ac, bc, c}}};
}

/// The pieces of a triangle that is fully split `level` times, in 1/2^level of its units.
std::vector<Points> split(const Points& whole, int level);

/// The error of a fragment of the piece, in colour steps.
inline double colour_off(const Fragment& f, const ScreenPiece& piece) {
  return static_cast<double>(std::abs(f.red - std::clamp(exact_colour(piece, f.x, f.y), 0.0L, 255.0L)));
}

std::string pixel_of(const ScreenPiece& piece, std::int64_t x, std::int64_t y);

/// The fragments that the preset draws for the pieces; `triangle` is the index of the piece. Preset published
/// draws only the pieces within the frame.
std::vector<Fragment> draw_pieces(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces,
                                  FrameSize frame);

/// Draws the pieces and compares the error of each fragment with the bound of its differences.
void measure_colours(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces, FrameSize frame);
void measure_depths(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces, FrameSize frame);

}  // namespace halfway::stability
