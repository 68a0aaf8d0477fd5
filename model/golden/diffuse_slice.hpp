// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/diffuse_slice.vhd: the output of each stage for the current angle's pixel.
#pragma once

#include <array>
#include <type_traits>

#include "golden/angle_address.hpp"
#include "golden/cosine_rom.hpp"
#include "golden/line_interpolator.hpp"
#include "golden/multiplier.hpp"

namespace halfway::golden {

template <class Preset>
class DiffuseSlice {
 public:
  using Angle = Word<Preset::c_angle_bits>;

  DiffuseSlice() = default;
  /// `channels` 0: without factor and table, only the light's horizon.
  DiffuseSlice(int channels, const CosineSize& size, std::span<const CosineTable> tables = c_cosine_tables)
      : channels_(channels), size_(size) {
    if (channels > 0) rom_ = CosineRom(std::is_same_v<Preset, Exact>, 1, size, tables);
  }

  /// `low`: lowest bit of the slice's block in the line record.
  void span_load(std::span<const std::uint32_t> record, int low) {
    using At = typename Preset::diffuse_header_at;
    angle_.load(Angle::from_bits(get_bits(record, At::angle, low)));
    slope_ = Angle::from_bits(get_bits(record, At::slope, low));
    for (int c = 0; c < channels_; ++c)
      factors_[static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(
          get_bits(record, Preset::diffuse_channel_at::factor,
                   low + Preset::c_diffuse_header_bits + c * Preset::c_diffuse_channel_bits));
  }
  void span_step() { angle_.step(slope_); }

  Angle angle() const { return angle_.value(); }
  /// True if the light is above the pixel's horizon.
  bool lit() const { return place().in_range; }
  std::uint32_t sample() const { return rom_.sample(place().address); }
  std::uint64_t product(int channel) const { return product(channel, gated_sample()); }

  /// Input of the multipliers: the sample, or zero outside the bell.
  std::uint32_t gated_sample() const {
    const AngleAddress at = place();
    return at.in_range ? rom_.sample(at.address) : 0;
  }
  std::uint64_t product(int channel, std::uint32_t gated_sample) const {
    return multiply(gated_sample, factors_[static_cast<std::size_t>(channel)]);
  }

 private:
  AngleAddress place() const { return angle_address<Preset>(angle(), size_); }

  int channels_ = 0;
  CosineSize size_;
  CosineRom rom_;
  LineInterpolator<Preset::c_angle_bits> angle_;
  Angle slope_;
  std::array<std::uint32_t, 3> factors_{};
};

}  // namespace halfway::golden
