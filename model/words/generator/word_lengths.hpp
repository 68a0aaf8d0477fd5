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

  bool any() const { return *this != WordLengths{}; }
  /// For example `angle16`, `seed8-plain`. Empty if nothing is changed.
  std::string name() const;
  friend bool operator==(const WordLengths&, const WordLengths&) = default;
};

inline constexpr int c_seed_cells = 3;

/// A word length: the fraction bits of a format. It is a key of spaces and a part of names.
struct WordLength {
  const char* key;
  std::optional<int> WordLengths::* bits;
  int least, most;  ///< limits of the formats' C++ and VHDL
  const char *shader, *format, *in_names;
};
inline constexpr WordLength c_word_lengths[] = {
    {"angle_bits", &WordLengths::angle_bits, 4, 30, "spherical", "angle", "angle"},
    {"fraction_bits", &WordLengths::fraction_bits, 2, 40, "quadratic", "intensity", "fraction"},
    {"seed_bits", &WordLengths::seed_bits, 5, 14, "processors", "root_entry", "seed"},
};

}  // namespace halfway::tables
