// SPDX-License-Identifier: Apache-2.0
// Mesh files, one target per format (HALFWAY_FUZZ_ENDING). Each file loads as a valid scene or is refused.
// assimp runs in its own process and cannot crash this one. Scenes that load are drawn.
#include "fuzz/draw.hpp"
#include "fuzz/fuzz.hpp"
#include "sim/scene_files/check_mesh_file.hpp"
#include "sim/scene_files/load_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfway;
  using namespace halfway::fuzz;
  constexpr std::size_t c_most_drawn = 100;
  const std::string_view bytes = text_of(data, size);
  // Ignore files that refer to others (materials, buffers) outside their folder.
  if (bytes.find("../") != std::string_view::npos || bytes.find(" /") != std::string_view::npos ||
      bytes.find("\"/") != std::string_view::npos)
    return -1;
  const auto path = write_input("input" HALFWAY_FUZZ_ENDING, bytes);
  if (size > 0) {
    const auto checked = check_mesh_file(path);
    if (!checked) {
      demand_refusal(checked.error());
      return 0;
    }
  }
  const auto loaded = load_scene(path.string(), folder());
  if (!loaded) {
    demand_refusal(loaded.error());
    return 0;
  }
  demand_fit(*loaded);
  if (loaded->triangles.size() <= c_most_drawn) draw(*loaded, choice_of(bytes));
  return 0;
}
