// SPDX-License-Identifier: Apache-2.0
#include "plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace halfway {
namespace {

bool is_grey(const glm::dvec3& v) {
  return v.x == v.y && v.y == v.z;
}

// The first colour that is not grey, named; empty where all are.
std::string first_colour(const Scene& scene) {
  if (!is_grey(scene.ambient)) return "the ambient light is coloured";
  const auto coloured = [](const auto& lights) {
    return std::ranges::find_if(lights, [](const auto& l) { return !is_grey(l.intensity); }) - lights.begin();
  };
  const auto light = [&](const auto& lights, std::string_view kind) -> std::string {
    const auto i = coloured(lights);
    if (i == std::ranges::ssize(lights)) return {};
    return fmt::format("{} light {} is coloured", kind, i + 1);
  };
  if (auto why = light(scene.directional, "directional"); !why.empty()) return why;
  if (auto why = light(scene.positional, "positional"); !why.empty()) return why;
  if (auto why = light(scene.spots, "spot"); !why.empty()) return why;
  // Only what a triangle wears can reach a fragment.
  std::vector<bool> used(scene.materials.size(), false);
  for (const SceneTriangle& t : scene.triangles) used[t.material] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Material& m = scene.materials[i];
    if (used[i] && (!is_grey(m.colour) || (m.specular > 0.0 && !is_grey(m.specular_colour))))
      return fmt::format("material '{}' is coloured", m.name);
  }
  return {};
}

}  // namespace

Plan plan_quadratic(const Scene& scene, Preset preset) {
  Plan plan;
  plan.key.entity = "quadratic_shader";
  plan.key.preset = preset;
  const std::string colour = first_colour(scene);
  plan.key.channels = colour.empty() ? 1 : 3;
  plan.effects = {
      {"colour channels", !colour.empty(),
       colour.empty() ? "every light and material is grey: one channel" : colour},
      {"depth", true, "the z test needs every fragment's depth"},
      {"exact edges", preset == Preset::exact,
       preset == Preset::exact ? "preset exact: quotient and remainder" : "preset published: real slopes"},
  };
  return plan;
}

}  // namespace halfway
