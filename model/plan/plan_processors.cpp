// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "plan/shader_plans.hpp"
#include "scene/lights.hpp"
#include "words/object_limits.hpp"

namespace halfway {
namespace {

// The pipeline's number of lights of a kind.
unsigned& light_units(ProcessorUnits& units, LightKind kind) {
  switch (kind) {
    case LightKind::directional:
      return units.directional;
    case LightKind::positional:
      return units.positional;
    case LightKind::spot:
      return units.spots;
  }
  std::abort();
}

// The first triangle with more than one normal. Empty if there is none.
std::optional<std::size_t> first_curved(const Scene& scene) {
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const auto& n = scene.triangles[i].normal;
    const auto normal_world = [&](std::size_t corner) { return scene.normals_world[n[corner]]; };
    if (normal_world(1) != normal_world(0) || normal_world(2) != normal_world(0)) return i;
  }
  return std::nullopt;
}

// Whether N is normalized at each pixel, with the reason. That the scene needs unit vectors does not imply
// that the N of a pixel must be normalized.
Call call_normalize(const Scene& scene, const SceneCalls& calls, Preset preset) {
  const Call& lit = calls[Effect::normalization];
  if (!lit.called_for) return lit;
  if (preset == Preset::published) {
    const bool has_places = calls.count(LightKind::positional) + calls.count(LightKind::spot) > 0;
    return {has_places, has_places ? "version II: lights with a place" : "version I: no light has a place"};
  }
  if (const auto triangle = first_curved(scene))
    return {true, fmt::format("the normals at the corners of triangle {} differ", *triangle)};
  return {false, "each triangle has one normal, unit from the host"};
}

// Error if a highlight is not of Blinn's model.
Status check_highlights(const Scene& scene) {
  const std::vector<bool> used = used_materials(scene);
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Material& m = scene.materials[i];
    if (!used[i] || !has_specular(m) || m.brdf == Brdf::blinn) continue;
    const bool phong = m.brdf == Brdf::phong;
    return bad_input(fmt::format(
        "{}: material '{}' is {}, and the shading processors' highlights are blinn's, powers of N.H; make it "
        "blinn{}, or use the {} shader",
        scene.name, m.name, phong ? "phong" : "cook_torrance",
        phong ? " with about four times the exponent" : "", phong ? "quadratic or spherical" : "quadratic"));
  }
  return Ok{};
}

// Removes units that serve only effects that the hardware does not have.
HardwareKey without_idle_processors(HardwareKey key) {
  ProcessorUnits& p = key.processors;
  if (!p.diffuse && !p.specular) p.directional = p.positional = p.spots = 0;
  if (p.lights() == 0) p.diffuse = p.specular = p.normalize = p.shadows = false;
  return key;
}

HardwareKey every_processor(HardwareKey key, unsigned lights) {
  ProcessorUnits& p = key.processors;
  key.channels = 3;
  // Hardware for a spot can also draw the other kinds of light.
  p.directional = p.positional = 0;
  p.spots = lights;
  p.diffuse = p.specular = p.normalize = true;
  p.shadows = p.objects > 0;
  return key;
}

class ProcessorsPlanner : public EffectPlanner {
 public:
  ProcessorsPlanner(const SceneCalls& calls, const Call& normalize, const Plan& plan)
      : EffectPlanner(calls, plan.key, without_idle_processors), normalize_(normalize) {}

