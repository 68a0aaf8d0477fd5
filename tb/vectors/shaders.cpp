// SPDX-License-Identifier: Apache-2.0
// Files for each shader and set of triangles. init: the vector, and the clock in which it is accepted at full
// speed. fragments: triangle, y, x, z, red, green, blue, and the clock in which the fragment is output at
// full speed.
#include <fmt/format.h>

#include <array>

#include "golden/quadratic_shader.hpp"
#include "golden/spherical_shader.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/light_parts.hpp"
#include "vectors/random.hpp"
#include "vectors/triangles.hpp"

namespace halfway::vectors {
namespace {

using words::Exact, words::Published;

constexpr std::pair<Mix, const char*> c_sets[] = {{Mix::dense, "dense"}, {Mix::mixed, "mixed"}};

void add_clock(VectorFile& file, std::int64_t clock) {
  file.word(clock, 32).end_vector();
}

// Colours that change slowly over the triangle. One channel in six keeps random words.
template <class Preset, int Degree>
void put_colours(InitVector& init, Random& random, int channels) {
  using Layout = words::QuadraticLayout<Preset, Degree>;
  for (int c = 0; c < channels; ++c) {
    if (random.one_in(6)) continue;
    for (const words::Field& field : Preset::c_init_channel) {
      if (!Layout::has(field)) continue;
      // Limits: 512 steps for the value, 16 for first differences, 1 for second differences.
      const bool value = field.name == "value", second = field.name.size() > 3 || field.name == "dxx";
      const std::int64_t most = std::int64_t{1} << (field.fraction_bits + (value ? 9 : second ? 0 : 4));
      const std::int64_t word = random.between(value ? -most / 8 : -most, most);
      set_bits(init, field, word, Layout::channel_low(c));
    }
  }
}

// The clocks in which the quadratic shader accepts vectors and outputs fragments at full speed, as its header
// promises. Clocks count from the first accepted init vector.
class QuadraticClock {
 public:
  /// The largest number of clocks that may be lost after a triangle of `pixels` pixels.
  static std::int64_t may_lose(std::int64_t pixels) { return std::max<std::int64_t>(2 - pixels, 0); }

  /// The clock in which the next vector is accepted.
  std::int64_t take_init() {
    // The init buffer accepts it one clock after the walker has read the previous one.
    const std::int64_t taken = first_ ? 0 : clock_.read() + 2 + c_held;
    first_ = false;
    clock_.take_init();
    return taken;
  }
  /// The clock of the line's first fragment: one clock in the init buffer, one in the edge stage, one to the
  /// span stage, two for both halves of the words, two in the queue.
  std::int64_t take_line(std::int64_t pixels) { return clock_.take_line(pixels) + 7; }

