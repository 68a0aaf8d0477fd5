// SPDX-License-Identifier: Apache-2.0
// Tables of the functions that the shading processors use. Source of rtl/tables/function_pkg.vhd and of
// words/function_tables.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "words/generator/bound.hpp"
#include "words/generator/word_lengths.hpp"

namespace halfway::tables {

enum class Function {
  reciprocal_root,  ///< 1/sqrt(x), 1 <= x < 4: half of the entries up to x = 2, half from 2 on
  logarithm,        ///< log2(x), 1 <= x <= 2
  decay             ///< 2^-x, 0 <= x <= 1
};
inline constexpr std::array c_functions = {Function::reciprocal_root, Function::logarithm, Function::decay};
inline const char* to_string(Function function) {
  switch (function) {
    case Function::reciprocal_root:
      return "reciprocal_root";
    case Function::logarithm:
      return "logarithm";
    case Function::decay:
      break;
  }
  return "decay";
}

/// The function over 2^cell_bits cells, times 2^fraction_bits, correctly rounded, clamped to value_bits.
/// With slope_bits the table is interpolated: value i is the function at the start of cell i, and one more
/// value is the function at the end of the last cell. Without slope_bits a value is the function at the
/// middle of its cell.
struct FunctionTable {
  bool exact;
  Function function;
  int cell_bits, value_bits, fraction_bits;
  int slope_bits;  ///< of the difference between neighbours; 0: none
  Bound error;     ///< over whole cells; with slopes along the chord, the product truncated to a unit
  std::vector<std::uint32_t> values;
};

/// The tables of preset exact in the order of c_functions, then those of published. `words`: with another
/// table of 1/sqrt(x) in one preset.
std::vector<FunctionTable> function_tables(bool exact = true, const WordLengths& words = {});

/// The result of the derivation of the table's bound.
double derived(const FunctionTable& table);

std::string function_vhdl_package(const std::vector<FunctionTable>& tables = function_tables());
std::string function_cpp_header(const std::vector<FunctionTable>& tables);

}  // namespace halfway::tables
