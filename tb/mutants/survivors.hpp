// SPDX-License-Identifier: Apache-2.0
// Mutants that no test kills and no proof excuses, and lines and outcomes that no test reaches, each with its
// reason. What is no longer so is an error: the list says what is.
#pragma once

#include <span>
#include <string_view>

namespace halfway::mutants {

struct KnownSurvivor {
  std::string_view file;     ///< in rtl/
  std::string_view in_line;  ///< the line, from its first word on
  std::string_view from, to;
  std::string_view reason;
};

std::span<const KnownSurvivor> known_survivors();

struct KnownGap {
  std::string_view file;  ///< in rtl/
  std::string_view text;  ///< the line; or the condition and what it never was
  std::string_view reason;
};

std::span<const KnownGap> known_gaps();

}  // namespace halfway::mutants
