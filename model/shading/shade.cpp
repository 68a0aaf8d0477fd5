// SPDX-License-Identifier: Apache-2.0
#include "shading/shade.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace halfway {
namespace {

/// max(0, min(v, limit)), and 0 for NaN.
double bounded(double v, double limit) {
  return v > 0 ? std::min(v, limit) : 0.0;
}

}  // namespace

double highlight_power(double base, double exponent) {
  return base > 0 ? std::pow(std::min(base, 1.0), exponent) : 0.0;
}

double beckmann(double n_dot_h, double sin2_n_h, double roughness) {
  if (!(n_dot_h > 0)) return 0.0;
  const double tangent_over_m = std::sqrt(sin2_n_h) / n_dot_h / roughness;
  const double exponent = tangent_over_m * tangent_over_m;
  if (!(exponent < 700)) return 0.0;  // cos^4 may have underflowed too
  const double m_cos2 = roughness * n_dot_h * n_dot_h;
  return std::exp(-exponent) / (std::numbers::pi * m_cos2 * m_cos2);
}

double schlick(double reflectance, double l_dot_h) {
  const double x = std::clamp(1.0 - l_dot_h, 0.0, 1.0);
  return reflectance + (1.0 - reflectance) * (x * x) * (x * x) * x;
}

double cook_torrance_geometry(double n_dot_l, double n_dot_v, double length2_l_plus_v) {
  if (!(n_dot_l > 0) || !(n_dot_v > 0)) return 0.0;
  const double masked = n_dot_l * ((n_dot_l + n_dot_v) / std::max(n_dot_l, n_dot_v)) / length2_l_plus_v;
  return std::min(masked, 0.25 / n_dot_v);
}

double specular_factor(const Material& material, glm::dvec3 normal, glm::dvec3 to_light, glm::dvec3 to_eye) {
  const double n_dot_l = glm::dot(normal, to_light);
  if (!(n_dot_l > 0)) return 0.0;
  if (material.brdf == Brdf::phong) {
    const glm::dvec3 mirrored = 2.0 * n_dot_l * normal - to_light;
    return highlight_power(glm::dot(mirrored, to_eye), material.exponent);
  }
  const glm::dvec3 l_plus_v = to_light + to_eye;
  const double length = glm::length(l_plus_v);
  if (!(length > 0)) return 0.0;  // L = -V: no halfway vector
  const glm::dvec3 halfway = l_plus_v / length;
  const double n_dot_h = glm::dot(normal, halfway);
  if (material.brdf == Brdf::blinn) return highlight_power(n_dot_h, material.exponent);

  const double n_dot_v = glm::dot(normal, to_eye);
  const glm::dvec3 across = glm::cross(normal, halfway);
  const double density = bounded(beckmann(n_dot_h, glm::dot(across, across), material.roughness), 1e200);
  return bounded(density * schlick(material.reflectance, 0.5 * length) *
                     cook_torrance_geometry(n_dot_l, n_dot_v, length * length),
                 c_largest_specular);
}

namespace {

// each_light(visit) calls visit(light) for each light.
template <class EachLight>
glm::dvec3 sum_of_lights(const Scene& scene, const Material& material, glm::dvec3 position_world,
                         glm::dvec3 normal_world, const LightFilter& reaches, EachLight&& each_light) {
  const glm::dvec3 to_eye = [&] {
    const glm::dvec3 v = direction(position_world, scene.camera.eye_world);
    return v == glm::dvec3(0.0) ? normal_world : v;
  }();
  const SurfaceColours colours(material);

  glm::dvec3 sum = ambient_radiance(scene, material);
  each_light([&](const Light& light) {
    const glm::dvec3 to_light = direction_to(light, position_world);
    const double share = cone_share(light, to_light);
    if (!(share > 0)) return;
    sum += share * light.intensity *
           reflected(
               light.ref.kind, colours, glm::dot(normal_world, to_light),
               [&] { return !reaches || reaches(light.ref); },
               [&] { return specular_factor(material, normal_world, to_light, to_eye); });
  });
  for (int i = 0; i < 3; ++i) sum[i] = bounded(sum[i], c_largest_radiance);
  return sum;
}

}  // namespace

glm::dvec3 radiance(const Scene& scene, const Material& material, glm::dvec3 position_world,
                    glm::dvec3 normal_world, const LightFilter& reaches) {
  return sum_of_lights(scene, material, position_world, normal_world, reaches,
                       [&](const auto& visit) { for_each_light(scene, visit); });
}

glm::dvec3 radiance(const Scene& scene, std::span<const Light> lights, const Material& material,
                    glm::dvec3 position_world, glm::dvec3 normal_world) {
  return sum_of_lights(scene, material, position_world, normal_world, {}, [&](const auto& visit) {
    for (const Light& light : lights) visit(light);
  });
}

}  // namespace halfway
