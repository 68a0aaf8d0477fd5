// SPDX-License-Identifier: Apache-2.0
// What a scene calls for, whichever shader draws it: effects, and the lights and materials that can reach a
// fragment.
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

/// Lights of an intensity other than 0: directional ones, positional ones, spots, each in the scene's order.
std::vector<LightRef> shining_lights(const Scene& scene);
/// These, or none where no material in use reflects them.
std::vector<LightRef> reflected_lights(const Scene& scene);

/// For each material whether a triangle wears it.
std::vector<bool> worn_materials(const Scene& scene);

/// Whether light reflects from it this way.
bool has_diffuse(const Material& material);
bool has_specular(const Material& material);

bool is_grey(glm::dvec3 colour);

/// All that the project knows of, in the order that a plan lists it.
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

/// Such as "highlight colour".
const char* to_string(Effect effect);

struct Call {
  bool called_for;
  std::string why;  ///< or why not
};
struct SceneCalls {
  std::vector<LightRef> lights;  ///< reflected_lights
  std::array<Call, c_effects> call;

  const Call& operator[](Effect effect) const { return call[static_cast<std::size_t>(effect)]; }
  std::size_t count(LightKind kind) const;  ///< of these lights
};

SceneCalls calls_of(const Scene& scene);

}  // namespace halfway
