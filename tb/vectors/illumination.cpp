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
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/light_parts.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

using golden::ColourTerms, words::Exact, words::Published;

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

template <class Product>
Products products_of(int channels, const Product& product) {
  Products products{};
  for (int c = 0; c < channels; ++c) products[c] = product(c);
  return products;
}

struct SliceSize {
  int channels;
  unsigned powers;  ///< of a specular slice
  words::CosineSize table;
};

void add_products(VectorFile& file, const Products& products, int channels, int bits) {
  for (int c = 0; c < channels; ++c) file.word(products[c], bits);
}

/// Columns part, span_load, span_step, sample_step of one clock, after `checked`.
void add_slice_clock(VectorFile& file, int i, const InitVector& part, int bits, const SpanStrobes& s) {
  file.flag(i > c_filling + 1).words_of(part, bits).flag(s.span_load).flag(s.span_step).flag(s.sample_step);
}

/// The products, or terms, in the stages after the sample stage.
template <class Products>
struct Multiplier {
  Products sampled, quarters = sampled, halves = sampled, multiplied = sampled;

  /// One clock. Each stage loads the previous stage's old value, so update the last stage first, and then the
  /// twin. `sample()` gives the products of the twin.
  template <class Twin, class Sample>
  void clock(const SpanStrobes& s, Twin& twin, const InitVector& part, const Sample& sample) {
    multiplied = halves;
    halves = quarters;
    if (s.sample_step) quarters = sampled;
    if (s.span_step) sampled = sample();
    if (s.span_load)
      twin.span_load(part, 0);
    else if (s.span_step)
      twin.span_step();
  }
};

// A line: checked, part, span_load, span_step, sample_step; lit, products, before the edge.
template <class Preset>
void write_diffuse(const Folder& folder, const SliceSize& size) {
  const int bits = Preset::c_diffuse_header_bits + size.channels * Preset::c_diffuse_channel_bits;
  Random random(bits);
  VectorFile file;
  golden::DiffuseSlice<Preset> twin(size.channels, size.table);
  Multiplier<Products> multiplier{};
  for (int i = 0; i < 9000; ++i) {
    InitVector part = random_vector(random, bits);
    put_diffuse_part<Preset>(part, random, size.channels, 1, 0);
    const SpanStrobes s = random_span_strobes(random, i);
    add_slice_clock(file, i, part, bits, s);
    file.flag(twin.lit());
    add_products(file, multiplier.multiplied, size.channels, Preset::c_factor_bits + size.table.data_bits);
    file.end_vector();
    multiplier.clock(s, twin, part,
                     [&] { return products_of(size.channels, [&](int c) { return twin.product(c); }); });
  }
  file.write(folder / fmt::format("{}_{}_{}.txt", Preset::c_name, size.channels, vhdl_name(size.table)));
}

// A line: checked, part, span_load, span_step, sample_step, lit; products, before the edge.
template <class Preset>
void write_specular(const Folder& folder, const SliceSize& size) {
  const int bits = Preset::c_specular_header_bits + size.channels * Preset::c_specular_channel_bits;
  Random random(bits);
  VectorFile file;
  golden::SpecularSlice<Preset> twin(size.channels, size.powers, size.table);
  Multiplier<Products> multiplier{};
  for (int i = 0; i < 9000; ++i) {
    InitVector part = random_vector(random, bits);
    put_specular_part<Preset>(part, random, size.channels, 1, 0);
    const SpanStrobes s = random_span_strobes(random, i);
    const bool lit = !random.one_in(5);
    add_slice_clock(file, i, part, bits, s);
    file.flag(lit);
    add_products(file, multiplier.multiplied, size.channels, Preset::c_factor_bits + size.table.data_bits);
    file.end_vector();
    multiplier.clock(s, twin, part,
                     [&] { return products_of(size.channels, [&](int c) { return twin.product(c, lit); }); });
  }
  file.write(folder / fmt::format("{}_{}_{}_{}.txt", Preset::c_name, size.channels, size.powers,
                                  vhdl_name(size.table)));
}

