// SPDX-License-Identifier: Apache-2.0
#include "inputs/random/draw.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "frame/metrics.hpp"
#include "inputs/random/fuzz.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "reference/spherical_renderer.hpp"
#include "scene/camera.hpp"
#include "scene/check_numbers.hpp"
#include "sim/driver/frame_driver.hpp"

namespace halfway::fuzz {
namespace {

constexpr std::array<FrameSize, 4> c_sizes = {{{24, 18}, {1, 1}, {40, 3}, {3, 40}}};

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
  FrameDriver driver(scene, size, plan->key, {}, {.golden_picture = true});
  if (const Status drawn = driver.draw(); !drawn) {
    demand(drawn.error().code == ExitCode::bad_input, drawn.error().message);
    return;
  }
  demand(driver.golden_frame().frame().rgb.size() == 3 * std::size_t{size.width} * size.height,
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
  const Status numbers = check_numbers(scene);
  demand(bool(numbers), numbers ? "" : numbers.error().message);
  // check_numbers also accepts wide cones and normals without length, but load_scene does not give them.
  for (const SpotLight& spot : scene.spots) demand(spot.cos_outer >= -1e-9, "a cone of at most 90 degrees");
  for (const glm::dvec3& normal : scene.normals_world)
    demand(std::abs(glm::length(normal) - 1.0) < 1e-6, "unit normals");
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
