// SPDX-License-Identifier: Apache-2.0
#include "plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <set>

#include "golden/cosine_tables.hpp"
#include "plan/effects.hpp"
#include "setup/bell.hpp"

namespace halfway {
namespace {

// The first colour that is not grey, named; empty where all are.
std::string first_colour(const Scene& scene) {
  if (!is_grey(scene.ambient)) return "the ambient light is coloured";
  for (const LightRef light : shining_lights(scene))
    if (!is_grey(intensity(scene, light))) return name_of(light) + " is coloured";
  const std::vector<bool> worn = worn_materials(scene);
  for (std::size_t i = 0; i < worn.size(); ++i) {
    const Material& m = scene.materials[i];
    if (worn[i] && (!is_grey(m.colour) || (has_specular(m) && !is_grey(m.specular_colour))))
      return fmt::format("material '{}' is coloured", m.name);
  }
  return {};
}

// The first highlight that is not white, named; empty where all are.
std::string first_coloured_highlight(const Scene& scene) {
  for (const LightRef light : shining_lights(scene))
    if (!is_grey(intensity(scene, light))) return name_of(light) + " is coloured";
  const std::vector<bool> worn = worn_materials(scene);
  for (std::size_t i = 0; i < worn.size(); ++i) {
    const Material& m = scene.materials[i];
    if (worn[i] && has_specular(m) && !is_grey(m.specular_colour))
      return fmt::format("the highlights of material '{}' are coloured", m.name);
  }
  return {};
}

void plan_common(Plan& plan, const Scene& scene, Preset preset) {
  const std::string colour = first_colour(scene);
  plan.key.preset = preset;
  plan.key.channels = colour.empty() ? 1 : 3;
  plan.effects = {
      {"colour channels", !colour.empty(),
       colour.empty() ? "every light and material is grey: one channel" : colour},
      {"depth", true, "the z test needs every fragment's depth"},
      {"exact edges", preset == Preset::exact,
       preset == Preset::exact ? "preset exact: quotient and remainder" : "preset published: real slopes"},
  };
}

std::vector<TableSize> generated_sizes(bool exact) {
  std::vector<TableSize> sizes;
  for (const golden::CosineTable& table : golden::c_cosine_tables)
    if (const TableSize size{table.address_bits, table.data_bits};
        table.exact == exact && std::ranges::find(sizes, size) == sizes.end())
      sizes.push_back(size);
  return sizes;
}

Result<TableSize> table_size(const PlanRequest& request) {
  const bool exact = request.preset == Preset::exact;
  const golden::CosineSize usual = exact ? golden::c_exact_cosine_size : golden::c_published_cosine_size;
  if (!request.tables) return TableSize{usual.address_bits, usual.data_bits};
  const std::vector<TableSize> sizes = generated_sizes(exact);
  if (std::ranges::find(sizes, *request.tables) != sizes.end()) return *request.tables;
  std::vector<std::string> there;
  for (const TableSize& size : sizes)
    there.push_back(fmt::format("{}/{}", size.address_bits, size.data_bits));
  return bad_input(
      fmt::format("no cosine tables of {} address and {} data bits in preset {}: there are {}; make them "
                  "with `make tables "
                  "PRESET={} ADDRESS_BITS={} DATA_BITS={}`, and draw again",
                  request.tables->address_bits, request.tables->data_bits, to_string(request.preset),
                  fmt::join(there, ", "), to_string(request.preset), request.tables->address_bits,
                  request.tables->data_bits));
}

Result<Plan> plan_spherical(const Scene& scene, const PlanRequest& request) {
  Plan plan;
  plan.key.shader = Shader::spherical;
  plan_common(plan, scene, request.preset);
  SphericalUnits& units = plan.key.spherical;
  const auto tables = table_size(request);
  if (!tables) return tables.error();
  units.tables = *tables;

  const std::vector<LightRef> lights = shining_lights(scene);
  const bool lit = !lights.empty();
  std::string diffuse, specular;
  std::vector<std::string> bells;
  const std::vector<bool> worn = worn_materials(scene);
  for (std::size_t i = 0; i < worn.size(); ++i) {
    const Material& m = scene.materials[i];
    if (!worn[i]) continue;
    if (diffuse.empty() && has_diffuse(m))
      diffuse = fmt::format("material '{}' has k_d {:g}", m.name, m.diffuse);
    if (!has_specular(m)) continue;
    if (lit && m.brdf == Brdf::cook_torrance)
      return bad_input(fmt::format(
          "{}: material '{}' is cook_torrance, and the spherical shader's highlights are powers of a cosine; "
          "make it blinn or phong, or take the quadratic shader",
          scene.name, m.name));
    if (specular.empty()) specular = fmt::format("material '{}' has k_s {:g}", m.name, m.specular);
    // Each power is a power of two: itself the mask's bit.
    units.powers |=
        request.preset == Preset::exact ? static_cast<unsigned>(fitted_bell(m.exponent).power) : 2U;
  }
  if ((!diffuse.empty() || !specular.empty()) && lights.size() > c_most_lights)
    return bad_input(fmt::format(
        "{}: {} lights; the spherical shader takes up to {}: leave some out, or take the quadratic shader",
        scene.name, lights.size(), c_most_lights));
  units.diffuse = lit && !diffuse.empty();
  units.specular = lit && !specular.empty();
  units.lights = units.diffuse || units.specular ? static_cast<unsigned>(lights.size()) : 0;
  const std::string coloured = units.specular ? first_coloured_highlight(scene) : "";
  units.highlight_channels = coloured.empty() ? 1 : plan.key.channels;
  if (!units.specular) units.powers = 0;
  for (unsigned power = 1; power <= 16; power *= 2)
    if ((units.powers & power) != 0) bells.push_back(fmt::format("cos^{}", power));

  const std::string dark = "no light shines";
  plan.effects.push_back({"lights", units.records(),
                          !lit               ? dark
                          : !units.records() ? "no material reflects them"
                                             : fmt::format("{}, each with slices of its own", units.lights)});
  plan.effects.push_back({"diffuse", units.diffuse,
                          !lit              ? dark
                          : diffuse.empty() ? "every k_d is 0"
                                            : diffuse});
  plan.effects.push_back({"specular", units.specular,
                          !lit               ? dark
                          : specular.empty() ? "every k_s is 0"
                                             : specular});
  if (units.specular) {
    plan.effects.push_back(
        {"highlight colour", !coloured.empty(),
         coloured.empty() ? "every highlight is white: one multiplier for all channels" : coloured});
    plan.effects.push_back(
        {"cosine powers", true, fmt::format("{} for the exponents in use", fmt::join(bells, ", "))});
  }
  if (units.records())
    plan.effects.push_back(
        {"cosine tables", true,
         fmt::format("{} address bits, {} data bits", units.tables.address_bits, units.tables.data_bits)});
  return plan;
}

}  // namespace

Result<Plan> plan_scene(const Scene& scene, const PlanRequest& request) {
  if (request.shader == Shader::spherical) return plan_spherical(scene, request);
  if (request.tables)
    return bad_input("--address-bits, --data-bits: only the spherical shader has cosine tables");
  Plan plan;
  plan_common(plan, scene, request.preset);
  return plan;
}

}  // namespace halfway
