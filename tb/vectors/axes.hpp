// SPDX-License-Identifier: Apache-2.0
// Random vectors of three components, and their number.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "golden/vector_shift.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {

// Number of vectors at full speed, and after that with pauses.
inline constexpr int c_running = 3000, c_pausing = 1000;

inline std::int64_t signed_word(Random& random, int bits) {
  return static_cast<std::int64_t>(random.word(bits) << (64 - bits)) >> (64 - bits);
}

// The components have one common magnitude or three, and are often zero.
inline golden::Axes random_axes(Random& random, int bits) {
  golden::Axes v;
  const auto smaller = random.between(0, bits - 1);
  const bool alike = random.one_in(2);
  for (std::int64_t& component : v) component = signed_word(random, bits) >> (alike ? smaller : 0);
  if (random.one_in(8)) v[random.between(0, 2)] = 0;
  if (random.one_in(50)) v = {};
  if (random.one_in(50)) v = {-1, 0, -1};
  return v;
}

template <class Add>
void run(Random& random, const Add& add) {
  for (int i = 0; i < c_running; ++i) add(true);
  for (int i = 0; i < c_pausing; ++i) add(random.one_in(2));
}

/// Two unit vectors of format direction with any cosine, often close to 1; or random words.
template <class Preset>
std::array<golden::Axes, 2> random_directions(Random& random) {
  if (random.one_in(8))
    return {random_axes(random, Preset::c_direction_bits), random_axes(random, Preset::c_direction_bits)};
  constexpr double c_spreads[] = {0.01, 0.1, 0.5, 2};
  std::array<double, 3> base{};
  const auto draw = [&](double spread) {
    std::array<double, 3> v = base;
    for (double& component : v) component += spread * static_cast<double>(random.between(-1000, 1000)) / 1000;
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + 1e-9;
    for (double& component : v) component /= length;
    return v;
  };
  std::array<golden::Axes, 2> directions;
  for (golden::Axes& direction : directions) {
    base = draw(&direction == &directions[0] ? 1 : c_spreads[random.between(0, 3)]);
    for (std::size_t i = 0; i < base.size(); ++i)
      direction[i] = std::lround(std::ldexp(base[i], Preset::c_direction_fraction_bits));
  }
  return directions;
}

}  // namespace halfway::vectors
