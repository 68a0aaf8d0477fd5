// SPDX-License-Identifier: Apache-2.0
// The table of number formats, and the layouts composed of them. Source of rtl/tables/formats_pkg.vhd and of
// words/formats.hpp.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "words/generator/bound.hpp"
#include "words/generator/word_lengths.hpp"

namespace halfway::tables {

/// A fixed-point number: value = word * 2^-fraction_bits.
struct Number {
  bool is_signed;
  int integer_bits;  ///< without the sign
  int fraction_bits;

  double unit() const { return std::ldexp(1.0, -fraction_bits); }
  int bits() const { return (is_signed ? 1 : 0) + integer_bits + fraction_bits; }
  /// Such as s10.22.
  std::string text() const;
};

struct Format : Number {
  std::string_view name;
  std::string_view why;       ///< the reason for the widths
  std::vector<Bound> bounds;  ///< worst cases of its words; tb/specification/bounds checks each
};

/// A named word in a flat vector. The fields of a list are consecutive from bit 0 upwards.
struct Field {
  std::string_view name;
  std::string_view format;
  std::string_view meaning{};  ///< for docs/rtl/init-vectors.md; empty in vectors between entities
};

/// A flat vector: one header, then one block per colour channel.
struct Layout {
  std::string_view name;
  std::vector<Field> header, channel;
};

constexpr std::string_view preset_name(bool exact) {
  return exact ? "exact" : "published";
}

struct PresetFormats {
  std::string_view name;
  std::vector<Format> formats;
  std::vector<Layout> layouts;
};

/// The format of this name; throws std::logic_error if there is none.
const Format& format_of(const PresetFormats& preset, std::string_view name);

int total_bits(const PresetFormats& preset, const std::vector<Field>& fields);

/// Both presets. Each format name exists in both. `words`: other word lengths of one preset; the texts of the
/// bounds stay those of the preset.
std::vector<PresetFormats> preset_formats(bool exact = true, const WordLengths& words = {});

/// The result of a bound's derivation with the preset's formats. If it increases with the exponent, it is
/// computed for the given exponent, or else for the largest.
double derived(const PresetFormats& preset, const Format& format, const Bound& bound,
               std::optional<double> exponent = {});

std::string vhdl_package(const std::vector<PresetFormats>& presets);
std::string cpp_header(const std::vector<PresetFormats>& presets);

}  // namespace halfway::tables
