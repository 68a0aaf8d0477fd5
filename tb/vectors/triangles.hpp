// SPDX-License-Identifier: Apache-2.0
// Random triangles as init vectors, the golden walker's output for them, and the clocks of the hardware.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "frame/fragment.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/walker_clock.hpp"
#include "setup/walk.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {

using golden::WalkerClock;
using InitVector = std::vector<std::uint32_t>;

/// `bits` random bits; the bits above are zero.
InitVector random_vector(Random& random, int bits);

/// Walks of one random triangle: ordinary, sliver, one pixel, one horizontal side, subdivided or cut by the
/// frame.
Walks random_walks(Random& random);

/// Writes the walk to the header of `init`. Other bits do not change.
void put_walk(InitVector& init, const Walk& walk);

/// One line of the walker.
struct WalkedLine {
  std::uint32_t triangle, y;
  golden::SpanXWord start, stop;
  bool backward, last, carry;
  std::int64_t pixels() const {
    const std::int64_t count = backward ? start.value() - stop.value() : stop.value() - start.value();
    return count < 0 ? 0 : count;
  }
};

template <class Preset>
std::vector<WalkedLine> walk_lines(const InitVector& init) {
  golden::TriangleWalker<Preset> walker;
  walker.line_load(init);
  std::vector<WalkedLine> lines;
  for (;;) {
    lines.push_back({walker.triangle(), walker.y(), walker.start(), walker.stop(), walker.backward(),
                     walker.line_last(), walker.carry()});
    if (walker.line_last()) return lines;
    walker.line_step();
  }
}

/// Columns triangle, y, x, z, red, green, blue.
template <class Preset>
VectorFile& add_fragment(VectorFile& file, const Fragment& f) {
  file.word(f.triangle, Preset::c_triangle_bits).word(f.y, Preset::c_pixel_y_bits);
  file.word(f.x, Preset::c_pixel_x_bits).word(f.z, Preset::c_depth_bits);
  for (const std::uint8_t colour : {f.red, f.green, f.blue}) file.word(colour, Preset::c_colour_bits);
  return file;
}

/// Counts the clocks that are lost between triangles whose lines all cover a pixel.
class LostClocks {
 public:
  /// The fragments of a triangle are output from clock `first` on, one per clock, `pixels` in total.
  std::int64_t triangle(std::int64_t first, std::int64_t pixels) {
    const std::int64_t lost = next_ == c_none ? 0 : first - next_;
    next_ = first + pixels;
    return lost;
  }

 private:
  static constexpr std::int64_t c_none = -1;
  std::int64_t next_ = c_none;
};

/// The kind of a set of triangles.
enum class Mix {
  dense,  ///< every line covers a pixel: no clock may be lost
  small,  ///< the same, with at most three pixels
  mixed   ///< with empty lines, and with words that setup never writes
};

template <class Preset>
InitVector random_triangle(Random& random, Mix mix, int init_bits);
template <>
InitVector random_triangle<words::Exact>(Random& random, Mix mix, int init_bits);
template <>
InitVector random_triangle<words::Published>(Random& random, Mix mix, int init_bits);

/// Triangles of approximately `pixels` pixels in total. Header bits that the walker does not read, and all
/// bits after the header, are random.
template <class Preset>
std::vector<InitVector> random_triangles(Random& random, Mix mix, int init_bits, std::int64_t pixels) {
  std::vector<InitVector> set;
  while (pixels > 0) {
    InitVector init = random_triangle<Preset>(random, mix, init_bits);
    std::int64_t covered = 0;
    bool empty = false;
    for (const WalkedLine& line : walk_lines<Preset>(init)) {
      covered += line.pixels();
      empty |= line.pixels() == 0;
    }
    // Long spans of random words are rare: they find no more faults than short ones.
    if (covered > 400 && (mix != Mix::mixed || !random.one_in(40) || covered > pixels)) continue;
    if (mix != Mix::mixed && empty) continue;
    if (mix == Mix::small && covered > 3) continue;
    pixels -= covered + 1;
    set.push_back(std::move(init));
  }
  return set;
}

}  // namespace halfway::vectors
