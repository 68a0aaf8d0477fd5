// SPDX-License-Identifier: Apache-2.0
// The cosine tables: sizes, entries and errors. Source of rtl/tables/cosine_pkg.vhd and of
// words/cosine_tables.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "words/generator/cosine_size.hpp"

namespace halfway::tables {

using words::CosineSize;

inline constexpr CosineSize c_smallest_cosine_size{3, 2};
inline constexpr CosineSize c_largest_cosine_size{12, 12};
/// The size of a text such as `9x8`; std::nullopt if it is none from the smallest to the largest.
std::optional<CosineSize> parse_cosine_size(std::string_view text);
/// What a value of the knob `cosine` is, for help and errors.
inline constexpr const char* c_cosine_values =
    "ADDRESSxDATA bits of the cosine tables, such as 9x8, 3x2 to 12x12";

/// The generated sizes. The first size of each preset is its default.
struct CosineSizes {
  std::vector<CosineSize> exact = {{9, 8}};
  std::vector<CosineSize> published = {{6, 6}, {4, 4}};  ///< 4x4: the spherical paper's figure 15
  /// Preset exact: the exponents of own tables, at most c_most_own_tables. They replace the powers 2, 4, 8
  /// and 16. Empty: these powers.
  std::vector<double> own{};
};

/// An own table contains the highlight of one exponent, cos^n itself, so that no bell has to be fitted. Own
/// table i takes the place of cosine to the power 2^(i + 1).
inline constexpr std::size_t c_most_own_tables = 4;
/// The smallest size with which the shader is within one colour step of 255 cos^n for every exponent n >= 1.
inline constexpr CosineSize c_own_size{10, 11};

/// The angle at which an own table ends, in radians: where cos^exponent is c_own_end.
inline constexpr double c_own_end = 0x1p-10;
double own_reach(double exponent);

/// cos^power at the middles of 2^address_bits cells of an angle, times 2^data_bits - 1, correctly rounded.
/// Preset exact: entry k is for the cell [k, k + 1] / 2^address_bits of half a bell (pi/2), powers 1, 2, 4,
/// 8, 16. Preset published: the address is signed and covers a full period. Power 2: cells of 1 /
/// 2^(address_bits - 1) of half a bell. Power 1: cells of the same fraction of half a turn (pi), and zero
/// where the cosine is negative. An own table has cos^own instead of cos^power, and cells of own_reach
/// instead of half a bell.
struct CosineTable {
  bool exact;
  int power;
  CosineSize size;
  std::vector<std::uint32_t> entries;
  double own = 0.0;  ///< exponent of an own table, at least 1; 0: cos^power

  int bits() const { return size.data_bits * size.entries(); }
};

/// Throws std::invalid_argument for sizes and powers not listed above.
CosineTable cosine_table(bool exact, int power, const CosineSize& size);

/// The own table of an exponent, at least 1, instead of cos^power. Throws as cosine_table.
CosineTable own_table(double exponent, int power, const CosineSize& size);

/// Every table of these sizes once: preset exact first, then by size, then by power.
std::vector<CosineTable> cosine_tables(const CosineSizes& sizes = {});

/// Largest |entry / (2^data_bits - 1) - cos^power| over all angles of the table, in units of 1. Beyond the
/// end of an own table cos^own is less than c_own_end; this is not included.
double table_error(const CosineTable& table);

/// Upper bound of table_error: half a step of an entry, plus half a cell where cos^power is steepest.
double error_bound(const CosineTable& table);

std::string cosine_vhdl_package(const CosineSizes& sizes = {});
/// The sizes of the tables in the text of a package that cosine_vhdl_package wrote, in its order.
CosineSizes cosine_sizes_in(const std::string& vhdl_package);
std::string cosine_cpp_header(const CosineSizes& sizes = {});

}  // namespace halfway::tables
