// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "golden/dot_product.hpp"
#include "golden/power.hpp"
#include "golden/reciprocal_root.hpp"
#include "golden/spot_cone.hpp"
#include "golden/unit_vector.hpp"
#include "golden/vector_multiply.hpp"
#include "golden/vector_shift.hpp"
#include "vectors/axes.hpp"
#include "vectors/entities.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

using golden::Axes, words::Exact, words::Published;

template <class Preset>
std::string file_of() {
  return std::string(Preset::c_name) + ".txt";
}

// Inputs: address.
template <class Preset>
void write_function_rom(const Folder& folder, words::Function function) {
  const words::FunctionTable& table = golden::function_table<Preset>(function);
  Random random(table.value_bits);
  Pipeline pipeline(1);
  const auto add = [&](bool enable, std::uint32_t address) {
    const golden::FunctionSample sample = golden::function_rom<Preset>(function, address);
    Flat result(sample.value, table.value_bits);
    if (table.slope_bits > 0) result.add(sample.slope, table.slope_bits);
    pipeline.clock(enable, {{address, table.cell_bits}}, result);
  };
  const std::uint32_t entries = 1U << table.cell_bits;
  for (std::uint32_t address = 0; address < entries; ++address) add(true, address);
  for (std::uint32_t i = 0; i < entries; ++i)
    add(random.one_in(2), static_cast<std::uint32_t>(random.bits(table.cell_bits)));
  pipeline.write(folder / fmt::format("{}_{}.txt", Preset::c_name, static_cast<int>(function)));
}

// Inputs: a, b.
void write_dot_product_of(const Folder& folder, int bits, int clocks) {
  Random random(bits);
  Pipeline pipeline(clocks);
  run(random, [&](bool) {
    const Axes a = random_axes(random, bits), b = random.one_in(4) ? a : random_axes(random, bits);
    const auto sum = static_cast<std::uint64_t>(golden::dot_product(a, b));
    pipeline.clock({flat(a, bits), flat(b, bits)}, {sum, 2 * bits + 1});
  });
  pipeline.write(folder / fmt::format("{}_{}.txt", bits, clocks));
}

// Inputs: a, b. All of small widths, then random and extreme ones.
void write_signed_multiplier_of(const Folder& folder, int a_bits, int b_bits, int clocks) {
  Random random(a_bits + b_bits);
  Pipeline pipeline(clocks);
  const auto add = [&](std::int64_t a, std::int64_t b) {
    pipeline.clock({{static_cast<std::uint64_t>(a), a_bits}, {static_cast<std::uint64_t>(b), b_bits}},
                   {static_cast<std::uint64_t>(a * b), a_bits + b_bits});
  };
  if (a_bits + b_bits <= 16) {
    const std::int64_t a_half = std::int64_t{1} << (a_bits - 1), b_half = std::int64_t{1} << (b_bits - 1);
    for (std::int64_t a = -a_half; a < a_half; ++a)
      for (std::int64_t b = -b_half; b < b_half; ++b) add(a, b);
  }
  run(random, [&](bool) { add(signed_word(random, a_bits), signed_word(random, b_bits)); });
  pipeline.write(folder / fmt::format("{}_{}_{}.txt", a_bits, b_bits, clocks));
}

// Inputs: a, b.
void write_vector_multiply_of(const Folder& folder, int a_bits, int b_bits, int clocks) {
  Random random(a_bits + b_bits);
  Pipeline pipeline(clocks);
  run(random, [&](bool) {
    const Axes a = random_axes(random, a_bits), b = random_axes(random, b_bits);
    pipeline.clock({flat(a, a_bits), flat(b, b_bits)}, flat(golden::vector_multiply(a, b), a_bits + b_bits));
  });
  pipeline.write(folder / fmt::format("{}_{}_{}.txt", a_bits, b_bits, clocks));
}

