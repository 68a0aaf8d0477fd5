// SPDX-License-Identifier: Apache-2.0
// Random triangles as init vectors, what the golden walker makes of them, and when the hardware must show it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "golden/triangle_walker.hpp"
#include "golden/walker_clock.hpp"
#include "setup/walk.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {

using golden::WalkerClock;
using InitVector = std::vector<std::uint32_t>;

/// `bits` random bits; those above are zero.
InitVector random_vector(Random& random, int bits);

/// Walks of one random triangle: ordinary, sliver, about a pixel, flat-sided, subdivided or cut by the frame.
std::vector<Walk> random_walks(Random& random);

/// `init` with the walk in its header; its other bits stay.
void put_walk(InitVector& init, const Walk& walk);

/// One line as the walker goes over it.
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

/// The clocks that are lost between triangles of which every line covers a pixel, held against a promise.
class LostClocks {
 public:
  /// A triangle's fragments come out from `first` on, one a clock, `pixels` in all.
  std::int64_t triangle(std::int64_t first, std::int64_t pixels) {
    const std::int64_t lost = next_ == c_none ? 0 : first - next_;
    next_ = first + pixels;
    return lost;
  }

 private:
  static constexpr std::int64_t c_none = -1;
  std::int64_t next_ = c_none;
};

/// What a set of triangles is for.
enum class Mix {
  dense,  ///< every line covers a pixel: not a clock may be lost
  small,  ///< the same, and three pixels at most
  mixed   ///< with empty lines, and with words that setup would never write
};

template <class Preset>
InitVector random_triangle(Random& random, Mix mix, int init_bits);
template <>
InitVector random_triangle<golden::Exact>(Random& random, Mix mix, int init_bits);
template <>
InitVector random_triangle<golden::Published>(Random& random, Mix mix, int init_bits);

/// Triangles of about `pixels` pixels altogether. Header bits that the walker does not read, and all behind
/// the header, are random words.
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
    // Long spans of garbage are rare: they tell no more than short ones.
    if (covered > 400 && (mix != Mix::mixed || !random.one_in(40) || covered > pixels)) continue;
    if (mix != Mix::mixed && empty) continue;
    if (mix == Mix::small && covered > 3) continue;
    pixels -= covered + 1;
    set.push_back(std::move(init));
  }
  return set;
}

}  // namespace halfway::vectors
