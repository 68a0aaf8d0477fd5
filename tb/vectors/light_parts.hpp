// SPDX-License-Identifier: Apache-2.0
// Random words for the parts of a line record that belong to a light.
#pragma once

#include <cstdint>
#include <type_traits>

#include "vectors/random.hpp"
#include "vectors/triangles.hpp"
#include "words/formats.hpp"

namespace halfway::vectors {

/// Colour terms, a few of which add up to white, for `terms` terms per pixel. Some are random words.
inline void put_colour(InitVector& vector, const words::Field& field, Random& random, int terms, int low) {
  const std::int64_t most = (std::int64_t{300} << field.fraction_bits) / terms;
  const auto word =
      random.one_in(8) ? random.word(field.bits) : static_cast<std::uint64_t>(random.between(0, most));
  set_bits(vector, field, word, low);
}

/// An angle around the ends of the bell that changes a little per pixel. Some are random words with any
/// slope.
template <class At>
void put_angle(InitVector& vector, Random& random, int low) {
  if (random.one_in(8)) {
    set_bits(vector, At::angle, random.word(At::angle.bits), low);
    set_bits(vector, At::slope, random.word(At::slope.bits), low);
    return;
  }
  const std::int64_t one = std::int64_t{1} << At::angle.fraction_bits;
  const auto angle = random.between(-one * 5 / 4, one * 5 / 4);
  // Sometimes the second pixel is at the end of a table's cell: a wrong low bit changes its sample.
  const std::int64_t cell = one / 16, next = (angle / cell + random.between(0, 1)) * cell;
  const std::int64_t slope =
      random.one_in(8) ? next - angle - random.between(0, 1) : random.between(-one / 12, one / 12);
  set_bits(vector, At::angle, angle, low);
  set_bits(vector, At::slope, slope, low);
}

/// The diffuse part of a light at bit `low`. `terms` as in put_colour.
template <class Preset>
void put_diffuse_part(InitVector& vector, Random& random, int channels, int terms, int low) {
  put_angle<typename Preset::diffuse_header_at>(vector, random, low);
  for (int c = 0; c < channels; ++c)
    put_colour(vector, Preset::diffuse_channel_at::factor, random, terms,
               low + Preset::c_diffuse_header_bits + c * Preset::c_diffuse_channel_bits);
}

/// The specular part of a light. One of six has any power, with or without a table.
template <class Preset>
void put_specular_part(InitVector& vector, Random& random, int channels, int terms, int low) {
  put_angle<typename Preset::specular_header_at>(vector, random, low);
  if constexpr (std::is_same_v<Preset, words::Exact>) {
    const auto power = random.one_in(6) ? random.bits(Preset::c_power_bits)
                                        : static_cast<std::uint64_t>(random.between(0, 4));
    set_bits(vector, Preset::specular_header_at::power, power, low);
  }
  for (int c = 0; c < channels; ++c)
    put_colour(vector, Preset::specular_channel_at::factor, random, terms,
               low + Preset::c_specular_header_bits + c * Preset::c_specular_channel_bits);
}

}  // namespace halfway::vectors
