// SPDX-License-Identifier: Apache-2.0
// Word lengths of hardware that the program was not built with: changes to a preset's formats for a study.
#pragma once

#include <optional>
#include <string>

namespace halfway::tables {

/// An empty value selects the preset's word length.
struct WordLengths {
  std::optional<int> angle_bits;     ///< fraction bits of the spherical shader's angles
  std::optional<int> fraction_bits;  ///< of the quadratic shader's intensities
  /// Bits of an entry of the processors' table of 1/sqrt(x), which has 2^(seed_bits - c_seed_cells) entries.
  std::optional<int> seed_bits;
  std::optional<bool> newton;  ///< preset exact: true if a Newton step follows the table

  bool any() const { return angle_bits || fraction_bits || seed_bits || newton; }
  /// For example `angle16`, `seed8-plain`. Empty if nothing is changed.
  std::string name() const;
  friend bool operator==(const WordLengths&, const WordLengths&) = default;
};

inline constexpr int c_seed_cells = 3;

/// Limits of the formats' C++ and VHDL.
struct Range {
  int least, most;
};
inline constexpr Range c_angle_range{4, 30}, c_fraction_range{2, 40}, c_seed_range{5, 14};

}  // namespace halfway::tables
