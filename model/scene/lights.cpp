// SPDX-License-Identifier: Apache-2.0
#include "scene/lights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace halfway {

const char* to_string(LightKind kind) {
  switch (kind) {
    case LightKind::directional:
      return "directional";
    case LightKind::positional:
      return "positional";
    case LightKind::spot:
      return "spot";
  }
  std::abort();
}

bool has_highlight(LightKind kind) {
  switch (kind) {
    case LightKind::directional:
    case LightKind::positional:
    case LightKind::spot:
      return true;
  }
  std::abort();
}

bool casts_shadow(LightKind kind) {
  switch (kind) {
    case LightKind::directional:
    case LightKind::positional:
    case LightKind::spot:
      return true;
  }
  std::abort();
}

std::string name_of(LightRef light) {
  return fmt::format("{} light {}", to_string(light.kind), light.index + 1);
}

glm::dvec3 direction(glm::dvec3 from, glm::dvec3 to) {
  const glm::dvec3 v = to - from;
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 && std::isfinite(largest) ? glm::normalize(v / largest) : glm::dvec3(0.0);
}

glm::dvec3 direction_to(const Light& light, const glm::dvec3& point_world) {
  return light.point.w == 0.0 ? light.point.xyz_world : direction(point_world, light.point.xyz_world);
}

double cone_share(const LightCone& cone, double cos_to_axis) {
  if (cos_to_axis >= cone.cos_inner) return 1.0;
  if (!(cos_to_axis > cone.cos_outer)) return 0.0;
  const double t = (cos_to_axis - cone.cos_outer) / (cone.cos_inner - cone.cos_outer);
  return t * t * (3.0 - 2.0 * t);
}

double cone_share(const Light& light, const glm::dvec3& to_light) {
  return light.cone ? cone_share(*light.cone, -glm::dot(to_light, light.cone->axis_world)) : 1.0;
}

std::size_t light_count(const Scene& scene, LightKind kind) {
  switch (kind) {
    case LightKind::directional:
      return scene.directional.size();
    case LightKind::positional:
      return scene.positional.size();
    case LightKind::spot:
      return scene.spots.size();
  }
  std::abort();
}

std::size_t light_count(const Scene& scene) {
  std::size_t count = 0;
  for (const LightKind kind : c_light_kinds) count += light_count(scene, kind);
  return count;
}

Light light_of(const Scene& scene, LightRef ref) {
  switch (ref.kind) {
    case LightKind::directional: {
      const DirectionalLight& light = scene.directional[ref.index];
      return {ref, {light.to_light_world, 0.0}, light.intensity, {}};
    }
    case LightKind::positional: {
      const PositionalLight& light = scene.positional[ref.index];
      return {ref, {light.position_world, 1.0}, light.intensity, {}};
    }
    case LightKind::spot: {
      const SpotLight& light = scene.spots[ref.index];
      return {ref,
              {light.position_world, 1.0},
              light.intensity,
              LightCone{light.axis_world, light.cos_inner, light.cos_outer}};
    }
  }
  std::abort();
}

void clear_lights(Scene& scene) {
  for (const LightKind kind : c_light_kinds) {
    switch (kind) {
      case LightKind::directional:
        scene.directional.clear();
        break;
      case LightKind::positional:
        scene.positional.clear();
        break;
      case LightKind::spot:
        scene.spots.clear();
        break;
    }
  }
}

std::vector<Light> lights_of(const Scene& scene) {
  std::vector<Light> lights;
  for_each_light(scene, [&](const Light& light) { lights.push_back(light); });
  return lights;
}

}  // namespace halfway
