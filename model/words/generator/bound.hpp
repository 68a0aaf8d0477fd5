// SPDX-License-Identifier: Apache-2.0
// A worst case that a format or table states for its words, and the formula from which it is derived.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace halfway::tables {

struct Bound {
  enum class Kind {
    range,  ///< exact integers: the largest magnitude
    error   ///< greatest difference of a word from the value that it represents
  };
  Kind kind;
  std::string_view of;          ///< distinguishes an entry's bounds; empty if it has only one
  double value;                 ///< in `unit`
  std::string_view unit;        ///< empty: the unit of the values
  std::string_view derivation;  ///< a formula whose result is `value` or slightly less
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

/// Evaluates a formula of numbers, named quantities, + - * / ^, brackets and sqrt. Throws std::logic_error
/// for other text.
double evaluated(std::string_view formula, std::span<const Quantity> quantities);

/// "0.15", or a power of two such as "2^-11" if that is shorter.
std::string shown(double value);

/// "power: off by at most 2^-15 + m * 2^-23 = 0.00101"
std::string to_string(const Bound& bound);

}  // namespace halfway::tables
