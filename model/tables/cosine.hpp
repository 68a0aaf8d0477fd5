// SPDX-License-Identifier: Apache-2.0
// The cosine tables: sizes, entries and errors. Source of rtl/tables/cosine_pkg.vhd and of
// model/golden/cosine_tables.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace halfway::tables {

/// A table has 2^address_bits entries of data_bits each.
struct CosineSize {
  int address_bits, data_bits;
  bool operator==(const CosineSize&) const = default;
};

inline constexpr CosineSize c_smallest_cosine_size{3, 2};
inline constexpr CosineSize c_largest_cosine_size{12, 12};

/// The generated sizes. The first size of each preset is its default.
struct CosineSizes {
  std::vector<CosineSize> exact = {{9, 8}};
  std::vector<CosineSize> published = {{6, 6}, {4, 4}};  ///< 4/4: the spherical paper's figure 15
};

/// cos^power at the middles of 2^address_bits cells of an angle, times 2^data_bits - 1, correctly rounded.
/// Preset exact: entry k is for the cell [k, k + 1] / 2^address_bits of half a bell (pi/2), powers 1, 2, 4,
/// 8, 16. Preset published: the address is signed and covers a full period. Power 2: cells of 1 /
/// 2^(address_bits - 1) of half a bell. Power 1: cells of the same fraction of half a turn (pi), and zero
/// where the cosine is negative.
struct CosineTable {
  bool exact;
  int power;
  int address_bits;
  int data_bits;
  std::vector<std::uint32_t> entries;

  int bits() const { return data_bits << address_bits; }
};

/// Throws std::invalid_argument for sizes and powers not listed above.
CosineTable cosine_table(bool exact, int power, int address_bits, int data_bits);

/// Every table of these sizes once: preset exact first, then by size, then by power.
std::vector<CosineTable> cosine_tables(const CosineSizes& sizes = {});

/// Largest |entry / (2^data_bits - 1) - cos^power| over all angles of the table, in units of 1.
double table_error(const CosineTable& table);

/// Upper bound of table_error: half a step of an entry, plus half a cell where cos^power is steepest.
double error_bound(const CosineTable& table);

std::string cosine_vhdl_package(const CosineSizes& sizes = {});
std::string cosine_cpp_header(const CosineSizes& sizes = {});

}  // namespace halfway::tables