// A light. tb/vectors/rows.toml has the same list.
struct LightWords {
  const char* name;
  words::SphericalConfig config;
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
void write_light(const Folder& folder, const LightWords& light) {
  using Groups = std::vector<ColourTerms>;
  const words::SphericalConfig& config = light.config;
  const words::SphericalLayout<Preset> layout(config);
  const int bits = layout.record_bits();
  Random random(bits);
  VectorFile file;
  golden::SphericalLight<Preset> twin(config);
  const auto terms = [&] {
    Groups groups;
    twin.add_terms([&](const ColourTerms& group) { groups.push_back(group); });
    return groups;
  };
  Multiplier<Groups> multiplier{terms()};
  for (int i = 0; i < 9000; ++i) {
    InitVector part = random_vector(random, bits);
    if (layout.has_diffuse_part())
      put_diffuse_part<Preset>(part, random, layout.diffuse_channels(), 1, layout.diffuse_low(0));
    if (config.specular)
      put_specular_part<Preset>(part, random, config.highlight_channels, 1, layout.specular_low(0));
    const SpanStrobes s = random_span_strobes(random, i);
    add_slice_clock(file, i, part, bits, s);
    for (const ColourTerms& group : multiplier.multiplied)
      add_products(file, group, config.channels, Preset::c_factor_bits + config.size.data_bits);
    file.end_vector();
    multiplier.clock(s, twin, part, terms);
  }
  file.write(folder / fmt::format("{}.txt", light.name));
}

// A line: checked, ambient, span_load; terms, before the edge.
template <class Preset>
void write_ambient(const Folder& folder, int channels, int data_bits, int depth) {
  const int bits = channels * Preset::c_ambient_channel_bits;
  Random random(bits + depth);
  VectorFile file;
  golden::AmbientLight<Preset> twin(channels, data_bits);
  golden::DelayLine<ColourTerms> delay(depth);
  for (int i = 0; i < 2000; ++i) {
    const InitVector ambient = random_vector(random, bits);
    const bool span_load = i == 0 || random.one_in(3);
    file.flag(i > depth).words_of(ambient, bits).flag(span_load);
    add_products(file, delay.delayed(), channels, Preset::c_factor_bits + data_bits);
    file.end_vector();
    // As in Multiplier.
    delay.step(twin.terms());
    if (span_load) twin.span_load(ambient, 0);
  }
  file.write(folder / fmt::format("{}_{}_{}_{}.txt", Preset::c_name, channels, data_bits, depth));
}

// Inputs: terms.
template <class Preset>
void write_colour_sum_of(const Folder& folder, int channels, int terms, int data_bits) {
  const int bits = Preset::c_factor_bits + data_bits;
  const std::int64_t white = std::int64_t{300} << (Preset::c_factor_fraction_bits + data_bits);
  Random random(channels * terms + bits);
  Pipeline pipeline(1);
  for (int i = 0; i < 20000; ++i) {
    golden::ColourSum<Preset> sum(channels, data_bits);
    Flat words;
    ColourTerms total{};
    const bool full = random.one_in(40);  // all terms but the last
    const std::uint64_t step = std::uint64_t{1} << (Preset::c_factor_fraction_bits + data_bits);
    for (int term = 0; term < terms; ++term) {
      ColourTerms group{};
      for (int c = 0; c < channels; ++c) {
        // Sums around white; few of them far above, some only by one high bit.
        group[c] = full                ? words::low_bits(~std::uint64_t{0}, bits)
                   : random.one_in(12) ? random.word(bits)
                   : random.one_in(16) ? std::uint64_t{1} << random.between(0, bits - 1)
                                       : words::low_bits(random.between(0, 2 * white / terms), bits);
        // On a step of the colour, or just below: a lower bit that is wrong changes the colour.
        if (term > 0 && term == terms - 1 && random.one_in(3))
          group[c] = 2 * step - total[c] % step - random.bits(1);
        total[c] += group[c];
        words.add(group[c], bits);
      }
      sum.add(group);
    }
    Flat colours;
    for (const std::uint8_t colour : sum.colours()) colours.add(colour, Preset::c_colour_bits);
    pipeline.clock(!random.one_in(4), {words}, colours);
  }
  pipeline.write(folder / fmt::format("{}_{}_{}_{}.txt", Preset::c_name, channels, terms, data_bits));
}

// A line: checked, enable, address; sample, before the edge.
void write_cosine_rom(const Folder& folder) {
  for (const words::CosineTable& table : words::c_cosine_tables) {
    VectorFile file;
    Random random(table.entries.size());
    const golden::CosineRom twin(table.exact, table.power, table.size);
    std::uint32_t sample = 0;
    // Read every entry, one per clock, then at random with pauses.
    const int entries = table.size.entries();
    for (int i = 0; i < 2 * entries + 2; ++i) {
      const bool enable = i < entries || random.one_in(2);
      const auto address = i < entries ? static_cast<std::uint32_t>(i)
                                       : static_cast<std::uint32_t>(random.bits(table.size.address_bits));
      file.flag(i > 0).flag(enable).word(address, table.size.address_bits);
      file.word(sample, table.size.data_bits).end_vector();
      if (enable) sample = twin.sample(address);
    }
    const auto name =
        fmt::format("{}_{}_{}.txt", table.exact ? "exact" : "published", table.power, vhdl_name(table.size));
    file.write(folder / name);
  }
}

}  // namespace

std::vector<Entity> illumination_entities() {
  return {
      {"cosine_rom", write_cosine_rom},
      {"diffuse_slice",
       [](const Folder& folder) {
         for (const int channels : {0, 1, 3}) write_diffuse<Exact>(folder, {channels, 0, 9, 8});
         write_diffuse<Published>(folder, {3, 0, 6, 6});
         write_diffuse<Published>(folder, {1, 0, 4, 4});
       }},
      {"specular_slice",
       [](const Folder& folder) {
         write_specular<Exact>(folder, {3, 31, 9, 8});
         write_specular<Exact>(folder, {3, 18, 9, 8});
         write_specular<Exact>(folder, {1, 8, 9, 8});
         write_specular<Published>(folder, {3, 2, 6, 6});
         write_specular<Published>(folder, {1, 2, 4, 4});
       }},
      {"spherical_light",
       [](const Folder& folder) {
         for (const LightWords& light : c_exact_lights) write_light<Exact>(folder, light);
         for (const LightWords& light : c_published_lights) write_light<Published>(folder, light);
       }},
      {"ambient_light",
       [](const Folder& folder) {
         write_ambient<Exact>(folder, 3, 8, 4);
         write_ambient<Exact>(folder, 1, 8, 4);
         write_ambient<Published>(folder, 3, 6, 2);
       }},
      {"colour_sum",
       [](const Folder& folder) {
         for (const int terms : {1, 3, 5}) write_colour_sum_of<Exact>(folder, 3, terms, 8);
         write_colour_sum_of<Exact>(folder, 1, 3, 8);
         write_colour_sum_of<Published>(folder, 3, 3, 6);
       }},
  };
}

}  // namespace halfway::vectors
