// SPDX-License-Identifier: Apache-2.0
// The pixels that a triangle covers: by exact integers in preset exact, by a stepped real slope in preset
// published.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "specification/hard_cases/hard_case.hpp"
#include "specification/hard_cases/screen_drawing.hpp"
#include "specification/hard_cases/specification.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {

namespace {

// Triangles that cover each pixel once, and pieces that must cover the same pixels when drawn.
struct Shape {
  std::vector<ScreenPiece> whole, pieces;
};

Shape shape_of(const Points& p) {
  return {{{.points = p}}, {{.points = p}}};
}

enum class Wrong {
  any,     ///< too many or too few pixels
  missing  ///< too few pixels: cracks
};

using Pixel = std::tuple<std::uint32_t, std::uint16_t, std::uint16_t>;  // shape, y, x

// The number of pixels of each shape that are drawn and not covered, or covered and not drawn.
std::vector<std::size_t> wrong_pixels(const std::vector<Shape>& shapes, FrameSize frame,
                                      const std::vector<Fragment>& fragments, Wrong wrong) {
  std::vector<Pixel> drawn, covered, other;
  for (const Fragment& f : fragments) drawn.emplace_back(f.triangle, f.y, f.x);
  for (std::uint32_t i = 0; i < shapes.size(); ++i)
    for (const ScreenPiece& whole : shapes[i].whole)
      for_each_covered(whole.points, whole.unit_bits, frame, [&](std::int64_t x, std::int64_t y) {
        covered.emplace_back(i, static_cast<std::uint16_t>(y), static_cast<std::uint16_t>(x));
      });
  std::ranges::sort(drawn);
  std::ranges::sort(covered);
  if (wrong == Wrong::missing) {
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    std::ranges::set_difference(covered, drawn, std::back_inserter(other));
  } else {
    std::ranges::set_symmetric_difference(covered, drawn, std::back_inserter(other));
  }
  std::vector<std::size_t> count(shapes.size());
  for (const auto& [shape, y, x] : other) ++count[shape];
  return count;
}

// In preset published only the shapes within the frame are drawn.
void cover(Trial& trial, Preset preset, std::vector<Shape> shapes, FrameSize frame,
           Wrong wrong = Wrong::any) {
  if (preset == Preset::published)
    std::erase_if(shapes, [&](const Shape& shape) {
      return !std::ranges::all_of(shape.whole,
                                  [&](const ScreenPiece& whole) { return in_frame(whole, frame); });
    });
  std::vector<ScreenPiece> pieces;
  std::vector<std::uint32_t> shape_of;  // the piece
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    pieces.insert(pieces.end(), shapes[i].pieces.begin(), shapes[i].pieces.end());
    shape_of.resize(pieces.size(), i);
  }
  std::vector<Fragment> fragments = draw_pieces(trial, preset, pieces, frame);
  for (Fragment& f : fragments) f.triangle = shape_of[f.triangle];
  const auto count = wrong_pixels(shapes, frame, fragments, wrong);
  for (std::size_t i = 0; i < shapes.size(); ++i)
    trial.measure(preset, static_cast<double>(count[i]), 0,
                  [&] { return name_of(shapes[i].whole[0].points, shapes[i].whole[0].unit_bits); });
}
void cover_exact(Trial& trial, const std::vector<Shape>& shapes, FrameSize frame) {
  cover(trial, Preset::exact, shapes, frame);
}
void cover_both(Trial& trial, const std::vector<Shape>& shapes, FrameSize frame) {
  cover(trial, Preset::exact, shapes, frame);
  cover(trial, Preset::published, shapes, frame);
}

constexpr FrameSize c_frame{97, 61}, c_largest{4096, 4096};

std::vector<Shape> random_shapes(TriangleKind kind, FrameSize frame, int count) {
  RandomTriangles random(static_cast<unsigned>(kind) + 1);
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) shapes.push_back(shape_of(random.next(kind, c_subpixel_bits, frame)));
  return shapes;
}

void every_kind(Trial& trial) {
  const int count = trial.rounds(150, 20'000);
  for (const TriangleKind kind : {TriangleKind::on_centres, TriangleKind::horizontal_edge,
                                  TriangleKind::one_line, TriangleKind::subpixel, TriangleKind::small})
    cover_both(trial, random_shapes(kind, c_frame, count), c_frame);
}

// Corners at the corners of guard band and frame, or up to half a pixel off.
std::vector<Shape> corner_shapes(int count) {
  std::vector<std::int32_t> places;
  for (const int at : {c_guard_begin, 0, 61, 97, 4096, c_guard_end})
    for (const int off : {0, 1, 8}) places.push_back(at * 16 + (at == c_guard_end ? -off : off));
  RandomTriangles random(8);
  const auto place = [&] {
    return places[static_cast<std::size_t>(random.within(0, static_cast<int>(places.size()) - 1))];
  };
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i)
    shapes.push_back(shape_of({{{place(), place()}, {place(), place()}, {place(), place()}}}));
  return shapes;
}

