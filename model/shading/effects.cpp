// SPDX-License-Identifier: Apache-2.0
#include "shading/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace halfway {
namespace {

bool is_black(glm::dvec3 colour) {
  return colour == glm::dvec3(0.0);
}

// Materials in use.
using Materials = std::vector<const Material*>;

Materials materials_in_use(const Scene& scene) {
  const std::vector<bool> in_use = used_materials(scene);
  Materials materials;
  for (std::size_t i = 0; i < in_use.size(); ++i)
    if (in_use[i]) materials.push_back(&scene.materials[i]);
  return materials;
}

// The first material that passes the test, or null.
const Material* first(const Materials& materials, bool (*test)(const Material&)) {
  const auto it =
      std::find_if(materials.begin(), materials.end(), [&](const Material* m) { return test(*m); });
  return it == materials.end() ? nullptr : *it;
}

bool reflects(const Materials& materials) {
  return first(materials, has_diffuse) != nullptr || first(materials, has_specular) != nullptr;
}

bool has_ambient(const Material& m) {
  return m.ambient > 0.0 && !is_black(m.colour);
}
bool has_emission(const Material& m) {
  return !is_black(m.emission);
}
bool has_coloured_highlight(const Material& m) {
  return has_specular(m) && !is_grey(m.specular_colour);
}
bool is_coloured(const Material& m) {
  return !is_grey(m.colour) || !is_grey(m.emission) || has_coloured_highlight(m);
}

// The shining lights of the kinds that pass the test.
std::vector<LightRef> shining_lights(const Scene& scene, bool (*test)(LightKind)) {
  std::vector<LightRef> lights = shining_lights(scene);
  std::erase_if(lights, [&](LightRef light) { return !test(light.kind); });
  return lights;
}

// Names the first light that is not grey. Empty if there is none.
std::string first_coloured(const Scene& scene, const std::vector<LightRef>& lights) {
  for (const LightRef light : lights)
    if (!is_grey(light_of(scene, light).intensity)) return name_of(light) + " is coloured";
  return {};
}

Call call_ambient(const Scene& scene, const Materials& in_use) {
  if (const Material* m = first(in_use, has_emission))
    return {true, fmt::format("material '{}' emits light", m->name)};
  if (is_black(scene.ambient)) return {false, "the ambient light is 0"};
  const Material* m = first(in_use, has_ambient);
  if (m == nullptr) return {false, "every k_a is 0"};
  return {true, fmt::format("material '{}' has k_a {:g}", m->name, m->ambient)};
}

Call call_colour(const Scene& scene, const Materials& in_use) {
  if (!is_grey(scene.ambient)) return {true, "the ambient light is coloured"};
  if (std::string light = first_coloured(scene, shining_lights(scene)); !light.empty())
    return {true, std::move(light)};
  if (const Material* m = first(in_use, is_coloured))
    return {true, fmt::format("material '{}' is coloured", m->name)};
  return {false, "every light and material is grey"};
}

const char* c_no_light = "no light shines";

Call call_diffuse(const Materials& in_use, bool lit) {
  if (!lit) return {false, c_no_light};
  const Material* m = first(in_use, has_diffuse);
  if (m == nullptr) return {false, "every k_d is 0"};
  return {true, fmt::format("material '{}' has k_d {:g}", m->name, m->diffuse)};
}

Call call_specular(const Scene& scene, const Materials& in_use) {
  if (shining_lights(scene, has_highlight).empty()) return {false, "no light with a highlight shines"};
  const Material* m = first(in_use, has_specular);
  if (m == nullptr) return {false, "every k_s is 0"};
  return {true, fmt::format("material '{}' has k_s {:g}", m->name, m->specular)};
}

const char* c_no_highlight = "there is no highlight";

Call call_highlight_colour(const Scene& scene, const Materials& in_use, const Call& specular) {
  if (!specular.called_for) return {false, c_no_highlight};
  if (std::string light = first_coloured(scene, shining_lights(scene, has_highlight)); !light.empty())
    return {true, std::move(light)};
  if (const Material* m = first(in_use, has_coloured_highlight))
    return {true, fmt::format("the highlights of material '{}' are coloured", m->name)};
  return {false, "every highlight is white"};
}

Call call_exponents(const Materials& in_use, const Call& specular) {
  if (!specular.called_for) return {false, c_no_highlight};
  std::set<double> exponents;
  for (const Material* m : in_use)
    if (has_specular(*m) && m->brdf != Brdf::cook_torrance) exponents.insert(m->exponent);
  if (exponents.empty()) return {false, "no highlight has an exponent"};
  if (exponents.size() == 1) return {false, fmt::format("every exponent is {:g}", *exponents.begin())};
  return {true, fmt::format("{} exponents, {:g} to {:g}", exponents.size(), *exponents.begin(),
                            *exponents.rbegin())};
}

Call call_lights(const Scene& scene, LightKind kind, const SceneCalls& calls) {
  const std::size_t all = light_count(scene, kind), count = calls.count(kind);
  if (all == 0) return {false, fmt::format("the scene has no {} light", to_string(kind))};
  if (count > 0) return {true, fmt::format("{} of {} lights", count, calls.lights.size())};
  const std::vector<LightRef> shining = shining_lights(scene);
  const bool shine = std::any_of(shining.begin(), shining.end(), [&](LightRef l) { return l.kind == kind; });
  return {false, shine ? "no material reflects them" : "their intensity is 0"};
}

}  // namespace

