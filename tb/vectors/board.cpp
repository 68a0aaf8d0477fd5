// SPDX-License-Identifier: Apache-2.0
#include "golden/board_pixel.hpp"
#include "golden/quadratic_shader.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/triangles.hpp"

namespace halfway::vectors {
namespace {

// A line: y, x, z, red, green, blue; inside, place, depth, colour.
void write_fragment_pixel(const Folder& folder) {
  Random random(1);
  VectorFile file;
  const auto add = [&](std::uint32_t y, std::uint32_t x) {
    const Fragment fragment{.triangle = 0,
                            .z = static_cast<std::uint32_t>(random.bits(24)),
                            .y = static_cast<std::uint16_t>(y),
                            .x = static_cast<std::uint16_t>(x),
                            .red = static_cast<std::uint8_t>(random.bits(8)),
                            .green = static_cast<std::uint8_t>(random.bits(8)),
                            .blue = static_cast<std::uint8_t>(random.bits(8))};
    const auto place = golden::board_place(fragment);
    file.word(y, 12).word(x, 12).word(fragment.z, 24);
    file.word(fragment.red, 8).word(fragment.green, 8).word(fragment.blue, 8);
    file.flag(place.has_value()).word(place.value_or(0), 17).word(golden::board_depth(fragment.z), 16);
    file.word(golden::board_colour(fragment.red, fragment.green, fragment.blue), 16).end_vector();
  };
  // Each line at both ends; the positions next to the frame; others.
  for (std::uint32_t y = 0; y < golden::c_board_height; ++y)
    for (const std::uint32_t x : {0U, 1U, 255U, 256U, golden::c_board_width - 1}) add(y, x);
  for (const std::uint32_t y : {239U, 240U, 255U, 256U, 495U, 4095U})
    for (const std::uint32_t x : {319U, 320U, 511U, 512U, 831U, 4095U}) add(y, x);
  for (int i = 0; i < 2000; ++i)
    add(static_cast<std::uint32_t>(random.bits(9)), static_cast<std::uint32_t>(random.bits(9)));
  file.write(folder / "fragments.txt");
}

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
      {"fragment_pixel", write_fragment_pixel},
      {"scan_out", write_scan_out},
      {"board_top", write_scan_out},
      {"drawing_rate", write_drawing_rate},
  };
}

}  // namespace halfway::vectors
