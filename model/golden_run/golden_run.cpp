// SPDX-License-Identifier: Apache-2.0
#include "golden_run/golden_run.hpp"

#include "golden_run/shader_model.hpp"

namespace halfway {
namespace {

template <class Formats>
std::unique_ptr<GoldenModel> make(const HardwareKey& key) {
  if (key.shader == Shader::spherical) return make_shader_model<Formats, Shader::spherical>(key);
  if (key.shader == Shader::processors) return make_shader_model<Formats, Shader::processors>(key);
  return make_shader_model<Formats, Shader::quadratic>(key);
}

}  // namespace

std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key) {
  return key.preset == Preset::exact ? make<golden::Exact>(key) : make<golden::Published>(key);
}

}  // namespace halfway