// Each shift, for each component and both signs; then vectors of any kind.
template <int Bits, class Add>
void run_axes(Random& random, const Add& add) {
  for (int bit = 0; bit < Bits; ++bit)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const std::int64_t sign : {1, -1}) {
        Axes v{};
        v[axis] = sign * (std::int64_t{1} << bit);
        if (bit == Bits - 1 && sign > 0) --v[axis];
        add(true, v);
      }
  run(random, [&](bool enable) { add(enable, random_axes(random, Bits)); });
}

// Inputs: components.
template <int VectorBits, int ResultBits>
void write_vector_shift_of(const Folder& folder, int clocks) {
  Random random(VectorBits + ResultBits);
  Pipeline pipeline(clocks);
  const auto add = [&](bool enable, const Axes& v) {
    pipeline.clock(enable, {flat(v, VectorBits)},
                   flat(golden::vector_shift<VectorBits, ResultBits>(v), ResultBits));
  };
  if constexpr (3 * VectorBits <= 16) {
    constexpr std::int64_t c_half = std::int64_t{1} << (VectorBits - 1);
    for (std::int64_t x = -c_half; x < c_half; ++x)
      for (std::int64_t y = -c_half; y < c_half; ++y)
        for (std::int64_t z = -c_half; z < c_half; ++z) add(true, {x, y, z});
  }
  run_axes<VectorBits>(random, add);
  pipeline.write(folder / fmt::format("{}_{}_{}.txt", VectorBits, ResultBits, clocks));
}

// Inputs: components.
template <class Preset, int VectorBits>
void write_unit_vector_of(const Folder& folder) {
  Random random(VectorBits);
  Pipeline pipeline(std::is_same_v<Preset, Exact> ? 15 : 7);
  const auto add = [&](bool, const Axes& v) {
    pipeline.clock({flat(v, VectorBits)},
                   flat(golden::normalized<Preset, VectorBits>(v), Preset::c_direction_bits));
  };
  run_axes<VectorBits>(random, add);
  pipeline.write(folder / fmt::format("{}_{}.txt", Preset::c_name, VectorBits));
}

// Inputs: square.
template <class Preset>
void write_reciprocal_root_of(const Folder& folder, int latency) {
  constexpr int c_bits = Preset::c_square_bits;
  Random random(c_bits);
  Pipeline pipeline(latency);
  const auto add = [&](std::uint64_t bits) {
    const auto square = static_cast<std::uint32_t>(words::low_bits(bits, c_bits));
    using Root = golden::ReciprocalRoot<Preset>;
    pipeline.clock({{square, c_bits}}, {Root::reciprocal(square), Root::c_bits});
  };
  if constexpr (c_bits <= 16) {
    for (std::uint64_t square = 0; square < std::uint64_t{1} << c_bits; ++square) add(square);
  } else {
    // Squares around the ends of each cell, from 1/4 to 4.
    for (std::uint64_t cell = 0; cell < 1024; ++cell)
      for (const std::uint64_t offset : {~std::uint64_t{0}, std::uint64_t{0}, random.bits(c_bits - 10)})
        add((cell << (c_bits - 10)) + offset);
    for (int bit = 0; bit < c_bits; ++bit) add(std::uint64_t{1} << bit);
  }
  run(random, [&](bool) { add(random.word(c_bits)); });
  pipeline.write(folder / file_of<Preset>());
}

