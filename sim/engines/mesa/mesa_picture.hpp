// SPDX-License-Identifier: Apache-2.0
// Phong shading per pixel in software by OpenGL ES on Mesa's llvmpipe, drawn by the program halfway_mesa.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Ok if halfway_mesa can draw the scene; otherwise the error names what it cannot draw.
Status mesa_draws(const Scene& scene);

/// The program in the tree `source`.
std::filesystem::path mesa_program(const std::filesystem::path& source);
/// The packages that are missing for halfway_mesa in the tree `source`; empty if it is built.
std::string mesa_lacks(const std::filesystem::path& source);

struct MesaRequest {
  std::string scene;  ///< as for load_scene
  FrameSize size;
  double tessellation = 1.0;
  std::optional<double> exponent{};  ///< of every material; std::nullopt: the scene's exponents
  int repetitions = 1;  ///< of the drawing; the first one, which compiles the shaders, is additional
};
/// Each time is from vertices in OpenGL's memory to the picture in the program's memory.
struct MesaPicture {
  Frame frame;
  double seconds = 0.0;          ///< processor seconds of the fastest repetition, on one core
  double elapsed_seconds = 0.0;  ///< of all repetitions
  std::string renderer;          ///< the renderer's name
};
/// Draw the scene on one core in a new process. The caller checks that mesa_lacks is empty.
MesaPicture draw_by_mesa(const MesaRequest& request, const std::filesystem::path& source);

}  // namespace halfway
