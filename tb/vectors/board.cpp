// SPDX-License-Identifier: Apache-2.0
#include "golden/board_pixel.hpp"
#include "golden/quadratic_shader.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/triangles.hpp"

namespace halfway::vectors {
namespace {

// A line: colour; red, green, blue of the dots (0, 0), (1, 0), (0, 1), (1, 1) in (x, y). One line per level
// of a channel, and others.
void write_scan_out(const Folder& folder) {
  Random random(2);
  VectorFile file;
  const auto add = [&](std::uint32_t colour) {
    file.word(colour, 16);
    for (const unsigned y : {0U, 1U})
      for (const unsigned x : {0U, 1U})
        for (const std::uint8_t level : golden::board_pins(static_cast<std::uint16_t>(colour), x, y))
          file.word(level, 3);
    file.end_vector();
  };
  for (std::uint32_t level = 0; level < 64; ++level) {
    add(level << 5);
    if (level < 32) add(level << 11);
    if (level < 32) add(level);
  }
  for (int i = 0; i < 1152; ++i) add(static_cast<std::uint32_t>(random.bits(16)));
  file.write(folder / "colours.txt");
}

// Init vectors of large triangles inside the frame, for planes of three channels.
void write_drawing_rate(const Folder& folder) {
  using Shader = golden::QuadraticShader<words::Exact, 3, 1>;
  constexpr std::size_t c_triangles = 3;
  constexpr std::int64_t c_least_pixels = 3000;
  Random random(3);
  VectorFile file;
  while (file.size() < c_triangles) {
    const InitVector init = random_triangle<words::Exact>(random, Mix::dense, Shader::c_init_bits);
    std::int64_t pixels = 0;
    bool inside = true;
    for (const WalkedLine& line : walk_lines<words::Exact>(init)) {
      pixels += line.pixels();
      for (const std::int64_t x : {line.start.value(), line.stop.value()})
        inside = inside && line.y < golden::c_board_height && x >= 0 && x < golden::c_board_width;
    }
    if (inside && pixels >= c_least_pixels) file.words_of(init, Shader::c_init_bits).end_vector();
  }
  file.write(folder / "init.txt");
}

}  // namespace

std::vector<Entity> board_entities() {
  return {
      {"scan_out", write_scan_out},
      {"board_top", write_scan_out},
      {"drawing_rate", write_drawing_rate},
  };
}

}  // namespace halfway::vectors