// Inputs: base, exponent.
template <class Preset>
void write_power_of(const Folder& folder, bool pipelined, int latency) {
  using Power = golden::Power<Preset>;
  Random random(Preset::c_exponent_bits);
  Pipeline pipeline(latency);
  const auto add = [&](std::uint32_t base, std::uint64_t exponent) {
    const auto m = static_cast<std::uint32_t>(words::low_bits(exponent, Preset::c_exponent_bits));
    pipeline.clock({{base, Power::c_base_fraction + 1}, {m, Preset::c_exponent_bits}},
                   {Power::power(base, m), Preset::c_weight_bits});
  };
  // Highlights of any exponent and height, where the power is mostly neither 0 nor 1.
  const auto any = [&](bool) {
    const std::uint64_t exponent =
        random.bits(Preset::c_exponent_bits) >> random.between(0, Preset::c_exponent_bits - 1);
    const std::int64_t below_one = std::min<std::int64_t>(
        random.between(0, 8 * Power::c_one) / std::max<std::int64_t>(1, static_cast<std::int64_t>(exponent) >>
                                                                            Preset::c_exponent_fraction_bits),
        Power::c_one);
    add(random.one_in(4) ? static_cast<std::uint32_t>(random.between(0, Power::c_one))
                         : Power::c_one - static_cast<std::uint32_t>(below_one),
        exponent);
  };
  if constexpr (Power::c_base_fraction <= 16)
    for (std::uint32_t base = 0; base <= Power::c_one; ++base)
      add(base, random.bits(Preset::c_exponent_bits) >> random.between(0, 9));
  for (int bit = 0; bit <= Power::c_base_fraction; ++bit)
    for (const std::uint32_t offset : {~0U, 0U, 1U}) {
      const std::uint32_t base = std::min((1U << bit) + offset, Power::c_one);
      add(base, random.word(Preset::c_exponent_bits));
      for (const std::uint64_t exponent :
           {std::uint64_t{0}, std::uint64_t{1} << Preset::c_exponent_fraction_bits, ~std::uint64_t{0}})
        add(base, exponent);
    }
  for (int i = 0; i < c_running; ++i) any(true);
  run(random, any);
  pipeline.write(folder / fmt::format("{}_{:d}.txt", Preset::c_name, pipelined));
}

// Inputs: axis_sum, outer, slope.
template <class Preset>
void write_spot_cone_of(const Folder& folder) {
  constexpr int c_sum_bits = 2 * Preset::c_direction_bits + 1, c_slope_bits = Preset::c_spot_slope_bits;
  constexpr int c_fraction = Preset::c_direction_fraction_bits;
  Random random(c_sum_bits);
  Pipeline pipeline(8);
  const auto add = [&](std::int64_t sum, std::int64_t outer, std::uint64_t slope) {
    pipeline.clock({{static_cast<std::uint64_t>(sum), c_sum_bits},
                    {static_cast<std::uint64_t>(outer), Preset::c_direction_bits},
                    {slope, c_slope_bits}},
                   {golden::SpotCone<Preset>::factor(sum, outer, static_cast<std::uint32_t>(slope)),
                    Preset::c_weight_bits});
  };
  run(random, [&](bool) {
    const std::int64_t outer = signed_word(random, Preset::c_direction_bits);
    const std::uint64_t slope =
        std::max<std::uint64_t>(1, random.bits(c_slope_bits) >> random.between(0, c_slope_bits - 1));
    // Cosines between the edges of the rim and a little outside, or anywhere.
    const std::int64_t width = (std::int64_t{1} << (2 * c_fraction + Preset::c_spot_slope_fraction_bits)) /
                               static_cast<std::int64_t>(slope);
    const std::int64_t edge = -outer * (std::int64_t{1} << c_fraction);
    std::int64_t sum = edge - random.between(-width / 4, width * 5 / 4);
    if (random.one_in(16)) sum = edge - random.between(-1, 1);
    if (random.one_in(8) || std::abs(sum) >= std::int64_t{1} << (c_sum_bits - 1))
      sum = signed_word(random, c_sum_bits);
    add(sum, outer, random.one_in(50) ? 0 : slope);
  });
  pipeline.write(folder / file_of<Preset>());
}

// Inputs: word.
void write_delay_line_of(const Folder& folder, int bits, int depth) {
  Random random(bits + depth);
  Pipeline pipeline(depth);
  run(random, [&](bool enable) {
    Flat word;
    for (int left = bits; left > 0; left -= 64) word.add(random.bits(64), std::min(left, 64));
    pipeline.clock(enable, {word}, word);
  });
  pipeline.write(folder / fmt::format("{}_{}.txt", bits, depth));
}

