// SPDX-License-Identifier: Apache-2.0
#include "fuzz/draw.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "frame/assemble.hpp"
#include "frame/metrics.hpp"
#include "fuzz/fuzz.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "reference/spherical_renderer.hpp"
#include "scene/camera.hpp"
#include "scene/lights.hpp"
#include "setup/check_counts.hpp"
#include "sim/run/scene_stream.hpp"

namespace halfway::fuzz {
namespace {

constexpr std::array<FrameSize, 4> c_sizes = {{{24, 18}, {1, 1}, {40, 3}, {3, 40}}};

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_unit(const glm::dvec3& v) {
  return std::abs(glm::length(v) - 1.0) < 1e-6;
}
bool is_colour(const glm::dvec3& v) {
  return is_finite(v) && v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0;
}

void draw_by(Shader shader, const Scene& scene, FrameSize size, unsigned choice) {
  PlanRequest request;
  request.shader = shader;
  request.preset = choice % 2 == 0 ? Preset::exact : Preset::published;
  request.all_effects = choice / 2 % 4 == 0;
  if (shader == Shader::processors && choice / 8 % 2 == 0) request.form = ProcessorForm::folded;
  const auto plan = plan_scene(scene, request);
  if (!plan) {
    demand(plan.error().code == ExitCode::bad_input && !plan.error().message.empty(),
           "a scene that a shader cannot draw is bad input: " + plan.error().message);
    return;
  }
  const std::unique_ptr<Setup> setup = make_setup(scene, size, plan->key, {});
  (void)setup->notes();
  SceneStream stream(*setup, plan->key, 1);
  FrameAssembler assembler(size, scene.background);
  for (Batch batch; stream.next(batch);) {
    if (const Status counts = check_shadow_counts(scene, stream.counts(), stream.fault()); !counts) {
      demand(counts.error().code == ExitCode::bad_input, counts.error().message);
      return;
    }
    const Status added = assembler.add(batch.golden);
    demand(bool(added), added ? "" : added.error().message);
  }
  demand(assembler.frame().rgb.size() == 3 * std::size_t{size.width} * size.height,
         "a frame of another size");
}

}  // namespace

unsigned choice_of(std::string_view text) {
  unsigned hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash ^ hash >> 16;
}

void demand_fit(const Scene& scene) {
  demand(!scene.triangles.empty() && scene.triangles.size() <= c_max_triangles, "1 to c_max_triangles");
  demand(has_view(scene.camera), "a camera with a view");
  demand(is_colour(scene.ambient) && is_colour(scene.background), "colours finite, not negative");
  for (const Material& m : scene.materials) {
    demand(is_colour(m.colour) && is_colour(m.specular_colour), "material colours finite, not negative");
    for (const double part : {m.ambient, m.diffuse, m.specular, m.reflectance})
      demand(std::isfinite(part) && part >= 0.0, "material: finite, not negative");
    demand(std::isfinite(m.exponent) && m.exponent >= 1.0, "exponent at least 1");
    demand(m.roughness > 0.0 && m.roughness <= 1.0 && m.reflectance <= 1.0, "roughness and reflectance");
  }
  for_each_light(scene, [](const Light& light) {
    const bool from_fit =
        light.point.w == 0.0 ? is_unit(light.point.xyz_world) : is_finite(light.point.xyz_world);
    demand(from_fit && is_colour(light.intensity), to_string(light.ref.kind));
    if (!light.cone) return;
    const LightCone& cone = *light.cone;
    demand(is_unit(cone.axis_world) && cone.cos_outer <= cone.cos_inner && cone.cos_inner <= 1.0 &&
               cone.cos_outer >= -1e-9,
           "cone");
  });
  for (const glm::dvec3& position : scene.positions_world) demand(is_finite(position), "positions finite");
  for (const glm::dvec3& normal : scene.normals_world) demand(is_unit(normal), "unit normals");
  for (const SceneTriangle& triangle : scene.triangles) {
    demand(triangle.material < scene.materials.size(), "material index in range");
    for (std::size_t corner = 0; corner < 3; ++corner)
      demand(triangle.position[corner] < scene.positions_world.size() &&
                 triangle.normal[corner] < scene.normals_world.size(),
             "corner's indices in range");
  }
}

void draw(const Scene& scene, unsigned choice) {
  const FrameSize size = c_sizes[choice / 16 % c_sizes.size()];
  for (const Shader shader : c_shaders) draw_by(shader, scene, size, choice);

  const std::vector<ScreenTriangle> triangles = Projector(scene, size, {}).project_all();
  const RenderOptions options{.frame = size, .subpixel_bits = 4};
  const ReferenceImage reference = render_reference(scene, triangles, options);
  const ReferenceImage gouraud = render_gouraud(scene, triangles, options);
  const SphericalMethod method{
      choice / 64 % 2 == 0 ? VectorScheme::one_fixed : VectorScheme::both_interpolated,
      choice / 128 % 2 == 0 ? SpanEnds::on_surface : SpanEnds::slerped_along_edges};
  const ReferenceImage spherical = render_spherical(scene, triangles, options, method);
  for (const ReferenceImage* image : {&gouraud, &spherical}) {
    const auto distance = frame_distance(image->frame, reference.frame, reference.mask);
    demand(bool(distance), "frames of one scene have one size");
  }
}

}  // namespace halfway::fuzz
