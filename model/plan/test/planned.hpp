// SPDX-License-Identifier: Apache-2.0
// For tests: a scene of one triangle, and the plan of a scene.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "plan/plan.hpp"
#include "sim/os/must.hpp"

namespace halfway {

/// One flat triangle, all grey, without lights. Its normals are two by index and one by value. Exponent 2:
/// the bell equals cos^2.
inline Scene grey_scene() {
  Scene scene;
  scene.name = "s";
  scene.materials = {{.name = "plain", .exponent = 2.0}};
  scene.positions_world = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals_world = {{0, 0, 1}, {0, 0.6, 0.8}, {0, 0, 1}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 2}, 0}};
  return scene;
}

inline Scene with_lights(std::size_t directional, std::size_t positional = 0, std::size_t spots = 0) {
  Scene scene = grey_scene();
  scene.directional.resize(directional);
  scene.positional.resize(positional);
  scene.spots.resize(spots);
  return scene;
}

/// Adds a triangle with this material.
inline void wear(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  scene.triangles.push_back(scene.triangles[0]);
  scene.triangles.back().material = static_cast<std::uint32_t>(scene.materials.size() - 1);
}

inline Plan planned(const Scene& scene, const PlanRequest& request) {
  return must(plan_scene(scene, request));
}

inline const PlannedEffect& effect(const Plan& plan, Effect which) {
  const auto it = std::ranges::find(plan.effects, which, &PlannedEffect::effect);
  if (it != plan.effects.end()) return *it;
  ADD_FAILURE() << "no effect '" << to_string(which) << "'";
  static const PlannedEffect c_none{};
  return c_none;
}

}  // namespace halfway
