// SPDX-License-Identifier: Apache-2.0
// Random strips for the filter. Files for each case: _in, weight and token in one word, then token, weight
// and background for the netlist of tb/mutants; _out, fragments; _ends, for each fragment the number of the
// token that ends its pixel.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
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
// The first two backgrounds differ in all bits.
constexpr FilterCase c_exact_filters[] = {{3, 16, golden::c_filter_weights, {0x11, 0xC8, 0xFF}},
                                          {3, 16, golden::c_filter_weights, {0xEE, 0x37, 0}},
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
        case_(c),
        background_(c.background[0] | c.background[1] << 8 | c.background[2] << 16),
        random_(static_cast<std::uint64_t>(c.channels + c.subpixels + background_)),
        twin_(c.channels, c.subpixels, c.background, c.weights) {
    for (std::size_t i = 0; i < 3; ++i) outside_[i] = subpixels_ * behind(i);
  }

  void add_strip(int number) {
    const auto lines = random_.between(1, 7), columns = random_.one_in(20) ? 130 : random_.between(1, 24);
    // In turn, the first line or the first column is a power of two.
    const std::int64_t power = std::int64_t{1} << number / 2 % 12, last_y = 4096 - lines,
                       last_x = 4096 - columns;
    const auto y = number % 2 == 0 ? std::min(power, last_y) : first_of(last_y),
               x = number % 2 == 1 ? std::min(power, last_x) : first_of(last_x);
    depth_ = random_.bits(Preset::c_depth_bits);
    const int kind = static_cast<int>(random_.between(0, 3));  // lone pixels, all covered, mixed, empty
    std::vector<Sums> above(static_cast<std::size_t>(columns + 1), outside_);
    for (std::int64_t line = 0; line < lines; ++line) {
      const bool empty = kind == 3 || random_.one_in(4);
      std::vector<Sums> sums{outside_};  // of the column to the left, then of the line's
      for (std::int64_t column = 0; column < columns; ++column) {
        // The first pixel of a strip starts a line with either command.
        add_head(column == 0 && (line > 0 || random_.one_in(2)), y + line, x + column);
        const Sums support[] = {sums.back(), above[sums.size()], above[sums.size() - 1]};
        sums.push_back(outside_);
        if (kind == 1 || (!empty && random_.one_in(kind == 0 ? 12 : 2)))
          add_objects(kind == 1, sums.back(), support);
        if (random_.one_in(20)) add_ignored();
      }
      above = sums;
    }
    add(any_token(Command::new_frame), any_weight());
    if (random_.one_in(3)) add_ignored();
    // Objects outside a strip are ignored, whatever their weights.
    for (auto n = random_.between(0, 3); n > 0; --n) add(any_token(Command::new_object), any_weight());
    if (random_.one_in(3)) add(any_token(Command::new_frame), any_weight());
  }
  void write(const Folder& folder) const {
    const std::string stem = fmt::format("{}_{}_{}_{}_{:06X}", Preset::c_name, case_.channels, subpixels_,
                                         fmt::join(case_.weights, "_"), background_);
    in_.write(folder / (stem + "_in.txt"));
    out_.write(folder / (stem + "_out.txt"));
    ends_.write(folder / (stem + "_ends.txt"));
  }

 private:
  using Token = golden::ShadingToken<Preset>;
  using Sums = std::array<std::int64_t, 3>;  // of a pixel's subpixels, per channel

  static constexpr int c_fraction = Preset::c_radiance_fraction_bits;
  static constexpr std::int64_t c_half = (std::int64_t{1} << c_fraction) / 2,
                                c_white = (std::int64_t{255} << c_fraction) + c_half;

  std::int64_t behind(std::size_t channel) const {
    return (std::int64_t{case_.background[channel]} << c_fraction) + c_half;
  }
  std::int64_t first_of(std::int64_t last) {
    const std::int64_t firsts[] = {0, last, random_.between(0, last)};
    return firsts[random_.between(0, 2)];
  }
  // Depths of a strip are often equal, or equal down to any bit.
  std::uint64_t any_depth() {
    if (random_.one_in(3)) return random_.word(Preset::c_depth_bits);
    const auto lower = random_.between(0, random_.one_in(2) ? 2 : Preset::c_depth_bits);
    return depth_ ^ random_.bits(static_cast<int>(lower));
  }
  std::uint32_t any_weight() { return static_cast<std::uint32_t>(random_.bits(weight_bits_)); }
  // Fields that are not used are random.
  Token any_token(Command command) {
    Token token;
    token.command = command;
    token.triangle = static_cast<std::uint32_t>(random_.bits(32));
    token.z = static_cast<std::uint32_t>(any_depth());
    token.y = static_cast<std::uint32_t>(random_.bits(12));
    token.x = static_cast<std::uint32_t>(random_.bits(12));
    for (std::uint32_t& word : token.radiance) {
      word = static_cast<std::uint32_t>(random_.word(Preset::c_radiance_bits));
      if (c_fraction > 0 && random_.one_in(3))  // close to white
        word = static_cast<std::uint32_t>((255 << c_fraction) + random_.between(-2, 1 << c_fraction));
    }
    return token;
  }
  // A colour with which the sum over the support is at the limit between two colours, or just below. `sum` is
  // that without the difference between this object and the background.
  std::uint32_t tied(std::size_t channel, std::int64_t weight, std::int64_t sum) {
    std::int64_t step = 0, share = weight * case_.weights[0];
    for (const std::int64_t w : case_.weights) step += w * subpixels_ << c_fraction;
    const auto colour = random_.between(0, c_white);
    sum += share * (colour - behind(channel)) + (c_fraction > 0 ? 0 : step / 2);
    return static_cast<std::uint32_t>(
        std::clamp(colour - sum % step / share - random_.between(0, 1), std::int64_t{0}, c_white));
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
  // `sums` are of this pixel, `support` of the left one, the one above and the one above left.
  void add_objects(bool all, Sums& sums, std::span<const Sums, 3> support) {
    const std::int64_t covered = all ? subpixels_ : random_.between(1, subpixels_);
    for (std::int64_t rest = covered; rest > 0;) {
      const std::int64_t weight = random_.one_in(3) ? rest : random_.between(1, rest);
      rest -= weight;
      Token object = any_token(Command::new_object);
      for (std::size_t i = 0; i < 3; ++i) {
        if (rest == 0 && !random_.one_in(4)) {
          std::int64_t sum = case_.weights[0] * sums[i];
          for (std::size_t n = 0; n < 3; ++n) sum += case_.weights[n + 1] * support[n][i];
          object.radiance[i] = tied(i, weight, sum);
        }
        sums[i] += weight * (std::min<std::int64_t>(object.radiance[i], c_white) - behind(i));
      }
      add(object, static_cast<std::uint32_t>(weight));
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
  FilterCase case_;
  int background_;
  Random random_;
  Sums outside_;
  std::uint64_t depth_ = 0;  ///< of the objects of a strip, but for some
  golden::PixelFilter<Preset> twin_;
  VectorFile in_, out_, ends_;
};

template <class Preset>
void write_filters(const Folder& folder, std::span<const FilterCase> cases) {
  for (const FilterCase& c : cases) {
    FilterFiles<Preset> files(c);
    for (int i = 0; i < 30; ++i) files.add_strip(i);
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
