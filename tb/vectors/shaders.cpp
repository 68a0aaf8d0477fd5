// SPDX-License-Identifier: Apache-2.0
#include "golden/quadratic_shader.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/triangles.hpp"
#include "vectors/vector_file.hpp"

namespace halfway::vectors {
namespace {

using golden::Exact, golden::Published, golden::SpanXWord;

// Colours that cross the range slowly; one channel in six is left as it is, random words.
template <class Preset>
void put_colours(InitVector& init, Random& random, int channels) {
  for (int c = 0; c < channels; ++c) {
    if (random.one_in(6)) continue;
    const int low = Preset::c_init_header_bits + c * Preset::c_init_channel_bits;
    for (const golden::Field& field : Preset::c_init_channel) {
      // 512 steps for the value, 16 for first differences, 1 for second ones.
      const bool value = field.name == "value", second = field.name.size() > 3 || field.name == "dxx";
      const std::int64_t most = std::int64_t{1} << (field.fraction_bits + (value ? 9 : second ? 0 : 4));
      const std::int64_t word = random.between(value ? -most / 8 : -most, most);
      set_bits(init, field, static_cast<std::uint64_t>(word), low);
    }
  }
}

// init: the vector, and the clock in which it is taken at full speed; fragments: triangle, y, x, z, red,
// green, blue, and the clock in which it is given out at full speed; probes: their words in the order of the
// events.
template <class Preset, int Channels>
Status write_shader(const std::filesystem::path& folder) {
  using Shader = golden::QuadraticShader<Preset, Channels>;
  Random random(Shader::c_init_bits);
  for (const auto& [mix, name] : {std::pair{Mix::dense, "dense"}, std::pair{Mix::mixed, "mixed"}}) {
    VectorFile inits, fragments, line_probes, span_probes;
    struct Watch {
      VectorFile &lines, &spans;
      void line(const Shader& s) { lines.words_of(s.line_probe(), Shader::c_probe_bits).end_vector(); }
      void span(const Shader& s, SpanXWord x) {
        spans.words_of(s.span_probe(x), Shader::c_probe_bits).end_vector();
      }
    };
    Shader twin;
    WalkerClock clock;
    std::int64_t taken = 0;
    for (InitVector init :
         random_triangles<Preset>(random, mix, Shader::c_init_bits, mix == Mix::dense ? 700 : 1000)) {
      put_colours<Preset>(init, random, Channels);
      inits.words_of(init, Shader::c_init_bits).word(static_cast<std::uint64_t>(taken), 32).end_vector();
      // The buffer in front takes the next vector in the clock in which the walker, a clock behind, takes
      // this one.
      taken = clock.take_init() + 1;
      std::vector<std::int64_t> clocks;
      for (const WalkedLine& line : walk_lines<Preset>(init)) {
        const std::int64_t first = clock.take_line(line.pixels());
        for (std::int64_t i = 0; i < line.pixels(); ++i) clocks.push_back(first + i);
      }
      auto at = clocks.begin();
      twin.draw(
          init,
          [&](const Fragment& f) {
            fragments.word(f.triangle, Preset::c_triangle_bits).word(f.y, Preset::c_pixel_y_bits);
            fragments.word(f.x, Preset::c_pixel_x_bits).word(f.z, Preset::c_depth_bits);
            for (const std::uint8_t colour : {f.red, f.green, f.blue})
              fragments.word(colour, Preset::c_colour_bits);
            // A clock in the buffer in front, and one in the register behind.
            fragments.word(static_cast<std::uint64_t>(*at++ + 2), 32).end_vector();
          },
          Watch{line_probes, span_probes});
    }
    const std::string stem = std::string(Preset::c_name) + std::to_string(Channels) + '_' + name;
    if (auto s = inits.write(folder / (stem + "_init.txt")); !s) return s;
    if (auto s = fragments.write(folder / (stem + "_fragments.txt")); !s) return s;
    if (auto s = line_probes.write(folder / (stem + "_line_probes.txt")); !s) return s;
    if (auto s = span_probes.write(folder / (stem + "_span_probes.txt")); !s) return s;
  }
  return Ok{};
}

}  // namespace

Status write_quadratic_shader(const std::filesystem::path& folder) {
  if (auto s = write_shader<Exact, 3>(folder); !s) return s;
  if (auto s = write_shader<Exact, 1>(folder); !s) return s;
  if (auto s = write_shader<Published, 3>(folder); !s) return s;
  return write_shader<Published, 1>(folder);
}

}  // namespace halfway::vectors
