// SPDX-License-Identifier: Apache-2.0
#include "study/table.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "study/figures.hpp"

namespace halfway::study {
namespace {

// By record; software is neither on a front nor off it.
Result<std::vector<std::optional<bool>>> on_fronts(std::size_t records, std::span<const Market> markets) {
  std::vector<std::optional<bool>> on_front(records);
  for (const Market& market : markets) {
    const auto found = answer(market.offers, {});
    if (!found) return found.error();
    for (const Offer& offer : market.offers) on_front[offer.record] = false;
    for (const std::size_t at : found->front) on_front[market.offers[at].record] = true;
  }
  return on_front;
}

template <class Value>
std::string column(const Value& value) {
  return fmt::format(",{}", value);
}
std::string column(const std::optional<std::uint64_t>& value) {
  return value ? fmt::format(",{}", *value) : ",";
}

std::string ratio(std::uint64_t part, std::uint64_t whole) {
  if (part == 0 || whole == 0) return ",";
  return fmt::format(",{:.6g}", static_cast<double>(part) / static_cast<double>(whole));
}

std::string cells_columns(const HardwareTable& hardware, const std::string& key) {
  const auto found = hardware.find(key);
  if (found == hardware.end() || !found->second.cells) return ",,,,,,";
  const Cells& c = *found->second.cells;
  return fmt::format(",{},{},{},{},{},{:.0f}", c.luts, c.flip_flops, c.memory_bits, c.multipliers,
                     c.product_bits, cell_count(c));
}

}  // namespace

Result<std::string> to_csv(const Provenance& provenance, std::span<const Record> records,
                           const HardwareTable& hardware, std::span<const Market> markets) {
  const auto on_front = on_fronts(records.size(), markets);
  if (!on_front) return on_front.error();
  std::string text =
      "scene,scene_hash,tools,point,method,preset,address_bits,data_bits,form,threshold,tessellation,"
      "exponent,width,height";
  Measurement none;
  for_each_figure(none, [&](const char* name, const auto&) { text += fmt::format(",{}", name); });
  text +=
      ",luts,flip_flops,memory_bits,multipliers,product_bits,cells,front,cycles_a_fragment,"
      "host_instructions_a_triangle,record\n";
  for (std::size_t at = 0; at < records.size(); ++at) {
    const auto& [p, measured] = records[at];
    text += fmt::format(
        "\"{}\",{},\"{}\",\"{}\",{},{},{},{},{},{},{:g},{},{},{}", provenance.scene, provenance.scene_hash,
        provenance.tools, p.name(), to_string(p.method), in_hardware(p.method) ? to_string(p.preset) : "",
        p.tables ? std::to_string(p.tables->address_bits) : "",
        p.tables ? std::to_string(p.tables->data_bits) : "", p.plan().form ? to_string(p.form) : "",
        p.has_threshold() ? fmt::format("{:g}", p.threshold) : "", p.tessellation,
        p.exponent ? fmt::format("{:g}", *p.exponent) : "", p.size.width, p.size.height);
    for_each_figure(measured, [&](const char*, const auto& value) { text += column(value); });
    text += cells_columns(hardware, measured.hardware);
    const std::optional<bool> front = (*on_front)[at];
    text += !front ? "," : *front ? ",1" : ",0";
    text += ratio(measured.cycles, measured.fragments) +
            ratio(measured.host_instructions.value_or(0), measured.triangles) + "," +
            record_name(provenance, p) + "\n";
  }
  return text;
}

}  // namespace halfway::study
