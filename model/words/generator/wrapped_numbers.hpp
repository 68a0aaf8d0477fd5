// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace halfway::tables {

/// The numbers, separated by commas, on lines of at most `columns` that start with `indent`.
inline std::string wrapped_numbers(std::span<const std::uint32_t> numbers, std::string_view indent,
                                   std::size_t columns) {
  std::string text, line(indent);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string word = std::to_string(numbers[i]) + (i + 1 == numbers.size() ? "" : ",");
    if (line.size() > indent.size()) {
      if (line.size() + 1 + word.size() > columns) {
        text += line + "\n";
        line = indent;
      } else {
        line += ' ';
      }
    }
    line += word;
  }
  return text + line;
}

}  // namespace halfway::tables
