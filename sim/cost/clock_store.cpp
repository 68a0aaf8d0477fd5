// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/clock_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/to_integer.hpp"
#include "sim/os/csv.hpp"
#include "sim/os/file.hpp"

namespace halfway::synth {
std::string clocks_file(const Family& family) {
  return fmt::format("docs/results/clocks_{}.csv", family.device->option);
}

ClockStore::const_iterator clock_of(const ClockStore& clocks, const std::string& netlist) {
  return std::ranges::find_if(clocks, [&](const auto& clock) { return clock.second.netlist == netlist; });
}

ClockStore::const_iterator clock_by_other_ghdl(const ClockStore& clocks, const std::string& hardware,
                                               const std::string& ghdl) {
  return std::ranges::find_if(clocks, [&](const auto& clock) {
    return clock.second.hardware == hardware && !clock.second.tools.starts_with(ghdl + ",");
  });
}

bool is_placed(const StoredClock& clock, const std::string& tools, const std::string& netlist,
               unsigned seeds) {
  return clock.tools == tools && clock.netlist == netlist && (clock.seeds == seeds || clock.seeds == 0);
}

Result<ClockStore> read_clocks(const std::filesystem::path& root, const Family& family) {
  ClockStore clocks;
  const std::filesystem::path path = root / clocks_file(family);
  if (!std::filesystem::exists(path)) return clocks;
  const auto table = read_csv(path);
  if (!table) return table.error();
  for (std::size_t row = 0; row < table->rows.size(); ++row) {
    bool right = true;
    const auto number = [&](std::string_view column) {
      const auto value = table->number(row, std::string(column));
      right = right && value && *value >= 0;
      return right ? *value : 0;
    };
    const auto count = [&](std::string_view column) { return to_integer<std::uint64_t>(number(column)); };
    StoredClock clock{.cells = {},
                      .mhz = number("mhz"),
                      .seeds = static_cast<unsigned>(count("seeds")),
                      .range = table->text(row, "range"),
                      .path = table->text(row, "path"),
                      .tools = table->text(row, "tools"),
                      .netlist = table->text(row, "netlist"),
                      .hardware = table->text(row, "hardware")};
    for (const CellColumn& column : family.columns) clock.cells.*column.number = count(column.name);
    right = right && !clock.netlist.empty() && clocks.emplace(table->text(row, "design"), clock).second;
    if (!right)
      return bad_input(
          fmt::format("{}:{}: not a design's clock, or a second one; make evidence PAGE=clocks "
                      "writes the file",
                      path.string(), row + 2));
  }
  return clocks;
}

Status write_clocks(const std::filesystem::path& root, const Family& family, const ClockStore& clocks) {
  Table table{{"design"}, {}};
  for (const CellColumn& column : family.columns) table.columns.emplace_back(column.name);
  table.columns.insert(table.columns.end(),
                       {"mhz", "seeds", "range", "path", "tools", "netlist", "hardware"});
  for (const auto& [design, clock] : clocks) {
    std::vector<std::string>& row = table.rows.emplace_back(1, design);
    for (const CellColumn& column : family.columns) row.push_back(std::to_string(clock.cells.*column.number));
    row.insert(row.end(), {fmt::format("{:.1f}", clock.mhz), std::to_string(clock.seeds), clock.range,
                           clock.path, clock.tools, clock.netlist, clock.hardware});
  }
  return write_file(root / clocks_file(family), to_csv(table));
}

}  // namespace halfway::synth