std::vector<LightRef> shining_lights(const Scene& scene) {
  std::vector<LightRef> lights;
  for_each_light(scene, [&](const Light& light) {
    if (!is_black(light.intensity)) lights.push_back(light.ref);
  });
  return lights;
}

std::vector<LightRef> reflected_lights(const Scene& scene) {
  return reflects(materials_in_use(scene)) ? shining_lights(scene) : std::vector<LightRef>();
}

std::vector<bool> used_materials(const Scene& scene) {
  std::vector<bool> in_use(scene.materials.size(), false);
  for (const SceneTriangle& t : scene.triangles) in_use[t.material] = true;
  return in_use;
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

const char* to_string(Effect effect) {
  static constexpr std::array<const char*, c_effects> c_names = {"ambient",         "diffuse",
                                                                 "specular",        "highlight colour",
                                                                 "exponents",       "directional",
                                                                 "positional",      "spot",
                                                                 "shadow",          "normalization",
                                                                 "colour channels", "depth",
                                                                 "subdivision",     "perspective correction"};
  return c_names[static_cast<std::size_t>(effect)];
}

std::size_t SceneCalls::count(LightKind kind) const {
  return static_cast<std::size_t>(
      std::count_if(lights.begin(), lights.end(), [&](LightRef light) { return light.kind == kind; }));
}

SceneCalls calls_of(const Scene& scene) {
  const Materials in_use = materials_in_use(scene);
  SceneCalls calls;
  calls.lights = reflected_lights(scene);
  const auto at = [&](Effect effect) -> Call& { return calls.call[static_cast<std::size_t>(effect)]; };
  const bool lit = !shining_lights(scene).empty();
  at(Effect::ambient) = call_ambient(scene, in_use);
  at(Effect::diffuse) = call_diffuse(in_use, lit);
  at(Effect::specular) = call_specular(scene, in_use);
  at(Effect::highlight_colour) = call_highlight_colour(scene, in_use, at(Effect::specular));
  at(Effect::exponents) = call_exponents(in_use, at(Effect::specular));
  at(Effect::directional) = call_lights(scene, LightKind::directional, calls);
  at(Effect::positional) = call_lights(scene, LightKind::positional, calls);
  at(Effect::spot) = call_lights(scene, LightKind::spot, calls);
  const auto where_reflected = [&](const char* why) -> Call {
    if (calls.lights.empty()) return {false, lit ? "no material reflects a light" : c_no_light};
    return {true, why};
  };
  at(Effect::shadow) = {false, "the scene has no shadows"};
  if (scene.shadows)
    at(Effect::shadow) = shining_lights(scene, casts_shadow).empty()
                             ? Call{false, "no light that casts shadows shines"}
                             : where_reflected("surfaces cast shadows");
  at(Effect::normalization) = where_reflected("reflection uses cosines between unit vectors");
  at(Effect::colour) = call_colour(scene, in_use);
  at(Effect::depth) = {true, "the z test needs every fragment's depth"};
  at(Effect::subdivision) = where_reflected("details of a reflection may be smaller than a triangle");
  at(Effect::perspective) = {true, "every camera has perspective"};
  return calls;
}

}  // namespace halfway
