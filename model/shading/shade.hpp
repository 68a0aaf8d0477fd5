// SPDX-License-Identifier: Apache-2.0
// The illumination model at one point of a surface, in double. All shaders of this project approximate it.
#pragma once

#include <cstdlib>
#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include "scene/lights.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Upper bounds of the model's results, so that every result is finite. Cook-Torrance is unbounded if light
/// and eye are both at grazing angles on opposite sides.
inline constexpr double c_largest_specular = 1e6;
inline constexpr double c_largest_radiance = 1e12;

// The terms as functions of plain numbers: cosines and sines of angles between unit vectors.

/// base^exponent, 0 for base <= 0: (R.V)^n of Phong (spherical, equation 4), (N.H)^n of Blinn (spherical,
/// equation 5).
double highlight_power(double base, double exponent);

/// Beckmann's density of microfacet normals at the angle between N and H (P of spherical, equation 7),
/// 1/steradian: exp(-tan^2/m^2) / (pi m^2 cos^4). The squared sine is a separate argument: 1 - cos^2 has no
/// accurate digits close to 0.
double beckmann(double n_dot_h, double sin2_n_h, double roughness);

/// Schlick's approximation of Fresnel's reflectance, `reflectance` at normal incidence.
double schlick(double reflectance, double l_dot_h);

/// (N.L)/(4 (N.L)(N.V)) min{2 (N.H)(N.V)/(V.H), 2 (N.H)(N.L)/(L.H), 1} (spherical, equation 7, times N.L),
/// with N.L and N.V cancelled. With s = |L+V|, N.H = (N.L+N.V)/s and V.H = L.H = s/2 it is min{N.L
/// (N.L+N.V)/(s^2 max(N.L, N.V)), 1/(4 N.V)}. 0 if light or eye is at or below the horizon.
double cook_torrance_geometry(double n_dot_l, double n_dot_v, double length2_l_plus_v);

/// Specular factor of a light, without k_s, colour and intensity. All vectors are unit and point away from
/// the surface. It replaces (N.H)^n in I = I_in (k_s (N.H)^n + k_d (N.L)). 0 if N.L <= 0. Finite, 0 to
/// c_largest_specular.
double specular_factor(const Material& material, glm::dvec3 normal, glm::dvec3 to_light, glm::dvec3 to_eye);

/// The part of the radiance that no light adds: I_a k_a and the surface's emission.
inline glm::dvec3 ambient_radiance(const Scene& scene, const Material& m) {
  return scene.ambient * (m.ambient * m.colour) + m.emission;
}

/// A material's colours, k_d and k_s included.
struct SurfaceColours {
  glm::dvec3 diffuse, specular;

  explicit SurfaceColours(const Material& m)
      : diffuse(m.diffuse * m.colour), specular(m.specular * m.specular_colour) {}
};

/// The equation of each kind of light: the part of its intensity that a surface reflects. Calls reaches() and
/// specular() only where their values matter.
template <class Reaches, class Specular>
glm::dvec3 reflected(LightKind kind, const SurfaceColours& colours, double n_dot_l, Reaches&& reaches,
                     Specular&& specular) {
  switch (kind) {
    case LightKind::directional:
    case LightKind::positional:
    case LightKind::spot:
      if (!(n_dot_l > 0) || !reaches()) return glm::dvec3(0.0);
      return n_dot_l * colours.diffuse + specular() * colours.specular;
  }
  std::abort();
}

/// True if a light reaches the point. Without a function every light does.
using LightFilter = std::function<bool(LightRef)>;

/// Radiance towards the eye: I_a k_a colour, the surface's emission, and from each light I (k_d colour
/// max(N.L, 0) + k_s specular_colour specular). Linear, not clamped to 1; finite and >= 0. `normal_world` is
/// unit. A light exactly at the point has no direction and contributes nothing. If the eye is exactly at the
/// point, the normal is used as the direction to the eye. A light for which `reaches` is false contributes
/// nothing.
glm::dvec3 radiance(const Scene& scene, const Material& material, glm::dvec3 position_world,
                    glm::dvec3 normal_world, const LightFilter& reaches = {});

/// The same, sooner: `lights` are lights_of(scene).
glm::dvec3 radiance(const Scene& scene, std::span<const Light> lights, const Material& material,
                    glm::dvec3 position_world, glm::dvec3 normal_world);

}  // namespace halfway
