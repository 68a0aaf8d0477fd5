// SPDX-License-Identifier: Apache-2.0
// Entry points of a shared library with setup and golden model of one shader and preset, compiled with other
// word lengths: see sim/generator/word_lengths/README.md. HALFWAY_SHADER is the shader's number,
// HALFWAY_PRESET its formats' name.
#include "golden_run/shader_model.hpp"
#include "setup/processors_setup.hpp"
#include "setup/quadratic_setup.hpp"
#include "setup/spherical_setup.hpp"

namespace halfway {
namespace {

using Formats = golden::HALFWAY_PRESET;
constexpr auto c_shader = static_cast<Shader>(HALFWAY_SHADER);

// Inside this library the compiled formats are the key's word lengths.
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
  return make_shader_model<Formats, c_shader>(built_in(key)).release();
}
}
