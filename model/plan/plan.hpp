// SPDX-License-Identifier: Apache-2.0
// The plan: which hardware a scene calls for, and why. A pure function of the scene and the shader asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "shading/effects.hpp"

namespace halfway {

/// Where a shader leaves an effect to.
enum class DoneBy { hardware, host, nobody };

struct PlannedEffect {
  Effect effect;
  bool called_for;  ///< by the scene
  std::string why;  ///< or why not
  DoneBy by;
  std::string how;  ///< in this shader; may be empty
  /// Whether the hardware has it: what is called for, and with all effects the rest too.
  bool elaborated = false;
  /// The same hardware with this effect alone put in, or left out; none where it cannot be.
  std::optional<HardwareKey> other;
};

struct Plan {
  HardwareKey key;                     ///< what is elaborated: one of these two
  HardwareKey called_for;              ///< what the scene calls for
  HardwareKey everything;              ///< every effect that the shader has
  std::vector<PlannedEffect> effects;  ///< every effect there is, in their order
};

struct PlanRequest {
  Shader shader = Shader::quadratic;
  Preset preset = Preset::exact;
  std::optional<TableSize> tables;  ///< of the spherical shader; none: the preset's
  /// Where the program was not built with that size; the RTL must have it, too (rtl_with_tables of
  /// sim/formats).
  std::span<const golden::CosineTable> made_tables{};
  /// Elaborate Plan::everything; what the scene has not, setup gives coefficients of zero.
  bool all_effects = false;
  /// Lights that Plan::everything has in the spherical shader and in the processors; none: those of the
  /// scene, and at least one.
  std::optional<unsigned> lights;
  std::optional<ProcessorForm> form;  ///< of the shading processors; none: unrolled
};

inline constexpr std::size_t c_most_lights = 16;  ///< of the spherical shader, and of the processors

/// An error where the shader cannot draw the scene, or the scene's numbers are not what scene.hpp says.
Result<Plan> plan_scene(const Scene& scene, const PlanRequest& request);

}  // namespace halfway
