// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/given_fields.hpp"

#include <fmt/format.h>

#include <span>

#include "sim/driver/shader_stages.hpp"
#include "words/processors_layout.hpp"
#include "words/quadratic_layout.hpp"
#include "words/spherical_layout.hpp"

namespace halfway {
namespace {

template <class P, int Degree>
GivenFields quadratic_given(const HardwareKey& key) {
  using Layout = words::QuadraticLayout<P, Degree>;
  GivenFields given;
  for (const words::Field& f : P::c_init_header) given.init.push_back({std::string(f.name), f, 0});
  for (unsigned c = 0; c < key.channels; ++c)
    for (const words::Field& f : P::c_init_channel)
      if (Layout::has(f))
        given.init.push_back({fmt::format("{} {}", channel_name(c, key.channels), f.name), f,
                              Layout::channel_low(static_cast<int>(c))});
  return given;
}

template <class P>
GivenFields spherical_given(const HardwareKey& key) {
  const words::SphericalConfig config = golden_config(key);
  const words::SphericalLayout<P> at(config);
  GivenFields given;
  for (const words::Field& f : P::c_init_header) given.init.push_back({std::string(f.name), f, 0});
  for (int c = 0; c < config.channels; ++c)
    given.init.push_back({channel_name(static_cast<unsigned>(c), key.channels) + " ambient",
                          P::ambient_channel_at::ambient, at.ambient_low(c)});
  // A slice's part of a record: the fields of its header, then one word per channel.
  const auto place = [&](std::span<const words::Field> header, int header_bits,
                         std::span<const words::Field> channel, int channel_bits, int channels,
                         const std::string& slice, int low) {
    for (const words::Field& f : header)
      given.record.push_back({fmt::format("{} {}", slice, f.name), f, low});
    for (int c = 0; c < channels; ++c)
      for (const words::Field& f : channel)
        given.record.push_back(
            {fmt::format("{} {}{}", slice,
                         channels == 1 ? "" : channel_name(static_cast<unsigned>(c), 3) + " ", f.name),
             f, low + header_bits + c * channel_bits});
  };
  for (int l = 0; l < config.lights; ++l) {
    const std::string light = fmt::format("light {}", l + 1);
    if (at.has_diffuse_part())
      place(P::c_diffuse_header, P::c_diffuse_header_bits, P::c_diffuse_channel, P::c_diffuse_channel_bits,
            at.diffuse_channels(), light + " diffuse", at.diffuse_low(l));
    if (config.specular)
      place(P::c_specular_header, P::c_specular_header_bits, P::c_specular_channel,
            P::c_specular_channel_bits, config.highlight_channels, light + " specular", at.specular_low(l));
  }
  return given;
}

template <class P>
GivenFields processors_given(const HardwareKey& key) {
  using words::Field;
  const words::ProcessorsConfig config = processors_config(key);
  const words::ProcessorsLayout<P> at(config);
  GivenFields given;
  for (const Field& f : P::c_request_header) given.init.push_back({std::string(f.name), f, 0});
  for (const Field& f : words::Exact::c_init_header)
    given.init.push_back({std::string(f.name), f, at.walk_low()});
  const std::vector<std::string> planes = plane_names(key);
  for (std::size_t p = 0; p < planes.size(); ++p)
    for (const Field& f : P::c_plane_header)
      given.init.push_back({fmt::format("{} {}", planes[p], f.name), f, at.plane_low(static_cast<int>(p))});
  const int material = at.init_material_low();
  if (config.specular)
    given.init.push_back({"exponent",
                          {"", at.exponent_low(), P::c_exponent_bits, false, P::c_exponent_fraction_bits},
                          material});
  const auto place_coefficient = [&](const char* name, int low, int channel) {
    given.init.push_back(
        {fmt::format("{} {}", channel_name(static_cast<unsigned>(channel), key.channels), name),
         {"", low, P::c_coefficient_bits, false, P::c_coefficient_fraction_bits},
         material});
  };
  for (int c = 0; c < config.channels; ++c) {
    place_coefficient("k ambient", at.ambient_low(c), c);
    if (config.diffuse) place_coefficient("k diffuse", at.diffuse_low(c), c);
    if (config.specular) place_coefficient("k specular", at.specular_low(c), c);
  }
  return given;
}

template <class P>
GivenFields given_of(const HardwareKey& key) {
  if (key.shader == Shader::processors) return processors_given<P>(key);
  if (key.shader == Shader::spherical) return spherical_given<P>(key);
  return key.degree == 1 ? quadratic_given<P, 1>(key) : quadratic_given<P, 2>(key);
}

}  // namespace

GivenFields given_fields(const HardwareKey& key) {
  return key.preset == Preset::exact ? given_of<words::Exact>(key) : given_of<words::Published>(key);
}

}  // namespace halfway
