// SPDX-License-Identifier: Apache-2.0
#include "sim/study/table.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "sim/study/figures.hpp"

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

template <class Value>
std::string ratio_of(const std::optional<Value>& value, double more) {
  return value ? fmt::format(",{:.6g}", more / *value) : ",";
}

// The period in ns, for a frame and for a fragment; then what the hardware was made of for that.
std::string clock_columns(const HardwareTable& hardware, const Measurement& m) {
  const auto found = hardware.find(m.hardware);
  if (found == hardware.end()) return ",,,,,,,,";
  const HardwareFigures& f = found->second;
  const auto cycles = static_cast<double>(m.cycles);
  std::string text = f.mhz ? fmt::format(",{:.1f}", *f.mhz) : ",";
  text += fmt::format(",\"{}\"", f.clock) + ratio_of(f.mhz, 1e3 * cycles);
  text += m.fragments == 0 ? "," : ratio_of(f.mhz, 1e3 * cycles / static_cast<double>(m.fragments));
  if (!f.ice40) return text + ",,,,";
  return text +
         fmt::format(",{},{},{},{}", f.ice40->luts, f.ice40->carries, f.ice40->flip_flops, f.ice40->rams);
}

std::string cells_columns(const HardwareTable& hardware, const std::string& key) {
  const auto found = hardware.find(key);
  if (found == hardware.end() || !found->second.cells) return ",,,,,,";
  const Cells& c = *found->second.cells;
  return fmt::format(",{},{},{},{},{},{:.0f}", c.luts, c.flip_flops, c.memory_bits, c.multipliers,
                     c.product_bits, cell_count(c));
}

std::string words_columns(const tables::WordLengths& words) {
  std::string text;
  for (const std::optional<int>& bits : {words.angle_bits, words.fraction_bits, words.seed_bits})
    text += bits ? fmt::format(",{}", *bits) : ",";
  return text + (!words.newton ? "," : *words.newton ? ",1" : ",0");
}

// Those of all points, and those of what the hardware costs.
std::string tools_of(const Provenance& provenance, const HardwareTable& hardware, const std::string& key) {
  const auto found = hardware.find(key);
  if (found == hardware.end() || found->second.tools.empty()) return provenance.tools;
  return provenance.tools + ", " + found->second.tools;
}

std::string multiplier_column(const HardwareTable& hardware, const std::string& key) {
  const auto found = hardware.find(key);
  if (found == hardware.end() || !found->second.cells) return ",";
  return fmt::format(",{}", found->second.cells->multiplier_luts);
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
      "host_instructions_a_triangle,record,multiplier_luts,clock_mhz,clock,frame_ns,fragment_ns,ice40_luts,"
      "ice40_carries,ice40_flip_flops,ice40_rams,angle_bits,fraction_bits,seed_bits,newton,tiles\n";
  for (std::size_t at = 0; at < records.size(); ++at) {
    const DesignPoint& p = records[at].point;
    const Measurement& measured = records[at].measured;
    text += fmt::format("\"{}\",{},\"{}\",\"{}\",{},{},{},{},{},{},{:g},{},{},{}", provenance.scene,
                        provenance.scene_hash, tools_of(provenance, hardware, measured.hardware), p.name(),
                        to_string(p.method), in_hardware(p.method) ? to_string(p.preset) : "",
                        p.tables ? std::to_string(p.tables->address_bits) : "",
                        p.tables ? std::to_string(p.tables->data_bits) : "",
                        p.plan().form ? to_string(p.form) : "",
                        p.has_threshold() ? fmt::format("{:g}", p.threshold) : "", p.tessellation,
                        p.exponent ? fmt::format("{:g}", *p.exponent) : "", p.size.width, p.size.height);
    for_each_figure(measured, [&](const char*, const auto& value) { text += column(value); });
    text += cells_columns(hardware, measured.hardware);
    const std::optional<bool> front = (*on_front)[at];
    text += !front ? "," : *front ? ",1" : ",0";
    text += ratio(measured.cycles, measured.fragments) +
            ratio(measured.host_instructions.value_or(0), measured.triangles) + "," +
            record_name(provenance, p) + multiplier_column(hardware, measured.hardware) +
            clock_columns(hardware, measured) + words_columns(p.words) + column(p.tiles().size()) + "\n";
  }
  return text;
}

}  // namespace halfway::study
