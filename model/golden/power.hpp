// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/power.vhd.
#pragma once

#include <algorithm>
#include <bit>

#include "golden/function_rom.hpp"
#include "golden/words.hpp"

namespace halfway::golden {

template <class Preset>
class Power {
 public:
  static constexpr int c_base_fraction = Preset::c_direction_fraction_bits;
  static constexpr std::uint32_t c_one = std::uint32_t{1} << c_base_fraction;
  /// Fraction bits of -log2(base). Its whole part is the number of leading zeros, its fraction comes from the
  /// table.
  static constexpr int c_loss_fraction = function_table<Preset>(Function::logarithm).fraction_bits;
  /// Fraction bits of exponent times -log2(base), from which the power of two is computed.
  static constexpr int c_decay_fraction = std::min(c_loss_fraction, 20);

  /// base^exponent in format weight. `base` is from 0 to 1 with the fraction bits of direction; `exponent` is
  /// in format exponent. 0 for base 0.
  static constexpr std::uint32_t power(std::uint32_t base, std::uint32_t exponent) {
    if (base == 0) return 0;
    return decayed((std::uint64_t{loss(base)} * exponent) >>
                   (c_loss_fraction + Preset::c_exponent_fraction_bits - c_decay_fraction));
  }

  /// -log2(base), base > 0.
  static constexpr std::uint32_t loss(std::uint32_t base) {
    if (base == c_one) return 0;
    const auto lead = static_cast<std::uint32_t>(c_base_fraction + 1 - std::bit_width(base));
    const auto mantissa = static_cast<std::uint32_t>(low_bits(base << lead, c_base_fraction));
    return (lead << c_loss_fraction) - interpolated(Function::logarithm, mantissa, c_base_fraction, 1);
  }

  /// 2^-exponent in format weight, rounded half up.
  static constexpr std::uint32_t decayed(std::uint64_t exponent) {
    // The table's first entry is the value at the middle of its cell, not at 0.
    if (exponent == 0) return std::uint32_t{1} << Preset::c_weight_fraction_bits;
    const std::uint64_t whole = exponent >> c_decay_fraction;
    const auto rest = static_cast<std::uint32_t>(low_bits(exponent, c_decay_fraction));
    const std::uint32_t value = interpolated(Function::decay, rest, c_decay_fraction, -1) << c_guard_below;
    const std::uint32_t shifted = whole >= 32 ? 0 : value >> whole;
    return (shifted + (1U << (c_guard - 1))) >> c_guard;
  }

 private:
  // Guard bits of the shifted value below a weight.
  static constexpr int c_guard = 2;
  static constexpr int c_guard_below =
      Preset::c_weight_fraction_bits + c_guard - function_table<Preset>(Function::decay).fraction_bits;

  // The upper bits of `position` select the cell. With slopes the other bits interpolate in it.
  static constexpr std::uint32_t interpolated(Function function, std::uint32_t position, int position_bits,
                                              int sign) {
    const FunctionTable& table = function_table<Preset>(function);
    const int rest_bits = position_bits - table.cell_bits;
    const auto [value, slope] = function_rom<Preset>(function, position >> rest_bits);
    const auto rest = low_bits(position, rest_bits);
    const auto part = static_cast<std::uint32_t>((slope * rest) >> rest_bits);
    return sign > 0 ? value + part : value - part;
  }
};

}  // namespace halfway::golden
