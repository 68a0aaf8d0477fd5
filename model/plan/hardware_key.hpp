// SPDX-License-Identifier: Apache-2.0
// The hardware key: what is elaborated. One key, one build of the RTL for each simulator.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace halfway {

enum class Preset { exact, published };
inline const char* to_string(Preset preset) {
  return preset == Preset::exact ? "exact" : "published";
}

struct HardwareKey {
  std::string entity = "quadratic_shader";  ///< top entity in rtl/shaders
  Preset preset = Preset::exact;
  unsigned channels = 3;  ///< 1 where every colour of the scene is grey
  bool probe = false;     ///< brings the stages' registers out, for `halfway why` and the register tests

  /// Generics of the top entity, as `-g` takes them, in a fixed order.
  std::vector<std::pair<std::string, std::string>> generics() const {
    return {{"g_exact", preset == Preset::exact ? "true" : "false"},
            {"g_channels", std::to_string(channels)},
            {"g_probe", probe ? "true" : "false"}};
  }
  /// Such as quadratic_shader-exact-c3; names the cached build.
  std::string name() const {
    return entity + '-' + to_string(preset) + "-c" + std::to_string(channels) + (probe ? "-probe" : "");
  }
};

}  // namespace halfway
