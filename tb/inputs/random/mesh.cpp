// SPDX-License-Identifier: Apache-2.0
// Mesh files, one target per format (HALFWAY_FUZZ_ENDING). Each file loads as a valid scene or is refused.
// Scenes that load are drawn.
#include <algorithm>

#include "inputs/random/draw.hpp"
#include "inputs/random/fuzz.hpp"
#include "sim/files/load_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfway;
  using namespace halfway::fuzz;
  constexpr std::size_t c_most_drawn = 100;
  const std::string_view bytes = text_of(data, size);
  // Ignore files that refer to others (materials, buffers) outside their folder.
  if (bytes.find("../") != std::string_view::npos || bytes.find(" /") != std::string_view::npos ||
      bytes.find("\"/") != std::string_view::npos)
    return -1;
  // What follows this line is a file of its own, which an OBJ may name.
  constexpr std::string_view c_library = "# input.mtl\n";
  const std::size_t end = std::min(bytes.find(c_library), bytes.size());
  write_input("input.mtl", bytes.substr(std::min(end + c_library.size(), bytes.size())));
  const auto path = write_input("input" HALFWAY_FUZZ_ENDING, bytes.substr(0, end));
  const auto loaded = load_scene(path.string(), folder());
  if (!loaded) {
    demand_refusal(loaded.error());
    return 0;
  }
  demand_fit(*loaded);
  if (loaded->triangles.size() <= c_most_drawn) draw(*loaded, choice_of(bytes));
  return 0;
}
