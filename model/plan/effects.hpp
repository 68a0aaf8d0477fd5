// SPDX-License-Identifier: Apache-2.0
// Which of a scene's lights and materials can reach a fragment.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace halfway {

enum class LightKind { directional, positional, spot };

struct LightRef {
  LightKind kind;
  std::size_t index;  ///< into the scene's list of that kind
  friend bool operator==(const LightRef&, const LightRef&) = default;
};

glm::dvec3 intensity(const Scene& scene, LightRef light);
/// Such as "positional light 2".
std::string name_of(LightRef light);

/// Lights of an intensity other than 0: directional ones, positional ones, spots, each in the scene's order.
std::vector<LightRef> shining_lights(const Scene& scene);

/// For each material whether a triangle wears it.
std::vector<bool> worn_materials(const Scene& scene);

/// Whether light reflects from it this way.
bool has_diffuse(const Material& material);
bool has_specular(const Material& material);

bool is_grey(glm::dvec3 colour);

}  // namespace halfway
