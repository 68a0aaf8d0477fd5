// SPDX-License-Identifier: Apache-2.0
#include "words/generator/layout_page.hpp"

#include <fmt/format.h>

#include <iterator>

namespace halfway::tables {
namespace {

/// A word of the material of the shading processors; processors_pkg has its positions.
struct MaterialWord {
  std::string_view name, count, format, condition, meaning;
};

constexpr MaterialWord c_material[] = {
    {"exponent", "1", "exponent", "`g_specular`", "exponent n of the highlight"},
    {"ambient", "one per channel", "coefficient", "always",
     "k_a: ambient coefficient times colour; with emission in the scene, the surface's ambient term and "
     "emission, divided by the frame's ambient light"},
    {"diffuse", "one per channel", "coefficient", "`g_diffuse`", "k_d: diffuse coefficient times colour"},
    {"specular", "one per channel", "coefficient", "`g_specular`",
     "k_s: specular coefficient times the highlight's colour"},
};

/// One row per field; bits count from the start of the block.
void add_fields(std::string& table, const PresetFormats& preset, const std::vector<Field>& fields,
                std::string_view block) {
  int low = 0;
  for (const Field& field : fields) {
    const Format& format = format_of(preset, field.format);
    table += fmt::format("| {} | `{}` | {}:{} | {} | {} |\n", block, field.name, low + format.bits() - 1, low,
                         format.text(), field.meaning);
    low += format.bits();
  }
}

std::string fields_of(const PresetFormats& preset, const Layout& layout) {
  const bool axes = layout.name == "light_axes";
  std::string table = "| block | field | bits | format | meaning |\n| --- | --- | --- | --- | --- |\n";
  add_fields(table, preset, layout.header, "header");
  add_fields(table, preset, layout.channel, axes ? "axis" : "channel");
  if (layout.header.empty() || layout.channel.empty()) return table;
  const int header = total_bits(preset, layout.header), block = total_bits(preset, layout.channel);
  const std::string sum =
      axes ? fmt::format("an axis: {}; together", block)
           : fmt::format("a channel: {}; with one channel {}, with three", block, header + block);
  return table + fmt::format("\nHeader: {} bits; {} {}.\n", header, sum, header + 3 * block);
}

std::string material_of(const PresetFormats& preset) {
  std::string table =
      "| word | number | bits each | format | present with | meaning |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const MaterialWord& word : c_material) {
    const Format& format = format_of(preset, word.format);
    table += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", word.name, word.count, format.bits(),
                         format.text(), word.condition, word.meaning);
  }
  return table;
}

template <class TableOf>
std::string of_both(const std::vector<PresetFormats>& presets, const TableOf& table_of) {
  return fmt::format("Preset `{}`:\n\n{}\nPreset `{}`:\n\n{}", presets[0].name, table_of(presets[0]),
                     presets[1].name, table_of(presets[1]));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> layout_tables(const std::vector<PresetFormats>& presets) {
  std::vector<std::pair<std::string, std::string>> tables = {{"material", of_both(presets, material_of)}};
  for (std::size_t i = 0; i < presets[0].layouts.size(); ++i)
    if (const std::string name(presets[0].layouts[i].name); name != "pixel")  // no vector of the host
      tables.emplace_back(name, of_both(presets, [&](const PresetFormats& preset) {
                            return fields_of(preset, preset.layouts[i]);
                          }));
  return tables;
}

}  // namespace halfway::tables
