// SPDX-License-Identifier: Apache-2.0
#include "tables/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace halfway::tables {
namespace {

// Formats that both presets share.
std::vector<Format> common_formats() {
  return {
      {"flag", false, 1, 0, "one bit"},
      {"triangle", false, 32, 0, "number of the scene's triangle, carried through as a tag"},
      {"pixel_x", false, 12, 0, "frames up to 4096 pixels wide"},
      {"pixel_y", false, 12, 0, "frames up to 4096 lines high"},
      {"lines", false, 13, 0, "0 to 4096 lines"},
      {"span_x", true, 13, 0, "-1 to 4096: a span's end is exclusive on either side"},
      {"colour", false, 8, 0, "what the frame stores"},
      {"depth", false, 24, 0, "what the z test compares"},
      {"depth_sum", true, 24, 15,
       "first differences, each rounded to 2^-16, at most 4095 lines and 8190 steps: "
       "off by at most (1 + 4095 + 8190) 2^-16 = 0.19 of a depth step"},
      {"sample_word", false, 16, 0, "a cosine table's entry, of whatever size, for the probe"},
      {"command", false, 3, 0, "of a vector or token of the shading processors"},
      {"light", false, 5, 0, "a light's number from 1; 0 is the ambient light"},
      {"shadow_count", true, 9, 0, "shadow volumes opened less those closed, up to 511 either way"},
      {"spot_slope", false, 18, 6,
       "one over the width of a spot's soft edge, in cosines; a harder edge has one of 2^-18, so that a "
       "cone of a tenth of a degree still comes to its full light"},
  };
}

std::vector<Format> joined(std::vector<Format> a, const std::vector<Format>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Format& format_of(const PresetFormats& preset, std::string_view name) {
  const auto it = std::ranges::find(preset.formats, name, &Format::name);
  if (it == preset.formats.end())
    throw std::logic_error(fmt::format("format '{}' is not in the table", name));
  return *it;
}

// What the spherical shader has beside the walk: with the header of `init` a word a channel; then for each
// line and light a diffuse and a specular part. Angles are in units of half a bell: 1 is where the bell has
// come down to zero.
std::vector<Layout> spherical_layouts(bool exact) {
  std::vector<Field> specular = {{"angle", "angle"}, {"slope", "angle"}};
  if (exact) specular.push_back({"power", "power"});
  const std::vector<Field> probe = {{"angle", "angle"}, {"in_range", "flag"}, {"sample", "sample_word"}};
  return {
      {"ambient", {}, {{"ambient", "factor"}}},
      {"diffuse", {{"angle", "angle"}, {"slope", "angle"}}, {{"factor", "factor"}}},
      {"specular", specular, {{"factor", "factor"}}},
      {"diffuse_probe", probe, {{"product", "product_word"}}},
      {"specular_probe", probe, {{"product", "product_word"}}},
  };
}

// What the shading processors have beside the walk; processors_pkg says where the blocks lie.
std::vector<Layout> processors_layouts(bool exact) {
  std::vector<Field> axis = {{"place", "light_place"}, {"axis", "direction"}};
  if (!exact) axis.push_back({"half", "direction"});
  std::vector<Field> light = {{"positional", "flag"}, {"spot", "flag"}};
  if (exact) light.push_back({"shift", "light_shift"});
  light.insert(light.end(),
               {{"outer", "direction"}, {"slope", "spot_slope"}, {"around_eye", "shadow_count"}});
  return {
      {"request", {{"command", "command"}, {"light", "light"}, {"opens", "flag"}, {"normalize", "flag"}}, {}},
      {"plane",
       {{"value", "plane_sum"}, {"dx", "plane_sum"}, {"de0", "plane_sum"}, {"de1", "plane_sum"}},
       {}},
      {"pixel",
       {{"command", "command"},
        {"light", "light"},
        {"opens", "flag"},
        {"normalize", "flag"},
        {"triangle", "triangle"},
        {"y", "pixel_y"},
        {"x", "pixel_x"},
        {"z", "depth"}},
       {}},
      {"light_axes", light, axis},
      {"light_colour", {}, {{"intensity", "light_intensity"}}},
      {"processor_probe", {{"leaves", "flag"}, {"command", "command"}}, {{"radiance", "radiance"}}},
  };
}

std::vector<Layout> joined(std::vector<Layout> a, const std::vector<Layout>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Layout> exact_layouts() {
  return {
      {"init",
       {{"triangle", "triangle"},
        {"y", "pixel_y"},
        {"upper_lines", "lines"},
        {"lower_lines", "lines"},
        {"backward", "flag"},
        {"start_x", "span_x"},
        {"start_quotient", "span_x"},
        {"start_remainder", "edge_error"},
        {"start_divisor", "edge_error"},
        {"start_error", "edge_error"},
        {"start_carry", "flag"},
        {"upper_x", "span_x"},
        {"upper_quotient", "span_x"},
        {"upper_remainder", "edge_error"},
        {"upper_divisor", "edge_error"},
        {"upper_error", "edge_error"},
        {"upper_carry", "flag"},
        {"lower_x", "span_x"},
        {"lower_quotient", "span_x"},
        {"lower_remainder", "edge_error"},
        {"lower_divisor", "edge_error"},
        {"lower_error", "edge_error"},
        {"lower_carry", "flag"},
        {"z", "depth_sum"},
        {"z_dx", "depth_sum"},
        {"z_de0", "depth_sum"},
        {"z_de1", "depth_sum"}},
       {{"value", "intensity"},
        {"dx", "intensity"},
        {"de0", "intensity"},
        {"de1", "intensity"},
        {"dxx", "intensity"},
        {"dxe0", "intensity"},
        {"dxe1", "intensity"},
        {"de0e0", "intensity"},
        {"de0e1", "intensity"},
        {"de1e1", "intensity"}}},
      {"probe",
       {{"line_event", "flag"},
        {"span_event", "flag"},
        {"sample_event", "flag"},
        {"product_event", "flag"},
        {"line_y", "pixel_y"},
        {"line_start", "span_x"},
        {"line_stop", "span_x"},
        {"line_carry", "flag"},
        {"line_z", "depth_sum"},
        {"span_y", "pixel_y"},
        {"span_x", "span_x"},
        {"span_z", "depth_sum"}},
       {{"line_value", "intensity"},
        {"line_dx", "intensity"},
        {"line_de0", "intensity"},
        {"line_de1", "intensity"},
        {"span_value", "intensity"},
        {"span_dx", "intensity"}}},
  };
}

std::vector<Layout> published_layouts() {
  return {
      {"init",
       {{"triangle", "triangle"},
        {"y", "pixel_y"},
        {"upper_lines", "lines"},
        {"start_x", "edge_x"},
        {"start_slope", "edge_x"},
        {"upper_x", "edge_x"},
        {"upper_slope", "edge_x"},
        {"z", "depth_sum"},
        {"z_dx", "depth_sum"},
        {"z_de0", "depth_sum"}},
       {{"value", "intensity"},
        {"dx", "intensity"},
        {"de0", "intensity"},
        {"dxx", "intensity"},
        {"dxe0", "intensity"},
        {"de0e0", "intensity"}}},
      {"probe",
       {{"line_event", "flag"},
        {"span_event", "flag"},
        {"sample_event", "flag"},
        {"product_event", "flag"},
        {"line_y", "pixel_y"},
        {"line_start", "span_x"},
        {"line_stop", "span_x"},
        {"line_z", "depth_sum"},
        {"span_y", "pixel_y"},
        {"span_x", "span_x"},
        {"span_z", "depth_sum"}},
       {{"line_value", "intensity"},
        {"line_dx", "intensity"},
        {"line_de0", "intensity"},
        {"span_value", "intensity"},
        {"span_dx", "intensity"}}},
  };
}

// Fields that only one preset has become null slices in the other, so that one RTL source serves both.
std::vector<std::string_view> all_names(const std::vector<PresetFormats>& presets, std::size_t layout,
                                        std::vector<Field> Layout::*part) {
  std::vector<std::string_view> names;
  for (const PresetFormats& preset : presets)
    for (const Field& field : preset.layouts[layout].*part)
      if (std::ranges::find(names, field.name) == names.end()) names.push_back(field.name);
  return names;
}

int total_bits(const PresetFormats& preset, const std::vector<Field>& fields) {
  int bits = 0;
  for (const Field& field : fields) bits += format_of(preset, field.format).bits();
  return bits;
}

std::string vhdl_slices(const PresetFormats& preset, const std::vector<Field>& fields,
                        const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) {
    int low = 0, bits = 0;
    for (const Field& field : fields) {
      const int width = format_of(preset, field.format).bits();
      if (field.name == name) {
        bits = width;
        break;
      }
      low += width;
    }
    if (bits == 0) low = 0;
    fmt::format_to(std::back_inserter(text), "    {} => ({}, {}),\n", name, low + bits - 1, low);
  }
  text.resize(text.size() - 2);
  return text + "\n";
}

std::string upper_first(std::string_view name) {
  std::string text(name);
  text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

constexpr std::string_view c_notice = "Made by `make tables` from model/tables/formats.cpp; edit that.";

}  // namespace

std::vector<PresetFormats> preset_formats() {
  return {
      {"exact",
       joined(
           common_formats(),
           {{"edge_error", false, 18, 0,
             "below the edge's height in subpixels: 8192 pixels of 16, doubled at no level of subdivision"},
            {"edge_x", true, 13, 0, "an edge is a whole pixel and a remainder"},
            {"intensity", true, 11, 28,
             "second differences, each word rounded to 2^-29, k = 4095 lines + 8190 steps: off by at most "
             "(1 + k + k^2/2) 2^-29 = 0.15 of a colour step; samples up to 1023 stay within +-2046"},
            {"angle", true, 10, 22,
             "half bells; start and slope each rounded to 2^-23, at most 4095 steps: off by at most 2^-11, a "
             "quarter "
             "of a 2^-9 cell; exponents up to 10^6 stay within +-1024"},
            {"power", false, 3, 0, "which table: cosine to the power 2^word"},
            {"plane_sum", true, 1, 42,
             "first differences, each rounded to 2^-43, at most 4095 lines and 8190 steps: off by at most "
             "12286 2^-43 = 0.4 of a step of vector"},
            {"vector", true, 1, 28, "interpolated N/w, view ray and 1/w, the largest scaled to 1/2 to 1"},
            {"direction", true, 1, 22,
             "components of unit vectors; an exponent m multiplies the error of a cosine by m"},
            {"offset", true, 2, 28, "from a surface point to a light, before it is normalized"},
            {"light_place", true, 1, 26, "a light's direction, or its place with 2^light_shift taken off"},
            {"light_shift", false, 5, 0, "how much farther a light may be than the nearest surface: 2^31"},
            {"square", false, 2, 28, "of a vector's length, 1/4 to 3"},
            {"root_entry", false, 0, 12, "table of 1/sqrt(x), 512 entries: within 2^-9.8 of it"},
            {"root", false, 1, 23, "after a Newton step: within 2^-19 of 1/sqrt(x)"},
            {"exponent", false, 13, 8, "up to 8191; off by 2^-9: 0.0008 of a highlight's peak at most"},
            {"weight", false, 1, 16, "a power of a cosine, or of a spot's edge"},
            {"coefficient", false, 4, 16, "k of a material, up to 15"},
            {"light_intensity", false, 14, 4, "colour steps, 64 times white"},
            {"reflected", false, 14, 8, "k I in colour steps; held at 64 times white"},
            {"radiance", false, 10, 12, "sum of the terms in colour steps; held at four times white"},
            {"factor", false, 16, 8,
             "off by at most 2^-9 of a step; the largest times the least entry of up to 8 bits is white, so "
             "what is brighter needs no more"},
            {"product_word", false, 40, 0, "a factor times a table's entry, for the probe"}}),
       joined(joined(exact_layouts(), spherical_layouts(true)), processors_layouts(true))},
      {"published",
       joined(
           common_formats(),
           {{"edge_error", false, 0, 0, "edges are stepped by a real slope"},
            {"edge_x", true, 13, 18, "32 bits, as the quadratic paper's other registers"},
            {"intensity", true, 11, 20, "32 bits, 20 of them fraction: the quadratic paper's figure 7"},
            {"angle", true, 0, 11,
             "12 bits, the upper 6 of them the address: the spherical paper's line interpolator; wraps at "
             "the "
             "bell's ends"},
            {"power", false, 0, 0, "cosine squared alone"},
            {"plane_sum", true, 1, 26, "first differences: off by at most 12286 2^-27 = 1.5 steps of vector"},
            {"vector", true, 1, 14, "16 bits: the processors paper names no width; interpolated N and P"},
            {"direction", true, 1, 14, "16 bits, so that an N that is not normalized passes as it is"},
            {"offset", true, 2, 14, "from a surface point to a light, before it is normalized"},
            {"light_place", true, 1, 14, "as vector"},
            {"light_shift", false, 0, 0, "places share one scale"},
            {"square", false, 2, 14, "of a vector's length, 1/4 to 3"},
            {"root_entry", false, 0, 9, "table of 1/sqrt(x), 64 entries: within 2^-6.4 of it"},
            {"root", false, 0, 9, "the table's entry"},
            {"exponent", false, 10, 0, "integers up to 1023"},
            {"weight", false, 1, 8, "a power of a cosine, or of a spot's edge"},
            {"coefficient", false, 1, 7, "an integer, in 1/128"},
            {"light_intensity", false, 8, 0, "an integer, in colour steps"},
            {"reflected", false, 8, 0, "k I, an integer"},
            {"radiance", false, 8, 0, "an integer; held at white"},
            {"factor", false, 10, 8, "colour steps up to 1023; off by at most 2^-9 of a step"},
            {"product_word", false, 36, 0, "a factor times a table's entry, for the probe"}}),
       joined(joined(published_layouts(), spherical_layouts(false)), processors_layouts(false))},
  };
}

std::string vhdl_package(const std::vector<PresetFormats>& presets) {
  std::string out = fmt::format(
      "-- SPDX-License-Identifier: Apache-2.0\n-- {}\n"
      "-- Number formats and the layouts of the flat vectors, for both presets. A slice of (-1, 0) is a "
      "field that\n"
      "-- the preset does not have.\n\nlibrary ieee;\n  use ieee.std_logic_1164.all;\n\npackage formats_pkg "
      "is\n\n",
      c_notice);
  auto to = std::back_inserter(out);
  out += "  type format_t is record\n    bits     : natural;\n    fraction : natural;\n  end record;\n\n";
  out += "  type slice_t is record\n    high : integer;\n    low  : natural;\n  end record;\n\n";
  out += "  type formats_t is record\n";
  for (const Format& format : presets[0].formats) fmt::format_to(to, "    {} : format_t;\n", format.name);
  out += "  end record;\n\n";
  for (const PresetFormats& preset : presets) {
    fmt::format_to(to, "  constant c_{}_formats : formats_t := (\n", preset.name);
    for (const Format& format : preset.formats)
      fmt::format_to(to, "    -- {}{}.{}: {}\n    {} => ({}, {}){}\n", format.is_signed ? 's' : 'u',
                     format.integer_bits, format.fraction_bits, format.why, format.name, format.bits(),
                     format.fraction_bits, &format == &preset.formats.back() ? "" : ",");
    out += "  );\n\n";
  }
  out += "  function formats (exact : boolean) return formats_t;\n\n";
  for (std::size_t i = 0; i < presets[0].layouts.size(); ++i) {
    const std::string_view layout = presets[0].layouts[i].name;
    for (const auto& [part, members] :
         {std::pair{"header", &Layout::header}, std::pair{"channel", &Layout::channel}}) {
      const std::vector<std::string_view> names = all_names(presets, i, members);
      if (!names.empty()) {
        fmt::format_to(to, "  type {}_{}_t is record\n", layout, part);
        for (const std::string_view name : names) fmt::format_to(to, "    {} : slice_t;\n", name);
        out += "  end record;\n\n";
        for (const PresetFormats& preset : presets)
          fmt::format_to(to, "  constant c_{}_{}_{} : {}_{}_t := (\n{}  );\n\n", preset.name, layout, part,
                         layout, part, vhdl_slices(preset, preset.layouts[i].*members, names));
        fmt::format_to(to, "  function {}_{} (exact : boolean) return {}_{}_t;\n\n", layout, part, layout,
                       part);
      }
      for (const PresetFormats& preset : presets)
        fmt::format_to(to, "  constant c_{}_{}_{}_bits : natural := {};\n", preset.name, layout, part,
                       total_bits(preset, preset.layouts[i].*members));
      out += "\n";
    }
    fmt::format_to(to, "  function {}_channel_low (exact : boolean; channel : natural) return natural;\n\n",
                   layout);
    fmt::format_to(to, "  function {}_bits (exact : boolean; channels : natural) return natural;\n\n",
                   layout);
  }
  out += "end package;\n\npackage body formats_pkg is\n\n";
  const auto choose = [&](std::string_view name, std::string_view type, std::string_view suffix) {
    fmt::format_to(to,
                   "  function {0} (exact : boolean) return {1} is\n  begin\n    if exact then\n"
                   "      return c_exact_{2};\n    end if;\n    return c_published_{2};\n  end function;\n\n",
                   name, type, suffix);
  };
  choose("formats", "formats_t", "formats");
  for (const Layout& layout : presets[0].layouts) {
    const std::string name(layout.name);
    if (!layout.header.empty()) choose(name + "_header", name + "_header_t", name + "_header");
    if (!layout.channel.empty()) choose(name + "_channel", name + "_channel_t", name + "_channel");
    fmt::format_to(
        to,
        "  function {0}_channel_low (exact : boolean; channel : natural) return natural is\n  begin\n"
        "    if exact then\n      return c_exact_{0}_header_bits + channel * c_exact_{0}_channel_bits;\n    "
        "end if;\n"
        "    return c_published_{0}_header_bits + channel * c_published_{0}_channel_bits;\n  end "
        "function;\n\n"
        "  function {0}_bits (exact : boolean; channels : natural) return natural is\n  begin\n"
        "    return {0}_channel_low(exact, channels);\n  end function;\n\n",
        name);
  }
  out += "end package body;\n";
  return out;
}

std::string cpp_header(const std::vector<PresetFormats>& presets) {
  std::string out = fmt::format(
      "// SPDX-License-Identifier: Apache-2.0\n// {}\n// Number formats and the layouts of the flat vectors, "
      "for both "
      "presets.\n#pragma once\n\n#include <array>\n#include <string_view>\n\n"
      "namespace halfway::golden {{\n\n"
      "/// A named word in a flat vector, bit 0 first; in a channel's block `low` counts from the block's "
      "start.\n"
      "struct Field {{\n  std::string_view name;\n  int low, bits;\n  bool is_signed;\n  int "
      "fraction_bits;\n}};\n\n",
      c_notice);
  auto to = std::back_inserter(out);
  for (const PresetFormats& preset : presets) {
    fmt::format_to(to, "struct {} {{\n  static constexpr std::string_view c_name = \"{}\";\n",
                   upper_first(preset.name), preset.name);
    for (const Format& format : preset.formats)
      fmt::format_to(to,
                     "  // {}{}.{}: {}\n  static constexpr int c_{}_bits = {};\n"
                     "  static constexpr int c_{}_fraction_bits = {};\n",
                     format.is_signed ? 's' : 'u', format.integer_bits, format.fraction_bits, format.why,
                     format.name, format.bits(), format.name, format.fraction_bits);
    for (const Layout& layout : preset.layouts)
      for (const auto& [part, fields] :
           {std::pair{"header", &layout.header}, std::pair{"channel", &layout.channel}}) {
        const std::string name = fmt::format("{}_{}", layout.name, part);
        fmt::format_to(to, "\n  static constexpr int c_{}_bits = {};\n", name, total_bits(preset, *fields));
        if (fields->empty()) continue;
        fmt::format_to(to, "  static constexpr std::array<Field, {}> c_{} = {{{{\n", fields->size(), name);
        int low = 0;
        for (const Field& field : *fields) {
          const Format& format = format_of(preset, field.format);
          fmt::format_to(to, "      {{\"{}\", {}, {}, {}, {}}},\n", field.name, low, format.bits(),
                         format.is_signed, format.fraction_bits);
          low += format.bits();
        }
        out += "  }};\n";
        fmt::format_to(to, "  struct {}_at {{\n", name);
        for (std::size_t i = 0; i < fields->size(); ++i)
          fmt::format_to(to, "    static constexpr const Field& {} = c_{}[{}];\n", (*fields)[i].name, name,
                         i);
        out += "  };\n";
      }
    out += "};\n\n";
  }
  out += "}  // namespace halfway::golden\n";
  return out;
}

}  // namespace halfway::tables
