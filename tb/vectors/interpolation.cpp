// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <vector>

#include "golden/line_interpolator.hpp"
#include "golden/parameter_register.hpp"
#include "golden/part_interpolator.hpp"
#include "golden/quadratic_interpolator.hpp"
#include "golden/z_interpolator.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/skew.hpp"

namespace halfway::vectors {
namespace {

using words::Exact, words::Published;

// A line: checked, load, start, step, increment; value, before the edge that may load or step.
template <int W>
void write_line(const Folder& folder) {
  Random random(W);
  VectorFile file;
  golden::LineInterpolator<W> twin;
  for (int i = 0; i < 4000; ++i) {
    const bool load = i == 0 || random.one_in(12), step = !random.one_in(5);
    const auto start = random.word<W>(), increment = random.word<W>();
    file.flag(i > 0).flag(load).word(start).flag(step).word(increment).word(twin.value()).end_vector();
    if (load)
      twin.load(start);
    else if (step)
      twin.step(increment);
  }
  file.write(folder / (std::to_string(W) + ".txt"));
}

// A line: checked, load, start, step, increment, carry_in; value, whether the last clock stepped, its carry,
// before the edge that may load or step.
template <int W>
void write_part(const Folder& folder) {
  Random random(W);
  VectorFile file;
  golden::PartInterpolator<W> twin;
  for (int i = 0; i < 4000; ++i) {
    const bool load = i == 0 || random.one_in(12), carry = random.one_in(2);
    const bool step = !load && !random.one_in(5);
    const auto start = random.word<W>(), increment = random.word<W>();
    file.flag(i > 0).flag(load).word(start).flag(step).word(increment).flag(carry);
    file.word(twin.value()).flag(twin.carry()).end_vector();
    if (load)
      twin.load(start);
    else if (step)
      twin.step(increment, carry);
  }
  file.write(folder / (std::to_string(W) + ".txt"));
}

// Writes BITS_PARTS.txt. `vector(i)` writes a vector except its first column, `checked`, which is 1 once all
// parts hold words of the file.
template <class Vector>
void write_skewed(const Folder& folder, VectorFile& file, int bits, int parts, Vector&& vector) {
  for (int i = 0; i < 3000; ++i) {
    file.flag(i >= parts);
    vector(i);
    file.end_vector();
  }
  file.write(folder / (std::to_string(bits) + "_" + std::to_string(parts) + ".txt"));
}

// A line: checked, load, start, step, increment; value, before the edge that may load or step.
template <int W>
void write_skewed_interpolator(const Folder& folder, int parts) {
  Random random(W);
  VectorFile file;
  golden::LineInterpolator<W> twin;
  Skew skew_start(W, parts), skew_increment(W, parts), skew_value(W, parts);
  write_skewed(folder, file, W, parts, [&](int i) {
    const bool load = i == 0 || random.one_in(12), step = !load && !random.one_in(5);
    const auto start = random.word<W>(), increment = random.word<W>();
    file.flag(load).word(skew_start(start.bits()), W).flag(step).word(skew_increment(increment.bits()), W);
    file.word(skew_value(twin.value().bits()), W);
    if (load)
      twin.load(start);
    else if (step)
      twin.step(increment);
  });
}

// A line: checked, load, start, value, before the edge that may load. Contains two words next to each other.
void write_skewed_register(const Folder& folder, int bits, int parts) {
  Random random(bits);
  VectorFile file;
  golden::ParameterRegister<std::array<std::uint64_t, 2>> twin;
  std::array<Skew, 2> skew_start{Skew(bits, parts), Skew(bits, parts)}, skew_value = skew_start;
  write_skewed(folder, file, bits, parts, [&](int i) {
    const bool load = i == 0 || random.one_in(3);
    const std::array start = {random.word(bits), random.word(bits)};
    const auto skewed = [&](std::array<Skew, 2>& skew, const std::array<std::uint64_t, 2>& words) {
      return skew[1](words[1]) << bits | skew[0](words[0]);
    };
    file.flag(load)
        .word(skewed(skew_start, start), 2 * bits)
        .word(skewed(skew_value, twin.value()), 2 * bits);
    if (load) twin.load(start);
  });
}

// A line: checked, select_b, a, b; value, before the edge.
void write_skewed_multiplexer(const Folder& folder, int bits, int parts) {
  Random random(bits);
  VectorFile file;
  Skew skew_a(bits, parts), skew_b(bits, parts), skew_value(bits, parts);
  write_skewed(folder, file, bits, parts, [&](int) {
    const bool select_b = random.one_in(2);
    const std::uint64_t a = random.word(bits), b = random.word(bits);
    file.flag(select_b).word(skew_a(a), bits).word(skew_b(b), bits).word(skew_value(select_b ? b : a), bits);
  });
}

// A line: checked, strobe; strobes, before the edge. The strobes are a word with one bit per part.
void write_skewed_strobe(const Folder& folder, int parts) {
  Random random(parts);
  VectorFile file;
  Skew skew(parts, parts);
  write_skewed(folder, file, 1, parts, [&](int) {
    const bool strobe = random.one_in(2);
    file.flag(strobe).word(skew(strobe ? words::low_bits(~std::uint64_t{0}, parts) : 0), parts);
  });
}

// A line: checked, skewed; word, before the edge.
void write_deskew(const Folder& folder, int bits, int parts) {
  Random random(bits);
  VectorFile file;
  Skew skew(bits, parts);
  std::vector<std::uint64_t> words(static_cast<std::size_t>(parts));
  write_skewed(folder, file, bits, parts, [&](int) {
    words.insert(words.begin(), random.word(bits));
    words.pop_back();
    file.word(skew(words.front()), bits).word(words.back(), bits);
  });
}

// The walker's strobes in one clock.
struct Strobes {
  bool line_load, line_step, line_carry, span_load, span_step;
};

// Clocks after a load in which the words do not change: a word's parts, at most three, are loaded one by one.
constexpr int c_held = 2;

// Every combination that the contract allows, also those that the walker never drives. The first two fill the
// registers.
Strobes random_strobes(Random& random, int i) {
  if (i == 0) return {true, false, false, false, false};
  if (i == 1) return {false, false, false, true, false};
  const bool busy = i / 200 % 2 == 0;
  const bool line_load = random.one_in(busy ? 4 : 40), span_load = random.one_in(busy ? 3 : 20);
  return {line_load, !line_load && !random.one_in(3), random.one_in(2), span_load,
          !span_load && !random.one_in(4)};
}

// A line: checked, init, strobes; value, before the edge. `draw(init)` draws init words, when no part of the
// last ones is still to be loaded; `line_load(init)` loads them into the twin.
template <int Bits, class Twin, class Draw, class LineLoad>
void write_strobed(const std::filesystem::path& path, Random& random, int clocks, Twin& twin,
                   const Draw& draw, const LineLoad& line_load) {
  VectorFile file;
  std::array<std::uint32_t, (Bits + 31) / 32> init{};
  int held = 0;
  for (int i = 0; i < clocks; ++i) {
    if (held == 0) draw(init);
    const Strobes s = random_strobes(random, i);
    held = s.line_load ? c_held : std::max(held - 1, 0);
    file.flag(i > 1).words_of(init, Bits);
    file.flag(s.line_load).flag(s.line_step).flag(s.line_carry).flag(s.span_load).flag(s.span_step);
    file.word(twin.value()).end_vector();
    // The span stage loads the line stage's old value, so update it first.
    if (s.span_load)
      twin.span_load();
    else if (s.span_step)
      twin.span_step();
    if (s.line_load)
      line_load(init);
    else if (s.line_step)
      twin.line_step(s.line_carry);
  }
  file.write(path);
}

template <int W, bool Carries>
void write_plane(const std::filesystem::path& path) {
  constexpr int c_bits = (Carries ? 4 : 3) * W;
  Random random(W);
  golden::PlaneInterpolator<W> twin;
  std::array<words::Word<W>, 4> words;
  const auto draw = [&](auto& plane) {
    for (int w = 0; w < 4; ++w) {
      words[w] = random.word<W>();
      if (w * W < c_bits) words::set_bits(plane, {"", w * W, W, true, 0}, words[w].bits());
    }
  };
  write_strobed<c_bits>(path, random, 2500, twin, draw, [&](const auto&) {
    twin.line_load(words[0], words[1], words[2], words[Carries ? 3 : 2]);
  });
}

template <class Preset>
void write_z(const Folder& folder) {
  using At = typename Preset::init_header_at;
  Random random(40);
  golden::ZInterpolator<Preset> twin;
  const auto draw = [&](auto& init) {
    random.fill(init);
    for (const words::Field* field : {&At::z, &At::z_dx, &At::z_de0})
      set_bits(init, *field, random.word(field->bits));
  };
  write_strobed<Preset::c_init_header_bits>(folder / (std::string(Preset::c_name) + ".txt"), random, 2500,
                                            twin, draw, [&](const auto& init) { twin.line_load(init); });
}

template <class Preset>
void write_quadratic(const Folder& folder) {
  Random random(41);
  golden::QuadraticInterpolator<Preset> twin;
  const auto draw = [&](auto& init) {
    random.fill(init);
    for (const words::Field& field : Preset::c_init_channel) set_bits(init, field, random.word(field.bits));
  };
  write_strobed<Preset::c_init_channel_bits>(folder / (std::string(Preset::c_name) + ".txt"), random, 3000,
                                             twin, draw, [&](const auto& init) { twin.line_load(init, 0); });
}

}  // namespace

std::vector<Entity> interpolation_entities() {
  const std::vector<std::tuple<int, int>> sizes{{7, 3}, {32, 1}, {40, 2}};  // bits, parts
  return {
      {"line_interpolator",
       [](const Folder& folder) {
         write_line<3>(folder);
         write_line<Published::c_intensity_bits>(folder);
         write_line<Exact::c_intensity_bits>(folder);
       }},
      {"part_interpolator",
       [](const Folder& folder) {
         write_part<3>(folder);
         write_part<Published::c_intensity_bits / 2>(folder);
         write_part<Exact::c_intensity_bits / 2>(folder);
       }},
      {"skewed_strobe", of_sizes(write_skewed_strobe, {1, 2, 3})},
      {"skewed_register", of_sizes(write_skewed_register, {{7, 3}, {32, 1}, {20, 2}})},
      {"skewed_multiplexer", of_sizes(write_skewed_multiplexer, sizes)},
      {"deskew", of_sizes(write_deskew, sizes)},
      {"skewed_interpolator",
       [](const Folder& folder) {
         write_skewed_interpolator<7>(folder, 3);
         write_skewed_interpolator<Published::c_intensity_bits>(folder, 1);
         write_skewed_interpolator<Exact::c_intensity_bits>(folder, 2);
       }},
      {"plane_interpolator",
       [](const Folder& folder) {
         write_plane<Exact::c_plane_sum_bits, true>(folder / "exact.txt");
         write_plane<Published::c_plane_sum_bits, true>(folder / "published.txt");
         write_plane<7, false>(folder / "without_carry.txt");
       }},
      {"z_interpolator", in_both_presets([]<class P>(const Folder& f) { write_z<P>(f); })},
      {"quadratic_interpolator", in_both_presets([]<class P>(const Folder& f) { write_quadratic<P>(f); })},
  };
}

}  // namespace halfway::vectors