// A line: dot; its cosine, positive.
template <class Preset>
void write_cosine(const Folder& folder) {
  constexpr int c_bits = 2 * Preset::c_direction_bits + 1, c_fraction = Preset::c_direction_fraction_bits;
  Random random(c_bits);
  VectorFile file;
  const auto add = [&](std::int64_t dot) {
    file.word(dot, c_bits)
        .word(golden::cosine<Preset>(dot), c_fraction + 1)
        .flag(golden::positive(dot))
        .end_vector();
  };
  for (int bit = 0; bit < c_bits - 1; ++bit)
    for (const std::int64_t offset : {-1, 0, 1}) {
      add((std::int64_t{1} << bit) + offset);
      add(offset - (std::int64_t{1} << bit));
    }
  constexpr std::int64_t c_one = std::int64_t{1} << (2 * c_fraction);
  for (int i = 0; i < c_running; ++i) {
    add(random.between(-c_one / 8, c_one));
    add(c_one - random.between(-3, 1) * (std::int64_t{1} << (c_fraction - 1)) - random.between(0, 2));
    add(signed_word(random, c_bits));
  }
  file.write(folder / file_of<Preset>());
}

}  // namespace

std::vector<Entity> shading_entities() {
  return {
      {"function_rom", in_both_presets([]<class P>(const Folder& f) {
         for (const auto function :
              {words::Function::reciprocal_root, words::Function::logarithm, words::Function::decay})
           write_function_rom<P>(f, function);
       })},
      {"signed_multiplier", of_sizes(write_signed_multiplier_of, {{1, 1, 1},
                                                                  {8, 8, 1},
                                                                  {5, 9, 2},
                                                                  {18, 18, 1},
                                                                  {19, 18, 2},
                                                                  {21, 19, 2},
                                                                  {25, 25, 1},
                                                                  {24, 26, 2},
                                                                  {30, 22, 2},
                                                                  {28, 30, 2},
                                                                  {36, 27, 2}})},
      {"dot_product", of_sizes(write_dot_product_of, {{4, 2}, {16, 2}, {24, 3}, {30, 3}})},
      {"vector_multiply",
       of_sizes(write_vector_multiply_of, {{2, 5, 1}, {16, 11, 1}, {24, 26, 2}, {28, 30, 2}, {13, 26, 2}})},
      {"vector_shift",
       [](const Folder& folder) {
         for (const int clocks : {1, 2}) {
           write_vector_shift_of<5, 5>(folder, clocks);
           write_vector_shift_of<17, 16>(folder, clocks);
         }
         write_vector_shift_of<25, 24>(folder, 1);
         write_vector_shift_of<30, 24>(folder, 2);
         write_vector_shift_of<16, 24>(folder, 2);
       }},
      {"unit_vector",
       [](const Folder& folder) {
         write_unit_vector_of<Exact, Exact::c_vector_bits>(folder);
         write_unit_vector_of<Exact, Exact::c_offset_bits>(folder);
         write_unit_vector_of<Exact, Exact::c_direction_bits + 1>(folder);
         write_unit_vector_of<Published, Published::c_vector_bits>(folder);
         write_unit_vector_of<Published, Published::c_offset_bits>(folder);
       }},
      {"reciprocal_root",
       [](const Folder& folder) {
         write_reciprocal_root_of<Exact>(folder, 7);
         write_reciprocal_root_of<Published>(folder, 1);
       }},
      {"power",
       [](const Folder& folder) {
         write_power_of<Exact>(folder, true, 11);
         write_power_of<Published>(folder, true, 7);
         write_power_of<Published>(folder, false, 2);
       }},
      {"spot_cone", in_both_presets([]<class P>(const Folder& f) { write_spot_cone_of<P>(f); })},
      {"delay_line", of_sizes(write_delay_line_of, {{8, 0}, {8, 1}, {70, 2}, {1, 3}, {33, 4}, {100, 13}})},
      {"shading_pkg", in_both_presets([]<class P>(const Folder& f) { write_cosine<P>(f); })},
  };
}

}  // namespace halfway::vectors
