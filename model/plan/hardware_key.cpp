// SPDX-License-Identifier: Apache-2.0
#include "plan/hardware_key.hpp"

#include <fmt/format.h>

namespace halfway {
namespace {

const char* boolean(bool value) {
  return value ? "true" : "false";
}

// A call of the package function that gives a port's width.
std::string width(const HardwareKey& key, const char* function) {
  if (key.shader == Shader::quadratic)
    return fmt::format("work.formats_pkg.{}(g_exact, g_channels)", function);
  return fmt::format(
      "work.spherical_pkg.{}(g_exact, g_channels, g_lights, g_diffuse, g_specular, g_highlight_channels)",
      function);
}

}  // namespace

std::string HardwareKey::entity() const {
  return std::string(to_string(shader)) + "_shader";
}

std::vector<std::pair<std::string, std::string>> HardwareKey::generics() const {
  std::vector<std::pair<std::string, std::string>> list = {{"g_exact", boolean(preset == Preset::exact)},
                                                           {"g_channels", std::to_string(channels)}};
  if (shader == Shader::spherical) {
    list.emplace_back("g_lights", std::to_string(spherical.lights));
    list.emplace_back("g_diffuse", boolean(spherical.diffuse));
    list.emplace_back("g_specular", boolean(spherical.specular));
    list.emplace_back("g_highlight_channels", std::to_string(spherical.highlight_channels));
    list.emplace_back("g_powers", std::to_string(spherical.powers));
    list.emplace_back("g_address_bits", std::to_string(spherical.tables.address_bits));
    list.emplace_back("g_data_bits", std::to_string(spherical.tables.data_bits));
  }
  list.emplace_back("g_probe", boolean(probe));
  return list;
}

std::string HardwareKey::vhdl_init_bits() const {
  return width(*this, "init_bits");
}
std::string HardwareKey::vhdl_probe_bits() const {
  return width(*this, "probe_bits");
}

std::string HardwareKey::name() const {
  std::string text = fmt::format("{}-{}-c{}", entity(), to_string(preset), channels);
  if (shader == Shader::spherical) {
    text += fmt::format("-l{}", spherical.lights);
    if (spherical.diffuse) text += "-d";
    if (spherical.specular) {
      text += fmt::format("-s{}-cos", spherical.highlight_channels);
      for (unsigned i = 0, first = 1; i < 5; ++i)
        if ((spherical.powers >> i & 1) != 0) {
          text += fmt::format("{}{}", first != 0 ? "" : ".", 1U << i);
          first = 0;
        }
    }
    if (spherical.records())
      text += fmt::format("-rom{}x{}", spherical.tables.address_bits, spherical.tables.data_bits);
  }
  return text + (probe ? "-probe" : "");
}

golden::SphericalConfig golden_config(const HardwareKey& key) {
  const SphericalUnits& s = key.spherical;
  return {.channels = static_cast<int>(key.channels),
          .lights = static_cast<int>(s.lights),
          .diffuse = s.diffuse,
          .specular = s.specular,
          .highlight_channels = static_cast<int>(s.highlight_channels),
          .powers = s.powers,
          .address_bits = s.tables.address_bits,
          .data_bits = s.tables.data_bits};
}

}  // namespace halfway
