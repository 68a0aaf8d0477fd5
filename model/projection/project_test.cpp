// SPDX-License-Identifier: Apache-2.0
#include "projection/project.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "projection/edge.hpp"
#include "scene/mesh.hpp"
#include "scene/test/sides_apart.hpp"
#include "setup/walk_header.hpp"

namespace halfway {
namespace {

std::vector<int> coverage(std::span<const ScreenTriangle> triangles, FrameSize frame) {
  std::vector<int> count(std::size_t{frame.width} * frame.height);
  for (const ScreenTriangle& t : triangles)
    for_each_span(screen_points(t), 4, frame, [&](std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t x = begin; x < end; ++x) ++count[std::size_t{y} * frame.width + x];
    });
  return count;
}

void expect_sound(std::span<const ScreenTriangle> triangles, FrameSize frame, ProjectionOptions options) {
  const std::int32_t unit = 1 << options.subpixel_bits;
  const int last = options.clip_to_frame && options.subpixel_bits == 0 ? 1 : 0;
  const std::int32_t low = options.clip_to_frame ? 0 : c_guard_begin * unit;
  const std::int32_t high_x =
      options.clip_to_frame ? static_cast<std::int32_t>(frame.width) * unit - last : c_guard_end * unit;
  const std::int32_t high_y =
      options.clip_to_frame ? static_cast<std::int32_t>(frame.height) * unit - last : c_guard_end * unit;
  for (const ScreenTriangle& t : triangles) {
    ASSERT_GT(t.twice_area(), 0);
    for (const ScreenVertex& v : t.vertex) {
      ASSERT_GE(v.x, low);
      ASSERT_GE(v.y, low);
      ASSERT_LE(v.x, high_x);
      ASSERT_LE(v.y, high_y);
      ASSERT_GE(v.z, 0.0);
      ASSERT_LE(v.z, 1.0);
      ASSERT_GT(v.inverse_w, 0.0);
      ASSERT_TRUE(std::isfinite(v.inverse_w));
    }
  }
}

Scene empty_scene() {
  Scene scene;
  scene.camera.near = 0.5;
  scene.camera.far = 100.0;
  scene.materials.emplace_back();
  return scene;
}

Scene one_triangle(std::array<glm::dvec3, 3> corners) {
  Scene scene = empty_scene();
  scene.positions_world.assign(corners.begin(), corners.end());
  scene.normals_world = {{0, 0, 1}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}};
  return scene;
}

TEST(Project, WithoutSubpixelsAVertexIsThePixelItFallsIn) {
  Scene scene = one_triangle({{{-5, -5, 0}, {5, -5, 0}, {1.36, 5, 0}}});
  scene.camera.vertical_fov_degrees = 90.0;
  const Projector projector(scene, {64, 64}, {.subpixel_bits = 0, .clip_to_frame = true});
  const auto triangles = projector.project_all();
  ASSERT_EQ(triangles.size(), 1u);
  EXPECT_EQ(triangles[0].vertex[0].x, 0);
  EXPECT_EQ(triangles[0].vertex[0].y, 63);  // y = 64.0 is the end of the frame; its last pixel is 63
  EXPECT_EQ(triangles[0].vertex[1].x, 40);  // 32 + 1.36 * 6.4 = 40.704
  EXPECT_EQ(triangles[0].vertex[1].y, 0);
  EXPECT_EQ(triangles[0].vertex[2].x, 63);
}

/// A square of 18000 below an eye 1.7 above it, which looks to the horizon.
Scene ground_scene(double eye_height = 1.7) {
  Scene scene;
  scene.camera = {.eye_world = {0.0, eye_height, 0.0}, .target_world = {0.0, eye_height, -5.0}};
  scene.positions_world = {{-9e3, 0, -9e3}, {9e3, 0, -9e3}, {9e3, 0, 9e3}, {-9e3, 0, 9e3}};
  scene.triangles = {{{3, 2, 1}, {}, 0}, {{3, 1, 0}, {}, 0}};
  return scene;
}

