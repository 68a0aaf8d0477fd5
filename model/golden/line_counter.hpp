// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/raster/line_counter.vhd.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>

#include "golden/words.hpp"

namespace halfway::golden {

/// The lines of one triangle, without timing.
template <class Preset>
class LineCounter {
 public:
  using At = typename Preset::init_header_at;

  void load(std::span<const std::uint32_t> init) {
    const auto word = [&](const Field& field) { return static_cast<std::uint32_t>(get_bits(init, field)); };
    triangle_ = word(At::triangle);
    y_ = word(At::y);
    remaining_ = word(At::upper_lines);
    if constexpr (std::is_same_v<Preset, Exact>) lower_lines_ = word(At::lower_lines);
  }
  /// Advances to the next line. Sums wrap: zero upper lines count as 2**bits.
  void step() {
    y_ = static_cast<std::uint32_t>(low_bits(y_ + 1, Preset::c_pixel_y_bits));
    if (section_last()) {
      remaining_ = lower_lines_;
      lower_lines_ = 0;
    } else {
      remaining_ = static_cast<std::uint32_t>(low_bits(remaining_ - 1, Preset::c_lines_bits));
    }
  }

  std::uint32_t triangle() const { return triangle_; }
  std::uint32_t y() const { return y_; }
  /// True for the last line of a section, or of the triangle.
  bool section_last() const { return remaining_ == 1; }
  bool last() const { return section_last() && lower_lines_ == 0; }

 private:
  std::uint32_t triangle_ = 0, y_ = 0;
  std::uint32_t remaining_ = 0;    ///< lines of this section, this line included
  std::uint32_t lower_lines_ = 0;  ///< lines of the next section
};

}  // namespace halfway::golden
