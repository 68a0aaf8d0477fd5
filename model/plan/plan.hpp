// SPDX-License-Identifier: Apache-2.0
// The plan: which hardware a scene calls for. A pure function of the scene and the shader asked for.
#pragma once

#include <string>
#include <vector>

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

Plan plan_quadratic(const Scene& scene, Preset preset);

}  // namespace halfway