TEST(Project, TheNearPlaneIsFittedToTheNearestSurfaceInView) {
  const auto range_of = [](const Scene& scene, std::uint32_t aspect = 1) {
    return Projector(scene, {100 * aspect, 100}, {}).range();
  };
  Scene scene = ground_scene();
  const double far = range_of(scene).far, nearest = 1.7 / std::tan(glm::radians(20.0));
  EXPECT_LT(range_of(scene).near, 0.9995 * nearest);
  EXPECT_GT(range_of(scene).near, 0.998 * nearest);
  // From the side, the nearest point depends on the width of the frame.
  scene.camera.up_world = {1.0, 0.0, 0.0};
  EXPECT_NEAR(range_of(scene, 2).near, 0.5 * nearest, 0.002 * nearest);
  // It keeps 1e-5 of far, obeys the camera, and ignores what is behind the eye or shows a back that is not
  // drawn.
  EXPECT_EQ(range_of(ground_scene(0.01)).near, c_least_near_part * far);
  scene.camera.near = 5.0;
  EXPECT_EQ(range_of(scene).near, 5.0);
  const Scene below = ground_scene(-1.7);
  EXPECT_EQ(range_of(below).near, c_near_part_of_far * far);
  Scene two_sided = below;
  for (SceneTriangle& triangle : two_sided.triangles) triangle.culling = Culling::none;
  EXPECT_NEAR(range_of(two_sided).near, nearest, 0.002 * nearest);
  Scene up = ground_scene();
  up.camera.target_world = {0.0, 1001.7, -1000.0};
  EXPECT_EQ(range_of(up).near, c_near_part_of_far * range_of(up).far);
}

TEST(Project, CountsTheReasonsIfNothingIsVisible) {
  const auto counts_of = [](std::array<glm::dvec3, 3> corners) {
    const Scene scene = one_triangle(corners);
    ProjectionCounts counts;
    const auto triangles = Projector(scene, {64, 64}, {}).project_all(&counts);
    EXPECT_EQ(triangles.empty(), counts.visible == 0);
    return counts;
  };
  EXPECT_EQ(counts_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}).visible, 1u);
  EXPECT_EQ(counts_of({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}}).back_facing, 1u);
  EXPECT_EQ(counts_of({{{0, 0, 4.6}, {1, 0, 9}, {0, 1, 5}}}).behind_near, 1u);
  // Cut in view; its back; behind the eye
  const auto cut = [&](std::array<glm::dvec3, 3> corners) { return counts_of(corners).cut_by_near; };
  EXPECT_EQ(cut({{{-1, -0.02, 4.8}, {1, -0.02, 4.8}, {0, 1, 0}}}), 1u);
  EXPECT_EQ(cut({{{-1, -0.02, 4.8}, {0, 1, 0}, {1, -0.02, 4.8}}}), 0u);
  EXPECT_EQ(cut({{{-1, -0.02, 5.2}, {1, -0.02, 5.2}, {0, 1, 6}}}), 0u);
  // Wholly before the near plane: in the frame, and beside it
  for (const glm::dvec3& at : {glm::dvec3(0, 0, 4.8), {1, 0, 4.8}, {-1, 0, 4.8}, {0, 1, 4.8}, {0, -1, 4.8}})
    EXPECT_EQ(cut({at, at + glm::dvec3(0.02, 0, 0), at + glm::dvec3(0, 0.02, 0)}), at.x == 0 && at.y == 0)
        << at.x;
  EXPECT_EQ(counts_of({{{0, 0, -96}, {1, 0, -100}, {0, 1, -200}}}).outside, 1u);
  EXPECT_EQ(counts_of({{{90, 0, 0}, {91, 0, 0}, {90, 1, 0}}}).outside, 1u);
  EXPECT_EQ(counts_of({{{1e9, 0, 0}, {2e9, 0, 0}, {1e9, 1e9, 0}}}).outside, 1u);
  EXPECT_EQ(counts_of({{{0, 0, 0}, {1e-5, 0, 0}, {0, 1e-5, 0}}}).degenerate, 1u);
  EXPECT_EQ(counts_of({{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}).degenerate, 1u);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (double bad : {nan, inf, -inf, 1e200, -1e300})
    EXPECT_EQ(counts_of({{{0, 0, 0}, {1, 0, 0}, {0, bad, 0}}}).unrepresentable, 1u) << bad;
}

