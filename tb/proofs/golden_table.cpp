// SPDX-License-Identifier: Apache-2.0
#include "golden_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "golden/function_rom.hpp"
#include "words/cosine_tables.hpp"

namespace halfway::proofs {
namespace {

using Generics = std::vector<std::pair<std::string, std::string>>;

std::string value_of(const Generics& generics, std::string_view name) {
  const auto at = std::ranges::find(generics, name, [](const auto& generic) { return generic.first; });
  return at == generics.end() ? "" : at->second;
}

Result<GoldenTable> cosine_table(const Generics& generics) {
  for (const words::CosineTable& table : words::c_cosine_tables)
    if (value_of(generics, "g_exact") == (table.exact ? "true" : "false") &&
        value_of(generics, "g_power") == std::to_string(table.power) &&
        value_of(generics, "g_cosine") == vhdl_name(table.size))
      return GoldenTable{{table.entries.begin(), table.entries.end()}, table.size.data_bits};
  return bad_input("no cosine table of the golden model has these generics");
}

// An entry is the slope, if the table has one, followed by the value.
template <class Formats>
GoldenTable entries_of(words::Function function) {
  const words::FunctionTable& table = golden::function_table<Formats>(function);
  GoldenTable result{{}, table.slope_bits + table.value_bits};
  for (std::uint32_t address = 0; address < 1U << table.cell_bits; ++address) {
    const auto sample = golden::function_rom<Formats>(function, address);
    result.entries.push_back(std::uint64_t{sample.slope} << table.value_bits | sample.value);
  }
  return result;
}

Result<GoldenTable> function_table(const Generics& generics) {
  constexpr int c_functions = 3;
  for (int which = 0; which < c_functions; ++which) {
    if (value_of(generics, "g_which") != std::to_string(which)) continue;
    const auto function = static_cast<words::Function>(which);
    if (value_of(generics, "g_exact") == "true") return entries_of<words::Exact>(function);
    if (value_of(generics, "g_exact") == "false") return entries_of<words::Published>(function);
  }
  return bad_input("no function table of the golden model has these generics");
}

}  // namespace

Result<GoldenTable> golden_table(std::string_view name, const Generics& generics) {
  if (name == "cosine") return cosine_table(generics);
  if (name == "function") return function_table(generics);
  return bad_input(fmt::format("'{}' is no ROM; give cosine or function", name));
}

}  // namespace halfway::proofs
