// SPDX-License-Identifier: Apache-2.0
#include "words/generator/layout_page.hpp"

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
     "The vector of the quadratic shader: one header, then one block per channel (1 or 3). With `g_degree` = "
     "1 a block ends before `dxx`. The other shaders "
     "start their vectors with the same header. In preset `exact` a triangle is one vector, or several if an "
     "edge leaves the frame. In preset `published` it is one or two vectors: each half has a horizontal "
     "side.\n\n"
     "`exact`: from a line to the next one the start edge moves by e0 = (q, 1), with q = `start_quotient`, "
     "or, with *carry*, by e1 = (q + 1, 1). The edge carries if its error is less than the remainder. x is a "
     "step along the span: +1, or -1 with `backward`. The names of the differences give their steps: `de0e1` "
     "is the mixed second difference along e0 and e1. `published`: the start edge moves by its real slope.",
     "`model/setup/walk.cpp` (edges of `exact`), `half_triangle.cpp` (header of `published`), "
     "`quadratic_fit.cpp` and `quadratic_setup.cpp` (depth, channels)"},
    {"ambient", "Ambient light of the spherical shader", "Follows the header, one block per channel.",
     "`model/setup/spherical_setup.cpp`"},
    {"diffuse", "Diffuse part of a line record (spherical shader)",
     "One line record per line follows the triangle's vector. It holds for each light its diffuse part, then "
     "its specular part; light 1 is lowest. On the line, N·L = A cos Θ. I is the intensity of the light (1 "
     "is white) and k_d the material's coefficient times its colour, both in this channel. c is the share of "
     "a spot's cone (1 for other lights), and D the number of data bits of the table. The unit of Θ is a "
     "quarter turn (half a bell) in preset `exact`, where the cosine is zero at 1, and a half turn in preset "
     "`published`.",
     "`model/setup/spherical_setup.cpp`, `arc.cpp`"},
    {"specular", "Specular part of a line record (spherical shader)",
     "One block per highlight channel: 1 if all highlights are white or grey, otherwise 3. On the line, N·H "
     "(of Phong materials R·V, with R = 2 (N·L) N − L) = A cos Θ. n is the material's exponent and k_s its "
     "coefficient times the highlight's colour; I, c and D are as in the diffuse part. The bell with scale a "
     "and gain g approximates cosⁿ (`model/shading/bell.hpp`; g is 1 in preset `published`). The words "
     "contain the product of a and Θ, in half bells: the highlight is zero at 1.",
     "`model/setup/spherical_setup.cpp`, `arc.cpp`"},
    {"request", "Request of the shading processors",
     "Every vector of the shading processors starts with a request. Its command gives what follows:\n\n"
     "| command | number | after the request |\n"
     "| --- | --- | --- |\n"
     "| new_object | 1 | a triangle: header of preset `exact`, planes, material |\n"
     "| new_scanline | 2 | [a strip](objects.md#vectors), in the header; only with `g_objects` |\n"
     "| new_frame | 3 | with subpixels the background, as the colour of a light; otherwise nothing |\n"
     "| define | 4 | axes and colour of the light; for light 0 (ambient) only the colour is read |\n"
     "| redefine | 5 | as define; only if the light is defined |\n"
     "| delete | 6 | nothing |\n"
     "| shadow | 7 | a shadow polygon: header of preset `exact`; only with `g_shadows` |\n\n"
     "Both presets of the processors have the header of preset `exact`. A frame starts with new_frame and a "
     "define for the ambient light and for each light. Lights are numbered from 1: directional, positional, "
     "spots. A vector for a light that does not exist, or with another command, is a fault. `processors_pkg` "
     "computes the positions of the blocks "
     "from the generics (`walk_low`, `plane_low`, `init_material_low`, `light_axes_low`, "
     "`light_colour_low`).",
     "`model/setup/processors_setup.cpp`"},
    {"plane", "Plane of the shading processors",
     "A value that is linear on the screen. One block each for N x, y, z; then for P x, y, z; then for 1/w. "
     "Preset `exact`: N/w, P/w (the view ray) and 1/w; preset `published`: N and P. P is present with "
     "positional lights or spots, in preset `exact` also with highlights. 1/w is present only in preset "
     "`exact` with positional lights or spots. All are in view space and scaled by powers of two to "
     "components below 1.",
     "`model/setup/processors_setup.cpp`"},
    {"light_axes", "Light of the shading processors",
     "One header, then one block per axis x, y, z, in view space. A position has the scale of P; in preset "
     "`exact` it is divided by 2^`shift`, too, and the hardware shifts the surface point by as many bits.",
     "`model/setup/processors_setup.cpp`, `shadow_volume.cpp` (around_eye)"},
    {"light_colour", "Colour of a light", "Follows the axes, one block per channel.",
     "`model/setup/processors_setup.cpp`"},
};

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
    fmt::format_to(to, "| {} | `{}` | {}:{} | {} | {} |\n", block, field.name, low + format.bits() - 1, low,
                   format.text(), field.meaning);
    low += format.bits();
  }
}

