// SPDX-License-Identifier: Apache-2.0
#include "reference/renderer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <span>
#include <vector>

#include "projection/project.hpp"
#include "reference/spherical_renderer.hpp"
#include "scene/test/sides_apart.hpp"
#include "shading/shade.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_frame{70, 53};

/// Unconnected, overlapping and intersecting triangles of two materials, with one light of each kind. Some
/// are there twice, in both materials.
Scene tangle(unsigned seed, int triangles) {
  Scene scene;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  scene.background = {0.2, 0.4, 0.6};
  scene.materials.resize(2);
  scene.materials[0].colour = {1.0, 0.5, 0.2};
  scene.materials[1].brdf = Brdf::phong;
  scene.directional = {{glm::normalize(glm::dvec3(1, 2, 3)), {0.5, 0.6, 0.7}}};
  scene.positional = {{{-2, 2, 3}, {0.3, 0.3, 0.3}}};
  scene.spots = {{{0, 0, 4}, {0, 0, -1}, 0.98, 0.9, {0.4, 0.2, 0.2}}};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(triangles); ++i) {
    for (int k = 0; k < 3; ++k) {
      scene.positions_world.push_back(2.0 * point());
      scene.normals_world.push_back(glm::normalize(point() + glm::dvec3(0, 0, 1.8)));
    }
    const std::array<std::uint32_t, 3> corners{3 * i, 3 * i + 1, 3 * i + 2};
    scene.triangles.push_back({corners, corners, i % 2});
    if (i % 5 == 0) scene.triangles.push_back({corners, corners, 1 - i % 2});
  }
  return scene;
}

// One triangle at a time, with sums above white at vertices, which must not be clamped before interpolation.
// Which triangle a pixel shows is decided as in render_reference, whose pictures
// tb/specification/oracle compares with the equations.
TEST(Renderer, GouraudInterpolatesTheColoursOfTheVertices) {
  Scene scene = tangle(1, 120);
  scene.directional[0].intensity *= 3.0;
  int covered = 0, above_white = 0;
  for (const ScreenTriangle& t : Projector(scene, c_frame, {}).project_all()) {
    const ReferenceImage image = render_gouraud(scene, {&t, 1}, {.frame = c_frame});
    for (std::uint32_t y = 0; y < c_frame.height; ++y)
      for (std::uint32_t x = 0; x < c_frame.width; ++x) {
        const std::size_t rgb = image.frame.offset(x, y);
        if (image.mask[rgb / 3] == 0) continue;
        ++covered;
        const glm::dvec3 weights = barycentric_screen(t, 32 * x + 16, 32 * y + 16);
        glm::dvec3 linear(0.0);
        for (int i = 0; i < 3; ++i) {
          const glm::dvec3 at_vertex =
              radiance(scene, scene.materials[t.material], t.vertex[i].position_world,
                       glm::normalize(t.vertex[i].normal_world));
          linear += weights[i] * at_vertex;
          above_white += at_vertex.r > 1.0;
        }
        for (int k = 0; k < 3; ++k)
          ASSERT_NEAR(image.frame.rgb[rgb + k], 255 * std::min(linear[k], 1.0), 0.5 + 1e-9) << x << ',' << y;
      }
  }
  EXPECT_GT(covered, 1000);
  EXPECT_GT(above_white, 100);
}

TEST(Renderer, BacksAreShadedAsFronts) {
  const Scene scene = drawn_from_both_sides(tangle(3, 120));
  const Scene apart = sides_apart(scene);
  const auto triangles = Projector(scene, c_frame, {}).project_all();
  const auto triangles_apart = Projector(apart, c_frame, {}).project_all();
  EXPECT_GT(triangles.size(), Projector(tangle(3, 120), c_frame, {}).project_all().size() + 40);
  const auto expect_same = [](const ReferenceImage& image, const ReferenceImage& wanted) {
    EXPECT_EQ(image.frame.rgb, wanted.frame.rgb);
    EXPECT_EQ(image.mask, wanted.mask);
  };
  expect_same(render_reference(scene, triangles, {.frame = c_frame}),
              render_reference(apart, triangles_apart, {.frame = c_frame}));
  expect_same(render_gouraud(scene, triangles, {.frame = c_frame}),
              render_gouraud(apart, triangles_apart, {.frame = c_frame}));
}

// A sheet that the light meets from behind: its back is lit, and its front is dark.
TEST(Renderer, ALightReachesTheBackThatItMeets) {
  Scene scene;
  scene.shadows = true;
  scene.materials.emplace_back();
  scene.materials[0].ambient = scene.materials[0].specular = 0.0;
  scene.directional = {{{0, 0, -1}, {1, 1, 1}}};
  scene.positions_world = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  scene.normals_world = {{0, 0, 1}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0, Culling::none}};
  for (const double side : {-5.0, 5.0}) {
    scene.camera.eye_world = {0, 0, side};
    const auto triangles = Projector(scene, c_frame, {}).project_all();
    ASSERT_EQ(triangles.size(), 1u);
    const ReferenceImage image = render_reference(scene, triangles, {.frame = c_frame});
    EXPECT_EQ(image.frame.rgb[image.frame.offset(35, 26)], side < 0.0 ? to_byte(0.6) : 0);
  }
}