// Triangles with corners at the guard band and those that extend over all of it, and so over every frame.
void guard_band(Trial& trial) {
  for (const FrameSize frame : {c_frame, FrameSize{4096, 3}, FrameSize{3, 4096}}) {
    const bool small = frame.width == c_frame.width;
    cover_exact(trial, corner_shapes(trial.rounds(small ? 150 : 20, small ? 20'000 : 1'000)), frame);
    for (const TriangleKind kind : {TriangleKind::crossing, TriangleKind::thin_across})
      cover_exact(trial, random_shapes(kind, frame, trial.rounds(small ? 150 : 20, small ? 20'000 : 2'000)),
                  frame);
  }
  if (trial.quick()) return;
  cover_exact(trial, corner_shapes(8), c_largest);
  cover_exact(trial, random_shapes(TriangleKind::crossing, c_largest, 6), c_largest);
}

void slivers(Trial& trial) {
  cover_both(trial, random_shapes(TriangleKind::sliver, c_largest, trial.rounds(200, 12'000)), c_largest);
}

// Two triangles with a common edge: one is whole, the other is fully split.
Shape half_split(const Points& whole, const Points& split, int level) {
  Shape shape{{{.points = whole}, {.points = split}}, {{.points = whole}}};
  for (const Points& p : stability::split(split, level))
    shape.pieces.push_back({.points = p, .unit_bits = c_subpixel_bits + level});
  return shape;
}

void t_junctions(Trial& trial) {
  RandomTriangles random(6);
  // Corners anywhere. For the published form, whose vertices are pixels, corners on pixel centres.
  for (const bool on_centres : {false, true}) {
    const auto corner = [&](int left, int right, int above, int below) {
      const ScreenPoint p{random.within(left * 16, right * 16), random.within(above * 16, below * 16)};
      return on_centres ? ScreenPoint{p.x / 16 * 16 + 8, p.y / 16 * 16 + 8} : p;
    };
    std::vector<Shape> shapes;
    for (int i = 0; i < trial.rounds(60, 4'000); ++i) {
      // The shared edge runs down the middle of the frame.
      const ScreenPoint top = corner(40, 56, 0, 8), bottom = corner(40, 56, 50, 60);
      shapes.push_back(
          half_split({top, bottom, corner(0, 36, 0, 60)}, {top, bottom, corner(60, 96, 0, 60)}, 1 + i % 5));
    }
    cover_exact(trial, shapes, c_frame);
    if (on_centres) cover(trial, Preset::published, shapes, c_frame, Wrong::missing);
  }
}

// A steep colour ramp next to edges of every slope.
void fractional_edges(Trial& trial) {
  RandomTriangles random(9);
  std::vector<ScreenPiece> pieces;
  while (std::ssize(pieces) < trial.rounds(200, 10'000)) {
    const Points p = random.next(TriangleKind::on_centres, c_subpixel_bits, c_frame);
    ScreenPiece piece{.points = p};
    if (!in_frame(piece, c_frame)) continue;
    // Linear in x and y, from dark to white over the triangle.
    const auto ramp = [&](ScreenPoint a, ScreenPoint b) { return 255.0 * (a.x + b.x) / (2.0 * 97 * 16); };
    piece.sample = {ramp(p[0], p[0]), ramp(p[1], p[1]), ramp(p[2], p[2]),
                    ramp(p[0], p[1]), ramp(p[0], p[2]), ramp(p[1], p[2])};
    double least = *std::ranges::min_element(piece.sample),
           greatest = *std::ranges::max_element(piece.sample);
    if (greatest == least) continue;
    for (double& s : piece.sample) s = 255.0 * (s - least) / (greatest - least);
    pieces.push_back(piece);
  }
  for (const Preset preset : {Preset::exact, Preset::published})
    measure_colours(trial, preset, pieces, c_frame);
}

constexpr HardCase c_cases[] = {{"every_kind", every_kind},
                                {"slivers", slivers},
                                {"guard_band", guard_band},
                                {"t_junctions", t_junctions},
                                {"fractional_edges", fractional_edges}};
INSTANTIATE_TEST_SUITE_P(edges, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace
}  // namespace halfway::stability
