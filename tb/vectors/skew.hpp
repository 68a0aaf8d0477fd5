// SPDX-License-Identifier: Apache-2.0
// Skewed words (rtl/interpolation/skew_pkg.vhd).
#pragma once

#include <cstdint>
#include <vector>

namespace halfway::vectors {

/// Skews a word that changes every clock: part p is that of the word p clocks ago.
class Skew {
 public:
  Skew(int bits, int parts) : bits_(bits), history_(static_cast<std::size_t>(parts)) {}

  /// Takes the word of this clock. Call it once per clock.
  std::uint64_t operator()(std::uint64_t word) {
    history_.insert(history_.begin(), word);
    history_.pop_back();
    std::uint64_t skewed = 0;
    const int parts = static_cast<int>(history_.size());
    for (int part = 0; part < parts; ++part) {
      const int low = part * bits_ / parts, high = (part + 1) * bits_ / parts;
      const std::uint64_t mask = (std::uint64_t{1} << high) - (std::uint64_t{1} << low);
      skewed |= history_[part] & mask;
    }
    return skewed;
  }

 private:
  int bits_;
  std::vector<std::uint64_t> history_;
};

}  // namespace halfway::vectors
