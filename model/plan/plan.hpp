// SPDX-License-Identifier: Apache-2.0
// The plan: which hardware a scene calls for. A pure function of the scene and the shader asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"

namespace halfway {

struct PlannedEffect {
  std::string name;
  bool called_for;
  std::string why;
};

struct Plan {
  HardwareKey key;
  std::vector<PlannedEffect> effects;
};

struct PlanRequest {
  Shader shader = Shader::quadratic;
  Preset preset = Preset::exact;
  std::optional<TableSize> tables;  ///< of the spherical shader; none: the preset's
};

inline constexpr std::size_t c_most_lights = 16;  ///< of the spherical shader

/// An error where the shader cannot draw the scene.
Result<Plan> plan_scene(const Scene& scene, const PlanRequest& request);

}  // namespace halfway