using Render =
    std::function<ReferenceImage(const Scene&, std::span<const ScreenTriangle>, const RenderOptions&)>;

// The renderer of the spherical paper keeps data of a line and of a triangle.
const std::array<Render, 3> c_renderers = {
    render_reference, render_gouraud,
    [](const Scene& scene, std::span<const ScreenTriangle> triangles, const RenderOptions& options) {
      return render_spherical(scene, triangles, options, {.ends = SpanEnds::slerped_along_edges});
    }};

TEST(Renderer, TheNumberOfThreadsDoesNotMatter) {
  Scene scene = tangle(2, 300);
  scene.shadows = true;
  const auto triangles = Projector(scene, {90, 200}, {}).project_all();
  for (const Render& render : c_renderers) {
    const ReferenceImage one = render(scene, triangles, {.frame = {90, 200}});
    for (unsigned threads : {0u, 2u, 3u, 16u, 100u}) {
      const ReferenceImage many =
          render(scene, triangles, {.frame = {90, 200}, .workers = on_threads(threads)});
      ASSERT_EQ(one.frame.rgb, many.frame.rgb);
      ASSERT_EQ(one.mask, many.mask);
    }
  }
}

// An emitting square in front of a background. Its edges lie 1/4, 1/2 and 3/4 pixel behind the edges of
// pixels.
TEST(Renderer, FilteredPixelsAreMeansOfSamples) {
  Scene scene;
  scene.background = {0.2, 0.4, 0.6};
  scene.materials.resize(1);
  scene.materials[0].colour = glm::dvec3(0.0);
  scene.materials[0].emission = {1.0, 0.5, 7.0};
  scene.positions_world = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  scene.normals_world = {{0, 0, 1}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}, {{0, 2, 3}, {0, 0, 0}, 0}};
  const FrameSize frame{8, 7};
  const std::int32_t left = 2 * 16 + 4, right = 6 * 16 + 12, top = 1 * 16 + 8, bottom = 4 * 16;
  const auto vertex = [](std::int32_t x, std::int32_t y) {
    ScreenVertex v{};
    v.x = x;
    v.y = y;
    v.inverse_w = 1.0;
    v.normal_world = {0, 0, 1};
    return v;
  };
  std::vector<ScreenTriangle> triangles(2);
  triangles[0].vertex = {vertex(left, bottom), vertex(right, bottom), vertex(right, top)};
  triangles[1].vertex = {vertex(left, bottom), vertex(right, top), vertex(left, top)};
  const std::array<std::int64_t, 4> weights = {9, 3, 3, 1};
  const ReferenceImage image = render_filtered(scene, triangles, {.frame = frame}, weights);
  // The share of a pixel that is covered.
  const auto covered = [&](std::int32_t x, std::int32_t y) {
    const auto within = [](std::int32_t first, std::int32_t end, std::int32_t pixel) {
      return std::max(0, std::min(end, 16 * pixel + 16) - std::max(first, 16 * pixel)) / 16.0;
    };
    return x < 0 || y < 0 ? 0.0 : within(left, right, x) * within(top, bottom, y);
  };
  for (std::int32_t y = 0; y < 7; ++y)
    for (std::int32_t x = 0; x < 8; ++x) {
      const double share =
          (9 * covered(x, y) + 3 * covered(x - 1, y) + 3 * covered(x, y - 1) + covered(x - 1, y - 1)) / 16;
      const std::size_t rgb =
          image.frame.offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      EXPECT_EQ(image.mask[rgb / 3], share > 0.0) << x << ',' << y;
      const glm::dvec3 expected = share * glm::dvec3(1.0, 0.5, 1.0) + (1.0 - share) * scene.background;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.frame.rgb[rgb + static_cast<std::size_t>(c)], 255.0 * expected[c], 0.501)
            << x << ',' << y;
    }
}

TEST(Reference, TilesArePartsOfTheFrame) {
  Scene scene = tangle(7, 60);
  scene.shadows = true;
  const auto triangles = Projector(scene, c_frame, {}).project_all();
  for (const Render& render : c_renderers) {
    const ReferenceImage whole = render(scene, triangles, {.frame = c_frame});
    EXPECT_GT(std::ranges::count(whole.mask, 1), 2000);
    for (const Tile& tile : tiles_of(c_frame, {23, 19})) {
      const ReferenceImage part = render(scene, triangles, {.frame = c_frame, .tile = tile});
      ASSERT_EQ(part.frame.size, tile.size);
      for (std::uint32_t y = 0; y < tile.size.height; ++y)
        for (std::uint32_t x = 0; x < tile.size.width; ++x) {
          const std::size_t here = part.frame.offset(x, y),
                            there = whole.frame.offset(tile.x + x, tile.y + y);
          ASSERT_EQ(part.mask[here / 3], whole.mask[there / 3]) << tile.x + x << "," << tile.y + y;
          for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(part.frame.rgb[here + k], whole.frame.rgb[there + k]);
        }
    }
  }
}

}  // namespace
}  // namespace halfway
