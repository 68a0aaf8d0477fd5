// SPDX-License-Identifier: Apache-2.0
// Random strips for the filter. Files for each case: _in, weight and token in one word, then token, weight
// and background for the netlist of tb/mutants; _out, fragments; _ends, for each fragment the number of the
// token that ends its pixel.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "golden/pixel_filter.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"
#include "vectors/triangles.hpp"

namespace halfway::vectors {
namespace {

using words::Command, words::Exact, words::Published, words::set_bits;

// tb/rtl/objects/pixel_filter_tb.vhd has the same list.
struct FilterCase {
  int channels, subpixels;
  golden::FilterWeights weights;
  golden::Background background;
};
constexpr FilterCase c_exact_filters[] = {{3, 16, golden::c_filter_weights, {0x11, 0xC8, 0xFF}},
                                          {1, 4, golden::c_filter_weights, {0xFF, 0, 0}},
                                          {3, 1, {1, 0, 0, 0}, {0, 0x80, 0x7F}},
                                          {1, 16, {9, 3, 3, 1}, {0x5A, 0, 0}}};
constexpr FilterCase c_published_filters[] = {{3, 16, golden::c_filter_weights, {0, 0x33, 0xFE}},
                                              {1, 1, {1, 0, 0, 0}, {0xFF, 0, 0}},
                                              {3, 4, {1, 0, 2, 1}, {0xFF, 1, 0x80}}};

template <class Preset>
class FilterFiles {
 public:
  explicit FilterFiles(const FilterCase& c)
      : config_{c.channels, 1, 0, 0, true, true, true, false},
        subpixels_(c.subpixels),
        weight_bits_(std::bit_width(static_cast<unsigned>(c.subpixels))),
        random_(static_cast<std::uint64_t>(c.channels + c.subpixels)),
        case_(c),
        background_(c.background[0] | c.background[1] << 8 | c.background[2] << 16),
        twin_(c.channels, c.subpixels, c.background, c.weights) {}

  void add_strip() {
    const auto lines = random_.between(1, 7), columns = random_.one_in(20) ? 130 : random_.between(1, 24);
    const auto y = random_.between(0, 4096 - lines), x = random_.one_in(2) ? 0
                                                         : random_.one_in(3)
                                                             ? 4096 - columns
                                                             : random_.between(1, 4096 - columns);
    const int kind = static_cast<int>(random_.between(0, 3));  // lone pixels, all covered, mixed, empty
    for (std::int64_t line = 0; line < lines; ++line) {
      const bool empty = kind == 3 || random_.one_in(4);
      for (std::int64_t column = 0; column < columns; ++column) {
        // The first pixel of a strip starts a line with either command.
        add_head(column == 0 && (line > 0 || random_.one_in(2)), y + line, x + column);
        if (kind == 1 || (!empty && random_.one_in(kind == 0 ? 12 : 2))) add_objects(kind == 1);
        if (random_.one_in(20)) add_ignored();
      }
    }
    add(any_token(Command::new_frame), any_weight());
    if (random_.one_in(3)) add_ignored();
    // Objects outside a strip are ignored, whatever their weights.
    for (auto n = random_.between(0, 3); n > 0; --n) add(any_token(Command::new_object), any_weight());
    if (random_.one_in(3)) add(any_token(Command::new_frame), any_weight());
  }
  void write(const Folder& folder) const {
    const std::string stem =
        fmt::format("{}_{}_{}_{}", Preset::c_name, case_.channels, subpixels_, fmt::join(case_.weights, "_"));
    in_.write(folder / (stem + "_in.txt"));
    out_.write(folder / (stem + "_out.txt"));
    ends_.write(folder / (stem + "_ends.txt"));
  }

 private:
  using Token = golden::ShadingToken<Preset>;

