// SPDX-License-Identifier: Apache-2.0
// Own tables: which exponents get one, the bells that use them, and the hardware that contains them.
#include "plan/own_bells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/test/is_error.hpp"
#include "plan/test/planned.hpp"
#include "words/generator/cosine.hpp"

namespace halfway {
namespace {

using ::testing::ElementsAre, ::testing::HasSubstr;

// A triangle per exponent, and one without a highlight.
Scene scene_with(const std::vector<double>& exponents) {
  Scene scene = with_lights(1);
  scene.materials[0] = {.name = "matt", .specular = 0.0, .exponent = 7.0};
  for (const double n : exponents) wear(scene, {.name = "shiny", .specular = 0.5, .exponent = n});
  return scene;
}

TEST(OwnBells, AreThoseOfVisibleHighlights) {
  Scene scene = scene_with({50.0, 5.5, 50.0});
  scene.materials.push_back({.name = "unused", .specular = 0.5, .exponent = 9.0});
  const auto own = own_exponents(scene);
  ASSERT_TRUE(own);
  EXPECT_THAT(*own, ElementsAre(5.5, 50.0));
  EXPECT_EQ(own_powers(*own), 6U);
  for (const auto& [n, power] : {std::pair{5.5, 2}, {50.0, 4}}) {
    const Bell bell = own_bell(*own, n);
    EXPECT_EQ(bell.power, power);
    EXPECT_EQ(bell.gain, 1.0);
    // The table's end is one half bell from the peak.
    EXPECT_DOUBLE_EQ(bell.scale * tables::own_reach(n), std::numbers::pi / 2);
  }
}

TEST(OwnBells, AreAtMostFour) {
  EXPECT_TRUE(own_exponents(scene_with({2, 3, 4, 5})));
  EXPECT_TRUE(is_error(own_exponents(scene_with({2, 3, 4, 5, 6})), "5 different exponents"));
}

TEST(OwnBells, ExponentsAreClamped) {
  const auto own = own_exponents(scene_with({1e7, 1e9}));
  ASSERT_TRUE(own);
  EXPECT_THAT(*own, ElementsAre(c_largest_exponent));
  EXPECT_EQ(own_bell(*own, 1e8).power, 2);
}

TEST(OwnBells, HardwareIsNamedByItsExponents) {
  const Scene scene = scene_with({5.5, 50.0});
  const auto names = [&](std::vector<double> own, bool all) {
    const auto plan =
        plan_scene(scene, {.shader = Shader::spherical, .own = std::move(own), .all_effects = all});
    EXPECT_TRUE(plan);
    return plan->key.name();
  };
  EXPECT_THAT(names({5.5, 50.0}, false), HasSubstr("-own5.5_50-rom"));
  EXPECT_THAT(names({5.5, 50.0}, true), HasSubstr("-own5.5_50-rom"));
  EXPECT_THAT(names({}, false), HasSubstr("-cos8.16-rom"));
}

}  // namespace
}  // namespace halfway
