// SPDX-License-Identifier: Apache-2.0
#include "tables/layout_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace halfway::tables {
namespace {

/// A vector, or a block of one, and where its words come from.
struct Section {
  std::string_view layout, title, text, source;
};

constexpr Section c_sections[] = {
    {"init", "Header and channels of a triangle",
     "The vector of the quadratic shader: one header, then one block per channel (1 or 3). The other shaders "
     "start their vectors with the same header. `carry`: the start edge moves one pixel more than its "
     "quotient on this line. e0 and e1 are the steps of the start edge without and with carry, x a step "
     "along the span; `de0e1` is the mixed second difference along e0 and e1, and so on.",
     "`model/setup/walk.cpp` (edges) and `quadratic_fit.cpp` (depth, channels)"},
    {"ambient", "Ambient light of the spherical shader", "Follows the header, one block per channel.",
     "`model/setup/spherical_setup.cpp`"},
    {"diffuse", "Diffuse part of a line record (spherical shader)",
     "A line record holds for each light its diffuse part, then its specular part. It follows the triangle's "
     "vector, one record per line. Angles are in half bells: at 1 the highlight or the cosine is zero.",
     "`model/setup/spherical_setup.cpp`, `arc.cpp`"},
    {"specular", "Specular part of a line record (spherical shader)",
     "One factor per highlight channel: 1 if all highlights are white, otherwise 3.",
     "`model/setup/spherical_setup.cpp`, `arc.cpp`"},
    {"request", "Request of the shading processors",
     "Every vector of the shading processors starts with a request. A triangle (draw, depth) continues with "
     "the header of preset `exact`, its planes and its material; a light (define, redefine) with its axes "
     "and "
     "colour.",
     "`model/setup/processors_setup.cpp`"},
    {"plane", "Plane of the shading processors",
     "A value that is linear on the screen: N x, y, z; then the surface point or the view ray x, y, z; then "
     "1/w. Which of them are present depends on the lights (`processors_pkg`).",
     "`model/setup/processors_setup.cpp`"},
    {"light_axes", "Light of the shading processors", "One header, then one block per axis x, y, z.",
     "`model/setup/processors_setup.cpp`, `shadow_volume.cpp` (around_eye)"},
    {"light_colour", "Colour of a light", "Follows the axes, one block per channel.",
     "`model/setup/processors_setup.cpp`"},
};

const Format& format_of(const PresetFormats& preset, std::string_view name) {
  return *std::ranges::find(preset.formats, name, &Format::name);
}

const Layout& layout_of(const PresetFormats& preset, std::string_view name) {
  return *std::ranges::find(preset.layouts, name, &Layout::name);
}

/// One row per field; bits count from the start of the block.
void add_fields(std::string& page, const PresetFormats& preset, const std::vector<Field>& fields,
                std::string_view block) {
  auto to = std::back_inserter(page);
  int low = 0;
  for (const Field& field : fields) {
    const Format& format = format_of(preset, field.format);
    fmt::format_to(to, "| {} | `{}` | {}:{} | {}{}.{} | {} |\n", block, field.name, low + format.bits() - 1,
                   low, format.is_signed ? 's' : 'u', format.integer_bits, format.fraction_bits,
                   field.meaning);
    low += format.bits();
  }
}

}  // namespace

std::string layout_page(const std::vector<PresetFormats>& presets) {
  std::string page =
      "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
      "<!-- Made by `make tables` from model/tables; edit that. -->\n"
      "# Init vectors\n\n"
      "What the host sends to the hardware, field by field. Bit 0 comes first. In a block the bits count "
      "from "
      "the start of the block. A format `sI.F` or `uI.F` is signed or unsigned with I integer bits (without "
      "the sign) and F fraction bits. In the RTL the same slices are constants of `formats_pkg`: "
      "`init_header(g_exact).start_x` and the like; in C++ they are "
      "`golden::Exact::init_header_at::start_x`.\n";
  auto to = std::back_inserter(page);
  for (const Section& section : c_sections) {
    fmt::format_to(to, "\n## {}\n\n{}\n\nComputed by {}.\n", section.title, section.text, section.source);
    for (const PresetFormats& preset : presets) {
      const Layout& layout = layout_of(preset, section.layout);
      fmt::format_to(
          to,
          "\nPreset `{}`:\n\n| block | field | bits | format | meaning |\n| --- | --- | --- | --- | --- |\n",
          preset.name);
      add_fields(page, preset, layout.header, "header");
      add_fields(page, preset, layout.channel, section.layout == "light_axes" ? "axis" : "channel");
    }
  }
  return page;
}

}  // namespace halfway::tables
