// SPDX-License-Identifier: Apache-2.0
#include "scene/check_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "scene/lights.hpp"

namespace halfway {
namespace {

constexpr double c_largest = std::numeric_limits<double>::max();
constexpr double c_not_unit = 1e-3;
constexpr double c_shortest_normal = 1e-8;

bool is_unit(glm::dvec3 v) {
  return std::abs(glm::length(v) - 1.0) <= c_not_unit;
}

// Keeps the first error only.
class Checker {
 public:
  explicit Checker(const Scene& scene) : scene_(scene) {}

  void number(std::string_view of, double value, double least = -c_largest, double greatest = c_largest) {
    if (value >= least && value <= greatest) return;
    fail(std::isfinite(value)
             ? fmt::format("{} is {:g}, but must be {:g} to {:g}", of, value, least, greatest)
             : fmt::format("{} is {}, not a finite number", of, value));
  }
  void vector(std::string_view of, glm::dvec3 v, double least = -c_largest) {
    for (int i = 0; i < 3; ++i) number(of, v[i], least);
  }
  void direction(std::string_view of, glm::dvec3 v) {
    vector(of, v);
    if (!is_unit(v)) fail(fmt::format("{} is ({:g}, {:g}, {:g}), not a unit vector", of, v.x, v.y, v.z));
  }
  void index(std::string_view of, std::size_t value, std::size_t count) {
    if (value >= count) fail(fmt::format("{} is {}, but there are {}", of, value, count));
  }
  void fail(std::string what) {
    if (!fault_) fault_ = bad_input(fmt::format("{}: {}; correct the scene", scene_.name, what));
  }
  Status status() const {
    if (fault_) return *fault_;
    return Ok{};
  }

 private:
  const Scene& scene_;
  std::optional<Error> fault_;
};

void check_camera(Checker& check, const Camera& camera) {
  check.vector("the camera's eye", camera.eye_world);
  check.vector("the camera's target", camera.target_world);
  check.vector("the camera's up", camera.up_world);
  const double fov = camera.vertical_fov_degrees;
  check.number("the camera's field of view", fov, 0.0, 180.0);
  if (fov == 0.0 || fov == 180.0) check.fail("the camera has no field of view");
  check.number("the near plane's distance", camera.near, 0.0);
  check.number("the far plane's distance", camera.far, 0.0);
}

void check_lights(Checker& check, const Scene& scene) {
  check.vector("the ambient light", scene.ambient, 0.0);
  check.vector("the background", scene.background, 0.0);
  for_each_light(scene, [&](const Light& light) {
    const std::string name = name_of(light.ref);
    if (light.point.w == 0.0)
      check.direction("the direction to " + name, light.point.xyz_world);
    else
      check.vector("the position of " + name, light.point.xyz_world);
    check.vector("the intensity of " + name, light.intensity, 0.0);
    if (!light.cone) return;
    check.direction("the axis of " + name, light.cone->axis_world);
    check.number("the outer cosine of " + name, light.cone->cos_outer, -1.0, 1.0);
    check.number("the inner cosine of " + name, light.cone->cos_inner, light.cone->cos_outer, 1.0);
  });
}

void check_material(Checker& check, const Material& m) {
  check.vector("a material's colour", m.colour, 0.0);
  check.vector("a material's specular colour", m.specular_colour, 0.0);
  check.vector("a material's emission", m.emission, 0.0);
  check.number("a material's k_a", m.ambient, 0.0);
  check.number("a material's k_d", m.diffuse, 0.0);
  check.number("a material's k_s", m.specular, 0.0);
  check.number("a material's exponent", m.exponent, 1.0);
  check.number("a material's roughness", m.roughness, std::numeric_limits<double>::denorm_min(), 1.0);
  check.number("a material's reflectance", m.reflectance, 0.0, 1.0);
}

}  // namespace

Status check_numbers(const Scene& scene) {
  Checker check(scene);
  check_camera(check, scene.camera);
  check_lights(check, scene);
  for (const Material& m : scene.materials) check_material(check, m);
  for (const glm::dvec3& p : scene.positions_world) check.vector("a vertex's coordinate", p);
  for (const glm::dvec3& n : scene.normals_world) {
    check.vector("a normal's component", n);
    if (!is_unit(n) && !(glm::length(n) <= c_shortest_normal))
      check.fail(fmt::format("a normal is ({:g}, {:g}, {:g}), not a unit vector", n.x, n.y, n.z));
  }
  for (const SceneTriangle& t : scene.triangles) {
    check.index("a triangle's material", t.material, scene.materials.size());
    for (std::size_t corner = 0; corner < 3; ++corner) {
      check.index("a triangle's vertex", t.position[corner], scene.positions_world.size());
      check.index("a triangle's normal", t.normal[corner], scene.normals_world.size());
    }
  }
  return check.status();
}

}  // namespace halfway
