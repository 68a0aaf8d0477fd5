// SPDX-License-Identifier: Apache-2.0
// The promise of --threshold: each pixel of the quadratic shader's picture is that close to the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "plan/plan.hpp"
#include "projection/project.hpp"
#include "reference/renderer.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

class Threshold : public testing::TestWithParam<const char*> {};

// Small pictures, where most triangles cover a pixel or two, and larger ones. The test of a leaf is
// tuned to, and may exceed, twice the threshold (setup/highlight_bound.hpp); the rest is the rounding of both
// pictures.
TEST_P(Threshold, EveryPixelOfABuiltInSceneIsWithinIt) {
  auto scene = built_in_scene(GetParam());
  scene.shadows = false;  // the quadratic shader draws none
  const HardwareKey key = plan_scene(scene, {.shader = Shader::quadratic})->key;
  const SetupOptions options;
  for (const FrameSize frame :
       {FrameSize{32, 24}, FrameSize{57, 41}, FrameSize{128, 96}, FrameSize{320, 240}}) {
    FrameDriver driver(scene, frame, key, {}, {.setup = options, .golden_picture = true});
    must(driver.draw());
    EXPECT_EQ(driver.counts().unresolved, 0u);
    const FrameAssembler& drawn = driver.golden_frame();
    ASSERT_GT(drawn.covered_pixels(), 100u);
    const ReferenceImage reference =
        render_reference(scene, Projector(scene, frame, ProjectionOptions{}).project_all(), {.frame = frame});
    ASSERT_EQ(drawn.mask(), reference.mask);
    int largest = 0;
    for (std::size_t i = 0; i < reference.frame.rgb.size(); ++i)
      largest = std::max(largest, std::abs(drawn.frame().rgb[i] - reference.frame.rgb[i]));
    EXPECT_LE(largest, 2 * options.quadratic.threshold + 1) << frame.width << 'x' << frame.height;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Threshold, testing::ValuesIn(c_built_in_names),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace halfway
