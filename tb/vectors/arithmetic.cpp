// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "golden/angle_address.hpp"
#include "golden/multiplier.hpp"
#include "golden/saturate.hpp"
#include "golden/saturating_sum.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

using words::Exact, words::Published;

template <int W, int FractionBits, int ResultBits>
void write_saturate(const Folder& folder) {
  VectorFile file;
  const auto add = [&](std::uint64_t bits) {
    const auto value = words::Word<W>::from_bits(bits);
    file.word(value).word(golden::saturate<W, FractionBits, ResultBits>(value), ResultBits).end_vector();
  };
  if constexpr (W <= 16) {
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << W; ++bits) add(bits);
  } else {
    Random random(W);
    constexpr std::uint64_t c_one = std::uint64_t{1} << FractionBits;
    // Each integer result with the fractions next to it, and every power of two with its neighbours.
    for (std::uint64_t whole = 0; whole <= std::uint64_t{1} << ResultBits; ++whole) {
      add(whole * c_one - 1);
      add(whole * c_one);
      add(whole * c_one + random.bits(FractionBits));
    }
    for (int bit = 0; bit < W; ++bit) {
      for (const std::uint64_t offset : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}}) {
        add((std::uint64_t{1} << bit) + offset);
        add(offset - (std::uint64_t{1} << bit));
      }
    }
    for (int i = 0; i < 4000; ++i) add(random.word(W));
  }
  file.write(folder / (std::to_string(W) + '_' + std::to_string(FractionBits) + '_' +
                       std::to_string(ResultBits) + ".txt"));
}

// A line: checked, enable, a, b; product, before the edge. At full speed all products, or random ones; then
// random ones with pauses.
void write_multiplier_of(const Folder& folder, int a_bits, int b_bits) {
  Random random(a_bits + b_bits);
  VectorFile file;
  std::uint64_t quarters = 0, halves = 0, product = 0;
  int filled = 0;
  const auto add = [&](bool enable, std::uint64_t a, std::uint64_t b) {
    file.flag(filled > 2)
        .flag(enable)
        .word(a, a_bits)
        .word(b, b_bits)
        .word(product, a_bits + b_bits)
        .end_vector();
    ++filled;
    // The quarters of the last product become halves, and the halves become the product.
    product = halves;
    halves = quarters;
    if (enable) quarters = golden::multiply(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  };
  if (a_bits + b_bits <= 16) {
    for (std::uint64_t a = 0; a < std::uint64_t{1} << a_bits; ++a)
      for (std::uint64_t b = 0; b < std::uint64_t{1} << b_bits; ++b) add(true, a, b);
  } else {
    for (int i = 0; i < 3000; ++i) add(true, random.word(a_bits), random.word(b_bits));
  }
  for (int i = 0; i < 1000; ++i) add(random.one_in(2), random.word(a_bits), random.word(b_bits));
  file.write(folder / fmt::format("{}_{}.txt", a_bits, b_bits));
}

// A line: angle; address, in_range.
template <class Preset>
void write_angle_address(const Folder& folder, const words::CosineSize& table) {
  const int address_bits = table.address_bits;
  constexpr int c_bits = Preset::c_angle_bits, c_fraction = Preset::c_angle_fraction_bits;
  VectorFile file;
  const auto add = [&](std::uint64_t bits) {
    const auto angle = words::Word<c_bits>::from_bits(bits);
    const auto [address, in_range] = golden::angle_address<Preset>(angle, table);
    file.word(angle).word(address, address_bits).flag(in_range).end_vector();
  };
  if constexpr (c_bits <= 16) {
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << c_bits; ++bits) add(bits);
  } else {
    Random random(address_bits);
    // Both ends of every cell within three half bells of the top, and an angle between; every power of two
    // with its neighbours.
    const std::uint64_t cell = std::uint64_t{1} << (c_fraction - address_bits);
    for (int k = -(3 << address_bits); k < 3 << address_bits; ++k) {
      const std::uint64_t low = static_cast<std::uint64_t>(k) * cell;
      add(low);
      add(low + cell - 1);
      add(low + random.bits(c_fraction - address_bits));
    }
    for (int bit = 0; bit < c_bits; ++bit) {
      for (const std::uint64_t offset : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}}) {
        add((std::uint64_t{1} << bit) + offset);
        add(offset - (std::uint64_t{1} << bit));
      }
    }
    for (int i = 0; i < 4000; ++i) add(random.word(c_bits));
  }
  file.write(folder / fmt::format("{}_{}.txt", Preset::c_name, vhdl_name(table)));
}

