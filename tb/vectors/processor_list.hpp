// SPDX-License-Identifier: Apache-2.0
// The shading processors that the testbenches run, and the names of their files. tb/rtl/tb_processors_pkg.vhd
// has the same list.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "golden/light_term.hpp"

namespace halfway::vectors {

struct Processor {
  words::ProcessorsConfig config;
  words::Term term;
  int light;  ///< 0 for the ambient processor
};

/// Preset, channels, lights of each kind and effects.
template <class Preset>
std::string name_of(const words::ProcessorsConfig& c) {
  return fmt::format("{}_{}{}{}{}{:d}{:d}{:d}{:d}", Preset::c_name, c.channels, c.directional, c.positional,
                     c.spots, c.diffuse, c.specular, c.normalize, c.shadows);
}
template <class Preset>
std::string name_of(const Processor& processor) {
  return fmt::format("{}_{}{}", name_of<Preset>(processor.config), static_cast<int>(processor.term),
                     processor.light);
}

/// Every processor of seven pipelines: one with all effects, the paper's version I, one with only a
/// positional light, one with only a spot, and three with single effects.
inline std::vector<Processor> processors() {
  constexpr words::ProcessorsConfig c_configs[] = {
      {3, 1, 1, 1, true, true, true, true},    {3, 1, 0, 0, true, true, false, false},
      {3, 0, 1, 0, true, true, true, false},   {1, 0, 0, 1, true, false, false, false},
      {1, 1, 0, 0, true, false, false, false}, {1, 0, 1, 1, false, true, false, false},
      {1, 1, 0, 0, true, false, true, false}};
  std::vector<Processor> all;
  for (const words::ProcessorsConfig& config : c_configs) {
    all.push_back({config, words::Term::ambient, 0});
    for (int light = 1; light <= config.lights(); ++light) {
      if (config.diffuse) all.push_back({config, words::Term::diffuse, light});
      if (config.specular) all.push_back({config, words::Term::specular, light});
    }
  }
  return all;
}

}  // namespace halfway::vectors
