// SPDX-License-Identifier: Apache-2.0
// Strict reading of the project's line formats. Exactly one space separates fields. Decimal numbers have no
// sign, space or leading zero. Every content therefore has exactly one spelling.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace halfway {

/// Remove the next field and the space after it from the front of `line`. In an invalid line a field may be
/// empty.
inline std::string_view take_field(std::string_view& line) {
  const std::size_t space = line.find(' ');
  const std::string_view field = line.substr(0, space);
  line.remove_prefix(space == std::string_view::npos ? line.size() : space + 1);
  return field;
}

/// Detects a space after the last field, which `take_field` would ignore.
inline bool ends_in_space(std::string_view line) {
  return !line.empty() && line.back() == ' ';
}

inline std::optional<std::uint64_t> to_number(std::string_view field, std::uint64_t largest) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  if (field.front() == '0' && field.size() > 1) return std::nullopt;
  return value <= largest ? std::optional(value) : std::nullopt;
}

}  // namespace halfway
