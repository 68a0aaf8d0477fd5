// SPDX-License-Identifier: Apache-2.0
#include "accuracy/row.hpp"

#include <fmt/format.h>

#include "frame/frame.hpp"
#include "reference/renderer.hpp"
#include "setup/project.hpp"
#include "sim/run/verilator_frame.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/study/measure.hpp"
#include "sim/system/must.hpp"
#include "sim/system/threads.hpp"

namespace halfway::accuracy {
namespace {

constexpr unsigned c_threads = 2;
constexpr int c_subpixel_bits = 4;

using Render = ReferenceImage (*)(const Scene&, std::span<const ScreenTriangle>, const RenderOptions&);

ReferenceImage rendered(const Scene& scene, FrameSize size, Render render) {
  const std::vector<ScreenTriangle> triangles = Projector(scene, size, {}).project_all();
  return render(scene, triangles,
                {.frame = size, .subpixel_bits = c_subpixel_bits, .workers = on_threads(c_threads)});
}

// Over the pixels that either picture covers.
FrameDistance error_of(const Scene& scene, const Frame& frame, std::vector<std::uint8_t> mask) {
  const ReferenceImage reference = rendered(scene, frame.size, render_reference);
  mask.resize(reference.mask.size());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= reference.mask[i];
  return must(frame_distance(frame, reference.frame, mask));
}

}  // namespace

const SimulatorFolders& folders() {
  static const SimulatorFolders c_folders{HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR};
  return c_folders;
}

Scene loaded(const std::string& file) {
  return must(load_scene((folders().source / file).string(), {}));
}

study::HardwareSource planned(const Scene& scene, const PlanRequest& request) {
  return {{.key = must(plan_scene(scene, request)).key, .tables = {}}, folders()};
}

Drawn drawn(const Scene& scene, FrameSize size, const PlanRequest& request, const SetupOptions& options) {
  VerilatorFrame drawing = must(
      draw_in_verilator(scene, size, planned(scene, request).hardware.key, options, folders(), c_threads));
  return {error_of(scene, drawing.frame, std::move(drawing.mask)), drawing.cycles, drawing.counts};
}

FrameDistance gouraud_error(const Scene& scene, FrameSize size) {
  ReferenceImage image = rendered(scene, size, render_gouraud);
  return error_of(scene, image.frame, std::move(image.mask));
}

study::HardwareSource point_hardware(const study::DesignPoint& point, const Scene& scene) {
  return {must(study::hardware_of(point, scene)), must(study::rtl_of(point, scene, folders()))};
}

Drawn drawn(const study::DesignPoint& point, const Scene& scene) {
  study::Drawing drawing =
      must(study::draw(point, {.name = scene.name, .scene = scene, .triangles = {}}, folders()));
  return {error_of(scene, drawing.frame, std::move(drawing.mask)), drawing.cycles, drawing.setup};
}

study::HardwareFigures figures_of(const study::DesignPoint& point, const std::string& scene) {
  study::Record record{.point = point, .measured = {}};
  record.measured.hardware = point_hardware(point, loaded(scene)).hardware.key.name();
  const std::string file = (folders().source / scene).string();
  study::HardwareTable table = must(study::hardware_figures(file, {&record, 1}, folders(), {}));
  return table.begin()->second;
}

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  constexpr std::size_t c_group = 3;
  for (std::size_t at = text.size(); at > c_group; at -= c_group) text.insert(at - c_group, " ");
  return text;
}

TEST_P(Accuracy, Full) {
  try {
    for (const auto& [column, value] : GetParam().measure()) RecordProperty(column, value);
  } catch (const Failure& failure) {
    FAIL() << failure.error.message;
  }
}

INSTANTIATE_TEST_SUITE_P(quadratic_shader, Accuracy, testing::ValuesIn(quadratic_rows()), id_of);
INSTANTIATE_TEST_SUITE_P(spherical_shader, Accuracy, testing::ValuesIn(spherical_rows()), id_of);
INSTANTIATE_TEST_SUITE_P(cosine_tables, Accuracy, testing::ValuesIn(cosine_rows()), id_of);
INSTANTIATE_TEST_SUITE_P(within_one_step, Accuracy, testing::ValuesIn(one_step_rows()), id_of);
INSTANTIATE_TEST_SUITE_P(bright_lights, Accuracy, testing::ValuesIn(bright_rows()), id_of);
INSTANTIATE_TEST_SUITE_P(shading_processors, Accuracy, testing::ValuesIn(processors_rows()), id_of);
INSTANTIATE_TEST_SUITE_P(root_tables, Accuracy, testing::ValuesIn(root_rows()), id_of);

}  // namespace halfway::accuracy
