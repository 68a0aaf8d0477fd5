// SPDX-License-Identifier: Apache-2.0
// The entities whose testbenches read vectors. Each has a function that writes stimulus and expected results
// from the golden model.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/system/must.hpp"

namespace halfway::vectors {

using Folder = std::filesystem::path;

struct Entity {
  const char* name;
  void (*write)(const Folder& folder);  ///< `folder` belongs to the entity
};

/// Folders short/ENTITY have the stimulus of `make test`: as many pixels or tokens, divided by this.
inline constexpr int c_short = 4;

std::vector<Entity> arithmetic_entities();
std::vector<Entity> board_entities();
std::vector<Entity> folded_entities();
std::vector<Entity> illumination_entities();
std::vector<Entity> interpolation_entities();
std::vector<Entity> processors_entities();
std::vector<Entity> processors_shader_entities();
std::vector<Entity> raster_entities();
std::vector<Entity> shaders_entities();
std::vector<Entity> shading_entities();
std::vector<Entity> stream_entities();
std::vector<Entity> terms_entities();

}  // namespace halfway::vectors