TEST(Project, ACornerNearInfinityIsCutCorrectly) {
  // A band of 45 degrees from the middle of the frame up to one of its corners, and its mirror image.
  const FrameSize frame{64, 64};
  for (const bool to_the_left : {false, true}) {
    const double side = to_the_left ? -1.0 : 1.0;
    const glm::dvec3 inner{-0.1 * side, 0, 0}, outer{side, 0, 0}, far{1e60 * side, 1e60, 0};
    Scene scene = to_the_left ? one_triangle({{inner, far, outer}}) : one_triangle({{inner, outer, far}});
    scene.camera.vertical_fov_degrees = 90.0;
    for (bool clip_to_frame : {false, true}) {
      const auto triangles = Projector(scene, frame, {.clip_to_frame = clip_to_frame}).project_all();
      const std::vector<int> count = coverage(triangles, frame);
      for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {  // relative to the diagonal the band covers -0.625 to 6.375 pixels
          const double from_middle = (x + 0.5 - 32.0) * side - (32.0 - (y + 0.5));
          const bool covered = y < 32 && from_middle > -0.625 && from_middle < 6.375;
          ASSERT_EQ(count[static_cast<std::size_t>(y * 64 + x)], covered ? 1 : 0) << x << ',' << y;
        }
    }
  }
  // With two such corners, no digits remain that determine the position of the edge between them.
  const Scene scene = one_triangle({{{0, 0, 0}, {1e60, 0, 0}, {-1e60, 1e60, 3}}});
  ProjectionCounts counts;
  EXPECT_TRUE(Projector(scene, frame, {}).project_all(&counts).empty());
  EXPECT_EQ(counts.unrepresentable, 1u);
}

TEST(Project, ACameraWithoutAViewDrawsNothingAndReportsIt) {
  Scene scene = one_triangle({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  scene.camera.up_world = {0, 0, 1};  // along the viewing axis
  ProjectionCounts counts;
  EXPECT_TRUE(Projector(scene, {64, 64}, {}).project_all(&counts).empty());
  EXPECT_EQ(counts.unrepresentable, 1u);
  scene.camera.up_world = {0, 1, 0};
  for (int bits : {-1, 10, 1000}) {
    counts = {};
    EXPECT_TRUE(Projector(scene, {64, 64}, {.subpixel_bits = bits}).project_all(&counts).empty());
    EXPECT_EQ(counts.unrepresentable, 1u);
  }
}

/// Ground in the world's plane y = 0, cells jittered within the plane, `half` units to each side of the
/// origin.
Scene ground_scene(unsigned seed, int cells, double half) {
  Scene scene;
  scene.materials.emplace_back();
  scene.normals_world = {{0, 1, 0}};
  std::mt19937 random(seed);
  const double cell = 2.0 * half / cells;
  std::uniform_real_distribution<double> jitter(-0.3 * cell, 0.3 * cell);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      scene.positions_world.emplace_back(-half + i * cell + jitter(random), 0.0,
                                         -half + j * cell + jitter(random));
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      // Counter-clockwise seen from above; z points towards the viewer.
      if (random() % 2)
        scene.triangles.insert(scene.triangles.end(), {{{a, d, c}, {0, 0, 0}, 0}, {{a, c, b}, {0, 0, 0}, 0}});
      else
        scene.triangles.insert(scene.triangles.end(), {{{a, d, b}, {0, 0, 0}, 0}, {{b, d, c}, {0, 0, 0}, 0}});
    }
  return scene;
}

/// Ground that extends from behind the eye to beyond the far plane, so that triangles cross the near plane,
/// the far plane, the guard band and the frame.
struct GroundView {
  Scene scene;
  FrameSize frame;
  ViewBasis basis;
  double focal;

  GroundView(std::mt19937& random, unsigned seed, FrameSize size)
      : scene(ground_scene(seed, 5, 40.0)), frame(size) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Camera& camera = scene.camera;
    camera.eye_world = {3.0 * unit(random), 1.0, 3.0 * unit(random)};
    camera.target_world = camera.eye_world + glm::dvec3(unit(random), -0.45, -1.0);
    camera.up_world = {0.6 * unit(random), 1.0, 0.0};
    camera.vertical_fov_degrees = 75.0;
    camera.near = 0.8;
    camera.far = 12.0;
    basis = view_basis(camera);
    focal = 0.5 * frame.height / std::tan(glm::radians(37.5));
  }
  /// True if the ray through this place of the screen meets ground between the near and the far plane.
  bool shows(double x, double y) const {
    const glm::dvec3 ray = (x - 0.5 * frame.width) / focal * basis.right_world -
                           (y - 0.5 * frame.height) / focal * basis.up_world - basis.backward_world;
    const double distance = -scene.camera.eye_world.y / ray.y;  // along the viewing axis
    return distance >= scene.camera.near && distance <= scene.camera.far;
  }
  /// How many of four rays around a pixel's centre do. Snapped borders move by up to 1/32 of a pixel.
  int shown_around(std::uint32_t x, std::uint32_t y) const {
    constexpr double c_low = 0.5 - 1.0 / 16.0, c_high = 0.5 + 1.0 / 16.0;
    return shows(x + c_low, y + c_low) + shows(x + c_low, y + c_high) + shows(x + c_high, y + c_low) +
           shows(x + c_high, y + c_high);
  }
};

