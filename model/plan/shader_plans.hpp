// SPDX-License-Identifier: Apache-2.0
// One function per shader: the hardware for a scene, and the effects left to the host.
#pragma once

#include "plan/plan.hpp"

namespace halfway {

Result<Plan> plan_quadratic(const Scene& scene, const SceneCalls& calls, const PlanRequest& request);
Result<Plan> plan_spherical(const Scene& scene, const SceneCalls& calls, const PlanRequest& request);
Result<Plan> plan_processors(const Scene& scene, const SceneCalls& calls, const PlanRequest& request);

inline constexpr const char* c_degree_of_another = "--degree: only the quadratic shader has two degrees";
inline constexpr const char* c_form_of_another = "--form: only the shading processors have two forms";

/// The scene's need for the effect, and the part of the system that computes it. Not elaborated.
PlannedEffect planned(const SceneCalls& calls, Effect effect, DoneBy by, std::string how);

/// Computed by the hardware; elaborated if the scene needs it.
PlannedEffect in_hardware(const SceneCalls& calls, Effect effect, std::string how);
/// Computed by the hardware; elaborated for every scene.
PlannedEffect always_elaborated(const SceneCalls& calls, Effect effect, std::string how);

}  // namespace halfway
