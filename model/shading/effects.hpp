// SPDX-License-Identifier: Apache-2.0
// What a scene needs, independent of the shader: effects, and the lights and materials that can contribute to
// a fragment.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/lights.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Lights whose intensity is not 0, in the order of for_each_light.
std::vector<LightRef> shining_lights(const Scene& scene);
/// The shining lights, or none if no material in use reflects them.
std::vector<LightRef> reflected_lights(const Scene& scene);

/// For each material, true if a triangle uses it.
std::vector<bool> used_materials(const Scene& scene);

/// True if the material reflects light in this way.
bool has_diffuse(const Material& material);
bool has_specular(const Material& material);

bool is_grey(glm::dvec3 colour);

/// All effects that the project has, in the order in which a plan lists them.
enum class Effect {
  ambient,
  diffuse,
  specular,
  highlight_colour,
  exponents,
  directional,
  positional,
  spot,
  shadow,
  normalization,
  colour,
  depth,
  subdivision,
  perspective,
};
inline constexpr std::size_t c_effects = static_cast<std::size_t>(Effect::perspective) + 1;

/// For example "highlight colour".
const char* to_string(Effect effect);

struct Call {
  bool called_for;
  std::string why;  ///< or why not
};
struct SceneCalls {
  std::vector<LightRef> lights;  ///< as returned by reflected_lights
  std::array<Call, c_effects> call;

  const Call& operator[](Effect effect) const { return call[static_cast<std::size_t>(effect)]; }
  std::size_t count(LightKind kind) const;  ///< of the lights above
};

SceneCalls calls_of(const Scene& scene);

}  // namespace halfway
