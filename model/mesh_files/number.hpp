// SPDX-License-Identifier: Apache-2.0
// Decimal numbers and words of mesh files.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

namespace halfway {

enum class NumberFault { none, not_a_number, not_finite, too_large };

/// Read a whole word as a decimal number: an optional sign, digits with at most one point before, between or
/// after them, and an optional exponent. The value is the nearest double, ties to even; too small numbers
/// give zero. A number beyond the range of float is too large. It does not depend on the locale.
NumberFault read_number(std::string_view word, double& value);

/// True if the nearest float is finite: products of some coordinates are then in the range of double. Half a
/// unit above the largest float, the nearest float is infinite.
inline bool is_in_float_range(double value) {
  return std::abs(value) < 0x1.ffffffp127;
}

/// The fault as the end of a message: "'x' is not a number".
std::string fault_text(NumberFault fault, std::string_view word);

/// The text with the letters A to Z as a to z. It does not depend on the locale.
std::string lower_case(std::string_view text);

/// A word in quotes for a message, shortened and printable, because damaged files contain any bytes.
std::string quoted(std::string_view word);

}  // namespace halfway
