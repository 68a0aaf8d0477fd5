// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/specular_slice.vhd: the output of each stage for the current angle's
// pixel.
#pragma once

#include <array>
#include <bit>
#include <type_traits>

#include "golden/angle_address.hpp"
#include "golden/cosine_rom.hpp"
#include "golden/line_interpolator.hpp"
#include "golden/multiplier.hpp"

namespace halfway::golden {

template <class Preset>
class SpecularSlice {
 public:
  using Angle = Word<Preset::c_angle_bits>;

  SpecularSlice() = default;
  /// Bit i of `powers`: the table of cosine to the power 2^i exists.
  SpecularSlice(int channels, unsigned powers, const CosineSize& size,
                std::span<const CosineTable> tables = c_cosine_tables)
      : channels_(channels), size_(size) {
    for (std::size_t i = 0; i < roms_.size(); ++i)
      if ((powers >> i & 1U) != 0) roms_[i] = CosineRom(std::is_same_v<Preset, Exact>, 1 << i, size, tables);
    // With one table no selection is needed.
    selects_ = std::popcount(powers) != 1;
    if (!selects_) selected_ = roms_[static_cast<std::size_t>(std::countr_zero(powers))];
  }

  /// `low`: lowest bit of the slice's block in the line record.
  void span_load(std::span<const std::uint32_t> record, int low) {
    using At = typename Preset::specular_header_at;
    angle_.load(Angle::from_bits(get_bits(record, At::angle, low)));
    slope_ = Angle::from_bits(get_bits(record, At::slope, low));
    if constexpr (std::is_same_v<Preset, Exact>) {
      if (selects_) {
        const auto power = static_cast<std::size_t>(get_bits(record, At::power, low));
        selected_ = power < roms_.size() ? roms_[power] : CosineRom();
      }
    }
    for (int c = 0; c < channels_; ++c)
      factors_[static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(
          get_bits(record, Preset::specular_channel_at::factor,
                   low + Preset::c_specular_header_bits + c * Preset::c_specular_channel_bits));
  }
  void span_step() { angle_.step(slope_); }

  Angle angle() const { return angle_.value(); }
  /// True if the angle is within the bell and, given by `lit`, the light is above the horizon.
  bool in_range(bool lit) const { return lit && place().in_range; }
  std::uint32_t sample() const { return selected_.sample(place().address); }
  std::uint64_t product(int channel, bool lit) const { return product(channel, gated_sample(lit)); }

  /// Input of the multipliers: the sample, or zero if not in_range.
  std::uint32_t gated_sample(bool lit) const {
    const AngleAddress at = place();
    return lit && at.in_range ? selected_.sample(at.address) : 0;
  }
  std::uint64_t product(int channel, std::uint32_t gated_sample) const {
    return multiply(gated_sample, factors_[static_cast<std::size_t>(channel)]);
  }

 private:
  AngleAddress place() const { return angle_address<Preset>(angle(), size_); }

  int channels_ = 0;
  CosineSize size_;
  bool selects_ = false;
  std::array<CosineRom, 5> roms_;
  CosineRom selected_;
  LineInterpolator<Preset::c_angle_bits> angle_;
  Angle slope_;
  std::array<std::uint32_t, 3> factors_{};
};

}  // namespace halfway::golden
