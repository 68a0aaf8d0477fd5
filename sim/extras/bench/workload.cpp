// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/bench/workload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/to_integer.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/camera.hpp"
#include "setup/spherical_setup.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"

namespace halfway {

Scene sphere_scene(std::uint64_t triangles) {
  // 2 slices (stacks - 1), at most the requested number. Pieces at the equator are almost square.
  const auto n = static_cast<double>(triangles);
  const auto stacks = std::max(2U, to_integer<std::uint32_t>(0.5 + std::sqrt(0.25 + 0.25 * n)));
  const auto slices = std::max(3U, static_cast<std::uint32_t>(triangles / (2 * (stacks - 1))));
  Mesh mesh = make_uv_sphere(slices, stacks, 1.0);
  Scene scene;
  scene.name = fmt::format("sphere-{}", mesh.triangles.size());
  scene.ambient = glm::dvec3(0.5);
  scene.directional.push_back({glm::normalize(glm::dvec3(-0.5, 0.6, 1.0)), glm::dvec3(1.0)});
  scene.materials.push_back({.name = "red", .colour = {0.85, 0.2, 0.15}});
  scene.positions_world = std::move(mesh.positions);
  scene.normals_world = std::move(mesh.normals);
  scene.triangles = std::move(mesh.triangles);
  for (SceneTriangle& triangle : scene.triangles) triangle.material = 0;
  scene.camera = fit_camera(bounding_sphere(scene), {0.3, 0.4, 1.0});
  return scene;
}

GoldenStream golden_stream(const Scene& scene, FrameSize size, const PlanRequest& plan) {
  const HardwareKey key = must(plan_scene(scene, plan)).key;
  return {must(whole_stream(scene, size, key)), key};
}

WholeFrame::WholeFrame(const Scene& scene, FrameSize size, const HardwareKey& key,
                       std::shared_ptr<Engine> engine) {
  FrameOptions options{.golden = GoldenDraws::beside, .clocks = host_clocks()};
  if (key.shader == Shader::spherical && key.preset == Preset::exact)
    options.setup.spherical.bells = std::make_shared<const Bells>(fitted_bells(scene));
  driver_ =
      std::make_unique<FrameDriver>(scene, size, key, std::vector{std::move(engine)}, std::move(options));
}

FrameSeconds WholeFrame::draw() {
  must(driver_->draw());
  must(driver_->equal());
  return driver_->seconds();
}

double frame_rate(std::span<WholeFrame> drawings, std::size_t frames) {
  const auto threads = static_cast<unsigned>(drawings.size());
  must_for_each(threads, threads, [&](std::size_t i) { drawings[i].draw(); });
  std::atomic<std::size_t> next_frame = 0;
  const auto start = std::chrono::steady_clock::now();
  must_for_each(threads, threads, [&](std::size_t i) {
    while (next_frame++ < frames) drawings[i].draw();
  });
  return static_cast<double>(frames) / seconds_since(start);
}

}  // namespace halfway