// A line: the terms as one flat word, the last term first; result.
void write_sum_of(const Folder& folder, int terms, int term_bits, int fraction_bits, int result_bits) {
  Random random(terms * term_bits);
  Random enables(terms);
  Pipeline pipeline(1);
  std::vector<std::uint64_t> values(static_cast<std::size_t>(terms));
  const auto add = [&] {
    golden::SaturatingSum sum;
    std::vector<std::uint32_t> flat(static_cast<std::size_t>(terms * term_bits + 31) / 32);
    for (int i = 0; i < terms; ++i) {
      const std::uint64_t value = values[i];
      sum.add(value);
      words::set_bits(flat, {"term", i * term_bits, term_bits, false, 0}, value);
    }
    Flat inputs;
    inputs.words = flat;
    inputs.bits = terms * term_bits;
    pipeline.clock(!enables.one_in(4), {inputs}, Flat(sum.result(fraction_bits, result_bits), result_bits));
  };
  if (terms * term_bits <= 16) {
    for (std::uint64_t all = 0; all < std::uint64_t{1} << terms * term_bits; ++all) {
      for (int i = 0; i < terms; ++i) values[i] = words::low_bits(all >> i * term_bits, term_bits);
      add();
    }
  } else {
    const std::uint64_t largest = words::low_bits(~std::uint64_t{0}, term_bits);
    const int sum_bits = static_cast<int>(std::bit_width(largest * values.size()));
    for (int i = 0; i < 4000; ++i) {
      switch (random.between(0, 7)) {
        case 0:
          std::ranges::fill(values, largest);
          break;
        case 1:
          for (std::uint64_t& value : values) value = random.word(term_bits);
          break;
        case 2:
        case 3:
        case 4: {
          // On a step of the result, or just below: a lower bit that is wrong changes the result.
          std::uint64_t rest = random.bits(result_bits) << fraction_bits;
          if (rest > 0) rest -= random.bits(1);
          for (std::size_t left = values.size(); left > 0; --left) {
            const std::uint64_t value = left == 1 ? rest : random.bits(64) % (2 * rest / left + 1);
            values[left - 1] = std::min(value, largest);
            rest -= values[left - 1];
          }
          break;
        }
        default: {
          // A power of two and a little more, in full terms: a higher bit that is wrong changes the result.
          std::uint64_t rest =
              (std::uint64_t{1} << random.between(0, sum_bits - 1)) + random.bits(fraction_bits);
          std::ranges::fill(values, 0);
          for (std::size_t at = random.bits(64) % values.size(); rest > 0 && at < values.size(); ++at) {
            values[at] = std::min(rest, largest);
            rest -= values[at];
          }
        }
      }
      add();
    }
  }
  pipeline.write(folder / fmt::format("{}_{}_{}_{}.txt", terms, term_bits, fraction_bits, result_bits));
}

}  // namespace

std::vector<Entity> arithmetic_entities() {
  return {
      {"saturate",
       [](const Folder& folder) {
         write_saturate<16, 4, 8>(folder);
         write_saturate<12, 2, 8>(folder);  // the fewest bits: no spare bit
         write_saturate<11, 0, 8>(folder);
         in_both_presets([]<class P>(const Folder& f) {
           write_saturate<P::c_intensity_bits, P::c_intensity_fraction_bits, P::c_colour_bits>(f);
         })(folder);
       }},
      {"multiplier", of_sizes(write_multiplier_of,
                              {{1, 1}, {8, 8}, {4, 9}, {8, 18}, {18, 12}, {8, 24}, {12, 24}, {32, 32}})},
      {"angle_address",
       [](const Folder& folder) {
         for (const words::CosineTable& table : words::c_cosine_tables) {
           write_angle_address<Exact>(folder, table.size);
           write_angle_address<Published>(folder, table.size);
         }
       }},
      {"saturating_sum", of_sizes(write_sum_of, {{1, 16, 4, 8},
                                                 {2, 8, 2, 6},
                                                 {2, 6, 0, 6},
                                                 {3, 5, 1, 4},
                                                 {5, 3, 0, 4},
                                                 {3, 24, 14, 8},
                                                 {33, 26, 16, 8},
                                                 {33, 32, 16, 8},
                                                 {3, 36, 20, 8}})},
  };
}

}  // namespace halfway::vectors
