// SPDX-License-Identifier: Apache-2.0
// The way into setup and golden model of one shader and preset, compiled with other formats:
// sim/formats/made_formats.hpp. HALFWAY_SHADER is the shader's number, HALFWAY_PRESET its formats' name.
#define HALFWAY_MODELS_ALONE 1
#include "golden_run/golden_run.cpp"
#include "setup/processors_setup.hpp"
#include "setup/quadratic_setup.hpp"
#include "setup/spherical_setup.hpp"

namespace halfway {
namespace {

using Formats = golden::HALFWAY_PRESET;
constexpr auto c_shader = static_cast<Shader>(HALFWAY_SHADER);

// In here the formats are those that the key asks for.
HardwareKey built_in(HardwareKey key) {
  key.words = {};
  return key;
}

template <Shader S>
std::unique_ptr<Setup> setup_of(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                const SetupOptions& options) {
  if constexpr (S == Shader::spherical)
    return std::make_unique<SphericalSetup>(scene, frame, key, options.spherical);
  else if constexpr (S == Shader::processors)
    return make_processors_setup(scene, frame, key, options.processors);
  else
    return std::make_unique<QuadraticSetup>(scene, frame, key, options.quadratic);
}

template <Shader S>
std::unique_ptr<GoldenModel> model_of(const HardwareKey& key) {
  if constexpr (S == Shader::spherical)
    return std::make_unique<Model<golden::SphericalShader<Formats>>>(golden_config(key));
  else if constexpr (S == Shader::processors)
    return std::make_unique<Model<golden::ProcessorsShader<Formats>>>(processors_config(key));
  else if (key.channels == 1)
    return std::make_unique<Model<golden::QuadraticShader<Formats, 1>>>();
  else
    return std::make_unique<Model<golden::QuadraticShader<Formats, 3>>>();
}

}  // namespace
}  // namespace halfway

extern "C" {

[[gnu::visibility("default")]] halfway::Setup* halfway_make_setup(const halfway::Scene& scene,
                                                                  const halfway::FrameSize& frame,
                                                                  const halfway::HardwareKey& key,
                                                                  const halfway::SetupOptions& options) {
  using namespace halfway;
  return setup_of<c_shader>(scene, frame, built_in(key), options).release();
}

[[gnu::visibility("default")]] halfway::GoldenModel* halfway_make_golden_model(
    const halfway::HardwareKey& key) {
  using namespace halfway;
  return model_of<c_shader>(built_in(key)).release();
}
}