// The ray through each pixel determines whether it must show ground.
TEST(Project, GroundThroughNearPlaneAndGuardBandIsWatertight) {
  std::mt19937 random(99);
  int clipped_at_guard = 0, clipped_at_near = 0;
  for (unsigned round = 0; round < 60; ++round) {
    const GroundView view(random, round, {round % 2 ? 120u : 1000u, round % 2 ? 90u : 700u});
    for (bool clip_to_frame : {false, true}) {
      const ProjectionOptions options{.subpixel_bits = 4, .clip_to_frame = clip_to_frame};
      const auto triangles = Projector(view.scene, view.frame, options).project_all();
      expect_sound(triangles, view.frame, options);
      if (HasFatalFailure()) return;
      for (const ScreenTriangle& t : triangles)
        for (const ScreenVertex& v : t.vertex) {
          clipped_at_guard += !clip_to_frame && (v.x == c_guard_begin * 16 || v.x == c_guard_end * 16 ||
                                                 v.y == c_guard_begin * 16 || v.y == c_guard_end * 16);
          clipped_at_near += std::abs(v.inverse_w * view.scene.camera.near - 1.0) < 1e-9;
        }
      const std::vector<int> count = coverage(triangles, view.frame);
      for (std::uint32_t y = 0; y < view.frame.height; ++y)
        for (std::uint32_t x = 0; x < view.frame.width; ++x) {
          const int here = count[std::size_t{y} * view.frame.width + x];
          const bool inside = view.shows(x + 0.5, y + 0.5);
          if (view.shown_around(x, y) == (inside ? 4 : 0)) {
            ASSERT_EQ(here, inside ? 1 : 0) << "round " << round << " pixel " << x << ',' << y;
          } else {
            ASSERT_LE(here, 1);
          }
        }
    }
  }
  // The scenes must contain enough such cases for the test to be meaningful.
  EXPECT_GT(clipped_at_guard, 100);
  EXPECT_GT(clipped_at_near, 100);
}

// The corners of a polygon, whichever of them its fan starts from.
std::set<std::tuple<std::int32_t, std::int32_t, double, double>> corners_of(
    std::span<const ScreenTriangle> pieces) {
  std::set<std::tuple<std::int32_t, std::int32_t, double, double>> corners;
  for (const ScreenTriangle& piece : pieces)
    for (const ScreenVertex& v : piece.vertex) corners.insert({v.x, v.y, v.z, v.inverse_w});
  return corners;
}

