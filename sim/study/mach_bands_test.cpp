// SPDX-License-Identifier: Apache-2.0
#include "sim/study/mach_bands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "projection/project.hpp"

namespace halfway::study {
namespace {

// A square of two triangles that fills the frame. Its diagonal rises from lower left to upper right.
Scene square() {
  Scene scene;
  scene.camera.eye_world = {0.0, 0.0, 5.0};
  scene.positions_world = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  scene.normals_world = {{0, 0, 1}, {0, 0, 1}};
  scene.materials.resize(1);
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}, {{0, 2, 3}, {0, 0, 0}, 0}};
  return scene;
}

constexpr FrameSize c_size{128, 128};

// Brightness decreases by `steps` per diagonal of pixels on both sides of the frame's diagonal. Whole steps
// avoid rounding.
Frame roof(int steps) {
  Frame frame(c_size);
  for (std::uint32_t y = 0; y < c_size.height; ++y)
    for (std::uint32_t x = 0; x < c_size.width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        frame.rgb[frame.offset(x, y) + c] = static_cast<std::uint8_t>(
            std::max(0, 200 - steps * std::abs(static_cast<int>(x) + static_cast<int>(y) - 127)));
  return frame;
}

TEST(MachBands, AreTheJumpOfTheSlopeAcrossAnEdge) {
  const Scene scene = square();
  const auto triangles = Projector(scene, c_size, {}).project_all();
  ASSERT_EQ(triangles.size(), 2U);
  const auto bands = mach_bands(roof(2), roof(0), scene, triangles);
  EXPECT_EQ(bands.edges, 1U);
  EXPECT_NEAR(bands.largest, 2 * 2 * std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(bands.rms, bands.largest, 1e-12);
}

TEST(MachBands, TheReferencesJumpsAreSubtracted) {
  const Scene scene = square();
  const auto triangles = Projector(scene, c_size, {}).project_all();
  const auto bands = mach_bands(roof(2), roof(2), scene, triangles);
  EXPECT_EQ(bands.edges, 1U);
  EXPECT_EQ(bands.largest, 0.0);
}

TEST(MachBands, ACreaseIsNotEvaluated) {
  Scene scene = square();
  scene.triangles[1].normal = {1, 1, 1};
  const auto triangles = Projector(scene, c_size, {}).project_all();
  const auto bands = mach_bands(roof(2), roof(0), scene, triangles);
  EXPECT_EQ(bands.edges, 0U);
}

TEST(MachBands, HiddenTrianglesAreNotEvaluated) {
  Scene scene = square();
  // Cover part of one triangle.
  scene.positions_world.insert(scene.positions_world.end(), {{-1, -0.9, 0.5}, {1, 1, 0.5}, {-1, 1, 0.5}});
  scene.triangles.push_back({{4, 5, 6}, {0, 0, 0}, 0});
  const auto triangles = Projector(scene, c_size, {}).project_all();
  ASSERT_EQ(triangles.size(), 3U);
  const auto bands = mach_bands(roof(2), roof(0), scene, triangles);
  EXPECT_EQ(bands.edges, 0U);
}

}  // namespace
}  // namespace halfway::study