/// The total number of bits, if the section shows more than one block.
void add_bits(std::string& page, const PresetFormats& preset, const Section& section, const Layout& layout) {
  if (layout.header.empty() || layout.channel.empty()) return;
  const int header = total_bits(preset, layout.header), block = total_bits(preset, layout.channel);
  auto to = std::back_inserter(page);
  if (section.layout == "light_axes")
    fmt::format_to(to, "\nHeader: {} bits; an axis: {}; together {}.\n", header, block, header + 3 * block);
  else
    fmt::format_to(to, "\nHeader: {} bits; a channel: {}; with one channel {}, with three {}.\n", header,
                   block, header + block, header + 3 * block);
}

void add_material(std::string& page, const std::vector<PresetFormats>& presets) {
  auto to = std::back_inserter(page);
  page +=
      "\n## Material of the shading processors\n\n"
      "Follows the planes of a triangle. The words are listed from bit 0 up; a word that the generics do not "
      "need "
      "takes no bits. Channels are in the order red, green, blue.\n\n"
      "Computed by `model/setup/processors_setup.cpp`.\n";
  for (const PresetFormats& preset : presets) {
    fmt::format_to(to,
                   "\nPreset `{}`:\n\n| word | number | bits each | format | present with | meaning |\n"
                   "| --- | --- | --- | --- | --- | --- |\n",
                   preset.name);
    for (const MaterialWord& word : c_material) {
      const Format& format = format_of(preset, word.format);
      fmt::format_to(to, "| `{}` | {} | {} | {} | {} | {} |\n", word.name, word.count, format.bits(),
                     format.text(), word.condition, word.meaning);
    }
  }
}

}  // namespace

std::string layout_page(const std::vector<PresetFormats>& presets) {
  std::string page =
      "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
      "<!-- Made by `make tables` from model/words/generator; edit that. -->\n"
      "# Init vectors\n\n"
      "What the host sends to the hardware, field by field. Fields are listed from bit 0 up. In a block the "
      "bits count from the start of the block. A format `sI.F` or `uI.F` is signed or unsigned with I "
      "integer "
      "bits (without the sign) and F fraction bits: its value is the word divided by 2^F. Colours are in "
      "colour steps (1/255 of white), depths in steps of the 24-bit depth, positions on the screen in "
      "pixels. In the RTL the same bit ranges are functions of `formats_pkg`: "
      "`init_header(g_exact).start_x` and the like; in C++ they are "
      "`words::Exact::init_header_at::start_x`.\n\n"
      "**Added halves.** The hardware drops fractions instead of rounding. The host therefore adds half a "
      "step of the result to the words whose row says *plus*: 0.5 colour steps, depth steps or pixels; 2^-29 "
      "or 2^-15 for planes, half a step of the interpolated word.\n";
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
      add_bits(page, preset, section, layout);
    }
    if (section.layout == "plane") add_material(page, presets);
  }
  return page;
}

}  // namespace halfway::tables
