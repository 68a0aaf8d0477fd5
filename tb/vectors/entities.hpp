// SPDX-License-Identifier: Apache-2.0
// The entities whose testbenches read vectors. Each has a function that writes stimulus and expected results
// from the golden model.
#pragma once

#include <filesystem>
#include <functional>
#include <tuple>
#include <vector>

#include "sim/os/must.hpp"
#include "words/formats.hpp"

namespace halfway::vectors {

using Folder = std::filesystem::path;

struct Entity {
  const char* name;
  std::function<void(const Folder& folder)> write;  ///< `folder` belongs to the entity
};

/// Calls write.operator()<Preset>(folder) for both presets.
template <class Write>
auto in_both_presets(const Write& write) {
  return [write](const Folder& folder) {
    write.template operator()<words::Exact>(folder);
    write.template operator()<words::Published>(folder);
  };
}

/// Calls write(folder, sizes...) for each of the sizes.
template <class... Size>
auto of_sizes(void (*write)(const Folder&, Size...), const std::vector<std::tuple<Size...>>& all) {
  return [write, all](const Folder& folder) {
    for (const auto& sizes : all) std::apply([&](const Size... size) { write(folder, size...); }, sizes);
  };
}

/// Folders short/ENTITY have the stimulus of `make test`: as many pixels, tokens, strips, lines or random
/// frames, divided by this. That of the core is described in core.cpp.
inline constexpr int c_short = 4;

/// The files of processors_shader with object processors.
void write_objects_shaders(const Folder& folder, int divisor);

std::vector<Entity> arithmetic_entities();
std::vector<Entity> board_entities();
std::vector<Entity> core_entities();
std::vector<Entity> core_registers_entities();
std::vector<Entity> filter_entities();
std::vector<Entity> folded_entities();
std::vector<Entity> illumination_entities();
std::vector<Entity> interpolation_entities();
std::vector<Entity> memory_entities();
std::vector<Entity> objects_entities();
std::vector<Entity> packets_entities();
std::vector<Entity> processors_entities();
std::vector<Entity> processors_shader_entities();
std::vector<Entity> raster_entities();
std::vector<Entity> shaders_entities();
std::vector<Entity> shading_entities();
std::vector<Entity> stream_entities();
std::vector<Entity> terms_entities();

}  // namespace halfway::vectors
