// SPDX-License-Identifier: Apache-2.0
#include "golden/saturate.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/vector_file.hpp"

namespace halfway::vectors {
namespace {

template <int W, int FractionBits, int ResultBits>
Status write_one(const std::filesystem::path& folder) {
  VectorFile file;
  const auto add = [&](std::uint64_t bits) {
    const auto value = golden::Word<W>::from_bits(bits);
    file.word(value).word(golden::saturate<W, FractionBits, ResultBits>(value), ResultBits).end_vector();
  };
  if constexpr (W <= 16) {
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << W; ++bits) add(bits);
  } else {
    Random random(W);
    constexpr std::uint64_t c_one = std::uint64_t{1} << FractionBits;
    // Each whole result with the fractions around it, and every power of two with its neighbours.
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
  return file.write(folder / (std::to_string(W) + '_' + std::to_string(FractionBits) + '_' +
                              std::to_string(ResultBits) + ".txt"));
}

}  // namespace

Status write_saturate(const std::filesystem::path& folder) {
  using golden::Exact, golden::Published;
  if (auto s = write_one<16, 4, 8>(folder); !s) return s;
  if (auto s = write_one<12, 2, 8>(folder); !s) return s;  // no bit to spare
  if (auto s = write_one<11, 0, 8>(folder); !s) return s;
  if (auto s =
          write_one<Exact::c_intensity_bits, Exact::c_intensity_fraction_bits, Exact::c_colour_bits>(folder);
      !s)
    return s;
  return write_one<Published::c_intensity_bits, Published::c_intensity_fraction_bits,
                   Published::c_colour_bits>(folder);
}

}  // namespace halfway::vectors
