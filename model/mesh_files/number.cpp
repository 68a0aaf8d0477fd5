// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/number.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>

namespace halfway {

namespace {

/// Digits that always fit into 64 bits.
constexpr int c_kept_digits = 19;
/// Doubles represent these integers and powers of ten exactly, so one operation on them rounds once.
constexpr std::uint64_t c_exact_integers = std::uint64_t{1} << 53;
constexpr double c_powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
/// Beyond this exponent every number of at most 4 GiB of digits is zero or too large.
constexpr std::int64_t c_last_exponent = std::int64_t{1} << 40;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// True for the spellings of NaN and infinity, also those of old C libraries: 1.#IND00, nan(ind).
bool is_not_finite(std::string_view word) {
  std::string text = lower_case(word.substr(0, 9));
  if (text.starts_with('+') || text.starts_with('-')) text.erase(0, 1);
  return text == "nan" || text == "inf" || text == "infinity" || text.starts_with("nan(") ||
         text.starts_with("1.#");
}

/// Round decimal digits times a power of ten to double. strtod rounds correctly, but its decimal point
/// depends on the locale, so the text has none.
double rounded(std::string_view mantissa, std::int64_t exponent) {
  std::string text;
  for (const char c : mantissa) {
    if (is_digit(c)) text += c;
  }
  text += 'e' + std::to_string(exponent);
  return std::strtod(text.c_str(), nullptr);
}

}  // namespace

NumberFault read_number(std::string_view word, double& value) {
  // Read the sign and the mantissa: the number is digits times 10^exponent.
  const std::string_view whole = word;
  const bool is_negative = word.starts_with('-');
  if (is_negative || word.starts_with('+')) word.remove_prefix(1);
  std::uint64_t digits = 0;
  std::int64_t fraction_digits = 0;
  int significant = 0;
  bool any = false, point = false;
  std::size_t at = 0;
  for (; at < word.size(); ++at) {
    const char c = word[at];
    if (c == '.' && !point) {
      point = true;
      continue;
    }
    if (!is_digit(c)) break;
    any = true;
    fraction_digits += point ? 1 : 0;
    if (significant > 0 || c != '0') ++significant;
    if (significant <= c_kept_digits) digits = 10 * digits + static_cast<std::uint64_t>(c - '0');
    significant = std::min(significant, c_kept_digits + 1);
  }
  if (!any) return is_not_finite(whole) ? NumberFault::not_finite : NumberFault::not_a_number;
  const std::string_view mantissa = word.substr(0, at);

  // Read the exponent.
  std::int64_t exponent = 0;
  if (at < word.size()) {
    if (word[at] != 'e' && word[at] != 'E')
      return is_not_finite(whole) ? NumberFault::not_finite : NumberFault::not_a_number;
    ++at;
    const bool is_divisor = at < word.size() && word[at] == '-';
    if (is_divisor || (at < word.size() && word[at] == '+')) ++at;
    if (at == word.size()) return NumberFault::not_a_number;
    for (; at < word.size(); ++at) {
      if (!is_digit(word[at])) return NumberFault::not_a_number;
      exponent = std::min(10 * exponent + (word[at] - '0'), c_last_exponent);
    }
    if (is_divisor) exponent = -exponent;
  }
  exponent -= fraction_digits;

  // Usually one operation gives the nearest double.
  constexpr auto c_last_power = static_cast<std::int64_t>(std::size(c_powers_of_ten)) - 1;
  if (significant == 0) {
    value = 0.0;
  } else if (significant <= c_kept_digits && digits <= c_exact_integers &&
             std::abs(exponent) <= c_last_power) {
    const double power = c_powers_of_ten[static_cast<std::size_t>(std::abs(exponent))];
    const auto integer = static_cast<double>(digits);
    value = exponent < 0 ? integer / power : integer * power;
  } else {
    value = rounded(mantissa, exponent);
  }
  if (is_negative) value = -value;
  return is_in_float_range(value) ? NumberFault::none : NumberFault::too_large;
}

std::string fault_text(NumberFault fault, std::string_view word) {
  switch (fault) {
    case NumberFault::none:
      break;
    case NumberFault::not_a_number:
      return quoted(word) + " is not a number";
    case NumberFault::not_finite:
      return quoted(word) + " is not finite";
    case NumberFault::too_large:
      return quoted(word) + " is too large";
  }
  return {};
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t c_longest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, c_longest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > c_longest ? "...'" : "'");
}

}  // namespace halfway
