// SPDX-License-Identifier: Apache-2.0
// The pixels that a triangle covers: by exact integers in preset exact, by a stepped real slope in preset
// published.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <tuple>

#include "scene/camera.hpp"
#include "stability/hard_case.hpp"
#include "stability/screen_drawing.hpp"
#include "stability/specification.hpp"
#include "stability/trial.hpp"

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
  const bool exact = preset == Preset::exact;
  if (!exact)
    std::erase_if(shapes, [&](const Shape& shape) {
      return !std::ranges::all_of(shape.whole,
                                  [&](const ScreenPiece& whole) { return in_frame(whole, frame); });
    });
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < shapes.size(); ++i)
    for (const ScreenPiece& piece : shapes[i].pieces)
      exact ? append_exact(piece, i, frame, words) : append_published(piece, i, words);
  const auto count =
      wrong_pixels(shapes, frame, trial.draw(exact ? c_exact_key : c_published_key, words), wrong);
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

template <TriangleKind kind>
std::vector<Shape> random_shapes(Trial& trial, FrameSize frame, int quick, int full) {
  RandomTriangles random(static_cast<unsigned>(kind) + 1);
  std::vector<Shape> shapes;
  for (int i = 0; i < trial.rounds(quick, full); ++i)
    shapes.push_back(shape_of(random.next(kind, c_subpixel_bits, frame)));
  return shapes;
}

