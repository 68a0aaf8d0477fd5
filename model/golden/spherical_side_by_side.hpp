// SPDX-License-Identifier: Apache-2.0
// Four pixels of a span in one vector: what the spherical shader's depth, slices and sums give for each, for
// speed where no register is watched.
#pragma once

#include <cstring>
#include <type_traits>

#include "golden/diffuse_slice.hpp"
#include "golden/four_words.hpp"
#include "golden/specular_slice.hpp"

namespace halfway::golden {

/// A word that a line interpolator steps, at four pixels in a row; kept at the top of 64 bits as Word is.
template <int W>
class FourSteps {
 public:
  FourSteps(Word<W> start, Word<W> slope) : step_(aligned(slope) << 2) {
    const FourWords one = FourWords{} + aligned(slope), two = one << 1;
    constexpr std::uint64_t x = ~std::uint64_t{0};
    value_ = aligned(start) + (one & FourWords{0, x, 0, x}) + (two & FourWords{0, 0, x, x});
  }
  /// On to the next four.
  void step() { value_ += step_; }
  const FourWords& aligned() const { return value_; }

 private:
  static std::uint64_t aligned(Word<W> word) { return word.bits() << (64 - W); }
  FourWords value_;
  std::uint64_t step_;
};

/// Four pixels' sums, one a channel.
struct alignas(32) FourSums {
  FourWords channel[3];
};

/// Four angle_addresses; in_range as all ones or zeros.
struct FourAddresses {
  FourWords address, in_range;
};

template <class Preset>
[[gnu::always_inline]] inline FourAddresses angle_addresses(const FourWords& angle, int address_bits) {
  constexpr int c_bits = Preset::c_angle_bits;
  if constexpr (std::is_same_v<Preset, Exact>) {
    constexpr int c_fraction = Preset::c_angle_fraction_bits;
    const auto sign = (FourWords)((FourSigned)angle < 0);
    const FourWords magnitude = (angle ^ sign) >> (64 - c_bits);
    constexpr std::uint64_t c_mask = (std::uint64_t{1} << c_fraction) - 1;
    return {(magnitude & c_mask) >> static_cast<std::uint64_t>(c_fraction - address_bits),
            (FourWords)(magnitude <= c_mask)};
  } else {
    return {angle >> static_cast<std::uint64_t>(64 - address_bits), ~FourWords{}};
  }
}

[[gnu::always_inline]] inline FourWords samples(const CosineRom& rom, const FourWords& address) {
  if (rom.empty()) return FourWords{};
  const auto at = [&](int i) { return std::uint64_t{rom.sample(static_cast<std::uint32_t>(address[i]))}; };
  return FourWords{at(0), at(1), at(2), at(3)};
}

/// One light's two slices over a span.
template <class Preset>
class FourLit {
 public:
  FourLit(const DiffuseSlice<Preset>& diffuse, const SpecularSlice<Preset>& specular)
      : diffuse_(diffuse),
        specular_(specular),
        diffuse_angle_(diffuse.angle(), diffuse.slope()),
        specular_angle_(specular.angle(), specular.slope()) {}

  /// Adds to four pixels' sums, one a channel, what the light gives them.
  template <int Channels, bool Coloured>
  void add_to(FourWords* sums) const {
    const auto diffuse = angle_addresses<Preset>(diffuse_angle_.aligned(), diffuse_.address_bits());
    const auto specular = angle_addresses<Preset>(specular_angle_.aligned(), specular_.address_bits());
    const FourWords cosine = samples(diffuse_.rom(), diffuse.address) & diffuse.in_range;
    const FourWords highlight =
        samples(specular_.rom(), specular.address) & specular.in_range & diffuse.in_range;
    for (int c = 0; c < Channels; ++c)
      sums[c] += cosine * diffuse_.factor(c) + highlight * specular_.factor(Coloured ? c : 0);
  }
  void step() {
    diffuse_angle_.step();
    specular_angle_.step();
  }

 private:
  const DiffuseSlice<Preset>& diffuse_;
  const SpecularSlice<Preset>& specular_;
  FourSteps<Preset::c_angle_bits> diffuse_angle_, specular_angle_;
};

/// Fragments of four pixels from x on, `step` apart, with these depths and sums; all four are written.
template <class Preset, int Channels>
void put_pixels(const Fragment& line, std::uint64_t x, std::uint64_t step, const FourWords& depth,
                const FourWords* sums, int data_bits, Fragment* out) {
  const auto colour = [&](int channel) __attribute__((always_inline)) {
    constexpr std::uint64_t c_most = (std::uint64_t{1} << Preset::c_colour_bits) - 1;
    const FourWords whole = sums[Channels == 3 ? channel : 0] >>
                            static_cast<std::uint64_t>(Preset::c_factor_fraction_bits + data_bits);
    return whole > c_most ? FourWords{} + c_most : whole;
  };
  const auto low_mask = [](int bits) { return (std::uint64_t{1} << bits) - 1; };
  const FourWords z = depth >> (64 - Preset::c_depth_sum_bits + Preset::c_depth_sum_fraction_bits) &
                      low_mask(Preset::c_depth_bits);
  const FourWords place = (x + step * FourWords{0, 1, 2, 3}) & low_mask(Preset::c_pixel_x_bits);
  const FourWords a = z << 32 | line.triangle;
  const FourWords b = place << 16 | colour(0) << 32 | colour(1) << 40 | colour(2) << 48 | line.y;
  const FourWords halves[2] = {__builtin_shufflevector(a, b, 0, 4, 1, 5),
                               __builtin_shufflevector(a, b, 2, 6, 3, 7)};
  std::memcpy(static_cast<void*>(out), halves, sizeof halves);
}

}  // namespace halfway::golden
