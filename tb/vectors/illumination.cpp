// SPDX-License-Identifier: Apache-2.0
// The spherical shader's slices, lights, ambient light and sum of colours, clock by clock. Uses every
// combination of strobes, also those that the shader never drives.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "golden/ambient_light.hpp"
#include "golden/colour_sum.hpp"
#include "golden/cosine_rom.hpp"
#include "golden/delay_line.hpp"
#include "golden/diffuse_slice.hpp"
#include "golden/specular_slice.hpp"
#include "golden/spherical_light.hpp"
#include "sim/stream_files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/light_parts.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

using golden::ColourTerms, golden::Exact, golden::Published;

struct SpanStrobes {
  bool span_load, span_step, sample_step;
};

/// The first three strobes fill the stages one after the other.
constexpr int c_filling = 3;
SpanStrobes random_span_strobes(Random& random, int i) {
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
    const SpanStrobes s = random_span_strobes(random, i);
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
    const SpanStrobes s = random_span_strobes(random, i);
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

// A light. tb/shaders/spherical_light_tb.vhd has the same list.
struct LightWords {
  const char* name;
  golden::SphericalConfig config;
};

constexpr LightWords c_exact_lights[] = {
    {"coloured_highlights", {3, 1, true, true, 3, 18, 9, 8}},
    {"white_highlights", {3, 1, true, true, 1, 2, 9, 8}},
    {"grey", {1, 1, true, true, 1, 16, 9, 8}},
    {"highlights", {3, 1, false, true, 3, 9, 9, 8}},
    {"matte", {3, 1, true, false, 1, 2, 9, 8}},
};
constexpr LightWords c_published_lights[] = {
    {"published", {3, 1, true, true, 1, 2, 6, 6}},
    {"published_highlights", {1, 1, false, true, 1, 2, 4, 4}},
};

// A line: checked, part, span_load, span_step, sample_step; terms, before the edge.
template <class Preset>
Status write_light(const std::filesystem::path& folder, const LightWords& light) {
  using Groups = std::vector<ColourTerms>;
  const golden::SphericalConfig& config = light.config;
  const golden::SphericalLayout<Preset> layout(config);
  const int bits = layout.record_bits();
  Random random(static_cast<std::uint64_t>(bits));
  VectorFile file;
  golden::SphericalLight<Preset> twin(config);
  const auto terms = [&] {
    Groups groups;
    twin.add_terms([&](const ColourTerms& group) { groups.push_back(group); });
    return groups;
  };
  Groups sampled = terms(), quarters = sampled, halves = sampled, multiplied = sampled;
  for (int i = 0; i < 3000; ++i) {
    InitVector part = random_vector(random, bits);
    if (layout.has_diffuse_part())
      put_diffuse_part<Preset>(part, random, layout.diffuse_channels(), 1, layout.diffuse_low(0));
    if (config.specular)
      put_specular_part<Preset>(part, random, config.highlight_channels, 1, layout.specular_low(0));
    const SpanStrobes s = random_span_strobes(random, i);
    file.flag(i > c_filling + 1).words_of(part, bits).flag(s.span_load).flag(s.span_step).flag(s.sample_step);
    for (const ColourTerms& group : multiplied)
      add_products(file, group, config.channels, Preset::c_factor_bits + config.data_bits);
    file.end_vector();
    // As in write_diffuse.
    multiplied = halves;
    halves = quarters;
    if (s.sample_step) quarters = sampled;
    if (s.span_step) sampled = terms();
    if (s.span_load)
      twin.span_load(part, 0);
    else if (s.span_step)
      twin.span_step();
  }
  return file.write(folder / fmt::format("{}.txt", light.name));
}

// A line: checked, ambient, span_load; terms, before the edge.
template <class Preset>
Status write_ambient(const std::filesystem::path& folder, int channels, int data_bits, int depth) {
  const int bits = channels * Preset::c_ambient_channel_bits;
  Random random(static_cast<std::uint64_t>(bits + depth));
  VectorFile file;
  golden::AmbientLight<Preset> twin(channels, data_bits);
  golden::DelayLine<ColourTerms> delay(depth);
  for (int i = 0; i < 2000; ++i) {
    const InitVector ambient = random_vector(random, bits);
    const bool span_load = i == 0 || random.one_in(3);
    file.flag(i > depth).words_of(ambient, bits).flag(span_load);
    add_products(file, delay.delayed(), channels, Preset::c_factor_bits + data_bits);
    file.end_vector();
    // As in write_diffuse.
    delay.step(twin.terms());
    if (span_load) twin.span_load(ambient, 0);
  }
  return file.write(folder / fmt::format("{}_{}_{}_{}.txt", Preset::c_name, channels, data_bits, depth));
}

// Inputs: terms.
template <class Preset>
Status write_colour_sum_of(const std::filesystem::path& folder, int channels, int terms, int data_bits) {
  const int bits = Preset::c_factor_bits + data_bits;
  const std::int64_t white = std::int64_t{300} << (Preset::c_factor_fraction_bits + data_bits);
  Random random(static_cast<std::uint64_t>(channels * terms + bits));
  Pipeline pipeline(1);
  for (int i = 0; i < 3000; ++i) {
    golden::ColourSum<Preset> sum(channels, data_bits);
    Flat words;
    for (int term = 0; term < terms; ++term) {
      ColourTerms group{};
      for (int c = 0; c < channels; ++c) {
        // Sums around white, few of them far above.
        group[static_cast<std::size_t>(c)] =
            random.one_in(16)
                ? random.word(bits)
                : golden::low_bits(static_cast<std::uint64_t>(random.between(0, 2 * white / terms)), bits);
        words.add(group[static_cast<std::size_t>(c)], bits);
      }
      sum.add(group);
    }
    Flat colours;
    for (const std::uint8_t colour : sum.colours()) colours.add(colour, Preset::c_colour_bits);
    pipeline.clock(!random.one_in(4), {words}, colours);
  }
  return pipeline.write(folder / fmt::format("{}_{}_{}_{}.txt", Preset::c_name, channels, terms, data_bits));
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

Status write_spherical_light(const std::filesystem::path& folder) {
  for (const LightWords& light : c_exact_lights)
    if (auto s = write_light<Exact>(folder, light); !s) return s;
  for (const LightWords& light : c_published_lights)
    if (auto s = write_light<Published>(folder, light); !s) return s;
  return Ok{};
}

Status write_ambient_light(const std::filesystem::path& folder) {
  if (auto s = write_ambient<Exact>(folder, 3, 8, 4); !s) return s;
  if (auto s = write_ambient<Exact>(folder, 1, 8, 4); !s) return s;
  return write_ambient<Published>(folder, 3, 6, 2);
}

Status write_colour_sum(const std::filesystem::path& folder) {
  for (const int terms : {1, 3, 5})
    if (auto s = write_colour_sum_of<Exact>(folder, 3, terms, 8); !s) return s;
  if (auto s = write_colour_sum_of<Exact>(folder, 1, 3, 8); !s) return s;
  return write_colour_sum_of<Published>(folder, 3, 3, 6);
}

}  // namespace halfway::vectors
