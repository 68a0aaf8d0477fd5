// SPDX-License-Identifier: Apache-2.0
// Strict reading of the project's line formats: fields with exactly one space between, decimal numbers
// without sign, space or leading zero, so that every content has one spelling.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace halfway {

/// Cuts the next field off the front of `line`, and the space after it. A field may be empty where the line
/// is bad.
inline std::string_view take_field(std::string_view& line) {
  const std::size_t space = line.find(' ');
  const std::string_view field = line.substr(0, space);
  line.remove_prefix(space == std::string_view::npos ? line.size() : space + 1);
  return field;
}

/// `take_field` would not see a space after the last field.
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