// Two triangles, front and back, are the same as one that is drawn from both sides.
TEST(Project, ABackIsTheFrontOfAReversedTriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  Scene scene = empty_scene();
  scene.camera.near = 3.8;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const std::array<std::uint32_t, 3> corner{3 * i, 3 * i + 1, 3 * i + 2};
    scene.triangles.push_back({corner, corner, 0, Culling::none});
    for (int k = 0; k < 3; ++k) {
      scene.positions_world.push_back(2.0 * point());
      scene.normals_world.push_back(glm::normalize(point()));
    }
  }
  const Scene apart = sides_apart(scene);
  const FrameSize frame{160, 120};
  const Projector projector(scene, frame, {}), projector_apart(apart, frame, {});
  MeshProjector mesh(projector);
  ProjectionCounts counts;
  int backs = 0, fronts = 0, averted = 0, cut = 0, slivers = 0;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    std::vector<ScreenTriangle> wanted, alone;
    projector_apart.project(2 * i, wanted);
    const bool is_back = wanted.empty();
    if (is_back) projector_apart.project(2 * i + 1, wanted);
    projector.project(i, alone);
    const std::span<const ScreenTriangle> got = mesh.project(i, counts);
    // Which pieces of a cut sliver have an area depends on the corner where its fan starts.
    std::int64_t twice_area = 0;
    for (const ScreenTriangle& piece : alone) twice_area += piece.twice_area();
    if (twice_area < 1000 && !alone.empty() && !alone[0].is_whole) {
      ++slivers;
      continue;
    }
    ASSERT_EQ(corners_of(alone), corners_of(wanted)) << i;
    ASSERT_EQ(corners_of(got), corners_of(wanted)) << i;
    const bool is_averted = has_averted_normals(scene, scene.triangles[i]);
    for (const ScreenTriangle& piece : got) {
      EXPECT_EQ(piece.is_back, is_back);
      EXPECT_GT(piece.twice_area(), 0);
      EXPECT_EQ(piece.source, i);
      if (got.size() != 1 || wanted.size() != 1) {
        ++cut;
        continue;
      }
      for (const ScreenVertex& v : piece.vertex) {
        const auto& all = wanted[0].vertex;
        const auto same = std::find_if(all.begin(), all.end(), [&](const ScreenVertex& w) {
          return w.position_world == v.position_world && w.normal_world == v.normal_world;
        });
        ASSERT_NE(same, all.end()) << i;
        ASSERT_EQ(std::tuple(v.x, v.y, v.z, v.inverse_w),
                  std::tuple(same->x, same->y, same->z, same->inverse_w));
      }
      EXPECT_FALSE(piece.is_whole && (is_back || is_averted));
      ++(is_back ? backs : fronts);
      averted += is_averted;
    }
  }
  EXPECT_EQ(counts.back_facing, 0u);
  EXPECT_EQ(counts.visible, 400 - counts.behind_near - counts.outside - counts.degenerate);
  EXPECT_GT(backs, 50);
  EXPECT_GT(fronts, 50);
  EXPECT_GT(averted, 50);
  EXPECT_GT(cut, 50);
  EXPECT_LT(slivers, 20);
}

TEST(Project, CountsBacksThatAreLeftOutAlthoughInView) {
  Scene scene = one_triangle({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}});
  for (const Culling culling : {Culling::closed, Culling::back, Culling::none})
    for (const bool turned : {false, true}) {
      scene.triangles[0].culling = culling;
      scene.triangles[0].position = {0, turned ? 2U : 1U, turned ? 1U : 2U};
      ProjectionCounts counts;
      Projector(scene, {64, 64}, {}).project_all(&counts);
      const bool is_drawn = turned || culling == Culling::none;
      EXPECT_EQ(counts.visible, is_drawn);
      EXPECT_EQ(counts.back_facing, !is_drawn);
      EXPECT_EQ(counts.left_out, !is_drawn && culling == Culling::back);
    }
}