 private:
  static constexpr std::int64_t c_held = 1;  // clocks in the buffer when it is read
  WalkerClock clock_{false, c_held};
  bool first_ = true;
};

template <class Preset, int Channels, int Degree>
void write_quadratic(const Folder& folder) {
  using Shader = golden::QuadraticShader<Preset, Channels, Degree>;
  Random random(Shader::c_init_bits);
  for (const auto& [mix, name] : c_sets) {
    VectorFile inits, fragments;
    Shader twin;
    QuadraticClock clock;
    LostClocks losses;
    std::int64_t may_lose = 0;
    auto set = random_triangles<Preset>(random, mix, Shader::c_init_bits, mix == Mix::dense ? 700 : 1000);
    for (InitVector& small : random_triangles<Preset>(random, Mix::small, Shader::c_init_bits, 60))
      set.push_back(std::move(small));
    for (InitVector init : set) {
      put_colours<Preset, Degree>(init, random, Channels);
      add_clock(inits.words_of(init, Shader::c_init_bits), clock.take_init());
      std::vector<std::int64_t> clocks;
      for (const WalkedLine& line : walk_lines<Preset>(init)) {
        const std::int64_t first = clock.take_line(line.pixels());
        for (std::int64_t i = 0; i < line.pixels(); ++i) clocks.push_back(first + i);
      }
      // Check the promise in the header of quadratic_shader.vhd.
      if (mix == Mix::dense) {
        const auto pixels = static_cast<std::int64_t>(clocks.size());
        const std::int64_t lost = losses.triangle(clocks.front(), pixels);
        if (lost < 0 || lost > may_lose)
          throw Failure{tool_failed(
              fmt::format("quadratic_shader: {} clocks lost before clock {}", lost, clocks.front()))};
        may_lose = QuadraticClock::may_lose(pixels);
      }
      auto at = clocks.begin();
      twin.draw(init, [&](const Fragment& f) { add_clock(add_fragment<Preset>(fragments, f), *at++); });
    }
    const std::string stem =
        std::string(Preset::c_name) + std::to_string(Channels) + (Degree == 1 ? "_planes_" : "_") + name;
    inits.write(folder / (stem + "_init.txt"));
    fragments.write(folder / (stem + "_fragments.txt"));
  }
}

// A configuration of the spherical shader. tb/rtl/shaders/spherical_shader_tb.vhd has the same list.
struct Spherical {
  const char* name;
  words::SphericalConfig config;
  std::int64_t pixels;
};

constexpr Spherical c_exact_spherical[] = {
    {"white_highlights", {3, 1, true, true, 1, 2, 9, 8}, 700},
    {"two_lights", {3, 2, true, true, 3, 22, 9, 8}, 700},
    {"grey", {1, 1, true, true, 1, 16, 9, 8}, 700},
    {"no_light", {3, 0, true, true, 1, 2, 9, 8}, 300},
    {"highlights", {3, 1, false, true, 3, 9, 9, 8}, 700},
    {"matte", {3, 1, true, false, 1, 2, 9, 8}, 500},
    {"sixteen_lights", {3, 16, true, true, 1, 3, 9, 8}, 150},
    {"no_effect", {3, 2, false, false, 1, 2, 9, 8}, 200},
};
constexpr Spherical c_published_spherical[] = {
    {"published", {3, 1, true, true, 3, 2, 6, 6}, 700},
    {"published_4_4", {3, 2, true, true, 1, 2, 4, 4}, 500},
    {"published_highlights", {1, 1, false, true, 1, 2, 6, 6}, 500},
};

template <class Preset>
InitVector random_record(const words::SphericalConfig& config, Random& random) {
  const words::SphericalLayout<Preset> layout(config);
  const int terms = 1 + 2 * config.lights;
  InitVector record = random_vector(random, layout.init_bits());
  for (int light = 0; light < config.lights; ++light) {
    if (layout.has_diffuse_part())
      put_diffuse_part<Preset>(record, random, layout.diffuse_channels(), terms, layout.diffuse_low(light));
    if (config.specular)
      put_specular_part<Preset>(record, random, config.highlight_channels, terms, layout.specular_low(light));
  }
  return record;
}

template <class Preset>
void write_spherical(const Folder& folder, const Spherical& spherical) {
  using Shader = golden::SphericalShader<Preset>;
  const words::SphericalLayout<Preset> layout(spherical.config);
  // Choose the seed so that the first triangle of each set covers a pixel on its first line: the checker
  // measures the latency there.
  Random random(layout.init_bits() + 3);
  for (const auto& [mix, name] : c_sets) {
    VectorFile inits, fragments;
    Shader twin(spherical.config);
    WalkerClock clock(layout.record_bits() != 0);
    std::int64_t taken = 0;
    const auto add_init = [&](const InitVector& vector) {
      add_clock(inits.words_of(vector, layout.init_bits()), taken);
    };
    std::int64_t given = 0, last_pixels = 0, pixels_before = 0;
    for (InitVector group : random_triangles<Preset>(random, mix, layout.init_bits(), spherical.pixels)) {
      for (int c = 0; c < spherical.config.channels; ++c)
        put_colour(group, Preset::ambient_channel_at::ambient, random, 5, layout.ambient_low(c));
      const auto lines = walk_lines<Preset>(group);
      add_init(group);
      // As in write_quadratic. The record of a line leaves the buffer with its line.
      taken = clock.take_init() + 2;
      std::vector<std::int64_t> clocks;
      for (const WalkedLine& line : lines) {
        const std::int64_t line_taken = clock.take_line(line.pixels());
        if (layout.record_bits() != 0) {
          const InitVector record = random_record<Preset>(spherical.config, random);
          add_init(record);
          group.insert(group.end(), record.begin(), record.end());
          taken = line_taken + 2;
        }
        // One clock in the init buffer, one in the edge stage, one to the span stage, one for the samples,
        // two for the products, one for their sum, two in the queue.
        const std::int64_t first = line_taken + 10;
        for (std::int64_t i = 0; i < line.pixels(); ++i) clocks.push_back(first + i);
      }
      if (twin.group(group) * twin.init_words() != group.size())
        throw Failure{tool_failed(fmt::format("{}: a group of {} vectors, expected {}", spherical.name,
                                              twin.group(group), group.size() / twin.init_words()))};
      // Check the promise in the header of spherical_shader.vhd.
      for (std::size_t i = 0; mix == Mix::dense && i < clocks.size(); ++i) {
        const std::int64_t lost = given == 0 ? 0 : clocks[i] - given - 1;
        // With records exactly this number is lost. Without records no clock is lost if the previous
        // triangle had to wait for the one before it.
        const std::int64_t most = i > 0                       ? 0
                                  : layout.record_bits() != 0 ? std::max<std::int64_t>(3 - last_pixels, 0)
                                  : pixels_before == 1        ? 1
                                                              : 0;
        if (lost < 0 || lost > most || (layout.record_bits() != 0 && given != 0 && lost != most))
          throw Failure{tool_failed(
              fmt::format("{}: {} clocks lost before clock {}", spherical.name, lost, clocks[i]))};
        given = clocks[i];
      }
      last_pixels = lines.back().pixels();
      pixels_before = static_cast<std::int64_t>(clocks.size());
      auto at = clocks.begin();
      twin.draw(group, [&](const Fragment& f) { add_clock(add_fragment<Preset>(fragments, f), *at++); });
    }
    const std::string stem = std::string(spherical.name) + '_' + name;
    inits.write(folder / (stem + "_init.txt"));
    fragments.write(folder / (stem + "_fragments.txt"));
  }
}

void write_quadratic_shader(const Folder& folder) {
  write_quadratic<Exact, 3, 2>(folder);
  write_quadratic<Exact, 1, 2>(folder);
  write_quadratic<Published, 3, 2>(folder);
  write_quadratic<Published, 1, 2>(folder);
  write_quadratic<Exact, 3, 1>(folder);
  write_quadratic<Exact, 1, 1>(folder);
  write_quadratic<Published, 3, 1>(folder);
}

void write_spherical_shader(const Folder& folder) {
  for (const Spherical& spherical : c_exact_spherical) write_spherical<Exact>(folder, spherical);
  for (const Spherical& spherical : c_published_spherical) write_spherical<Published>(folder, spherical);
}

}  // namespace

std::vector<Entity> shaders_entities() {
  return {
      {"quadratic_shader", write_quadratic_shader},
      {"spherical_shader", write_spherical_shader},
  };
}

}  // namespace halfway::vectors
