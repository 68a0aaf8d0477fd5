// SPDX-License-Identifier: Apache-2.0
// halfway_vectors ENTITY|all FOLDER: writes FOLDER/ENTITY/*.txt for the testbench of ENTITY.
#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "sim/files/table4.hpp"
#include "vectors/entities.hpp"

namespace halfway::vectors {
namespace {

std::vector<Entity> all_entities() {
  std::vector<Entity> all{{"table4", write_table4}};
  for (const auto& part :
       {arithmetic_entities(), board_entities(), core_entities(), core_registers_entities(),
        filter_entities(), folded_entities(), illumination_entities(), interpolation_entities(),
        memory_entities(), objects_entities(), packets_entities(), processors_entities(),
        processors_shader_entities(), raster_entities(), shaders_entities(), shading_entities(),
        stream_entities(), terms_entities()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

int print_usage() {
  fmt::print(stderr, "usage: halfway_vectors ENTITY|all FOLDER\nentities:");
  for (const Entity& entity : all_entities()) fmt::print(stderr, " {}", entity.name);
  fmt::print(stderr, "\n");
  return static_cast<int>(ExitCode::bad_input);
}

int run(const std::string_view chosen, const Folder& folder) {
  bool found = false;
  const auto written = caught([&] {
    for (const Entity& entity : all_entities()) {
      if (chosen != "all" && chosen != entity.name) continue;
      found = true;
      entity.write(folder / entity.name);
    }
  });
  if (!found) return print_usage();
  if (written) return static_cast<int>(ExitCode::equal);
  fmt::print(stderr, "{}\n", written.error().message);
  return static_cast<int>(written.error().code);
}

}  // namespace
}  // namespace halfway::vectors

int main(int argc, char** argv) {
  if (argc != 3) return halfway::vectors::print_usage();
  return halfway::vectors::run(argv[1], argv[2]);
}
