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

MachBands bands_of(const Scene& scene, const Frame& frame, const Frame& reference) {
  return mach_bands(frame, reference, scene, Projector(scene, c_size, {}).project_all());
}

TEST(MachBands, AreTheJumpOfTheSlopeAcrossAnEdgeWithoutTheReferences) {
  const auto bands = bands_of(square(), roof(2), roof(0)), same = bands_of(square(), roof(2), roof(2));
  EXPECT_EQ(bands.edges, 1U);
  EXPECT_NEAR(bands.largest, 2 * 2 * std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(bands.rms, bands.largest, 1e-12);
  EXPECT_EQ(same.edges, 1U);
  EXPECT_EQ(same.largest, 0.0);
}

TEST(MachBands, CreasesAndHiddenTrianglesAreNotEvaluated) {
  Scene crease = square(), hidden = square();
  crease.triangles[1].normal = {1, 1, 1};
  EXPECT_EQ(bands_of(crease, roof(2), roof(0)).edges, 0U);
  // Cover part of one triangle.
  hidden.positions_world.insert(hidden.positions_world.end(), {{-1, -0.9, 0.5}, {1, 1, 0.5}, {-1, 1, 0.5}});
  hidden.triangles.push_back({{4, 5, 6}, {0, 0, 0}, 0});
  EXPECT_EQ(bands_of(hidden, roof(2), roof(0)).edges, 0U);
}

}  // namespace
}  // namespace halfway::study
