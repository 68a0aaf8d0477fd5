// SPDX-License-Identifier: Apache-2.0
#include "plan/hardware_key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace halfway {
namespace {

const char* boolean(bool value) {
  return value ? "true" : "false";
}

}  // namespace

std::string HardwareKey::entity() const {
  return std::string(to_string(shader)) + "_shader";
}

std::vector<std::pair<std::string, std::string>> HardwareKey::generics() const {
  std::vector<std::pair<std::string, std::string>> list = {{"g_exact", boolean(preset == Preset::exact)},
                                                           {"g_channels", std::to_string(channels)}};
  if (shader == Shader::quadratic) list.emplace_back("g_degree", std::to_string(degree));
  if (shader == Shader::spherical) {
    list.emplace_back("g_lights", std::to_string(spherical.lights));
    list.emplace_back("g_diffuse", boolean(spherical.diffuse));
    list.emplace_back("g_specular", boolean(spherical.specular));
    list.emplace_back("g_highlight_channels", std::to_string(spherical.highlight_channels));
    list.emplace_back("g_powers", std::to_string(spherical.powers));
    list.emplace_back("g_cosine", vhdl_name(spherical.tables));
  }
  if (shader == Shader::processors) {
    list.emplace_back("g_directional", std::to_string(processors.directional));
    list.emplace_back("g_positional", std::to_string(processors.positional));
    list.emplace_back("g_spots", std::to_string(processors.spots));
    list.emplace_back("g_diffuse", boolean(processors.diffuse));
    list.emplace_back("g_specular", boolean(processors.specular));
    list.emplace_back("g_normalize", boolean(processors.normalize));
    list.emplace_back("g_shadows", boolean(processors.shadows));
    list.emplace_back("g_unrolled", boolean(processors.form == ProcessorForm::unrolled));
    if (processors.objects > 0) {
      list.emplace_back("g_objects", std::to_string(processors.objects));
      list.emplace_back("g_subpixels", std::to_string(processors.subpixels));
    }
  }
  return list;
}

std::vector<std::pair<std::string, std::string>> HardwareKey::stream_generics() const {
  auto list = generics();
  list.emplace_back("g_shader", to_string(shader));
  return list;
}

std::vector<std::pair<std::string, std::string>> HardwareKey::core_generics(bool true_colour,
                                                                            unsigned bus_bits) const {
  auto list = stream_generics();
  list.emplace_back("g_true_colour", boolean(true_colour));
  list.emplace_back("g_bus_bits", std::to_string(bus_bits));
  return list;
}

std::string HardwareKey::vhdl_init_bits() const {
  switch (shader) {
    case Shader::quadratic:
      return "work.quadratic_pkg.init_bits(g_exact, g_degree, g_channels)";
    case Shader::spherical:
      return "work.spherical_pkg.init_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular, "
             "g_highlight_channels)";
    case Shader::processors:
      return "work.processors_pkg.init_bits(work.processors_pkg.config(g_exact, g_channels, g_directional, "
             "g_positional, g_spots, g_diffuse, g_specular, g_normalize, g_shadows))";
  }
  return {};
}

std::string HardwareKey::name() const {
  std::string text = fmt::format("{}-{}-c{}", entity(), to_string(preset), channels);
  if (shader == Shader::quadratic && degree == 1) text += "-planes";
  if (shader == Shader::spherical) {
    text += fmt::format("-l{}", spherical.lights);
    if (spherical.diffuse) text += "-d";
    if (spherical.specular) {
      const bool own = !spherical.own.empty();
      std::vector<std::string> tables;
      for (unsigned i = 0; i < 5; ++i)
        if ((spherical.powers >> i & 1) != 0)
          tables.push_back(own ? fmt::format("{}", spherical.own[i - 1]) : std::to_string(1U << i));
      text += fmt::format("-s{}-{}{}", spherical.highlight_channels, own ? "own" : "cos",
                          fmt::join(tables, own ? "_" : "."));
    }
    if (spherical.records()) text += "-" + vhdl_name(spherical.tables);
  }
  if (shader == Shader::processors) {
    const ProcessorUnits& p = processors;
    text += fmt::format("-l{}.{}.{}", p.directional, p.positional, p.spots);
    if (p.diffuse) text += "-d";
    if (p.specular) text += "-s";
    if (p.normalize) text += "-n";
    if (p.shadows) text += "-shadows";
    text += fmt::format("-{}", to_string(p.form));
    if (p.objects > 0) text += fmt::format("-o{}x{}", p.objects, p.subpixels);
  }
  if (words.any()) text += "-" + words.name();
  return text;
}

words::SphericalConfig golden_config(const HardwareKey& key) {
  const SphericalUnits& s = key.spherical;
  words::SphericalConfig config{.channels = static_cast<int>(key.channels),
                                .lights = static_cast<int>(s.lights),
                                .diffuse = s.diffuse,
                                .specular = s.specular,
                                .highlight_channels = static_cast<int>(s.highlight_channels),
                                .powers = s.powers,
                                .size = s.tables};
  if (!s.made_tables.empty()) config.tables = s.made_tables;
  return config;
}

words::ProcessorsConfig processors_config(const HardwareKey& key) {
  const ProcessorUnits& p = key.processors;
  return {.channels = static_cast<int>(key.channels),
          .directional = static_cast<int>(p.directional),
          .positional = static_cast<int>(p.positional),
          .spots = static_cast<int>(p.spots),
          .diffuse = p.diffuse,
          .specular = p.specular,
          .normalize = p.normalize,
          .shadows = p.shadows};
}

}  // namespace halfway
