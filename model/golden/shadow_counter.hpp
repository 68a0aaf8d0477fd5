// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/shadow_counter.vhd: counts one light's shadow volumes around the surfaces
// of a line.
#pragma once

#include <cstdint>
#include <vector>

#include "golden/words.hpp"

namespace halfway::golden {

class ShadowCounter {
 public:
  ShadowCounter() : counts_(std::size_t{1} << Exact::c_pixel_x_bits) {}

  void clear() {
    if (!counted_) return;
    counts_.assign(counts_.size(), 0);
    counted_ = false;
  }
  /// Counts a shadow polygon at column x, the entry of a volume or its exit. The count is clamped to its
  /// format.
  void count(std::uint32_t x, bool opens) {
    std::int16_t& held = counts_[x];
    counted_ = true;
    if (held == (opens ? c_most : c_least))
      fault_ = true;
    else
      held = static_cast<std::int16_t>(held + (opens ? 1 : -1));
  }
  /// True if the light reaches an object at column x: no volume contains it, including those around the eye.
  /// A negative count is treated as zero: the rounding of depths may place the exit of a thin volume before
  /// its entry. Resets the count of the column.
  bool take(std::uint32_t x, int around_eye) {
    const int around = around_eye + counts_[x];
    counts_[x] = 0;
    return around <= 0;
  }
  /// The count of column x.
  int held(std::uint32_t x) const { return counts_[x]; }
  /// True if a count has exceeded its format.
  bool fault() const { return fault_; }

 private:
  static constexpr int c_most = (1 << (Exact::c_shadow_count_bits - 1)) - 1, c_least = -c_most - 1;

  std::vector<std::int16_t> counts_;
  bool counted_ = false;  ///< since the last clear; false: nothing to clear
  bool fault_ = false;
};

}  // namespace halfway::golden
