// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/mesa/mesa_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "scene/lights.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway {

Status mesa_draws(const Scene& scene) {
  if (scene.shadows) return bad_input("halfway_mesa draws no shadows; take a scene without them");
  Status drawn = Ok{};
  for_each_light(scene, [&](const Light& light) {
    if (light.cone)
      drawn = bad_input(fmt::format("{}: halfway_mesa draws no spot lights; remove it", name_of(light.ref)));
  });
  if (!drawn) return drawn;
  for (const Material& m : scene.materials)
    if (m.brdf != Brdf::blinn)
      return bad_input(fmt::format("material '{}': halfway_mesa draws highlights of blinn only", m.name));
  return Ok{};
}

std::filesystem::path mesa_program(const std::filesystem::path& source) {
  return source / "build/halfway_mesa";
}

std::string mesa_lacks(const std::filesystem::path& source) {
  return std::filesystem::exists(mesa_program(source)) ? "" : "libegl-dev, libgles-dev";
}

MesaPicture draw_by_mesa(const MesaRequest& request, const std::filesystem::path& source) {
  const TemporaryFolder scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path file = scratch.path() / "mesa.rgb";
  Command command{
      .arguments = {mesa_program(source).string(), request.scene, to_string(request.size),
                    std::to_string(request.repetitions), file.string(),
                    fmt::format("{}", request.tessellation)},
      // Use this thread only, and no graphics card.
      .environment = {
          {"LIBGL_ALWAYS_SOFTWARE", "1"}, {"GALLIUM_DRIVER", "llvmpipe"}, {"LP_NUM_THREADS", "0"}}};
  if (request.exponent) command.arguments.push_back(fmt::format("{}", *request.exponent));
  const ProcessEnd end =
      must(run_process(command, "apt-get install libegl-dev libgles-dev, then make study"));
  MesaPicture picture{.frame = Frame(request.size)};
  std::istringstream said(end.output);
  if (!end.succeeded() || !(said >> picture.seconds >> picture.elapsed_seconds))
    throw_tool_failed("halfway_mesa: {}: {}", end.how(), end.output);
  said.ignore();
  std::getline(said, picture.renderer);
  const std::string rgb = must(read_file(file));
  if (rgb.size() != picture.frame.rgb.size()) throw_tool_failed("halfway_mesa: a frame of another size");
  std::copy(rgb.begin(), rgb.end(), picture.frame.rgb.begin());
  return picture;
}

}  // namespace halfway
