// SPDX-License-Identifier: Apache-2.0
// Scene files. Any .toml text loads as a valid scene or is refused; scenes that load are drawn.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <string>

#include "inputs/random/draw.hpp"
#include "inputs/random/fuzz.hpp"
#include "scene/lights.hpp"
#include "sim/files/load_scene.hpp"

namespace halfway::fuzz {
namespace {

/// Scenes above these limits are slow because they are large, which is not a fault.
constexpr std::int64_t c_most_of_a_mesh = 12;
constexpr std::size_t c_most_meshes = 8, c_most_lights = 40, c_most_drawn = 600;

/// toml++ must not read keys of many parts; load_scene refuses them.
bool may_have_deep_key(std::string_view text) {
  constexpr int c_most_dots = 200;
  int dots = 0;
  for (const char c : text) {
    dots = c == '\n' ? 0 : dots + (c == '.' ? 1 : 0);
    if (dots > c_most_dots) return true;
  }
  return false;
}

/// The scene file reads no file outside of the folder, and makes no large mesh.
bool is_small_and_here(const toml::table& scene) {
  const toml::array* meshes = scene["mesh"].as_array();
  if (meshes == nullptr) return true;
  if (meshes->size() > c_most_meshes) return false;
  for (const toml::node& mesh : *meshes) {
    const toml::table* table = mesh.as_table();
    if (table == nullptr) continue;
    for (const char* count : {"slices", "stacks", "divisions"})
      if ((*table)[count].value_exact<std::int64_t>().value_or(1) > c_most_of_a_mesh) return false;
    if ((*table)["file"].value_or(std::string()).find('/') != std::string::npos) return false;
  }
  return true;
}

/// Writes a mesh to which `file = "triangle.obj"` can refer.
void write_meshes() {
  static const bool c_written = [] {
    write_input("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
    write_input("broken.ply", "ply\nformat ascii 1.0\n");
    return true;
  }();
  (void)c_written;
}

}  // namespace
}  // namespace halfway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfway;
  using namespace halfway::fuzz;
  const std::string_view text = text_of(data, size);
  write_meshes();
  const auto path = write_input("input.toml", text);
  if (may_have_deep_key(text)) {
    (void)load_scene(path.string(), folder());
    return 0;
  }
  try {
    if (const toml::table parsed = toml::parse(text); !is_small_and_here(parsed)) return -1;
  } catch (const toml::parse_error&) {
    // load_scene must refuse the file, too.
    const auto loaded = load_scene(path.string(), folder());
    demand(!loaded, "a scene from bad TOML");
    demand_refusal(loaded.error());
    demand(loaded.error().message.starts_with(path.string() + ":"), "file:line: " + loaded.error().message);
    return 0;
  }
  const auto loaded = load_scene(path.string(), folder());
  if (!loaded) {
    demand_refusal(loaded.error());
    return 0;
  }
  demand_fit(*loaded);
  if (loaded->triangles.size() > c_most_drawn) return 0;
  if (light_count(*loaded) > c_most_lights) return 0;
  draw(*loaded, choice_of(text));
  return 0;
}
