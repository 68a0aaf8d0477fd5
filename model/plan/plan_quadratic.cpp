// SPDX-License-Identifier: Apache-2.0
#include "plan/shader_plans.hpp"

namespace halfway {
namespace {

// The host computes the radiance, and therefore nearly every effect.
PlannedEffect effect_of(const EffectPlanner& planner, Effect effect, const HardwareKey& key) {
  switch (effect) {
    case Effect::ambient:
    case Effect::diffuse:
    case Effect::specular:
    case Effect::highlight_colour:
    case Effect::exponents:
    case Effect::directional:
    case Effect::positional:
    case Effect::spot:
    case Effect::normalization:
    case Effect::perspective:
      return planner.planned(effect, DoneBy::host, "at each sample");
    case Effect::subdivision:
      return planner.planned(effect, DoneBy::host, "triangles split into four above a threshold");
    case Effect::shadow:
      break;
    case Effect::colour: {
      HardwareKey other = key;
      other.channels = key.channels == 3 ? 1 : 3;
      return planner.in_hardware(effect,
                                 key.degree == 1 ? "one plane per channel" : "one interpolator per channel",
                                 key.channels == 3, other);
    }
    case Effect::depth:
      return planner.in_hardware(effect, "", true);
  }
  return planner.planned(effect, DoneBy::none, "not by this shader");
}

}  // namespace

Result<Plan> plan_quadratic(const Scene&, const SceneCalls& calls, const PlanRequest& request) {
  if (request.tables) return bad_input("--cosine: only the spherical shader has cosine tables");
  if (request.lights) return bad_input("--lights: the quadratic shader has no hardware for lights");
  if (request.form) return bad_input(c_form_of_another);
  Plan plan;
  plan.called_for.preset = request.preset;
  plan.called_for.degree = request.degree.value_or(2);
  plan.everything = plan.called_for;
  plan.called_for.channels = calls[Effect::colour].called_for ? 3 : 1;
  plan.everything.channels = 3;
  plan.key = request.all_effects ? plan.everything : plan.called_for;
  const EffectPlanner planner(calls, plan.key, [](HardwareKey key) { return key; });
  for (std::size_t i = 0; i < c_effects; ++i)
    plan.effects.push_back(effect_of(planner, static_cast<Effect>(i), plan.key));
  return plan;
}

}  // namespace halfway
