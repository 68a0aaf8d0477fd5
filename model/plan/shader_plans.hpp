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

/// Number of lights of Plan::everything. Error if the shader, called `name`, supports fewer lights than the
/// scene has or the request names.
Result<unsigned> lights_of_everything(const Scene& scene, const SceneCalls& calls, const PlanRequest& request,
                                      const char* name);

/// Makes the effects of a plan.
class EffectPlanner {
 public:
  /// `without_idle` removes units that serve only effects that a key does not have.
  EffectPlanner(const SceneCalls& calls, const HardwareKey& key, HardwareKey (*without_idle)(HardwareKey))
      : calls_(calls), key_(key), without_idle_(without_idle) {}

  /// The scene's need for the effect, and the part of the system that computes it. Not elaborated.
  PlannedEffect planned(Effect effect, DoneBy by, std::string how) const {
    return {effect, calls_[effect].called_for, calls_[effect].why, by, std::move(how)};
  }
  /// Computed by the hardware; without `other`, the hardware with only this effect added or removed does not
  /// exist.
  PlannedEffect in_hardware(Effect effect, std::string how, bool elaborated = false,
                            const std::optional<HardwareKey>& other = {}) const {
    PlannedEffect out = planned(effect, DoneBy::hardware, std::move(how));
    out.elaborated = elaborated;
    if (other) out.other = without_idle_(*other);
    return out;
  }

 protected:
  const SceneCalls& calls_;
  const HardwareKey& key_;

 private:
  HardwareKey (*without_idle_)(HardwareKey);
};

}  // namespace halfway
