// SPDX-License-Identifier: Apache-2.0
// The illumination model at one point of a surface, in double: what every shader here approximates.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "scene/lights.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Bounds on what the model may return, so that every result is finite. Cook-Torrance grows without bound
/// where light and eye both graze the surface from opposite sides.
inline constexpr double c_largest_specular = 1e6;
inline constexpr double c_largest_radiance = 1e12;

// The terms on plain numbers: cosines and sines between unit vectors, nothing else.

/// base^exponent, 0 for base <= 0: (N.H)^n of Blinn, (R.V)^n of Phong (spherical, equations 4 and 5).
double highlight_power(double base, double exponent);

/// Beckmann's density of microfacet normals at the angle between N and H (P of spherical, equation 7),
/// 1/steradian: exp(-tan^2/m^2) / (pi m^2 cos^4). The sine comes squared and by itself: 1 - cos^2 has no
/// digits left near 0.
double beckmann(double n_dot_h, double sin2_n_h, double roughness);

/// Schlick's approximation of Fresnel's reflectance, `reflectance` at normal incidence.
double schlick(double reflectance, double l_dot_h);

/// (N.L)/(4 (N.L)(N.V)) min{2 (N.H)(N.V)/(V.H), 2 (N.H)(N.L)/(L.H), 1} (spherical, equation 7, times N.L),
/// with N.L and N.V cancelled: with s = |L+V|, N.H = (N.L+N.V)/s and V.H = L.H = s/2 it is min{N.L
/// (N.L+N.V)/(s^2 max(N.L, N.V)), 1/(4 N.V)}. 0 at and below the horizon of either.
double cook_torrance_geometry(double n_dot_l, double n_dot_v, double length2_l_plus_v);

/// Specular factor of a light, before k_s, colour and intensity, all vectors unit, from the surface outwards.
/// It takes the place of (N.H)^n in I = I_in (k_s (N.H)^n + k_d (N.L)); 0 where N.L <= 0. Finite, 0 to
/// c_largest_specular.
double specular_factor(const Material& material, glm::dvec3 normal, glm::dvec3 to_light, glm::dvec3 to_eye);

/// Whether a light reaches the point in question; without a function every one does.
using LightFilter = std::function<bool(LightRef)>;

/// Radiance towards the eye: I_a k_a colour, and from each light I (k_d colour max(N.L, 0) + k_s
/// specular_colour specular). Linear, not clamped to 1; finite and >= 0. `normal_world` is unit. A light at
/// the very point has no direction and gives nothing; where the eye is at the point the normal stands for the
/// direction to it. A light for which `reaches` is false gives nothing.
glm::dvec3 radiance(const Scene& scene, const Material& material, glm::dvec3 position_world,
                    glm::dvec3 normal_world, const LightFilter& reaches = {});

}  // namespace halfway
