// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "plan/own_bells.hpp"
#include "plan/shader_plans.hpp"
#include "shading/bell.hpp"
#include "words/cosine_tables.hpp"

namespace halfway {
namespace {

constexpr unsigned c_squared = 2;  // of SphericalUnits::powers: only the table of cosine squared
constexpr unsigned c_every_power = 31;

Result<words::CosineSize> table_size(const PlanRequest& request) {
  const std::vector<words::CosineSize> sizes = cosine_sizes(request.preset);
  if (!request.tables) return sizes.front();
  if (!request.made_tables.empty() || std::find(sizes.begin(), sizes.end(), *request.tables) != sizes.end())
    return *request.tables;
  std::vector<std::string> there;
  for (const words::CosineSize& size : sizes) there.push_back(to_string(size));
  return bad_input(
      fmt::format("no cosine tables of {0} address x data bits in preset {1}: there are {2}; make them with "
                  "`make tables PRESET={1} COSINE={0}`, and draw again",
                  to_string(*request.tables), to_string(request.preset), fmt::join(there, ", ")));
}

// The powers for the exponents in use. Error if a highlight is not a power of a cosine.
Result<unsigned> powers_of(const Scene& scene, const PlanRequest& request) {
  unsigned powers = 0;
  const std::vector<bool> used = used_materials(scene);
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Material& m = scene.materials[i];
    if (!used[i] || !has_specular(m)) continue;
    if (m.brdf == Brdf::cook_torrance)
      return bad_input(fmt::format(
          "{}: material '{}' is cook_torrance, and the spherical shader's highlights are powers of a cosine; "
          "make it blinn or phong, or use the quadratic shader",
          scene.name, m.name));
    // Each power is a power of two, and so equal to its bit of the mask.
    if (request.preset == Preset::published)
      powers |= c_squared;
    else
      powers |= static_cast<unsigned>(
          (request.own.empty() ? fitted_bell(m.exponent) : own_bell(request.own, m.exponent)).power);
  }
  return powers;
}

std::string names(const SphericalUnits& units) {
  std::vector<std::string> list;
  for (unsigned power = 1, i = 0; power <= 16; power *= 2, ++i)
    if ((units.powers & power) != 0)
      list.push_back(fmt::format("cos^{}", units.own.empty() ? power : units.own[i - 1]));
  return fmt::format("{}", fmt::join(list, ", "));
}

// Removes units that serve only effects that the hardware does not have.
HardwareKey without_idle_lights(HardwareKey key) {
  SphericalUnits& s = key.spherical;
  if (!s.records()) {
    s.lights = 0;
    s.diffuse = s.specular = false;
  }
  if (!s.specular) s.powers = 0;
  s.highlight_channels = s.specular ? std::min(s.highlight_channels, key.channels) : 1;
  return key;
}

unsigned every_power(const HardwareKey& key) {
  if (!key.spherical.own.empty()) return own_powers(key.spherical.own);
  return key.preset == Preset::exact ? c_every_power : c_squared;
}

HardwareKey every_spherical_unit(HardwareKey key, unsigned lights) {
  SphericalUnits& s = key.spherical;
  key.channels = s.highlight_channels = 3;
  s.lights = lights;
  s.diffuse = s.specular = true;
  s.powers = every_power(key);
  return key;
}

class SphericalPlanner : public EffectPlanner {
 public:
  SphericalPlanner(const SceneCalls& calls, const Plan& plan)
      : EffectPlanner(calls, plan.key, without_idle_lights), called_for_(plan.called_for.spherical) {}

