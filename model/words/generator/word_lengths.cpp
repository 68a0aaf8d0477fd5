// SPDX-License-Identifier: Apache-2.0
#include "words/generator/word_lengths.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace halfway::tables {

std::string WordLengths::name() const {
  std::vector<std::string> parts;
  if (angle_bits) parts.push_back(fmt::format("angle{}", *angle_bits));
  if (fraction_bits) parts.push_back(fmt::format("fraction{}", *fraction_bits));
  if (seed_bits) parts.push_back(fmt::format("seed{}", *seed_bits));
  if (newton) parts.emplace_back(*newton ? "newton" : "plain");
  return fmt::format("{}", fmt::join(parts, "-"));
}

}  // namespace halfway::tables
