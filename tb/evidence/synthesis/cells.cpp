// SPDX-License-Identifier: Apache-2.0
#include "designs.hpp"
#include "measure.hpp"
#include "sim/cost/synthesis.hpp"

namespace halfway::synth {
namespace {

page::Row cells_row(const Synthesizer& synthesizer, const ListedDesign& listed, bool quick) {
  page::Row row{
      .name = listed.design.name, .section = "Cells", .fields = {{"design", quoted(listed.design)}}};
  for (const Family& family : quick ? std::span(c_families).first(1) : std::span(c_families)) {
    const bool counted = listed.ice40 || &family != &c_ice40;
    const Cells cells = counted ? synthesizer.cells(listed.design, family) : Cells{};
    for (const CellColumn& column : family.columns)
      row.fields.emplace_back(column.title, counted ? std::to_string(cells.*column.number) : c_none);
  }
  return row;
}

std::vector<page::Value> values(std::span<const page::Row> rows) {
  std::vector<page::Value> values;
  for (const page::Row& row : rows)
    if (row.field("LUTs") != c_none)
      values.push_back(
          {"cells",
           row.name,
           {std::stod(row.field("LUTs")), std::stod(row.field("flip-flops")), std::stod(row.field("RAMs"))}});
  return values;
}

}  // namespace

ExitCode cells(const Options& options) {
  const std::vector<ListedDesign> designs = selected(options);
  const Synthesizer synthesizer = Synthesizer::open(options.folders.cache, false);
  std::vector<Item> items;
  for (const ListedDesign& listed : designs)
    items.push_back({listed.design.name, [&] { return cells_row(synthesizer, listed, options.quick); }});
  return measure(options, {"cells", {"ghdl", "yosys"}, values}, std::move(items));
}

}  // namespace halfway::synth