  PlannedEffect effect_of(Effect effect) const {
    const ProcessorUnits& p = key_.processors;
    const bool exact = key_.preset == Preset::exact;
    HardwareKey other = key_;
    ProcessorUnits& o = other.processors;
    switch (effect) {
      case Effect::ambient:
        return in_hardware(effect, "the first processor", true);
      case Effect::depth:
        return in_hardware(effect, "", true);
      case Effect::diffuse:
        o.diffuse = !p.diffuse;
        if (o.lights() == 0) o.directional = 1;
        return in_hardware(effect, "one processor per light", p.diffuse, other);
      case Effect::specular:
        o.specular = !p.specular;
        if (o.lights() == 0) o.directional = 1;
        return in_hardware(effect, "one processor per light", p.specular, other);
      case Effect::highlight_colour:
        if (!p.specular) return in_hardware(effect, "");
        other.channels = key_.channels == 1 ? 3 : 1;
        return in_hardware(effect, "separate channels for all colours", key_.channels == 3, other);
      case Effect::exponents:
        return in_hardware(effect, "any exponent, set per material", p.specular);
      case Effect::directional:
        return lights_of(effect, LightKind::directional, "");
      case Effect::positional:
        return lights_of(effect, LightKind::positional, "the vector to it, normalized");
      case Effect::spot:
        return lights_of(effect, LightKind::spot, "like a positional light, and its cone");
      case Effect::shadow:
        o.shadows = !p.shadows;
        if (o.objects == 0) o.objects = c_object_processors;
        if (o.lights() == 0) o.directional = 1;
        if (!o.diffuse && !o.specular) o.diffuse = true;
        return in_hardware(effect, "object processors; each processor of a light counts shadow volumes",
                           p.shadows, other);
      case Effect::normalization: {
        o.normalize = !p.normalize;
        if (o.lights() == 0) o.directional = 1;
        if (!o.diffuse && !o.specular) o.diffuse = true;
        PlannedEffect out = in_hardware(effect, "N, by the first processor", p.normalize, other);
        out.called_for = normalize_.called_for;
        out.why = normalize_.why;
        return out;
      }
      case Effect::colour:
        other.channels = key_.channels == 1 ? 3 : 1;
        return in_hardware(effect, "separate channels", key_.channels == 3, other);
      case Effect::subdivision: {
        PlannedEffect out = planned(effect, DoneBy::none, "not needed");
        out.called_for = false;
        out.why = "each pixel is shaded separately";
        return out;
      }
      case Effect::perspective:
        break;
    }
    if (exact) return planned(effect, DoneBy::host, "planes of values that are linear on the screen");
    return planned(effect, DoneBy::none, "as published, N and P are linear on the screen");
  }

 private:
  PlannedEffect lights_of(Effect effect, LightKind kind, std::string how) const {
    const auto count = static_cast<unsigned>(calls_.count(kind));
    HardwareKey other = key_;
    ProcessorUnits& o = other.processors;
    // With all effects, every light uses the hardware of a spot.
    const bool all_spots = o.spots != calls_.count(LightKind::spot);
    unsigned& of_kind = all_spots ? o.spots : light_units(o, kind);
    if (count > 0) {
      of_kind -= count;
      return in_hardware(effect, std::move(how), true, other);
    }
    if (all_spots && kind != LightKind::directional) {
      (kind == LightKind::spot ? o.positional : o.directional) = o.spots;
      o.spots = 0;
      return in_hardware(effect, std::move(how), true, other);
    }
    if (o.lights() == c_most_lights) return in_hardware(effect, std::move(how));
    ++of_kind;
    if (!o.diffuse && !o.specular) o.diffuse = true;
    return in_hardware(effect, std::move(how), false, other);
  }

  const Call& normalize_;
};

}  // namespace

Result<Plan> plan_processors(const Scene& scene, const SceneCalls& calls, const PlanRequest& request) {
  if (request.tables) return bad_input("--cosine: only the spherical shader has cosine tables");
  if (request.degree) return bad_input(c_degree_of_another);
  const auto most = lights_of_everything(scene, calls, request, "shading processors support");
  if (!most) return most.error();
  const Call normalize = call_normalize(scene, calls, request.preset);

  Plan plan;
  HardwareKey& key = plan.called_for;
  key.shader = Shader::processors;
  key.preset = request.preset;
  key.channels = calls[Effect::colour].called_for ? 3 : 1;
  ProcessorUnits& units = key.processors;
  for (const LightKind kind : c_light_kinds)
    light_units(units, kind) = static_cast<unsigned>(calls.count(kind));
  units.diffuse = calls[Effect::diffuse].called_for;
  units.specular = calls[Effect::specular].called_for;
  units.normalize = normalize.called_for;
  units.shadows = calls[Effect::shadow].called_for;
  units.form = request.form.value_or(ProcessorForm::unrolled);
  // Shadow polygons are counted along the sorted lists of the object processors.
  units.objects = request.objects == 0 && units.shadows ? c_object_processors : request.objects;
  units.subpixels = request.subpixels;
  // The filter mixes the background into pixels at outlines.
  if (words::has_filter(static_cast<int>(units.subpixels)) && !is_grey(scene.background)) key.channels = 3;
  if (units.specular)
    if (Status status = check_highlights(scene); !status) return status.error();

  plan.everything = every_processor(key, *most);
  plan.key = request.all_effects ? plan.everything : plan.called_for;
  const ProcessorsPlanner planner(calls, normalize, plan);
  for (std::size_t i = 0; i < c_effects; ++i)
    plan.effects.push_back(planner.effect_of(static_cast<Effect>(i)));
  return plan;
}

}  // namespace halfway
