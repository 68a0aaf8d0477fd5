// SPDX-License-Identifier: Apache-2.0
#include "sim/study/table.hpp"

#include "sim/os/csv.hpp"

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

// The first line names the columns.
void add(Table& table, const Line& line) {
  std::vector<std::string>& row = table.rows.emplace_back();
  for (const auto& [name, value] : line) {
    if (table.rows.size() == 1) table.columns.push_back(name);
    row.push_back(value);
  }
}

Line study_line(const Provenance& provenance, const Record& record, const synth::Cost* known,
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
  Line line = {{"scene", provenance.scene},
               {"scene_hash", provenance.scene_hash},
               {"tools", provenance.tools + (hardware.tools.empty() ? "" : ", " + hardware.tools)},
               {"point", p.name()},
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
                     {"clock", known != nullptr ? hardware.clock : ""},
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

Line time_line(const Provenance& provenance, const Record& record, const FrameTime& time) {
  const auto& [p, m] = record;
  const bool has_hardware = time.hardware_ns.has_value();
  return {{"scene", provenance.scene},
          {"scene_hash", provenance.scene_hash},
          {"point", p.name()},
          {"design", p.design()},
          knob_of(p, "method"),
          knob_of(p, "preset"),
          knob_of(p, "form"),
          knob_of(p, "tessellation"),
          knob_of(p, "exponent"),
          {"width", text_of(p.size.width)},
          {"height", text_of(p.size.height)},
          {"hardware", m.hardware},
          {"triangles", text_of(m.triangles)},
          {"host_ns", fmt::format("{:.6g}", time.host_ns)},
          {"host_instructions", text_of(m.host_instructions)},
          {"words", has_hardware ? text_of(m.host_time->words) : ""},
          {"cycles", has_hardware ? text_of(m.cycles) : ""},
          {"hardware_ns", text_of(time.hardware_ns, "{:.6g}")},
          {"overlapped_ns", fmt::format("{:.6g}", time.overlapped_ns())},
          {"sequential_ns", fmt::format("{:.6g}", time.sequential_ns())},
          {"bound", time.bound()},
          {"rms", text_of(m.picture.rms)},
          {"largest_error", text_of(m.picture.max_lsb)},
          {"perceived_pixels", text_of(m.perceived)},
          {"clock_mhz", text_of(time.mhz, "{:.1f}")},
          knob_of(p, "highlight_test"),
          knob_of(p, "span_ends"),
          {"device", time.device},
          knob_of(p, "subpixels")};
}

}  // namespace

std::string study_csv(const Provenance& provenance, std::span<const Record> records,
                      const HardwareTable& hardware, std::span<const Market> markets) {
  const auto on_front = on_fronts(records.size(), markets);
  Table table;
  for (std::size_t at = 0; at < records.size(); ++at) {
    const auto found = hardware.find(records[at].measured.hardware);
    const synth::Cost* cost = found == hardware.end() ? nullptr : &found->second;
    add(table, study_line(provenance, records[at], cost, on_front[at]));
  }
  return to_csv(table);
}

std::string times_csv(const Provenance& provenance, std::span<const Record> records,
                      std::span<const PictureTimes> pictures) {
  Table table;
  for (const PictureTimes& picture : pictures)
    for (const FrameTime& time : picture.times) add(table, time_line(provenance, records[time.record], time));
  return to_csv(table);
}

}  // namespace halfway::study
