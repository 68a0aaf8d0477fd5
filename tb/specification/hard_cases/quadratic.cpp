// SPDX-License-Identifier: Apache-2.0
// Colour and depth of a triangle's pixels: by one division and forward differences that wrap, compared with
// the published five divisions and 20 fraction bits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/test/random_scenes.hpp"
#include "specification/hard_cases/hard_case.hpp"
#include "specification/hard_cases/screen_drawing.hpp"
#include "specification/hard_cases/specification.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {
namespace {

constexpr FrameSize c_frame{97, 61}, c_largest{4096, 4096};
constexpr double c_nearest = 1, c_farthest = (1 << 24) - 3;  // steps, the range that setup keeps

std::array<double, 6> random_samples(RandomTriangles& random, double most = 255.0) {
  std::array<double, 6> sample;
  for (double& s : sample) s = most * random.within(0, 1 << 20) / (1 << 20);
  return sample;
}

// Section 3 as printed, in double: T0 to T5 by five divisions, then equation 4. (X1, Y1) is the origin and
// the start of the drawing.
double five_divisions(const ScreenPiece& piece, std::int64_t x, std::int64_t y) {
  const double unit = 1 << piece.unit_bits;
  std::array<std::size_t, 3> n = {0, 1, 2};
  const std::size_t top = static_cast<std::size_t>(
      std::ranges::min_element(piece.points, {}, &ScreenPoint::y) - piece.points.begin());
  std::swap(n[0], n[top]);
  const auto px = [&](std::size_t i) { return piece.points[n[i]].x / unit; };
  const auto py = [&](std::size_t i) { return piece.points[n[i]].y / unit; };
  const auto vertex = [&](std::size_t i) { return piece.sample[n[i]]; };
  const auto middle = [&](std::size_t i, std::size_t j) { return piece.sample[2 + n[i] + n[j]]; };
  const double i1 = vertex(0), i2 = vertex(1), i3 = vertex(2), i12 = middle(0, 1), i13 = middle(0, 2),
               i23 = middle(1, 2);
  const double x2 = px(1) - px(0), y2 = py(1) - py(0), x3 = px(2) - px(0), y3 = py(2) - py(0);
  const double c2 = 4 * i12 - 3 * i1 - i2, c12 = i1 + i2 - 2 * i12, c3 = 4 * i13 - 3 * i1 - i3,
               c13 = i1 + i3 - 2 * i13, c23 = 4 * i1 - 4 * i12 - 4 * i13 + 4 * i23;
  const double t0 = i1, t1 = (c3 * x2 - c2 * x3) / (x2 * y3 - y2 * x3),
               t2 = (c2 * y3 - c3 * y2) / (x2 * y3 - y2 * x3);
  const double a = 2 * x2 * x2 * y3 - 2 * x2 * y2 * x3, b = y2 * x3 * y3 - x2 * y3 * y3,
               c = x2 * y2 * y3 - y2 * y2 * x3, d = 2 * y2 * x3 * x3 - 2 * x2 * x3 * y3;
  const double t4 = ((4 * c13 * y2 - c23 * y3) * a - (4 * c12 * y3 - c23 * y2) * d) / (a * b - c * d);
  const double t5 = ((4 * c12 * y3 - c23 * y2) * b - (4 * c13 * y2 - c23 * y3) * c) / (a * b - c * d);
  const double t3 = (2 * c12 - t5 * x2 * x2 - t4 * x2 * y2) / (y2 * y2);
  const double u = static_cast<double>(x) + 0.5 - px(0), v = static_cast<double>(y) + 0.5 - py(0);
  return t5 * u * u + t4 * u * v + t3 * v * v + t2 * u + t1 * v + t0;
}

void five_division_colours(Trial& trial, const std::vector<ScreenPiece>& pieces, FrameSize frame) {
  for (const ScreenPiece& piece : pieces)
    for_each_covered(piece.points, piece.unit_bits, frame, [&](std::int64_t x, std::int64_t y) {
      const double value = five_divisions(piece, x, y),
                   exact = static_cast<double>(std::clamp(exact_colour(piece, x, y), 0.0L, 255.0L)),
                   off = std::isfinite(value) ? std::abs(std::clamp(value, 0.0, 255.0) - exact) : c_infinity;
      trial.published(off, 0.5, [&] { return pixel_of(piece, x, y); });
    });
}

// Twice their area is below `most`, in units of 1/256 pixel.
std::vector<ScreenPiece> slivers(RandomTriangles& random, int count, FrameSize frame, Wide most = 1 << 30) {
  std::vector<ScreenPiece> pieces;
  while (std::ssize(pieces) < count) {
    const Points p = random.next(TriangleKind::sliver, c_subpixel_bits, frame);
    // Level edges are a case of their own.
    if (p[0].y == p[1].y || p[0].y == p[2].y || p[1].y == p[2].y) continue;
    const Wide area = barycentric(p, 0, 0).sum / 4;
    if (area > most || -area > most || plan_walks(p, c_subpixel_bits, frame).empty()) continue;
    pieces.push_back({.points = p,
                      .sample = random_samples(random),
                      .depth = {random.within(0, 1) != 0 ? c_nearest : c_farthest,
                                random.within(0, 1) != 0 ? c_nearest : c_farthest,
                                double(random.within(1, (1 << 24) - 3))}});
  }
  return pieces;
}

// The first edge is level or almost level.
std::vector<ScreenPiece> level_edges(int count) {
  RandomTriangles random(1);
  std::vector<ScreenPiece> pieces;
  for (int i = 0; i < count; ++i) {
    Points p = random.next(TriangleKind::any, c_subpixel_bits, c_frame);
    std::ranges::sort(p, {}, &ScreenPoint::y);
    p[1].y = p[0].y + i % 3;
    pieces.push_back({.points = p, .sample = random_samples(random)});
  }
  return pieces;
}

void no_divisor(Trial& trial) {
  RandomTriangles random(2);
  const int count = trial.rounds(200, 10'000);
  measure_colours(trial, Preset::exact, slivers(random, count, c_frame), c_frame);
  measure_colours(trial, Preset::exact, slivers(random, count / 4, c_largest), c_largest);
  five_division_colours(trial, slivers(random, trial.rounds(400, 10'000), c_largest, 4096), c_largest);
  const std::vector<ScreenPiece> level = level_edges(trial.rounds(100, 5'000));
  measure_colours(trial, Preset::exact, level, c_frame);
  five_division_colours(trial, level, c_frame);
}

// Slivers, and corners at the near and at the far plane in all combinations.
void depths(Trial& trial) {
  RandomTriangles random(3);
  const auto measure = [&](const std::vector<ScreenPiece>& pieces, FrameSize frame) {
    for (const Preset preset : {Preset::exact, Preset::published})
      measure_depths(trial, preset, pieces, frame);
  };
  const int count = trial.rounds(100, 10'000);
  measure(slivers(random, count, c_frame), c_frame);
  measure(slivers(random, count / 4, c_largest), c_largest);
  std::vector<ScreenPiece> pieces;
  for (int i = 0; i < count; ++i) {
    const auto end = [&](int corner) { return i >> corner & 1 ? c_farthest : c_nearest; };
    pieces.push_back({.points = random.next(i % 2 == 0 ? TriangleKind::any : TriangleKind::on_centres,
                                            c_subpixel_bits, c_frame),
                      .depth = {end(1), end(2), end(3)}});
  }
  measure(pieces, c_frame);
}

// Triangles with vertical start edges on pixel centres, where the published form has no error except
// rounding; so many pixels wide and so many lines high.
std::vector<ScreenPiece> upright(RandomTriangles& random, int count, int width, int height) {
  std::vector<ScreenPiece> pieces;
  for (int i = 0; i < count; ++i) {
    const auto centred = [](int pixel) { return 16 * pixel + 8; };
    const ScreenPoint top{centred(0), centred(0)}, bottom{centred(0), centred(height - 1)},
        right{centred(width - 1), centred(random.within(0, height - 1))};
    pieces.push_back({.points = {top, right, bottom}, .sample = random_samples(random)});
  }
  return pieces;
}

// The paper's own bound of the published form: M steps, each with an error of 2^-b.
void published_drift(Trial& trial, const std::vector<ScreenPiece>& pieces, FrameSize frame) {
  for (const Fragment& f : draw_pieces(trial, Preset::published, pieces, frame)) {
    const ScreenPiece& piece = pieces[f.triangle];
    const double m = most_steps(piece, frame);
    trial.published(colour_off(f, piece), 0.5 + std::ldexp(m, -words::Published::c_intensity_fraction_bits),
                    [&] { return pixel_of(piece, f.x, f.y); });
  }
}

void wide_and_upright(Trial& trial) {
  RandomTriangles random(5);
  const FrameSize frame{4096, 8};
  const auto pieces = upright(random, trial.rounds(20, 1'500), 4096, 8);
  measure_colours(trial, Preset::exact, pieces, frame);
  published_drift(trial, pieces, frame);
}

void tall_and_upright(Trial& trial) {
  RandomTriangles random(6);
  const FrameSize frame{8, 4096};
  auto pieces = upright(random, trial.rounds(20, 1'500), 8, 4096);
  published_drift(trial, pieces, frame);
  // Also lean the edges to either side: they then carry on most lines.
  for (ScreenPiece& piece : pieces) {
    piece.points[0].x = random.within(0, 8 * 16);
    piece.points[2].x = random.within(0, 8 * 16);
    if (random.within(0, 1) == 0)
      for (ScreenPoint& p : piece.points) p.x = 8 * 16 - p.x;
  }
  measure_colours(trial, Preset::exact, pieces, frame);
}

void long_spans(Trial& trial) {
  wide_and_upright(trial);
  tall_and_upright(trial);
  if (trial.quick()) return;
  RandomTriangles random(7);
  for (int i = 0; i < 4; ++i) {
    auto pieces = upright(random, 1, 4096, 4096);
    published_drift(trial, pieces, c_largest);
    const auto anywhere = [&] { return ScreenPoint{random.within(0, 65536), random.within(0, 65536)}; };
    pieces.push_back({.points = {anywhere(), anywhere(), anywhere()}, .sample = random_samples(random)});
    measure_colours(trial, Preset::exact, pieces, c_largest);
  }
}

// A triangle with normals up to 40 degrees apart, and with a highlight.
Scene highlighted(RandomScenes& random) {
  Scene scene;
  const glm::dvec3 to_eye(0, 0, 1);
  const auto within = [&](double low, double high) { return random.within(low, high); };
  for (int i = 0; i < 3; ++i) {
    const double turn = 2.0 * std::numbers::pi * (i + within(0, 0.5)) / 3, lean = within(0.05, 0.4);
    scene.positions_world.push_back(
        {within(0.5, 1) * std::cos(turn), within(0.5, 1) * std::sin(turn), within(-0.2, 0.2)});
    scene.normals_world.push_back(
        glm::normalize(glm::dvec3(lean * std::cos(turn), lean * std::sin(turn), 1)));
  }
  scene.triangles.push_back({{0, 1, 2}, {0, 1, 2}, 0});
  scene.materials.push_back({.name = "m",
                             .diffuse = within(0, 0.5),
                             .specular = within(0.5, 1),
                             .exponent = random.log_within(20.0, 500.0)});
  scene.ambient = glm::dvec3(0.05);
  scene.camera.eye_world = {0, 0, within(3, 10)};
  scene.camera.vertical_fov_degrees = 2 * 57.3 * std::atan(1.1 / scene.camera.eye_world.z);
  glm::dvec3 weight(within(0, 1), within(0, 1), within(0, 1));
  weight /= weight.x + weight.y + weight.z;
  glm::dvec3 normal(0);
  for (int i = 0; i < 3; ++i) normal += weight[i] * scene.normals_world[static_cast<std::size_t>(i)];
  normal = glm::normalize(normal);
  scene.directional.push_back({2 * glm::dot(normal, to_eye) * normal - to_eye, glm::dvec3(within(0.5, 1))});
  return scene;
}

void between_samples(Trial& trial) {
  constexpr FrameSize c_patch_frame{80, 80};
  RandomScenes random(9);
  std::uint64_t split = 0;
  int unresolved = 0;
  const int patches = trial.rounds(40, 4'000);
  for (int i = 0; i < patches; ++i) {
    Scene scene = highlighted(random);
    while (Pieces(scene, c_patch_frame).all().size() != 1) scene = highlighted(random);
    const Truth truth(scene, c_patch_frame);
    const auto off = [&](const Fragment& f) {
      return colour_error(f, truth.radiance_at(f.triangle, f.x, f.y));
    };
    DrawOptions options{.frame = c_patch_frame};
    // The test is tuned to, and may exceed, twice the threshold (setup/highlight_bound.hpp). The rest is
    // rounding.
    const double bound = 2 * options.setup.quadratic.threshold + colour_bound(Preset::exact, 3 * 80);
    const Drawing ours = trial.draw(scene, options);
    split += ours.counts.subdivided;
    unresolved += ours.counts.unresolved > 0;
    if (ours.counts.unresolved == 0)
      for (const Fragment& f : ours.golden)
        trial.ours(off(f), bound, [&] { return fmt::format("patch {}, pixel {},{}", i, f.x, f.y); });
    options.setup.quadratic.test = HighlightTest::centroid;
    for (const Fragment& f : trial.draw(scene, options).golden)
      trial.published(off(f), bound, [&] { return fmt::format("patch {}, pixel {},{}", i, f.x, f.y); });
  }
  trial.require(split > 10, [] { return std::string("nothing is split"); });
  trial.remark(
      fmt::format("directional lights, exponents 20 to 500; {} of {} patches are not compared: the smallest "
                  "pieces do not resolve their highlight",
                  unresolved, patches));
}

// Pieces of all levels with samples on one quadratic. They must draw that quadratic, split or not.
void split_alike(Trial& trial) {
  RandomTriangles random(11);
  std::vector<ScreenPiece> whole, pieces;
  std::vector<std::size_t> whole_of;
  for (int i = 0; i < trial.rounds(25, 1'500); ++i) {
    const int level = 1 + i % 5;
    // In preset published vertices are pixels: use pixel centres, so that both forms use the same points.
    ScreenPiece parent{.points = random.next(TriangleKind::on_centres, c_subpixel_bits, c_frame),
                       .sample = random_samples(random)};
    if (!in_frame(parent, c_frame)) continue;
    whole.push_back(parent);
    const std::vector<Points> parts = split(parent.points, level);
    for (ScreenPoint& p : parent.points) p = {p.x << level, p.y << level};
    for (const Points& p : parts) {
      ScreenPiece piece{.points = p, .unit_bits = c_subpixel_bits + level};
      for (std::size_t n = 0; n < 6; ++n) {
        constexpr std::array<std::array<std::size_t, 2>, 6> c_ends = {
            {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
        const ScreenPoint &a = p[c_ends[n][0]], &b = p[c_ends[n][1]];
        const ExactBarycentric at_sample = barycentric(parent.points, Wide{a.x} + b.x, Wide{a.y} + b.y);
        if (at_sample.sum == 0) break;  // without area nothing is drawn
        std::array<long double, 6> sample;
        std::ranges::copy(parent.sample, sample.begin());
        piece.sample[n] = static_cast<double>(quadratic(at_sample.real(), sample));
      }
      // Setup never has negative samples.
      if (std::ranges::any_of(piece.sample, [](double s) { return s < 0; })) continue;
      pieces.push_back(piece);
      whole_of.push_back(whole.size() - 1);
    }
  }
  for (const Preset preset : {Preset::exact, Preset::published})
    for (const Fragment& f : draw_pieces(trial, preset, pieces, c_frame)) {
      const ScreenPiece& piece = pieces[f.triangle];
      trial.measure(preset, colour_off(f, whole[whole_of[f.triangle]]),
                    colour_bound(preset, most_steps(piece, c_frame)),
                    [&] { return pixel_of(piece, f.x, f.y); });
    }
}

// ---- Hard scenes of one triangle

// Draws the scene in preset exact with both tests of ours, and with the published test.
void against_model(Trial& trial, const Scene& scene, const std::string& name, FrameSize frame = {64, 48}) {
  const Pieces pieces(scene, frame);
  const double rounding = colour_bound(Preset::exact, 3.0 * frame.width);
  for (const HighlightTest test :
       {HighlightTest::conservative, HighlightTest::proved, HighlightTest::centroid}) {
    DrawOptions options{.frame = frame};
    options.setup.quadratic.test = test;
    const Drawing drawing = trial.draw(scene, options);
    const bool ours = test != HighlightTest::centroid;
    // Pieces of a side of 64 pixels are drawn pixel by pixel at the last level.
    trial.require(!drawing.golden.empty() && !(ours && drawing.counts.unresolved > 0),
                  [&] { return name + ": nothing is drawn, or a leaf is not resolved"; });
    const double bound = options.setup.quadratic.threshold * thresholds_of(test) + rounding;
    for_each_error(scene, pieces, drawing.golden, [&](double off, const Fragment& f) {
      trial.measure(ours ? Preset::exact : Preset::published, off, bound,
                    [&] { return fmt::format("{}, pixel {},{}", name, f.x, f.y); });
    });
  }
}

const std::array<glm::dvec3, 3> c_leaning = {{{0.5, 0.2, 1}, {-0.5, 0.3, 1}, {0, -0.6, 1}}};

Scene bright_stage(double exponent, Brdf brdf = Brdf::blinn) {
  Scene scene = stage(c_leaning);
  Material& m = scene.materials[0];
  m.brdf = brdf;
  m.exponent = exponent;
  m.roughness = 1 / std::sqrt(exponent);
  return scene;
}

constexpr std::array c_brdfs = {Brdf::blinn, Brdf::phong, Brdf::cook_torrance};

// A light at the surface, and at 10^-6 to 1 from it.
void light_at_the_surface(Trial& trial) {
  for (const Brdf brdf : c_brdfs)
    for (const double distance : {0.0, 1e-6, 1e-3, 0.05, 1.0}) {
      Scene scene = bright_stage(50, brdf);
      scene.positional.push_back({{0.1, -0.2, distance}, glm::dvec3(1.0)});
      against_model(trial, scene, fmt::format("light at {:g}", distance));
    }
}

// Light from behind the triangle towards the eye, exactly opposite and almost. The normals lean away from the
// eye, so that the light shines on them; the half vector turns around the point where it is 0.
void no_halfway(Trial& trial) {
  for (const Brdf brdf : c_brdfs)
    for (const double aside : {0.0, 1e-12, 1e-6, 1e-2, 0.3}) {
      Scene scene = bright_stage(2, brdf);
      for (glm::dvec3& n : scene.normals_world) n = glm::normalize(glm::dvec3(n.x, n.y, -0.3));
      scene.directional.push_back({glm::normalize(glm::dvec3(aside, aside / 3, -1)), glm::dvec3(1.0)});
      scene.positional.push_back({{aside, 0, -3}, glm::dvec3(0.5)});
      against_model(trial, scene, fmt::format("opposite but for {:g}", aside));
    }
}

// The terminator crosses the triangle, and light and eye graze it from opposite sides.
void terminator(Trial& trial) {
  for (const Brdf brdf : c_brdfs)
    for (int i = -4; i <= 4; ++i) {
      Scene scene = bright_stage(20, brdf);
      scene.directional.push_back({glm::normalize(glm::dvec3(1, 0.02, 0.15 * i)), glm::dvec3(1.0)});
      against_model(trial, scene, fmt::format("light at slope {:.2f}", 0.15 * i));
      scene.camera.eye_world = {-4, 0, 0.1 * std::abs(i) + 0.3};
      against_model(trial, scene, fmt::format("light at slope {:.2f}, eye grazing", 0.15 * i));
    }
}

// Cones whose edge crosses the triangle, from a hard edge to a soft one, from a pixel to all of the triangle.
void spots(Trial& trial) {
  for (const double outer : {0.005, 0.05, 0.3, 1.0})
    for (const double inner : {1.0, 0.999, 0.9, 0.0}) {
      Scene scene = bright_stage(50);
      scene.spots.push_back({{0.5, 0.2, 2},
                             glm::normalize(glm::dvec3(-0.5, -0.3, -2)),
                             std::cos(inner * outer),
                             std::cos(outer),
                             glm::dvec3(1.0)});
      against_model(trial, scene, fmt::format("cone of {:g}, full to {:g} of it", outer, inner));
    }
}

// A floor from behind the eye, under lights close to it. It is narrow, so that no piece of it is too large to
// resolve.
void across_the_near_plane(Trial& trial) {
  for (const double near : {0.3, 0.4, 0.6})
    for (const double exponent : {5.0, 100.0}) {
      Scene scene = bright_stage(exponent);
      scene.positions_world = {{-0.12, 0, 1.3}, {0.12, 0, 1.3}, {0, 0, -2}};
      for (glm::dvec3& n : scene.normals_world) n = glm::normalize(glm::dvec3(0.2 * n.x, 1, 0.2 * n.y));
      scene.camera.eye_world = {0, 0.12, 1};
      scene.camera.target_world = {0, 0.05, 0};
      scene.camera.near = near;
      add_side_lights(scene);
      scene.positional[0].position_world = {0.1, 0.1, 0.4};
      against_model(trial, scene, fmt::format("near plane at {:g}, exponent {:g}", near, exponent));
    }
}

// Sixteen lights with highlights in a row; together up to ten times white.
void sixteen_lights(Trial& trial) {
  for (const double intensity : {0.05, 0.2, 1.0}) {
    Scene scene = bright_stage(400);
    for (int i = 0; i < 16; ++i)
      scene.directional.push_back(
          {glm::normalize(glm::dvec3(0.12 * (i - 8), 0.05 * (i % 5 - 2), 1)), glm::dvec3(intensity)});
    against_model(trial, scene, fmt::format("sixteen lights of {:g}", intensity));
  }
}

void exponents(Trial& trial) {
  for (const Brdf brdf : c_brdfs)
    for (const double exponent : {1.0, 1.5, 2.0, 3.0, 10.0, 100.0, 1000.0}) {
      Scene scene = bright_stage(exponent, brdf);
      scene.directional.push_back({glm::normalize(glm::dvec3(0.05, 0.02, 1)), glm::dvec3(0.9)});
      scene.directional.push_back({glm::normalize(glm::dvec3(2, 0.4, 1)), glm::dvec3(0.5)});
      against_model(trial, scene, fmt::format("exponent {:g}", exponent));
    }
}

// The interpolated normal is almost zero on an edge or at a point inside.
void cancelling_normals(Trial& trial) {
  for (const double left : {1e-1, 1e-3, 1e-6}) {
    Scene scene = bright_stage(30);
    scene.directional.push_back({glm::normalize(glm::dvec3(0.3, 0.2, 1)), glm::dvec3(1.0)});
    auto& n = scene.normals_world;
    n = {{1, 0, 0}, glm::normalize(glm::dvec3(-1, left, left)), {0, 0, 1}};
    against_model(trial, scene, fmt::format("edge, {:g} left", left));
    for (int i = 0; i < 3; ++i)
      n[i] = glm::normalize(glm::dvec3(std::cos(2.0944 * i), std::sin(2.0944 * i), left));
    against_model(trial, scene, fmt::format("inside, {:g} left", left));
  }
}

// Lengths times a power of two give the same fragments. 10^-6 and 10^6 are rounded, so they are compared.
void scales(Trial& trial) {
  Scene scene = bright_stage(50);
  add_side_lights(scene);
  for (const HighlightTest test : {HighlightTest::conservative, HighlightTest::proved}) {
    DrawOptions options;
    options.setup.quadratic.test = test;
    const std::vector<Fragment> one = trial.draw(scene, options).golden;
    for (const double by : {0x1p-20, 0x1p-200, 0x1p20, 0x1p200})
      trial.require(trial.draw(scaled(scene, by), options).golden == one,
                    [&] { return fmt::format("another picture, scaled by {:g}", by); });
  }
  for (const double by : {1e-6, 1.0, 1e6})
    against_model(trial, scaled(scene, by), fmt::format("scaled by {:g}", by));
}

constexpr HardCase c_cases[] = {{"no_divisor", no_divisor},
                                {"long_spans", long_spans},
                                {"between_samples", between_samples},
                                {"split_alike", split_alike},
                                {"depths", depths},
                                {"light_at_the_surface", light_at_the_surface},
                                {"no_halfway", no_halfway},
                                {"terminator", terminator},
                                {"spots", spots},
                                {"across_the_near_plane", across_the_near_plane},
                                {"sixteen_lights", sixteen_lights},
                                {"exponents", exponents},
                                {"cancelling_normals", cancelling_normals},
                                {"scales", scales}};
INSTANTIATE_TEST_SUITE_P(quadratic, HardCases, testing::ValuesIn(c_cases), id_of);

}  // namespace
}  // namespace halfway::stability
