// SPDX-License-Identifier: Apache-2.0
// The one table of number formats and of the layouts made from them: the source of rtl/tables/formats_pkg.vhd
// and of model/golden/formats.hpp.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tables/bound.hpp"
#include "tables/word_lengths.hpp"

namespace halfway::tables {

/// A fixed-point format: value = word * 2^-fraction_bits.
struct Format {
  std::string_view name;
  bool is_signed;
  int integer_bits;  ///< without the sign
  int fraction_bits;
  std::string_view why;       ///< what the widths follow from
  std::vector<Bound> bounds;  ///< what its words promise; tb/bounds checks each

  double unit() const { return std::ldexp(1.0, -fraction_bits); }
  int bits() const { return (is_signed ? 1 : 0) + integer_bits + fraction_bits; }
};

/// A named word in a flat vector; fields follow each other from bit 0 upwards in the order of their list.
struct Field {
  std::string_view name;
  std::string_view format;
};

/// A flat vector: one header, then the same block once a colour channel.
struct Layout {
  std::string_view name;
  std::vector<Field> header, channel;
};

struct PresetFormats {
  std::string_view name;
  std::vector<Format> formats;
  std::vector<Layout> layouts;
};

/// Both presets; every format name occurs in both.
std::vector<PresetFormats> preset_formats();

/// The same with other word lengths in one of them. What the formats say of their bounds stays the preset's.
std::vector<PresetFormats> preset_formats(bool exact, const WordLengths& words);

/// What a bound's derivation comes to with the preset's formats; where it grows with the exponent, at the one
/// given, else at the largest.
double derived(const PresetFormats& preset, const Format& format, const Bound& bound,
               std::optional<double> exponent = {});

std::string vhdl_package(const std::vector<PresetFormats>& presets);
std::string cpp_header(const std::vector<PresetFormats>& presets);

}  // namespace halfway::tables
