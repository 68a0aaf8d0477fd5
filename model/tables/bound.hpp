// SPDX-License-Identifier: Apache-2.0
// The worst case that a format or table states of its words, with the formula that it follows from.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace halfway::tables {

struct Bound {
  enum class Kind {
    range,  ///< whole numbers, held exactly: the largest magnitude that comes
    error   ///< how far a word may be from what it stands for
  };
  Kind kind;
  std::string_view of;          ///< which of an entry's bounds; empty where it has one
  double value;                 ///< in `unit`
  std::string_view unit;        ///< empty: of the values
  std::string_view derivation;  ///< a formula: what `value` is, or is a little more than
};

constexpr Bound at_most(double value, std::string_view derivation) {
  return {Bound::Kind::range, "", value, "", derivation};
}
constexpr Bound off_by(double value, std::string_view unit, std::string_view derivation,
                       std::string_view of = "") {
  return {Bound::Kind::error, of, value, unit, derivation};
}

struct Quantity {
  std::string_view name;
  double value;
};

/// A formula of numbers, named quantities, + - * / ^, brackets and sqrt. Throws std::logic_error where it is
/// none.
double evaluated(std::string_view formula, std::span<const Quantity> quantities);

/// "0.15", or where a power of two says it shorter "2^-11".
std::string shown(double value);

/// "power: off by at most 2^-15 + m * 2^-23 = 0.00101"
std::string to_string(const Bound& bound);

}  // namespace halfway::tables