// Two triangles at one edge, with opposite directions of the edge, in any position: the cut points on the
// edge are equal.
TEST(Project, ASharedEdgeIsCutAtTheSamePoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(9 * unit(random), 9 * unit(random), 9 * unit(random)); };
  int cuts = 0;
  for (int round = 0; round < 3000; ++round) {
    Scene scene = one_triangle({point(), point(), point()});
    scene.positions_world.push_back(point());
    scene.camera.far = 11.0;
    const FrameSize frame{64, 48};
    // Find cut points by their approximate place along the edge, and compare their coordinates exactly.
    const auto cut_points = [&](SceneTriangle t) {
      scene.triangles = {t};
      std::map<std::int64_t, std::array<double, 5>> found;
      for (int turn = 0; turn < 2; ++turn) {  // seen from both sides
        if (turn) std::swap(scene.triangles[0].position[1], scene.triangles[0].position[2]);
        for (const ScreenTriangle& s :
             Projector(scene, frame, {.clip_to_frame = round % 2 == 0}).project_all())
          for (const ScreenVertex& v : s.vertex) {
            const glm::dvec3 p = v.position_world, a = scene.positions_world[0], b = scene.positions_world[1];
            const double along = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
            if (glm::length(p - (a + along * (b - a))) < 1e-12 && along > 1e-9 && along < 1 - 1e-9)
              found[std::llround(along * 1e7)] = {double(v.x), double(v.y), p.x, p.y, p.z};
          }
      }
      return found;
    };
    const auto first = cut_points({{0, 1, 2}, {0, 0, 0}, 0});
    const auto second = cut_points({{1, 0, 3}, {0, 0, 0}, 0});
    for (const auto& [along, point_of_first] : first)
      if (const auto it = second.find(along);
          it != second.end()) {  // the piece of the other may have zero area after snapping
        ASSERT_EQ(point_of_first, it->second) << round;
        ++cuts;
      }
  }
  EXPECT_GT(cuts, 300);
}

TEST(SurfacePoint, BarycentricsAreExactAtVerticesAndMidpoints) {
  std::mt19937 random(18);
  std::uniform_int_distribution<std::int32_t> coordinate(0, 64 * 16);
  for (int round = 0; round < 200; ++round) {
    ScreenTriangle t{};
    do {
      for (ScreenVertex& v : t.vertex) v.x = coordinate(random), v.y = coordinate(random);
    } while (t.twice_area() < 64 * 256);
    const auto& [a, b, c] = t.vertex;
    EXPECT_EQ(barycentric_screen(t, 2 * a.x, 2 * a.y), glm::dvec3(1, 0, 0));
    EXPECT_EQ(barycentric_screen(t, 2 * b.x, 2 * b.y), glm::dvec3(0, 1, 0));
    EXPECT_EQ(barycentric_screen(t, 2 * c.x, 2 * c.y), glm::dvec3(0, 0, 1));
    EXPECT_EQ(barycentric_screen(t, b.x + c.x, b.y + c.y), glm::dvec3(0, 0.5, 0.5));
  }
}

TEST(SurfacePoint, OpposedNormalsFallBackToTheTrianglesOwn) {
  Scene scene = one_triangle({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}});
  auto triangle = Projector(scene, {64, 64}, {}).project_all().at(0);
  triangle.vertex[0].normal_world = {1, 0, 0};
  triangle.vertex[1].normal_world = {-1, 0, 0};
  EXPECT_EQ(surface_point(triangle, {0.5, 0.5, 0.0}).normal_world, glm::dvec3(0, 0, 1));  // towards the eye
  // One rounding next to it, the direction is still noise.
  EXPECT_EQ(surface_point(triangle, {0.5 + 1e-15, 0.5 - 1e-15, 0.0}).normal_world, glm::dvec3(0, 0, 1));
  EXPECT_FALSE(surface_point(triangle, {0.5, 0.5, 0.0}).is_smooth());
  EXPECT_NEAR(surface_point(triangle, {0.6, 0.4, 0.0}).normal_world.x, 1.0, 1e-15);
  EXPECT_NEAR(surface_point(triangle, {0.6, 0.4, 0.0}).normal_length, 0.2, 1e-15);
  // If the corners have no normal either, the result is still a unit vector.
  for (ScreenVertex& v : triangle.vertex) v.position_world = v.normal_world = glm::dvec3(0.0);
  EXPECT_EQ(glm::length(surface_point(triangle, {0.2, 0.3, 0.5}).normal_world), 1.0);
}

}  // namespace
}  // namespace halfway
