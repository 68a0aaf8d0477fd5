// SPDX-License-Identifier: Apache-2.0
// Word lengths of hardware that the program was not built with: what a study varies of a preset's formats.
#pragma once

#include <optional>
#include <string>

namespace halfway::tables {

/// Each of them: none for the preset's own.
struct WordLengths {
  std::optional<int> angle_bits;     ///< fraction bits of the spherical shader's angles
  std::optional<int> fraction_bits;  ///< of the quadratic shader's intensities
  /// Of an entry of the processors' table of 1/sqrt(x), which has 2^(seed_bits - c_seed_cells) entries.
  std::optional<int> seed_bits;
  std::optional<bool> newton;  ///< whether a Newton step follows the table; preset exact

  bool any() const { return angle_bits || fraction_bits || seed_bits || newton; }
  /// Such as `angle16`, `seed8-plain`; empty where there is none.
  std::string name() const;
  friend bool operator==(const WordLengths&, const WordLengths&) = default;
};

inline constexpr int c_seed_cells = 3;

/// What the formats' C++ and VHDL take.
struct Range {
  int least, most;
};
inline constexpr Range c_angle_range{4, 30}, c_fraction_range{2, 40}, c_seed_range{5, 14};

}  // namespace halfway::tables
