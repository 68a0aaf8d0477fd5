// SPDX-License-Identifier: Apache-2.0
// The slices of a light, clock by clock. Uses every combination of strobes, also those that the shader never
// drives.
#include <fmt/format.h>

#include <array>

#include "golden/cosine_rom.hpp"
#include "golden/diffuse_slice.hpp"
#include "golden/specular_slice.hpp"
#include "sim/stream_files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/light_parts.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

using golden::Exact, golden::Published;

struct Strobes {
  bool span_load, span_step, sample_step;
};

/// The first three strobes fill the stages one after the other.
constexpr int c_filling = 3;
Strobes random_strobes(Random& random, int i) {
  if (i < c_filling) return {i == 0, i == 1, i == 2};
  const bool flowing = i / 300 % 2 == 0;
  return {random.one_in(i / 150 % 2 == 0 ? 3 : 25), flowing || !random.one_in(3),
          flowing || !random.one_in(3)};
}

/// The products of a pixel: in the sample stage, or in a stage after it.
using Products = std::array<std::uint64_t, 3>;

struct SliceSize {
  int channels;
  unsigned powers;  ///< of a specular slice
  int address_bits, data_bits;
};

void add_products(VectorFile& file, const Products& products, int channels, int bits) {
  for (int c = 0; c < channels; ++c) file.word(products[static_cast<std::size_t>(c)], bits);
}

// A line: checked, part, span_load, span_step, sample_step; lit, products, before the edge.
template <class Preset>
Status write_diffuse(const std::filesystem::path& folder, const SliceSize& size) {
  const int bits = Preset::c_diffuse_header_bits + size.channels * Preset::c_diffuse_channel_bits;
  Random random(static_cast<std::uint64_t>(bits));
  VectorFile file;
  golden::DiffuseSlice<Preset> twin(size.channels, size.address_bits, size.data_bits);
  Products sampled{}, quarters{}, halves{}, multiplied{};
  for (int i = 0; i < 3000; ++i) {
    InitVector part = random_vector(random, bits);
    put_diffuse_part<Preset>(part, random, size.channels, 1, 0);
    const Strobes s = random_strobes(random, i);
    file.flag(i > c_filling + 1).words_of(part, bits).flag(s.span_load).flag(s.span_step).flag(s.sample_step);
    file.flag(twin.lit());
    add_products(file, multiplied, size.channels, Preset::c_factor_bits + size.data_bits);
    file.end_vector();
    // Each stage loads the previous stage's old value, so update the last stage first.
    multiplied = halves;
    halves = quarters;
    if (s.sample_step) quarters = sampled;
    if (s.span_step) {
      for (int c = 0; c < size.channels; ++c) sampled[static_cast<std::size_t>(c)] = twin.product(c);
    }
    if (s.span_load)
      twin.span_load(part, 0);
    else if (s.span_step)
      twin.span_step();
  }
  return file.write(folder / fmt::format("{}_{}_{}_{}.txt", Preset::c_name, size.channels, size.address_bits,
                                         size.data_bits));
}

// A line: checked, part, span_load, span_step, sample_step, lit; products, before the edge.
template <class Preset>
Status write_specular(const std::filesystem::path& folder, const SliceSize& size) {
  const int bits = Preset::c_specular_header_bits + size.channels * Preset::c_specular_channel_bits;
  Random random(static_cast<std::uint64_t>(bits));
  VectorFile file;
  golden::SpecularSlice<Preset> twin(size.channels, size.powers, size.address_bits, size.data_bits);
  Products sampled{}, quarters{}, halves{}, multiplied{};
  for (int i = 0; i < 3000; ++i) {
    InitVector part = random_vector(random, bits);
    put_specular_part<Preset>(part, random, size.channels, 1, 0);
    const Strobes s = random_strobes(random, i);
    const bool lit = !random.one_in(5);
    file.flag(i > c_filling + 1).words_of(part, bits).flag(s.span_load).flag(s.span_step).flag(s.sample_step);
    file.flag(lit);
    add_products(file, multiplied, size.channels, Preset::c_factor_bits + size.data_bits);
    file.end_vector();
    multiplied = halves;
    halves = quarters;
    if (s.sample_step) quarters = sampled;
    if (s.span_step) {
      for (int c = 0; c < size.channels; ++c) sampled[static_cast<std::size_t>(c)] = twin.product(c, lit);
    }
    if (s.span_load)
      twin.span_load(part, 0);
    else if (s.span_step)
      twin.span_step();
  }
  return file.write(folder / fmt::format("{}_{}_{}_{}_{}.txt", Preset::c_name, size.channels, size.powers,
                                         size.address_bits, size.data_bits));
}

}  // namespace

// A line: checked, enable, address; sample, before the edge.
Status write_cosine_rom(const std::filesystem::path& folder) {
  for (const golden::CosineTable& table : golden::c_cosine_tables) {
    VectorFile file;
    Random random(table.entries.size());
    const golden::CosineRom twin(table.exact, table.power, table.address_bits, table.data_bits);
    std::uint32_t sample = 0;
    // Read every entry, one per clock, then at random with pauses.
    const int entries = 1 << table.address_bits;
    for (int i = 0; i < 2 * entries + 2; ++i) {
      const bool enable = i < entries || random.one_in(2);
      const auto address = i < entries ? static_cast<std::uint32_t>(i)
                                       : static_cast<std::uint32_t>(random.bits(table.address_bits));
      file.flag(i > 0).flag(enable).word(address, table.address_bits);
      file.word(sample, table.data_bits).end_vector();
      if (enable) sample = twin.sample(address);
    }
    const auto name = fmt::format("{}_{}_{}_{}.txt", table.exact ? "exact" : "published", table.power,
                                  table.address_bits, table.data_bits);
    if (auto s = file.write(folder / name); !s) return s;
  }
  return Ok{};
}

Status write_diffuse_slice(const std::filesystem::path& folder) {
  for (const int channels : {0, 1, 3})
    if (auto s = write_diffuse<Exact>(folder, {channels, 0, 9, 8}); !s) return s;
  if (auto s = write_diffuse<Published>(folder, {3, 0, 6, 6}); !s) return s;
  return write_diffuse<Published>(folder, {1, 0, 4, 4});
}

Status write_specular_slice(const std::filesystem::path& folder) {
  for (const auto& [channels, powers] : {std::pair{3, 31u}, std::pair{3, 18u}, std::pair{1, 8u}})
    if (auto s = write_specular<Exact>(folder, {channels, powers, 9, 8}); !s) return s;
  if (auto s = write_specular<Published>(folder, {3, 2, 6, 6}); !s) return s;
  return write_specular<Published>(folder, {1, 2, 4, 4});
}

}  // namespace halfway::vectors
