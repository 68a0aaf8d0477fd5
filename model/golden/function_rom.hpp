// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/tables/function_rom.vhd: reads the generated table.
#pragma once

#include <cstdint>
#include <type_traits>

#include "golden/words.hpp"
#include "words/function_tables.hpp"

namespace halfway::golden {

/// slope: the absolute difference to the next value; 0 if the table is not interpolated.
struct FunctionSample {
  std::uint32_t value, slope;
};

template <class Preset>
constexpr const FunctionTable& function_table(Function function) {
  const auto index = static_cast<std::size_t>(function);
  if constexpr (std::is_same_v<Preset, Exact>)
    return c_exact_functions[index];
  else
    return c_published_functions[index];
}

template <class Preset>
constexpr FunctionSample function_rom(Function function, std::uint32_t address) {
  const FunctionTable& table = function_table<Preset>(function);
  const std::uint32_t value = table.values[address];
  if (table.slope_bits == 0) return {value, 0};
  const std::uint32_t next = table.values[address + 1];
  return {value, next > value ? next - value : value - next};
}

}  // namespace halfway::golden
