// SPDX-License-Identifier: Apache-2.0
// One function a shader: which hardware a scene's calls are to it, and what it leaves to the host.
#pragma once

#include "plan/plan.hpp"

namespace halfway {

Result<Plan> plan_quadratic(const Scene& scene, const SceneCalls& calls, const PlanRequest& request);
Result<Plan> plan_spherical(const Scene& scene, const SceneCalls& calls, const PlanRequest& request);
Result<Plan> plan_processors(const Scene& scene, const SceneCalls& calls, const PlanRequest& request);

inline constexpr const char* c_form_of_another = "--form: only the shading processors have two forms";

/// What the scene says of the effect, and who does it; nothing elaborated yet.
PlannedEffect planned(const SceneCalls& calls, Effect effect, DoneBy by, std::string how);

/// Done by the hardware.
PlannedEffect in_hardware(const SceneCalls& calls, Effect effect, std::string how);
/// The same, and elaborated whatever the scene calls for.
PlannedEffect always_elaborated(const SceneCalls& calls, Effect effect, std::string how);

}  // namespace halfway
