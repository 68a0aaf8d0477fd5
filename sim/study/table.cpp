// SPDX-License-Identifier: Apache-2.0
#include "sim/study/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "sim/study/figures.hpp"

namespace halfway::study {
namespace {

// Indexed by record; std::nullopt for software.
std::vector<std::optional<bool>> on_fronts(std::size_t records, std::span<const Market> markets) {
  std::vector<std::optional<bool>> on_front(records);
  for (const Market& market : markets) {
    for (const Offer& offer : market.offers) on_front[offer.record] = false;
    for (const std::size_t at : front_of(costs_of(market.offers))) on_front[market.offers[at].record] = true;
  }
  return on_front;
}

template <class Value>
std::string text_of(const Value& value) {
  return fmt::format("{}", value);
}
// Empty text for std::nullopt.
template <class Value>
std::string text_of(const std::optional<Value>& value, const char* format = "{}") {
  return value ? fmt::format(fmt::runtime(format), *value) : "";
}
// The member's text; empty without an object.
template <class Whole, class Part>
std::string text_of(const std::optional<Whole>& whole, Part Whole::* part) {
  return whole ? text_of((*whole).*part) : "";
}

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

std::string ratio(std::uint64_t part, std::uint64_t whole) {
  if (part == 0 || whole == 0) return "";
  return fmt::format("{:.6g}", static_cast<double>(part) / static_cast<double>(whole));
}

// A line's values with the names of their columns.
using Column = std::pair<std::string, std::string>;  // name and value
using Line = std::vector<Column>;

Column knob_of(const DesignPoint& point, std::string_view name) {
  return {std::string(name), text_of(name, point)};
}

Line line_of(const Provenance& provenance, const Record& record, const synth::Cost* known,
             const std::optional<bool>& on_front) {
  const auto& [p, m] = record;
  const synth::Cost hardware = known != nullptr ? *known : synth::Cost{};
  const std::optional<Cells>& cells = hardware.cells;
  const std::optional<Cells>& on_device = hardware.device_cells;
  const auto cycles = static_cast<double>(m.cycles);
  std::optional<double> frame_ns, fragment_ns;
  if (hardware.mhz) frame_ns = 1e3 * cycles / *hardware.mhz;
  if (hardware.mhz && m.fragments > 0)
    fragment_ns = 1e3 * cycles / static_cast<double>(m.fragments) / *hardware.mhz;
  Line line = {{"scene", quoted(provenance.scene)},
               {"scene_hash", provenance.scene_hash},
               {"tools", quoted(provenance.tools + (hardware.tools.empty() ? "" : ", " + hardware.tools))},
               {"point", quoted(p.name())},
               knob_of(p, "method"),
               knob_of(p, "preset"),
               {"address_bits", text_of(p.hardware.tables, &words::CosineSize::address_bits)},
               {"data_bits", text_of(p.hardware.tables, &words::CosineSize::data_bits)},
               knob_of(p, "form"),
               knob_of(p, "threshold"),
               knob_of(p, "tessellation"),
               knob_of(p, "exponent"),
               {"width", text_of(p.size.width)},
               {"height", text_of(p.size.height)}};
  for_each_figure(m, [&](const char* name, const auto& value) { line.emplace_back(name, text_of(value)); });
  const Line rest = {{"luts", text_of(cells, &Cells::luts)},
                     {"flip_flops", text_of(cells, &Cells::flip_flops)},
                     {"memory_bits", text_of(cells, &Cells::memory_bits)},
                     {"multipliers", text_of(cells, &Cells::multipliers)},
                     {"product_bits", text_of(cells, &Cells::product_bits)},
                     {"cells", cells ? fmt::format("{:.0f}", synth::cell_count(*cells)) : ""},
                     {"front", text_of(on_front, "{:d}")},
                     {"cycles_a_fragment", ratio(m.cycles, m.fragments)},
                     {"host_instructions_a_triangle", ratio(m.host_instructions.value_or(0), m.triangles)},
                     {"record", record_name(provenance, p)},
                     {"multiplier_luts", text_of(cells, &Cells::multiplier_luts)},
                     {"clock_mhz", text_of(hardware.mhz, "{:.1f}")},
                     {"clock", known != nullptr ? quoted(hardware.clock) : ""},
                     {"frame_ns", text_of(frame_ns, "{:.6g}")},
                     {"fragment_ns", text_of(fragment_ns, "{:.6g}")},
                     {"device", hardware.device},
                     {"device_luts", text_of(on_device, &Cells::luts)},
                     {"device_carries", text_of(on_device, &Cells::carries)},
                     {"device_flip_flops", text_of(on_device, &Cells::flip_flops)},
                     {"device_rams", text_of(on_device, &Cells::rams)},
                     {"device_multipliers", text_of(on_device, &Cells::multipliers)},
                     knob_of(p, "angle_bits"),
                     knob_of(p, "fraction_bits"),
                     knob_of(p, "seed_bits"),
                     knob_of(p, "newton"),
                     {"tiles", text_of(p.tiles().size())},
                     knob_of(p, "highlight_test"),
                     knob_of(p, "span_ends")};
  line.insert(line.end(), rest.begin(), rest.end());
  // The other parameters. Size, tile and cosine have columns of their own.
  for (const Knob& knob : knobs())
    if (const std::string name = knob.name; name != "size" && name != "tile" && name != "cosine" &&
                                            std::ranges::find(line, name, &Column::first) == line.end())
      line.emplace_back(name, text_of(knob, p));
  return line;
}

/// The names or the values of all columns, with commas.
std::string joined(const Line& line, std::string Column::* part) {
  std::vector<std::string_view> parts;
  for (const Column& column : line) parts.push_back(column.*part);
  return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace

std::string to_csv(const Provenance& provenance, std::span<const Record> records,
                   const HardwareTable& hardware, std::span<const Market> markets) {
  const auto on_front = on_fronts(records.size(), markets);
  const Line head = line_of(provenance, {}, nullptr, {});
  std::string text = fmt::format("{}\n", joined(head, &Column::first));
  for (std::size_t at = 0; at < records.size(); ++at) {
    const auto found = hardware.find(records[at].measured.hardware);
    const Line line =
        line_of(provenance, records[at], found == hardware.end() ? nullptr : &found->second, on_front[at]);
    text += fmt::format("{}\n", joined(line, &Column::second));
  }
  return text;
}

}  // namespace halfway::study
