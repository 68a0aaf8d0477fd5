// SPDX-License-Identifier: Apache-2.0
#include "plan/plan.hpp"

#include <fmt/format.h>

#include "plan/shader_plans.hpp"
#include "scene/check_numbers.hpp"

namespace halfway {

Result<unsigned> lights_of_everything(const Scene& scene, const SceneCalls& calls, const PlanRequest& request,
                                      const char* name) {
  const std::size_t lights = calls.lights.size(), least = std::max<std::size_t>(lights, 1);
  if (lights > c_most_lights)
    return bad_input(fmt::format("{}: {} lights; the {} up to {}: remove some, or use the quadratic shader",
                                 scene.name, lights, name, c_most_lights));
  const std::size_t most = request.lights.value_or(static_cast<unsigned>(least));
  if (most < least || most > c_most_lights)
    return bad_input(fmt::format("--lights: {} is not {} to {}", most, least, c_most_lights));
  return static_cast<unsigned>(most);
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
