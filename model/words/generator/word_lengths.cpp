// SPDX-License-Identifier: Apache-2.0
#include "words/generator/word_lengths.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace halfway::tables {

std::string WordLengths::name() const {
  std::vector<std::string> parts;
  for (const WordLength& length : c_word_lengths)
    if (const auto& bits = this->*length.bits) parts.push_back(fmt::format("{}{}", length.in_names, *bits));
  if (newton) parts.emplace_back(*newton ? "newton" : "plain");
  return fmt::format("{}", fmt::join(parts, "-"));
}

}  // namespace halfway::tables
