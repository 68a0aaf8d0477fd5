// SPDX-License-Identifier: Apache-2.0
// `halfway render`: software pictures only, by the reference, Gouraud shading, the golden model, or spherical
// interpolation in double.
#include <fmt/format.h>

#include "frame/metrics.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "reference/spherical_renderer.hpp"
#include "sim/cli/options.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/image.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"

namespace halfway::cli {
namespace {

struct RenderCommand {
  DrawOptions draw;
  std::string scene;
  std::string method = "reference";
  std::string file;
};

Frame golden_frame(const Scene& scene, const DrawSettings& draw) {
  const auto plan = must(plan_scene(scene, draw.plan));
  FrameDriver driver(scene, draw.size, plan.key, {},
                     {.setup = draw.setup, .golden_picture = true, .workers = on_threads(draw.threads)});
  Progress progress(scene.name);
  must(driver.draw([&](const Batch& batch) {
    progress.show(batch.done);
    return Status(Ok{});
  }));
  progress.clear();
  for (const std::string& note : driver.notes()) say(fmt::format("{}: {}", scene.name, note));
  return driver.golden_frame().frame();
}

void run(const Folders& folders, const RenderCommand& command) {
  const bool spherical = command.method.starts_with("spherical-");
  DrawOptions options_given = command.draw;
  // these methods take the options of the spherical shader
  if (spherical) options_given.shader = to_string(Shader::spherical);
  const auto draw = checked(options_given);
  const auto scene = must(load_scene(command.scene, folders.scenes()));
  for (const std::string& note : scene.notes) say(note);

  const std::vector<ScreenTriangle> triangles = Projector(scene, draw.size, {}).project_all();
  const RenderOptions options{.frame = draw.size, .workers = on_threads(draw.threads)};
  const ReferenceImage reference = render_reference(scene, triangles, options);
  Frame frame = reference.frame;
  if (command.method == "gouraud") frame = render_gouraud(scene, triangles, options).frame;
  if (spherical) {
    const SphericalMethod method{
        command.method == "spherical-fixed" ? VectorScheme::one_fixed : VectorScheme::both_interpolated,
        draw.setup.spherical.ends};
    frame = render_spherical(scene, triangles, options, method).frame;
  }
  if (command.method == "golden") {
    frame = golden_frame(scene, draw);
  }
  const std::string file =
      command.file.empty() ? fmt::format("{}-{}.png", scene.name, command.method) : command.file;
  must(write_png(file, frame));
  const auto distance = must(frame_distance(frame, reference.frame, reference.mask));
  fmt::print("{}: {} against the reference: PSNR {:.2f} dB, largest error {}/255\n", file, command.method,
             distance.psnr_db, distance.max_lsb);
}

}  // namespace

void add_render(CLI::App& app, const Folders& folders, int&) {
  CLI::App* sub = app.add_subcommand("render", "draw a scene in software and compare it with the reference");
  auto command = std::make_shared<RenderCommand>();
  sub->add_option("scene", command->scene, "as for sim")->required();
  command->draw.add_to(*sub);
  sub->add_option("--method", command->method,
                  "reference, gouraud or golden; spherical-fixed or spherical-both: spherical interpolation\n"
                  "in double, with one vector fixed or both interpolated")
      ->check(CLI::IsMember({"reference", "gouraud", "golden", "spherical-fixed", "spherical-both"}))
      ->capture_default_str();
  sub->add_option("--file", command->file, "PNG to write (default: <scene>-<method>.png)");
  sub->callback([=, &folders] { run(folders, *command); });
}

}  // namespace halfway::cli
