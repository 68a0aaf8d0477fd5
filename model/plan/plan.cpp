// SPDX-License-Identifier: Apache-2.0
#include "plan/plan.hpp"

#include "plan/shader_plans.hpp"
#include "scene/check_numbers.hpp"

namespace halfway {

PlannedEffect planned(const SceneCalls& calls, Effect effect, DoneBy by, std::string how) {
  const Call& call = calls[effect];
  return {effect, call.called_for, call.why, by, std::move(how)};
}

PlannedEffect in_hardware(const SceneCalls& calls, Effect effect, std::string how) {
  return planned(calls, effect, DoneBy::hardware, std::move(how));
}

PlannedEffect always_elaborated(const SceneCalls& calls, Effect effect, std::string how) {
  PlannedEffect out = in_hardware(calls, effect, std::move(how));
  out.elaborated = true;
  return out;
}

Result<Plan> plan_scene(const Scene& scene, const PlanRequest& request) {
  if (const Status numbers = check_numbers(scene); !numbers) return numbers.error();
  const SceneCalls calls = calls_of(scene);
  switch (request.shader) {
    case Shader::quadratic:
      return plan_quadratic(scene, calls, request);
    case Shader::spherical:
      return plan_spherical(scene, calls, request);
    case Shader::processors:
      break;
  }
  return plan_processors(scene, calls, request);
}

}  // namespace halfway