  std::uint32_t any_weight() { return static_cast<std::uint32_t>(random_.bits(weight_bits_)); }
  // Fields that are not used are random.
  Token any_token(Command command) {
    Token token;
    token.command = command;
    token.triangle = static_cast<std::uint32_t>(random_.bits(32));
    token.z =
        static_cast<std::uint32_t>(random_.one_in(3) ? random_.bits(2) : random_.word(Preset::c_depth_bits));
    token.y = static_cast<std::uint32_t>(random_.bits(12));
    token.x = static_cast<std::uint32_t>(random_.bits(12));
    for (std::uint32_t& word : token.radiance) {
      constexpr int c_fraction = Preset::c_radiance_fraction_bits;
      word = static_cast<std::uint32_t>(random_.word(Preset::c_radiance_bits));
      if (c_fraction > 0 && random_.one_in(3))  // close to white
        word = static_cast<std::uint32_t>((255 << c_fraction) + random_.between(-2, 1 << c_fraction));
    }
    return token;
  }
  // A colour with which the sum of this object and background is halfway between two colours, or just below.
  std::uint32_t tied(std::int64_t background, std::int64_t weight) {
    constexpr int c_fraction = Preset::c_radiance_fraction_bits;
    std::int64_t step = 0, share = weight * case_.weights[0];  // of the sum
    for (const std::int64_t w : case_.weights) step += w * subpixels_ << c_fraction;
    const std::int64_t colour = random_.between(0, 254),
                       distance = (2 * (colour - background) + 1) * step / 2;
    const std::int64_t change =
        (distance + (distance > 0 ? share - 1 : 0)) / share - (random_.one_in(2) ? 1 : 0);
    const std::int64_t half = (1 << c_fraction) / 2;
    return static_cast<std::uint32_t>(std::clamp((background << c_fraction) + half + change, std::int64_t{0},
                                                 (std::int64_t{256} << c_fraction) - 1));
  }
  void add_head(bool line, std::int64_t y, std::int64_t x) {
    Token head = any_token(line ? Command::new_scanline : Command::new_pixel);
    head.y = static_cast<std::uint32_t>(y);
    head.x = static_cast<std::uint32_t>(x);
    add(head, any_weight());
  }
  void add_ignored() {
    constexpr Command c_ignored[] = {Command::define, Command::redefine, Command::remove, Command::shadow};
    add(any_token(c_ignored[random_.between(0, 3)]), any_weight());
  }
  void add_objects(bool all) {
    const std::int64_t covered = all ? subpixels_ : random_.between(1, subpixels_);
    for (std::int64_t rest = covered; rest > 0;) {
      const std::int64_t weight = random_.one_in(3) ? rest : random_.between(1, rest);
      Token object = any_token(Command::new_object);
      if (!all && random_.one_in(2))
        for (std::size_t i = 0; i < 3; ++i) object.radiance[i] = tied(case_.background[i], weight);
      add(object, static_cast<std::uint32_t>(weight));
      rest -= weight;
    }
  }
  void add(const Token& token, std::uint32_t weight) {
    const int bits = words::ProcessorsLayout<Preset>(config_).token_bits();
    std::vector<std::uint32_t> words(static_cast<std::size_t>(bits + weight_bits_ + 31) / 32);
    random_.fill(words);
    token.encode(config_, words);
    set_bits(words, {"", bits, weight_bits_, false, 0}, weight);
    twin_.take(token, weight, [&](const Fragment& f) {
      ends_.word(in_.size(), 32).end_vector();
      add_fragment<Preset>(out_, f).end_vector();
    });
    in_.words_of(words, bits + weight_bits_).words_of(words, bits).word(weight, weight_bits_);
    in_.word(static_cast<std::uint64_t>(background_), 24).end_vector();
  }

  words::ProcessorsConfig config_;
  int subpixels_, weight_bits_;
  Random random_;
  FilterCase case_;
  int background_;
  golden::PixelFilter<Preset> twin_;
  VectorFile in_, out_, ends_;
};

template <class Preset>
void write_filters(const Folder& folder, std::span<const FilterCase> cases) {
  for (const FilterCase& c : cases) {
    FilterFiles<Preset> files(c);
    for (int i = 0; i < 30; ++i) files.add_strip();
    files.write(folder);
  }
}

}  // namespace

std::vector<Entity> filter_entities() {
  return {{"pixel_filter", [](const Folder& folder) {
             write_filters<Exact>(folder, c_exact_filters);
             write_filters<Published>(folder, c_published_filters);
           }}};
}

}  // namespace halfway::vectors
