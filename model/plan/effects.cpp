// SPDX-License-Identifier: Apache-2.0
#include "plan/effects.hpp"

#include <fmt/format.h>

namespace halfway {
namespace {

bool is_black(glm::dvec3 colour) {
  return colour == glm::dvec3(0.0);
}

}  // namespace

glm::dvec3 intensity(const Scene& scene, LightRef light) {
  switch (light.kind) {
    case LightKind::directional:
      return scene.directional[light.index].intensity;
    case LightKind::positional:
      return scene.positional[light.index].intensity;
    case LightKind::spot:
      break;
  }
  return scene.spots[light.index].intensity;
}

std::string name_of(LightRef light) {
  const char* kind = light.kind == LightKind::directional  ? "directional"
                     : light.kind == LightKind::positional ? "positional"
                                                           : "spot";
  return fmt::format("{} light {}", kind, light.index + 1);
}

std::vector<LightRef> shining_lights(const Scene& scene) {
  std::vector<LightRef> lights;
  const auto add = [&](LightKind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      if (const LightRef light{kind, i}; !is_black(intensity(scene, light))) lights.push_back(light);
  };
  add(LightKind::directional, scene.directional.size());
  add(LightKind::positional, scene.positional.size());
  add(LightKind::spot, scene.spots.size());
  return lights;
}

std::vector<bool> worn_materials(const Scene& scene) {
  std::vector<bool> worn(scene.materials.size(), false);
  for (const SceneTriangle& t : scene.triangles) worn[t.material] = true;
  return worn;
}

bool has_diffuse(const Material& m) {
  return m.diffuse > 0.0 && !is_black(m.colour);
}
bool has_specular(const Material& m) {
  return m.specular > 0.0 && !is_black(m.specular_colour);
}

bool is_grey(glm::dvec3 v) {
  return v.x == v.y && v.y == v.z;
}

}  // namespace halfway
