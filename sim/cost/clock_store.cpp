// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/clock_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/to_integer.hpp"
#include "sim/os/csv.hpp"
#include "sim/os/file.hpp"

namespace halfway::synth {
namespace {

const std::vector<std::string> c_columns = {"design", "luts",  "carries", "flip_flops", "rams",
                                            "mhz",    "seeds", "tools",   "netlist",    "hardware"};

}  // namespace

ClockStore::const_iterator clock_of(const ClockStore& clocks, const std::string& netlist) {
  return std::ranges::find_if(clocks, [&](const auto& clock) { return clock.second.netlist == netlist; });
}

ClockStore::const_iterator clock_by_other_ghdl(const ClockStore& clocks, const std::string& hardware,
                                               const std::string& ghdl) {
  return std::ranges::find_if(clocks, [&](const auto& clock) {
    return clock.second.hardware == hardware && !clock.second.tools.starts_with(ghdl + ",");
  });
}

Result<ClockStore> read_clocks(const std::filesystem::path& root) {
  ClockStore clocks;
  const std::filesystem::path path = root / c_clocks;
  if (!std::filesystem::exists(path)) return clocks;
  const auto table = read_csv(path);
  if (!table) return table.error();
  for (std::size_t row = 0; row < table->rows.size(); ++row) {
    bool right = true;
    const auto number = [&](const char* column) {
      const auto value = table->number(row, column);
      right = right && value && *value >= 0;
      return right ? *value : 0;
    };
    const auto count = [&](const char* column) { return to_integer<std::uint64_t>(number(column)); };
    const StoredClock clock{.cells = {count("luts"), count("carries"), count("flip_flops"), count("rams")},
                            .mhz = number("mhz"),
                            .seeds = static_cast<unsigned>(count("seeds")),
                            .tools = table->text(row, "tools"),
                            .netlist = table->text(row, "netlist"),
                            .hardware = table->text(row, "hardware")};
    right = right && !clock.netlist.empty() && clocks.emplace(table->text(row, "design"), clock).second;
    if (!right)
      return bad_input(
          fmt::format("{}:{}: not a design's clock, or a second one; make evidence PAGE=clocks "
                      "writes the file",
                      path.string(), row + 2));
  }
  return clocks;
}

Status write_clocks(const std::filesystem::path& root, const ClockStore& clocks) {
  Table table{c_columns, {}};
  for (const auto& [design, clock] : clocks) {
    const auto text = [&](std::uint64_t Cells::* number) { return std::to_string(clock.cells.*number); };
    table.rows.push_back({design, text(&Cells::luts), text(&Cells::carries), text(&Cells::flip_flops),
                          text(&Cells::rams), fmt::format("{:.1f}", clock.mhz), std::to_string(clock.seeds),
                          clock.tools, clock.netlist, clock.hardware});
  }
  return write_file(root / c_clocks, to_csv(table));
}

}  // namespace halfway::synth
