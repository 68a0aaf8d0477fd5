// SPDX-License-Identifier: Apache-2.0
// For tests: a simple scene for the spherical shader, and the error bound of preset exact for it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "plan/plan.hpp"
#include "scene/lights.hpp"
#include "setup/spherical_setup.hpp"
#include "shading/effects.hpp"
#include "sim/os/must.hpp"
#include "words/generator/cosine.hpp"

namespace halfway {

inline constexpr int c_exact_subpixel_bits = 4;

/// Odd sizes, so that a pixel is at the exact middle.
inline constexpr FrameSize c_stage_frame{65, 49};

/// A triangle that fills the view of an eye straight above it, without lights.
inline Scene stage(const std::array<glm::dvec3, 3>& normals = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}) {
  Scene scene;
  scene.name = "stage";
  scene.materials = {{.name = "m", .ambient = 0.0, .diffuse = 0.5, .specular = 0.5, .exponent = 20.0}};
  scene.camera.eye_world = {0.0, 0.0, 4.0};
  scene.positions_world = {{-1.6, -1.3, 0.0}, {1.7, -1.2, 0.0}, {-0.1, 1.4, 0.0}};
  for (const glm::dvec3& n : normals) scene.normals_world.push_back(glm::normalize(n));
  scene.triangles = {{{0, 1, 2}, {0, 1, 2}, 0}};
  return scene;
}

/// One light of each kind, from the side.
inline void add_side_lights(Scene& scene) {
  scene.directional.push_back({glm::normalize(glm::dvec3(0.3, 0.2, 1.0)), glm::dvec3(0.4)});
  scene.positional.push_back({{0.4, -0.3, 2.0}, glm::dvec3(0.4)});
  scene.spots.push_back(
      {{-0.5, 0.3, 2.5}, glm::normalize(glm::dvec3(0.5, -0.2, -2.5)), 0.95, 0.9, glm::dvec3(0.4)});
}

/// Moves the eye so far away that its rays are parallel. The triangle still fills the view.
inline void move_eye_away(Scene& scene) {
  scene.camera.eye_world.z = 1e9;
  scene.camera.vertical_fov_degrees = 1e-7;
}

inline HardwareKey spherical_key(const Scene& scene, Preset preset = Preset::exact) {
  return must(plan_scene(scene, {.shader = Shader::spherical, .preset = preset})).key;
}

/// Greatest difference, in colour steps, between a fragment and the illumination model if the interpolation
/// stays within the threshold. It adds the errors of bells and tables for each light, and the rounding.
inline double promised_steps(const Scene& scene, const HardwareKey& key, double threshold) {
  const words::CosineSize size = key.spherical.tables;
  const auto error = [&](int power) {
    // Includes the angle's drift of up to 2^-11 of a half bell. No table is steeper than 4 per half bell.
    return tables::table_error(tables::cosine_table(true, power, size)) + 0x1p-11 * 4;
  };
  double largest = 0.0;
  for (const Material& m : scene.materials) {
    const double exponent = std::min(m.exponent, c_largest_exponent);
    const Bell bell = fitted_bell(exponent);
    double steps = threshold + 0.5 + 0x1p-9;
    for (const LightRef light : shining_lights(scene)) {
      const glm::dvec3 in = light_of(scene, light).intensity;
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
