// SPDX-License-Identifier: Apache-2.0
// For tests: what the golden model draws of a scene, and what preset exact promises of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "plan/effects.hpp"
#include "plan/plan.hpp"
#include "run/golden_run.hpp"
#include "setup/spherical_setup.hpp"
#include "tables/cosine.hpp"

namespace halfway {

inline constexpr int c_exact_subpixel_bits = 4;

inline HardwareKey spherical_key(const Scene& scene, Preset preset = Preset::exact) {
  const auto plan = plan_scene(scene, {.shader = Shader::spherical, .preset = preset});
  EXPECT_TRUE(plan) << plan.error().message;
  return plan ? plan->key : HardwareKey{.shader = Shader::spherical, .preset = preset};
}

struct Drawn {
  std::vector<Fragment> fragments;
  std::vector<std::uint32_t> words;
  std::size_t vector_words = 0;
  SetupCounts counts;
};

inline Drawn draw(const Scene& scene, FrameSize frame, const HardwareKey& key,
                  const SphericalSetupOptions& options = {}) {
  const SphericalSetup setup(scene, frame, key, options);
  const auto model = make_golden_model(key);
  EXPECT_EQ(setup.init_bits(), model->init_bits());
  Drawn drawn;
  drawn.vector_words = (setup.init_bits() + 31) / 32;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) setup.append(t, drawn.words, drawn.counts);
  EXPECT_EQ(drawn.words.size(), (drawn.counts.vectors + drawn.counts.records) * drawn.vector_words);
  model->draw(drawn.words, drawn.fragments);
  return drawn;
}

/// How far, in colour steps, a fragment may be from the illumination model where the interpolation holds the
/// threshold: what bells and tables add for each light, and roundings.
inline double promised_steps(const Scene& scene, const HardwareKey& key, double threshold) {
  const TableSize size = key.spherical.tables;
  const auto error = [&](int power) {
    // And the angle's drift, 2^-11 of a half bell at most; no table is steeper than 4 a half bell.
    return tables::table_error(tables::cosine_table(true, power, size.address_bits, size.data_bits)) +
           0x1p-11 * 4;
  };
  double largest = 0.0;
  for (const Material& m : scene.materials) {
    const double exponent = std::min(m.exponent, c_largest_exponent);
    const Bell bell = fitted_bell(exponent);
    double steps = threshold + 0.5 + 0x1p-9;
    for (const LightRef light : shining_lights(scene)) {
      const glm::dvec3 in = intensity(scene, light);
      steps +=
          255.0 * std::max({in.x, in.y, in.z}) *
              ((has_diffuse(m) ? m.diffuse * error(1) : 0.0) +
               (has_specular(m) ? m.specular * (fit_error(exponent, bell) + bell.gain * error(bell.power))
                                : 0.0)) +
          0x1p-8;
    }
    largest = std::max(largest, steps);
  }
  return largest;
}

}  // namespace halfway
