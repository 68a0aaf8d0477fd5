// SPDX-License-Identifier: Apache-2.0
// The plan: the hardware that a scene needs, with reasons. A pure function of the scene and the requested
// shader.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "shading/effects.hpp"

namespace halfway {

/// Which part of the system computes an effect in a given shader.
enum class DoneBy { hardware, host, none };

struct PlannedEffect {
  Effect effect;
  bool called_for;  ///< true if the scene needs it
  std::string why;  ///< the reason for called_for
  DoneBy by;
  std::string how;  ///< how this shader computes it; may be empty
  /// True if the hardware contains the effect: if the scene needs it, or if all effects are requested.
  bool elaborated = false;
  /// The same hardware with only this effect added or removed. Empty if that is impossible.
  std::optional<HardwareKey> other;
};

struct Plan {
  HardwareKey key;                     ///< the hardware to elaborate: one of the next two
  HardwareKey called_for;              ///< the hardware that the scene needs
  HardwareKey everything;              ///< hardware with every effect of the shader
  std::vector<PlannedEffect> effects;  ///< all effects, in the order of Effect
};

struct PlanRequest {
  Shader shader = Shader::quadratic;
  Preset preset = Preset::exact;
  std::optional<words::CosineSize> tables;  ///< of the spherical shader; empty: the preset's
  /// Tables of a size that the program was not built with. The RTL must have them too (rtl_with of
  /// sim/generator).
  std::span<const words::CosineTable> made_tables{};
  /// Preset exact of the spherical shader: the scene's own_exponents, if made_tables are its own tables.
  std::vector<double> own{};
  /// Elaborate Plan::everything. For effects not in the scene, setup uses coefficients of zero.
  bool all_effects = false;
  /// Number of lights of Plan::everything, for the spherical shader and the processors. Empty: the scene's
  /// number, at least one.
  std::optional<unsigned> lights;
  std::optional<int> degree;          ///< of the quadratic shader; empty: 2
  std::optional<ProcessorForm> form;  ///< of the shading processors; empty: unrolled
  unsigned objects = 0;               ///< object processors before the shading processors; 0: the rasterizer
  unsigned subpixels = 1;             ///< of a pixel, with object processors: 1, 4 or 16
};

inline constexpr unsigned c_most_object_processors = 256;
/// Object processors of a scene with shadows, if the request has none.
inline constexpr unsigned c_object_processors = 16;

inline constexpr std::size_t c_most_lights = 16;  ///< of the spherical shader, and of the processors

/// Sizes of the cosine tables that are built into the program, the preset's own first.
std::vector<words::CosineSize> cosine_sizes(Preset preset);

/// Error if the shader cannot draw the scene, or if a number of the scene is outside the range given in
/// scene.hpp.
Result<Plan> plan_scene(const Scene& scene, const PlanRequest& request);

}  // namespace halfway