  PlannedEffect effect_of(Effect effect) const {
    const SphericalUnits& s = key_.spherical;
    const bool exact = key_.preset == Preset::exact;
    HardwareKey other = key_;
    SphericalUnits& o = other.spherical;
    switch (effect) {
      case Effect::ambient:
        return in_hardware(effect, "its word also contains the rounding of the colours", true);
      case Effect::depth:
        return in_hardware(effect, "", true);
      case Effect::diffuse:
        o.diffuse = !s.diffuse;
        o.lights = std::max(s.lights, 1U);
        return in_hardware(effect, "one slice per light", s.diffuse, other);
      case Effect::specular:
        o.specular = !s.specular;
        o.lights = std::max(s.lights, 1U);
        if (o.specular) o.powers = c_squared;
        return in_hardware(effect, "one slice per light", s.specular, other);
      case Effect::highlight_colour:
        if (!s.specular) return in_hardware(effect, "");
        o.highlight_channels = s.highlight_channels == 1 ? 3 : 1;
        other.channels = std::max(key_.channels, o.highlight_channels);
        return in_hardware(effect, "one multiplier per channel", s.highlight_channels == 3, other);
      case Effect::exponents: {
        if (!exact) return planned(effect, DoneBy::host, "one table, cos^2; the exponent scales its angle");
        if (!s.specular) return in_hardware(effect, "");
        const bool several = std::popcount(s.powers) > 1;
        o.powers = several ? std::bit_floor(s.powers) : every_power(key_);
        PlannedEffect out = in_hardware(effect, "one table each, and a selection", several, other);
        // One table may serve several exponents.
        out.called_for = std::popcount(called_for_.powers) > 1;
        if (called_for_.specular) out.why += ": " + names(called_for_);
        return out;
      }
      case Effect::directional:
        return lights_of(effect, LightKind::directional, "the host computes the vectors to it");
      case Effect::positional:
        return lights_of(effect, LightKind::positional, "the host computes the vectors to it");
      case Effect::spot:
        return lights_of(effect, LightKind::spot, "the host computes the vectors to it and its cone");
      case Effect::normalization:
        return planned(effect, DoneBy::host,
                       exact ? "at both ends of a span" : "only at the vertices, angles need no others");
      case Effect::colour:
        other.channels = key_.channels == 1 ? 3 : 1;
        return in_hardware(effect, "multipliers and one sum per channel", key_.channels == 3, other);
      case Effect::subdivision:
        if (!exact) break;
        return planned(effect, DoneBy::host, "triangles cut into strips above a threshold");
      case Effect::perspective:
        return planned(
            effect, DoneBy::host,
            exact ? "at both ends of a span" : "only at the vertices, none between them, as published");
      case Effect::shadow:
        break;
    }
    return planned(effect, DoneBy::none,
                   effect == Effect::shadow ? "not by this shader" : "not by preset published");
  }

 private:
  // The slices of a light are the same for all kinds.
  PlannedEffect lights_of(Effect effect, LightKind kind, std::string how) const {
    const auto count = static_cast<unsigned>(calls_.count(kind));
    HardwareKey other = key_;
    SphericalUnits& o = other.spherical;
    if (count == 0) {
      if (o.lights == c_most_lights) return in_hardware(effect, std::move(how));
      if (!o.records()) o.diffuse = true;
      ++o.lights;
    } else {
      o.lights -= count;
    }
    return in_hardware(effect, std::move(how), count > 0, other);
  }

  const SphericalUnits& called_for_;
};

}  // namespace

std::vector<words::CosineSize> cosine_sizes(Preset preset) {
  const bool exact = preset == Preset::exact;
  std::vector<words::CosineSize> sizes = {exact ? words::c_exact_cosine_size
                                                : words::c_published_cosine_size};
  for (const words::CosineTable& table : words::c_cosine_tables)
    if (table.exact == exact && std::find(sizes.begin(), sizes.end(), table.size) == sizes.end())
      sizes.push_back(table.size);
  return sizes;
}

Result<Plan> plan_spherical(const Scene& scene, const SceneCalls& calls, const PlanRequest& request) {
  if (request.form) return bad_input(c_form_of_another);
  if (request.degree) return bad_input(c_degree_of_another);
  const auto tables = table_size(request);
  if (!tables) return tables.error();
  const auto most = lights_of_everything(scene, calls, request, "spherical shader supports");
  if (!most) return most.error();

  Plan plan;
  HardwareKey& key = plan.called_for;
  key.shader = Shader::spherical;
  key.preset = request.preset;
  key.channels = calls[Effect::colour].called_for ? 3 : 1;
  SphericalUnits& units = key.spherical;
  units.tables = *tables;
  units.made_tables = request.made_tables;
  units.own = request.own;
  units.lights = static_cast<unsigned>(calls.lights.size());
  units.diffuse = calls[Effect::diffuse].called_for;
  units.specular = calls[Effect::specular].called_for;
  units.highlight_channels = calls[Effect::highlight_colour].called_for ? key.channels : 1;
  if (units.specular) {
    const auto powers = powers_of(scene, request);
    if (!powers) return powers.error();
    units.powers = *powers;
  }

  plan.everything = every_spherical_unit(key, *most);
  plan.key = request.all_effects ? plan.everything : plan.called_for;
  const SphericalPlanner planner(calls, plan);
  for (std::size_t i = 0; i < c_effects; ++i)
    plan.effects.push_back(planner.effect_of(static_cast<Effect>(i)));
  return plan;
}

}  // namespace halfway