template <TriangleKind kind>
void random_ones(Trial& trial) {
  const std::vector<Shape> shapes = random_shapes<kind>(trial, c_frame, 300, 20'000);
  cover_both(trial, shapes, c_frame);
}

// Within the frame, and up to the ends of the guard band.
void a_line_high(Trial& trial) {
  std::vector<Shape> shapes = random_shapes<TriangleKind::one_line>(trial, c_frame, 300, 20'000);
  RandomTriangles random(2);
  for (int i = 0; i < trial.rounds(300, 20'000); ++i) {
    const int line = random.within(0, 60);
    const auto corner = [&] {
      return ScreenPoint{random.within(0, 97 * 16 - 1), line * 16 + random.within(0, 15)};
    };
    shapes.push_back(shape_of({corner(), corner(), corner()}));
  }
  cover_both(trial, shapes, c_frame);
}

// Triangles that extend over the whole guard band, and so over every frame.
void wide_ones(Trial& trial) {
  constexpr TriangleKind c_kind = TriangleKind::crossing;
  cover_exact(trial, random_shapes<c_kind>(trial, c_frame, 300, 20'000), c_frame);
  cover_exact(trial, random_shapes<c_kind>(trial, {4096, 3}, 40, 2'000), {4096, 3});
  cover_exact(trial, random_shapes<c_kind>(trial, {3, 4096}, 40, 2'000), {3, 4096});
  if (!trial.quick()) cover_exact(trial, random_shapes<c_kind>(trial, c_largest, 0, 6), c_largest);
}

// From one end of the guard band through the frame to the other, with the third corner a few units off the
// edge.
void wide_slivers(Trial& trial) {
  RandomTriangles random(11);
  for (const FrameSize frame : {c_frame, FrameSize{4096, 3}, FrameSize{3, 4096}}) {
    std::vector<Shape> shapes;
    for (int i = 0; i < trial.rounds(200, 8'000); ++i) {
      const double x = random.within(0, static_cast<int>(frame.width) * 16),
                   y = random.within(0, static_cast<int>(frame.height) * 16),
                   turn = i % 5 == 0 ? 0.0 : std::numbers::pi * random.within(0, 1 << 20) / (1 << 20);
      const auto end = [&](double dx, double dy) {
        const auto room = [](double from, double along) {
          return along > 0   ? (c_guard_end * 16 - from) / along
                 : along < 0 ? (c_guard_begin * 16 - from) / along
                             : 1e9;
        };
        const double reach = std::min(room(x, dx), room(y, dy));
        return ScreenPoint{static_cast<std::int32_t>(x + reach * dx),
                           static_cast<std::int32_t>(y + reach * dy)};
      };
      const ScreenPoint a = end(std::cos(turn), std::sin(turn)), b = end(-std::cos(turn), -std::sin(turn));
      const auto clamped = [](double v) {
        return static_cast<std::int32_t>(std::clamp<double>(v, c_guard_begin * 16, c_guard_end * 16));
      };
      const double t = random.within(0, 64) / 64.0;
      const int off = i % 2 == 0 ? 1 : 20;
      const ScreenPoint c{clamped(a.x + t * (b.x - a.x) + random.within(-off, off)),
                          clamped(a.y + t * (b.y - a.y) + random.within(-off, off))};
      shapes.push_back(shape_of({a, b, c}));
    }
    cover_exact(trial, shapes, frame);
  }
}

// Two corners at both ends of the frame's 4096 pixels, and the third corner 1/16 pixel off the edge between
// them.
void slivers(Trial& trial) {
  RandomTriangles random(3);
  std::vector<Shape> shapes;
  const int side = 4096 * 16 - 1;
  for (int i = 0; i < trial.rounds(60, 3'000); ++i) {
    ScreenPoint a{random.within(0, 40), random.within(0, side)},
        b{side - random.within(0, 40), i % 3 == 0 ? a.y + i % 2 : random.within(0, side)};
    if (i % 4 == 1) std::swap(a.x, a.y), std::swap(b.x, b.y);
    b.y = std::clamp(b.y, 0, side);
    const std::int64_t t = random.within(0, 4096);
    ScreenPoint c{static_cast<std::int32_t>(a.x + (b.x - a.x) * t / 4096),
                  static_cast<std::int32_t>(a.y + (b.y - a.y) * t / 4096)};
    (random.within(0, 1) == 0 ? c.x : c.y) += random.within(0, 1) == 0 ? 1 : -1;
    c = {std::clamp(c.x, 0, side), std::clamp(c.y, 0, side)};
    shapes.push_back(shape_of({a, b, c}));
  }
  cover_both(trial, shapes, c_largest);
}

// Collinear corners, two equal corners, three equal corners.
void no_area(Trial& trial) {
  RandomTriangles random(4);
  std::vector<Shape> shapes;
  for (int i = 0; i < trial.rounds(500, 20'000); ++i) {
    const int unit = i % 2 == 0 ? 1 : 8;  // also on the lines of the pixel centres
    const ScreenPoint a{8 * random.within(0, 120), 8 * random.within(0, 80)},
        step{unit * random.within(-40, 40), unit * random.within(-40, 40)};
    const auto at = [&](int n) { return ScreenPoint{a.x + n * step.x, a.y + n * step.y}; };
    shapes.push_back(shape_of({a, at(random.within(0, 6)), at(random.within(-6, 6))}));
  }
  cover_both(trial, shapes, c_frame);
}

// Two triangles with a common edge, or several around a corner.
void neighbours(Trial& trial) {
  RandomTriangles random(5);
  std::vector<Shape> shapes;
  for (int i = 0; i < trial.rounds(200, 10'000); ++i) {
    const int grid = i % 3 == 0 ? 16 : i % 3 == 1 ? 8 : 1;  // coarse grids contain pixel centres
    const auto snapped = [&](double v) {
      return static_cast<std::int32_t>(std::floor(v / grid)) * grid + (grid == 16 ? 8 : 0);
    };
    const double cx = random.within(480, 1000), cy = random.within(400, 560);
    const int count = random.within(4, 9);
    std::vector<ScreenPoint> ring;
    for (int n = 0; n < count; ++n) {
      const double turn = 2 * std::numbers::pi * (n + 0.3 * random.within(0, 100) / 100.0) / count,
                   reach = random.within(60, 380);
      ring.push_back({snapped(cx + reach * std::cos(turn)), snapped(cy + reach * std::sin(turn))});
    }
    const ScreenPoint middle{snapped(cx), snapped(cy)};
    Shape shape;
    for (int n = 0; n < count; ++n)
      shape.whole.push_back({.points = {middle, ring[static_cast<std::size_t>(n)],
                                        ring[static_cast<std::size_t>((n + 1) % count)]}});
    shape.pieces = shape.whole;
    shapes.push_back(std::move(shape));
  }
  cover_both(trial, shapes, c_frame);
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

// Triangles with their corners at the corners of guard band and frame, or up to half a pixel off.
void guard_band(Trial& trial) {
  std::vector<std::int32_t> places;
  for (const int at : {c_guard_begin, 0, 61, 97, 4096, c_guard_end})
    for (const int off : {0, 1, 8}) places.push_back(at * 16 + (at == c_guard_end ? -off : off));
  RandomTriangles random(8);
  const auto place = [&] {
    return places[static_cast<std::size_t>(random.within(0, static_cast<int>(places.size()) - 1))];
  };
  const auto some = [&](int quick, int full) {
    std::vector<Shape> shapes;
    for (int i = 0; i < trial.rounds(quick, full); ++i)
      shapes.push_back(shape_of({{{place(), place()}, {place(), place()}, {place(), place()}}}));
    return shapes;
  };
  cover_exact(trial, some(300, 20'000), c_frame);
  cover_exact(trial, some(20, 1'000), {4096, 4});
  cover_exact(trial, some(20, 1'000), {4, 4096});
  if (!trial.quick()) cover_exact(trial, some(0, 8), c_largest);
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

// A wide floor of random triangles below and behind the eye.
struct Floor {
  Scene scene;
  double half_side;
};

Floor random_floor(std::mt19937& random) {
  const auto within = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Floor floor;
  floor.half_side = 50.0;
  Scene& scene = floor.scene;
  const int cells = std::uniform_int_distribution<int>(2, 9)(random);
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(i * (cells + 1) + j); };
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const double room = 0.3 * 2 * floor.half_side / cells;
      const auto at = [&](int n) {
        return floor.half_side * (2.0 * n / cells - 1) + (n > 0 && n < cells ? within(-room, room) : 0.0);
      };
      const double x = at(i), z = at(j);
      scene.positions_world.push_back({x, 0, z});
    }
  scene.normals_world = {{0, 1, 0}};
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const std::uint32_t a = vertex(i, j), b = vertex(i, j + 1), c = vertex(i + 1, j + 1),
                          d = vertex(i + 1, j);
      // Counter-clockwise seen from above.
      if (within(0, 1) < 0.5) {
        scene.triangles.push_back({{a, b, c}, {0, 0, 0}, 0});
        scene.triangles.push_back({{a, c, d}, {0, 0, 0}, 0});
      } else {
        scene.triangles.push_back({{a, b, d}, {0, 0, 0}, 0});
        scene.triangles.push_back({{b, c, d}, {0, 0, 0}, 0});
      }
    }
  scene.materials.push_back({.name = "floor"});
  scene.directional.push_back({{0, 1, 0}, {1, 1, 1}});
  Camera& camera = scene.camera;
  camera.eye_world = {within(-3, 3), std::exp(within(std::log(0.01), std::log(3.0))), within(-3, 3)};
  const double turn = within(0, 6.28), down = within(0.0, 1.4);
  camera.target_world = camera.eye_world + glm::dvec3(std::cos(turn) * std::cos(down), -std::sin(down),
                                                      std::sin(turn) * std::cos(down));
  camera.near = camera.eye_world.y * within(0.2, 3.0);
  camera.far = 400;
  return floor;
}

// Counts the pixels of the floor between near and far plane, found by rays, that are not drawn exactly once.
// Pixels within one pixel of its outline may or may not be drawn. They may also be drawn twice: a triangle at
// the horizon that is less than 1/16 pixel high can turn over when its corners are snapped, so that its
// neighbours overlap.
double holes(const Floor& floor, FrameSize frame, const std::vector<Fragment>& fragments) {
  const Camera& camera = floor.scene.camera;
  const LongVec eye(camera.eye_world), forward = glm::normalize(LongVec(camera.target_world) - eye),
                                       right = glm::normalize(glm::cross(forward, LongVec(camera.up_world))),
                                       up = glm::cross(right, forward);
  const long double focal =
      0.5L * frame.height /
      std::tan(0.5L * (long double)camera.vertical_fov_degrees * std::numbers::pi_v<long double> / 180);
  const auto seen = [&](long double x, long double y) {
    const LongVec ray =
        forward + (x - 0.5L * frame.width) / focal * right - (y - 0.5L * frame.height) / focal * up;
    if (!(ray.y < 0)) return false;
    const long double along = -eye.y / ray.y;
    const LongVec at = eye + along * ray;
    return along > camera.near && along < camera.far && std::abs(at.x) < floor.half_side &&
           std::abs(at.z) < floor.half_side;
  };
  std::vector<int> drawn(std::size_t{frame.width} * frame.height);
  for (const Fragment& f : fragments) ++drawn[std::size_t{f.y} * frame.width + f.x];
  double wrong = 0;
  for (std::uint32_t y = 0; y < frame.height; ++y)
    for (std::uint32_t x = 0; x < frame.width; ++x) {
      int corners = 0;
      for (const int dx : {-1, 1})
        for (const int dy : {-1, 1}) corners += seen(x + 0.5L + dx, y + 0.5L + dy);
      const int count = drawn[std::size_t{y} * frame.width + x];
      wrong += (corners == 4 && count != 1) || (corners == 0 && count != 0);
    }
  return wrong;
}

void near_plane(Trial& trial) {
  std::mt19937 random(10);
  for (int i = 0; i < trial.rounds(12, 5'000); ++i) {
    const Floor floor = random_floor(random);
    const auto where = [&] { return fmt::format("floor {}", i); };
    DrawOptions options{.frame = c_frame};
    // Also split some triangles.
    options.setup.quadratic.threshold = i % 2 == 0 ? 2.0 : 0.05;
    trial.ours(holes(floor, c_frame, trial.draw(floor.scene, options).fragments), 0, where);
    options.plan.preset = Preset::published;
    options.setup.quadratic.test = HighlightTest::none;
    trial.published(holes(floor, c_frame, trial.draw(floor.scene, options).fragments), 0, where);
  }
}

constexpr std::string_view
    c_ends = "quadratic, section 5: edges step by rounded slopes; spans and lines include both ends",
    c_integers = "edges step by integer quotient and remainder; top-left rule at pixel centres",
    c_once = "pixels drawn = pixels covered";

constexpr HardCase c_cases[] = {
    {"on_centres", "Vertices on pixel centres", c_ends, c_integers, c_once, "pixels", PublishedForm::breaks,
     random_ones<TriangleKind::on_centres>},
    {"horizontal_edge", "Horizontal edges",
     "quadratic, section 5: the slope A = dX/dY is 1/0 for a horizontal edge", c_integers, c_once, "pixels",
     PublishedForm::breaks, random_ones<TriangleKind::horizontal_edge>},
    {"a_line_high", "Triangles of one line", c_ends, c_integers, c_once, "pixels", PublishedForm::breaks,
     a_line_high},
    {"subpixel", "Triangles within a pixel", "quadratic, section 5: vertices are whole pixels",
     "vertices are multiples of 1/16 pixel", c_once, "pixels", PublishedForm::breaks,
     random_ones<TriangleKind::subpixel>},
    {"small", "Triangles of a few pixels", c_ends, c_integers, c_once, "pixels", PublishedForm::breaks,
     random_ones<TriangleKind::small>},
    {"slivers", "Slivers 1/16 pixel thick and 4096 pixels long",
     "quadratic, section 5: vertices are whole pixels; section 3: D is close to 0", c_integers, c_once,
     "pixels", PublishedForm::breaks, slivers},
    {"no_area", "Triangles without area", "quadratic, section 3: divides by D = X2 Y3 - Y2 X3 = 0",
     "the triangle covers no pixel centre, so the set-up outputs no init vector", c_once, "pixels",
     PublishedForm::breaks, no_area},
    {"neighbours", "Triangles around a common vertex", c_ends,
     "a pixel centre on an edge belongs to one of the two triangles", "each pixel is drawn once", "pixels",
     PublishedForm::breaks, neighbours},
    {"t_junctions", "A split triangle next to an unsplit one, levels 1 to 5",
     "quadratic, section 4: midpoints are rounded to whole pixels, so they are not on the edge",
     "one more fraction bit per level, so midpoints stay on the edge",
     "each pixel is drawn once (published: no cracks)", "pixels", PublishedForm::breaks, t_junctions},
    {"guard_band", "Vertices at the guard band", "quadratic, section 5: triangles are clipped at the frame",
     "13 bits for pixels, clamped to the frame", c_once, "pixels", PublishedForm::silent, guard_band},
    {"wide_ones", "Triangles across the guard band",
     "quadratic, section 5: triangles are clipped at the frame",
     "at most three init vectors, each within the frame", c_once, "pixels", PublishedForm::silent, wide_ones},
    {"wide_slivers", "Slivers across the guard band",
     "quadratic, section 5: triangles are clipped at the frame",
     "at most three init vectors, each within the frame", c_once, "pixels", PublishedForm::silent,
     wide_slivers},
    {"fractional_edges", "Fractional edges",
     "quadratic, section 5: I steps by the slope A, which is no integer, to X_start",
     "separate differences for the integer step of the edge and for its carry",
     "the colour at the pixel's centre", "steps", PublishedForm::breaks, fractional_edges},
    {"near_plane", "A floor that crosses the near plane", "division x/w with w <= 0",
     "clipping at the near plane; the two triangles of an edge clip it in the same order of its ends",
     "each pixel of the floor is drawn once, except on its outline", "pixels", PublishedForm::breaks,
     near_plane},
};

INSTANTIATE_TEST_SUITE_P(edges, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace

}  // namespace halfway::stability
