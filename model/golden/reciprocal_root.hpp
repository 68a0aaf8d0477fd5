// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/reciprocal_root.vhd.
#pragma once

#include "golden/function_rom.hpp"

namespace halfway::golden {

template <class Preset>
class ReciprocalRoot {
 public:
  static constexpr int c_fraction_bits = Preset::c_root_fraction_bits;
  /// Bits of the result. Below 1/2 the root of four times the square is used and doubled.
  static constexpr int c_bits = Preset::c_root_bits + 1;

  /// 1/sqrt(x) in format root; x is in format square and from 1 to 4. The result is finite for 0 too.
  static constexpr std::uint32_t root(std::uint32_t x) {
    const std::uint32_t entry = function_rom<Preset>(Function::reciprocal_root, address(x)).value;
    if constexpr (!c_newton) {
      return entry;
    } else {
      // entry (3 - x entry^2) / 2
      const std::uint64_t x_cut = x >> (c_square - c_x_fraction);
      const std::uint64_t product = x_cut * (std::uint64_t{entry} * entry);
      constexpr int c_product_fraction = c_x_fraction + 2 * c_entry;
      const std::uint64_t rest = ((c_three << (c_product_fraction - c_rest_fraction)) - product) >>
                                 (c_product_fraction - c_rest_fraction);
      return static_cast<std::uint32_t>((entry * rest) >> (c_entry + c_rest_fraction + 1 - c_fraction_bits));
    }
  }
  /// 1/sqrt(square); the square is in its format and from 1/4 to 4.
  static constexpr std::uint32_t reciprocal(std::uint32_t square) {
    return square < c_one ? root(square << 2) << 1 : root(square);
  }

  /// The table's cell. The ranges 1 to 2 and 2 to 4 have the same number of cells.
  static constexpr std::uint32_t address(std::uint32_t x) {
    const int bits = function_table<Preset>(Function::reciprocal_root).cell_bits - 1;
    const std::uint32_t cells = std::uint32_t{1} << bits;
    if (x < 2 * c_one) return (x >> (c_square - bits)) & (cells - 1);
    return cells + ((x >> (c_square + 1 - bits)) & (cells - 1));
  }

 private:
  static constexpr bool c_newton = Preset::c_root_fraction_bits > Preset::c_root_entry_fraction_bits;
  static constexpr int c_square = Preset::c_square_fraction_bits;
  static constexpr int c_entry = Preset::c_root_entry_fraction_bits;
  static constexpr std::uint32_t c_one = std::uint32_t{1} << c_square;
  // Fraction bits of the Newton step's x and of 3 - x entry^2.
  static constexpr int c_x_fraction = 22, c_rest_fraction = 23;
  // The result of the step is too small by up to 3/2 of the entry's squared error. Add half of that.
  static constexpr std::uint64_t c_three =
      (std::uint64_t{3} << c_rest_fraction) +
      (std::is_same_v<Preset, Exact> ? c_exact_root_raise : c_published_root_raise);
};

}  // namespace halfway::golden
