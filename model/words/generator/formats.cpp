// SPDX-License-Identifier: Apache-2.0
#include "words/generator/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

namespace halfway::tables {

std::string Number::text() const {
  return fmt::format("{}{}.{}", is_signed ? 's' : 'u', integer_bits, fraction_bits);
}

const Format& format_of(const PresetFormats& preset, std::string_view name) {
  const auto it = std::ranges::find(preset.formats, name, &Format::name);
  if (it == preset.formats.end())
    throw std::logic_error(fmt::format("format '{}' is not in the table", name));
  return *it;
}

int total_bits(const PresetFormats& preset, const std::vector<Field>& fields) {
  int bits = 0;
  for (const Field& field : fields) bits += format_of(preset, field.format).bits();
  return bits;
}

namespace {

// A signed and an unsigned number, by the bits before and after its point.
constexpr Number s(int integer_bits, int fraction_bits) {
  return {true, integer_bits, fraction_bits};
}
constexpr Number u(int integer_bits, int fraction_bits) {
  return {false, integer_bits, fraction_bits};
}

// Formats common to both presets.
std::vector<Format> common_formats() {
  return {
      {u(1, 0), "flag", "one bit", {at_most(1, "1")}},
      {u(32, 0),
       "triangle",
       "number of the scene's triangle, carried through as a tag",
       {at_most(0x1p32 - 1, "2^32 - 1")}},
      {u(12, 0), "pixel_x", "frames up to 4096 pixels wide", {at_most(4095, "frame - 1")}},
      {u(12, 0), "pixel_y", "frames up to 4096 lines high", {at_most(4095, "frame - 1")}},
      {u(13, 0), "lines", "0 to 4096 lines", {at_most(4096, "frame")}},
      {s(13, 0), "span_x", "-1 to 4096: a span's end is exclusive on either side", {at_most(4096, "frame")}},
      {u(8, 0),
       "colour",
       "stored in the frame: the sum before it, rounded once and clamped",
       {at_most(255, "2^8 - 1"), off_by(0.5, "colour steps", "u / 2", "rounded")}},
      {u(24, 0),
       "depth",
       "compared by the depth test: the sum before it, rounded once",
       {at_most(0x1p24 - 1, "2^24 - 1"), off_by(0.5, "depth steps", "u / 2", "rounded")}},
      {s(24, 15),
       "depth_sum",
       "first differences, each word off by at most half a unit",
       {off_by(0.19, "depth steps", "(1 + k) * u / 2")}},
      {u(3, 0), "command", "of a vector or token of the shading processors", {at_most(7, "7")}},
      {u(5, 0), "light", "a light's number from 1; 0 is the ambient light", {at_most(16, "lights")}},
      {s(9, 0),
       "shadow_count",
       "shadow volumes of a light: those around the eye, limited to 511; those opened at a pixel minus those "
       "closed, at most one for each object processor",
       {at_most(511, "2^9 - 1")}},
      {u(18, 6),
       "spot_slope",
       "1 / width of a spot's soft edge, in cosines: at least 1/2. The largest slope is 2^18, so that a cone "
       "of a tenth of a degree reaches its full light. The share is t^2 (3 - 2t), where t is the slope times "
       "the distance of the cosine from the edge. Its error is 6 t^2 (1 - t), at most 8/9, times the "
       "relative error of the slope",
       {off_by(0x1p-7, "", "u / 2"),
        off_by(0.014, "of the spot's light", "8 / 9 * u / 2 / (1 / 2)", "share")}},
  };
}

// The quantities in the derivations. An edge of preset exact steps `lines` lines down with one extra pixel on
// each, and a span may run back over all these pixels: 4095 + 4095 `steps`, each of which adds a rounded word
// of its own. Preset published has no carries: a span has at most `pixels` steps, and so has a line record of
// either preset.
constexpr double c_frame = 4096, c_lines = c_frame - 1, c_pixels = c_frame - 1, c_steps = c_lines + c_pixels;
constexpr Quantity c_quantities[] = {
    {"frame", c_frame},     {"lines", c_lines},       {"pixels", c_pixels},
    {"steps", c_steps},     {"k", c_lines + c_steps}, {"k_published", c_lines + c_pixels},
    {"lights", 16},         {"terms", 2 * 16},  // truncated terms: a diffuse and a specular one per light
    {"e", std::numbers::e},
};

std::vector<Format> exact_formats() {
  return {
      {u(18, 0),
       "edge_error",
       "up to the edge's height in subpixels: 16 per pixel from -2048 to 6143; subdivision does not double "
       "it",
       {at_most(131056, "(6143 + 2048) * 16")}},
      {s(13, 0), "edge_x", "an edge is a whole pixel and a remainder", {at_most(4096, "frame")}},
      {s(11, 28),
       "intensity",
       "second differences; each word is off by at most half a unit. So is each sample; the weights of the "
       "six samples add up to at most 5/3. With samples up to 1023 the quadratic stays within +-2046",
       {off_by(0.15, "colour steps", "(1 + k + k * (k - 1) / 2) * u / 2"),
        off_by(3.2e-9, "colour steps", "5 / 3 * u / 2", "samples")}},
      {s(10, 22),
       "angle",
       "half bells; start and slope are each off by at most half a unit, together a quarter of a 2^-9 cell; "
       "exponents up to 10^6 stay within +-1024",
       {off_by(0x1p-11, "half bells", "(1 + pixels) * u / 2")}},
      {u(3, 0), "power", "which table: cosine to the power 2^word", {at_most(4, "4")}},
      {s(1, 42),
       "plane_sum",
       "first differences, each word off by at most half a unit",
       {off_by(0.4, "steps of vector", "(1 + k) * u / 2 / u_vector")}},
      {s(1, 28),
       "vector",
       "interpolated N/w, view ray and 1/w, scaled so that the largest component is 1/2 to 1; plane_sum "
       "rounded",
       {off_by(0x1p-29, "", "u / 2")}},
      {s(1, 22),
       "direction",
       "components of unit vectors, rounded; an exponent m multiplies the error of a cosine by m. The error "
       "of the length: that of root, half that of a square of at least 1/4, and three rounded components. "
       "The error of the angle: a vector of at least 1/2 whose components are cut by half a unit (at most "
       "3.1 halves across it), and rounding (1.8)",
       {off_by(0x1p-23, "", "u / 2", "component"),
        off_by(1.42e-6, "", "1.2 * 10^-6 + 2 * u_square + sqrt(3) * u / 2", "length"),
        off_by(5.9e-7, "radians", "4.9 * u / 2", "angle")}},
      {s(2, 28),
       "offset",
       "from a surface point to a light, before it is normalized: the light's position is rounded, the "
       "point's is cut",
       {off_by(0x1.8p-28, "", "(1 / 2 + 1) * u")}},
      {s(1, 26),
       "light_place",
       "a light's direction, or its position divided by 2^light_shift",
       {off_by(0x1p-27, "", "u / 2")}},
      {u(5, 0),
       "light_shift",
       "a light may be 2^31 times as far as the nearest surface",
       {at_most(31, "31")}},
      {u(2, 28), "square", "square of a vector's length, 1/4 to 3; cut", {off_by(0x1p-28, "", "u")}},
      {u(0, 12),
       "root_entry",
       "table of 1/sqrt(x), 512 entries: half a step, and half a cell of 2^-8 times the slope, 1/2 to 1",
       {off_by(0.0011, "", "u / 2 + 2^-8 / 2 / 2"),
        off_by(0.00115, "of it", "sqrt(2) * u / 2 + 2^-8 / 2 / 2", "relative")}},
      {u(1, 23),
       "root",
       "after a Newton step from an entry with relative error r: too small by 3/2 r^2; raised by 17/2 units, "
       "cut by half a unit and by one unit (sqrt(2) of the result at x = 2, where r is largest)",
       {off_by(1.2e-6, "of it", "3 / 2 * 0.00115^2 - (17 - 1) / 2 * u + sqrt(2) * u")}},
      {u(13, 8),
       "exponent",
       "up to 8191; an error dn changes x^n by x^n ln(1/x) dn, at most dn/(e n)",
       {off_by(0x1p-9, "", "u / 2"), off_by(0.0008, "of a highlight's peak", "u / 2 / e", "highlight")}},
      {u(1, 16),
       "weight",
       "a power of a cosine, or the share of a spot for slopes up to 2^12: t is cut by a unit and by 2^-28 "
       "of the slope, and the share changes by at most 3/2 of t; a diffuse term's cosine is rounded",
       {off_by(0.00101, "", "2^-15 + m * 2^-23", "power"),
        off_by(0x1.cp-15, "", "3 / 2 * (u + 2^12 * 2^-28) + u / 2", "spot"),
        off_by(0x1p-17, "", "u / 2", "diffuse")}},
      {u(4, 16), "coefficient", "k of a material, up to 15", {off_by(0x1p-17, "", "u / 2")}},
      {u(14, 4),
       "light_intensity",
       "colour steps, 64 times white",
       {off_by(0x1p-5, "colour steps", "u / 2")}},
      {u(14, 8),
       "reflected",
       "k I in colour steps, rounded; clamped at 64 times white",
       {off_by(0x1p-9, "colour steps", "u / 2")}},
      {u(10, 12),
       "radiance",
       "sum of the terms in colour steps, each cut except the ambient one; clamped at four times white",
       {off_by(0x1p-7, "colour steps", "terms * u")}},
      {u(16, 8),
       "factor",
       "colour steps; the largest factor times the smallest entry of 8 bits is white, so a larger factor "
       "would change nothing",
       {off_by(0x1p-9, "colour steps", "u / 2")}},
  };
}

std::vector<Format> published_formats() {
  return {
      {u(0, 0), "edge_error", "edges are stepped by a real slope", {at_most(0, "0")}},
      {s(13, 18),
       "edge_x",
       "32 bits, as the quadratic paper's other registers; start and slope each off by at most half a unit",
       {off_by(0x1p-7, "pixels", "(1 + lines) * u / 2")}},
      {s(11, 20),
       "intensity",
       "32 bits with 20 fraction bits: the quadratic paper's figure 7; second differences, each word off by "
       "at most half a unit: 4 colour steps after 4095 steps. The error of edges between pixels is "
       "additional",
       {off_by(16, "colour steps", "(1 + k_published + k_published * (k_published - 1) / 2) * u / 2"),
        off_by(8e-7, "colour steps", "5 / 3 * u / 2", "samples")}},
      {s(0, 11),
       "angle",
       "12 bits, the upper 6 of them the address: the spherical paper's line interpolator. That it wraps at "
       "the bell's ends is our reading. Start and slope are each off by at most half a unit: 8 addresses "
       "after 1023 steps",
       {off_by(1, "half bells", "(1 + pixels) * u / 2")}},
      {u(0, 0), "power", "only cosine squared", {at_most(0, "0")}},
      {s(1, 26),
       "plane_sum",
       "first differences, each word off by at most half a unit",
       {off_by(1.5, "steps of vector", "(1 + k) * u / 2 / u_vector")}},
      {s(1, 14),
       "vector",
       "16 bits: the processors paper's text gives no width; interpolated N and P, plane_sum rounded",
       {off_by(0x1p-15, "", "u / 2")}},
      {s(1, 14),
       "direction",
       "16 bits, so that an N that is not normalized is not changed; otherwise as in preset exact, but "
       "vectors of at most 17 bits are cut, by a quarter of a unit",
       {off_by(0x1p-15, "", "u / 2", "component"),
        off_by(0.0094, "", "0.0092 + 2 * u_square + sqrt(3) * u / 2", "length"),
        off_by(1.02e-4, "radians", "3.3 * u / 2 * (1 + 0.0094)", "angle")}},
      {s(2, 14),
       "offset",
       "from a surface point to a light, before it is normalized; with the vector to the eye, a sum of three "
       "words below 2",
       {at_most(4, "(2 - u) + 1 + 1")}},
      {s(1, 14), "light_place", "as vector", {off_by(0x1p-15, "", "u / 2")}},
      {u(0, 0), "light_shift", "all positions have one scale", {at_most(0, "0")}},
      {u(2, 14), "square", "square of a vector's length, 1/4 to 3; cut", {off_by(0x1p-14, "", "u")}},
      {u(0, 9),
       "root_entry",
       "table of 1/sqrt(x), 64 entries: half a step, and half a cell of 2^-5 times the slope, 1/2 to 1",
       {off_by(0.0088, "", "u / 2 + 2^-5 / 2 / 2"),
        off_by(0.0092, "of it", "sqrt(2) * u / 2 + 2^-5 / 2 / 2", "relative")}},
      {u(0, 9), "root", "the table's entry", {off_by(0.0092, "of it", "sqrt(2) * u / 2 + 2^-5 / 2 / 2")}},
      {u(10, 0),
       "exponent",
       "integers up to 1023",
       {off_by(0.5, "", "u / 2"), off_by(0.184, "of a highlight's peak", "u / 2 / e", "highlight")}},
      {u(1, 8),
       "weight",
       "a power of a cosine, or the share of a spot: next to 1 the middle of a cell of the logarithm and its "
       "rounding are off by 0.0062, so that an m-th power falls by e^(-m / 232); 2^-x, rounding and the cut "
       "of the product are additional. A diffuse term's cosine is rounded",
       {off_by(1, "", "1 - e^(-m / 232) + 0.0074 + u / 2 + 2^-10", "power"),
        off_by(0x1p-7, "", "3 / 2 * u + u / 2", "spot"), off_by(0x1p-9, "", "u / 2", "diffuse")}},
      {u(1, 7), "coefficient", "an integer, in 1/128", {off_by(0x1p-8, "", "u / 2")}},
      {u(8, 0), "light_intensity", "an integer, in colour steps", {off_by(0.5, "colour steps", "u / 2")}},
      {u(8, 0), "reflected", "k I, an integer, rounded", {off_by(0.5, "colour steps", "u / 2")}},
      {u(8, 0),
       "radiance",
       "an integer: each term except the ambient one is cut; clamped at white",
       {off_by(32, "colour steps", "terms * u")}},
      {u(10, 8), "factor", "colour steps up to 1023", {off_by(0x1p-9, "colour steps", "u / 2")}},
  };
}

template <class Item>
std::vector<Item> joined(std::vector<Item> a, const std::vector<Item>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Fields of the spherical shader, except those of the walk: one word per channel after the header of `init`;
// then for each line and light a diffuse and a specular part. Angles are in units of half a bell: the bell
// reaches zero at 1.
std::vector<Layout> spherical_layouts(bool exact) {
  const std::vector<Field> diffuse = {{"angle", "angle", "Θ at the first pixel of the line"},
                                      {"slope", "angle", "change of Θ per pixel"}};
  std::vector<Field> specular = diffuse;
  if (exact) specular.push_back({"power", "power", "log2 of the cosine's power: which table is read"});
  return {
      {"ambient", {}, {{"ambient", "factor", "ambient light of the triangle, in colour steps, plus 0.5"}}},
      {"diffuse", diffuse, {{"factor", "factor", "255 I k_d A c 2^D / (2^D - 1), in colour steps"}}},
      {"specular", specular, {{"factor", "factor", "255 I k_s A^n g c 2^D / (2^D - 1), in colour steps"}}},
  };
}

// Fields of the shading processors, except those of the walk. processors_pkg defines the blocks' positions.
std::vector<Layout> processors_layouts(bool exact) {
  std::vector<Field> axis = {{"place", "light_place", "position of the light, or unit vector to it"},
                             {"axis", "direction", "unit vector along the cone's axis, away from the light"}};
  if (!exact)
    axis.push_back({"half", "direction", "directional: H of a constant eye; positional: vector to the eye"});
  std::vector<Field> light = {{"positional", "flag", "1: `place` is a position; 0: `place` is a direction"},
                              {"spot", "flag", "1: the light has a cone"}};
  if (exact)
    light.push_back({"shift", "light_shift", "number of bits by which the surface point is shifted right"});
  light.insert(light.end(),
               {{"outer", "direction", "cosine of the cone's outer half angle"},
                {"slope", "spot_slope", "1 / (cosine of inner - cosine of outer half angle)"},
                {"around_eye", "shadow_count", "number of shadow volumes that contain the eye"}});
  return {
      {"request",
       {{"command", "command", "number of the command"},
        {"light", "light", "number of the light from 1; 0: the ambient light, or no light"},
        {"opens", "flag", "shadow polygon: 1 opens a volume, 0 closes it"},
        {"normalize", "flag", "1: the ambient processor normalizes N"}},
       {}},
      {"plane",
       {{"value", "plane_sum",
         exact ? "value at the first pixel, plus 2^-29" : "value at the first pixel, plus 2^-15"},
        {"dx", "plane_sum", "change of the value per pixel along the span"},
        {"de0", "plane_sum", "change of the value per line without carry"},
        {"de1", "plane_sum", "change of the value per line with carry"}},
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
      {"light_colour",
       {},
       {{"intensity", "light_intensity", "intensity of the light, in colour steps: 255 is white"}}},
  };
}

std::vector<Layout> exact_layouts() {
  return {
      {"init",
       {{"triangle", "triangle", "number of the triangle in the scene; copied to its fragments"},
        {"y", "pixel_y", "first line"},
        {"upper_lines", "lines", "lines in the upper section of the stop edge, at least 1"},
        {"lower_lines", "lines", "lines in its lower section; 0: no lower section"},
        {"backward", "flag", "1: spans run to smaller x"},
        {"start_x", "span_x", "first pixel of the first line"},
        {"start_quotient", "span_x", "whole pixels per line of the start edge, rounded down"},
        {"start_remainder", "edge_error", "remainder of that division, in 1/start_divisor pixel"},
        {"start_divisor", "edge_error", "height of the start edge, in 1/16 pixel"},
        {"start_error", "edge_error",
         "distance from the edge to its pixel after the first step, in 1/start_divisor pixel"},
        {"start_carry", "flag", "1: the first step ends one pixel further right than the quotient says"},
        {"upper_x", "span_x", "pixel after the last one of the first line, in the direction of the span"},
        {"upper_quotient", "span_x", "whole pixels per line of the stop edge, upper section, rounded down"},
        {"upper_remainder", "edge_error", "remainder of that division, in 1/upper_divisor pixel"},
        {"upper_divisor", "edge_error", "height of that section, in 1/16 pixel"},
        {"upper_error", "edge_error",
         "distance from the edge to its pixel after the first step, in 1/upper_divisor pixel"},
        {"upper_carry", "flag", "1: the first step ends one pixel further right than the quotient says"},
        {"lower_x", "span_x",
         "pixel after the last one of the lower section's first line, in the direction of the span"},
        {"lower_quotient", "span_x", "whole pixels per line of the stop edge, lower section, rounded down"},
        {"lower_remainder", "edge_error", "remainder of that division, in 1/lower_divisor pixel"},
        {"lower_divisor", "edge_error", "height of that section, in 1/16 pixel"},
        {"lower_error", "edge_error",
         "distance from the edge to its pixel after the first step, in 1/lower_divisor pixel"},
        {"lower_carry", "flag", "1: the first step ends one pixel further right than the quotient says"},
        {"z", "depth_sum", "depth at the first pixel, plus 0.5"},
        {"z_dx", "depth_sum", "change of depth per pixel along the span"},
        {"z_de0", "depth_sum", "change of depth per line without carry"},
        {"z_de1", "depth_sum", "change of depth per line with carry"}},
       {{"value", "intensity", "value at the first pixel, in colour steps, plus 0.5"},
        {"dx", "intensity", "first change of the value along the span"},
        {"de0", "intensity", "first change of the value to the next line, without carry"},
        {"de1", "intensity", "first change of the value to the next line, with carry"},
        {"dxx", "intensity", "change of dx per pixel along the span"},
        {"dxe0", "intensity", "change of dx per line without carry"},
        {"dxe1", "intensity", "change of dx per line with carry"},
        {"de0e0", "intensity", "change of de0 per line without carry"},
        {"de0e1", "intensity", "change of de0 per line with carry, and of de1 per line without carry"},
        {"de1e1", "intensity", "change of de1 per line with carry"}}},
  };
}

std::vector<Layout> published_layouts() {
  return {
      {"init",
       {{"triangle", "triangle", "number of the triangle in the scene; copied to its fragments"},
        {"y", "pixel_y", "first line"},
        {"upper_lines", "lines", "lines of this half of the triangle, the first and the last one included"},
        {"start_x", "edge_x", "x of the start edge on the first line (the first pixel), plus 0.5"},
        {"start_slope", "edge_x", "pixels per line of the start edge"},
        {"upper_x", "edge_x", "x of the stop edge on the first line (the last pixel), plus 0.5"},
        {"upper_slope", "edge_x", "pixels per line of the stop edge"},
        {"z", "depth_sum", "depth on the start edge, first line, plus 0.5"},
        {"z_dx", "depth_sum", "change of depth per pixel along the span"},
        {"z_de0", "depth_sum", "change of depth per line"}},
       {{"value", "intensity", "value on the start edge, first line, in colour steps, plus 0.5"},
        {"dx", "intensity", "first change of the value along the span"},
        {"de0", "intensity", "first change of the value to the next line"},
        {"dxx", "intensity", "change of dx per pixel along the span"},
        {"dxe0", "intensity", "change of dx per line"},
        {"de0e0", "intensity", "change of de0 per line"}}},
  };
}

// Fields that only one preset has become null slices in the other, so that one RTL source serves both.
std::vector<std::string_view> all_names(const std::vector<PresetFormats>& presets, std::size_t layout,
                                        std::vector<Field> Layout::* part) {
  std::vector<std::string_view> names;
  for (const PresetFormats& preset : presets)
    for (const Field& field : preset.layouts[layout].*part)
      if (std::ranges::find(names, field.name) == names.end()) names.push_back(field.name);
  return names;
}

std::string vhdl_slices(const PresetFormats& preset, const std::vector<Field>& fields,
                        const std::vector<std::string_view>& names, std::string_view indent) {
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
    fmt::format_to(std::back_inserter(text), "{}{} => ({}, {}),\n", indent, name, low + bits - 1, low);
  }
  text.resize(text.size() - 2);
  return text + "\n";
}

// The body of a function of `exact`: value(preset, indent) is what it returns.
template <class Value>
std::string by_preset(const std::vector<PresetFormats>& presets, const Value& value) {
  const std::string published = value(presets[1], "    ");
  const std::string exact =
      value(presets[0], "    ") == published
          ? ""
          : fmt::format("    if exact then\n      return {};\n    end if;\n", value(presets[0], "      "));
  return fmt::format("  begin\n{}    return {};\n  end function;\n\n", exact, published);
}

std::string upper_first(std::string_view name) {
  std::string text(name);
  text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

// The reason for a format and its bounds, one per line.
std::string commented(const Format& format, std::string_view indent) {
  std::string text = fmt::format("{}{}: {}\n", indent, format.text(), format.why);
  for (const Bound& bound : format.bounds)
    fmt::format_to(std::back_inserter(text), "{}  {}\n", indent, to_string(bound));
  return text;
}

// Comment lines that define the names in the formulas.
constexpr std::string_view c_names_in_bounds[] = {
    "In bounds u is the format's unit, u_x that of format x. Frames have up to 4096 lines and pixels, so",
    "lines = pixels = 4095; steps = 8190: one pixel per line along the edge, then the span; k = lines + "
    "steps,",
    "k_published = lines + pixels. There are up to 16 lights with 32 terms; m is an exponent, e Euler's "
    "number.",
};

std::string names_in_bounds(std::string_view indent) {
  std::string text;
  for (const std::string_view line : c_names_in_bounds)
    fmt::format_to(std::back_inserter(text), "{}{}\n", indent, line);
  return text;
}

constexpr std::string_view c_formats_notice =
    "Made by `make tables` from model/words/generator/formats.cpp; edit that.";

}  // namespace

std::vector<PresetFormats> preset_formats(bool exact, const WordLengths& words) {
  std::vector<PresetFormats> presets = {
      {"exact", joined(common_formats(), exact_formats()),
       joined(joined(exact_layouts(), spherical_layouts(true)), processors_layouts(true))},
      {"published", joined(common_formats(), published_formats()),
       joined(joined(published_layouts(), spherical_layouts(false)), processors_layouts(false))},
  };
  PresetFormats& preset = presets[exact ? 0 : 1];
  const auto format = [&](std::string_view name) -> Format& {
    const Format& found = format_of(preset, name);
    return preset.formats[static_cast<std::size_t>(&found - preset.formats.data())];
  };
  Format &entry = format("root_entry"), &root = format("root");
  // Without a Newton step the root is the table's entry.
  const bool newton = words.newton.value_or(root.fraction_bits > entry.fraction_bits);
  for (const WordLength& length : c_word_lengths)
    if (const auto& bits = words.*length.bits) format(length.format).fraction_bits = *bits;
  if (!newton) static_cast<Number&>(root) = entry;
  return presets;
}

double derived(const PresetFormats& preset, const Format& format, const Bound& bound,
               std::optional<double> exponent) {
  // Add the units of all formats under their names.
  std::vector<std::string> names;
  for (const Format& other : preset.formats) names.push_back(fmt::format("u_{}", other.name));
  std::vector<Quantity> quantities(std::begin(c_quantities), std::end(c_quantities));
  quantities.push_back({"u", format.unit()});
  // A bound that increases with the exponent is stated for the largest exponent.
  const Format& exponents = format_of(preset, "exponent");
  quantities.push_back({"m", exponent.value_or(std::ldexp(1.0, exponents.integer_bits) - exponents.unit())});
  for (std::size_t i = 0; i < names.size(); ++i) quantities.push_back({names[i], preset.formats[i].unit()});
  return evaluated(bound.derivation, quantities);
}

std::string vhdl_package(const std::vector<PresetFormats>& presets) {
  std::string out = fmt::format(
      "-- SPDX-License-Identifier: Apache-2.0\n-- {}\n"
      "-- Number formats and the layouts of the flat vectors, for both presets. A slice of (-1, 0) is a "
      "field that\n"
      "-- the preset does not have. A format of preset published without a comment is that of preset exact. "
      "A vector of n\n"
      "-- channels has x_bits(exact, n) bits; channel n starts there.\n{}\nlibrary ieee;\n"
      "  use ieee.std_logic_1164.all;\n\npackage formats_pkg is\n\n",
      c_formats_notice, names_in_bounds("-- "));
  std::string body = "end package;\n\npackage body formats_pkg is\n\n";
  auto to = std::back_inserter(out), to_body = std::back_inserter(body);
  const auto declare_record = [&](std::string_view name, const std::vector<std::string_view>& fields,
                                  std::string_view type) {
    fmt::format_to(to, "  type {}_t is record\n", name);
    for (const std::string_view field : fields) fmt::format_to(to, "    {} : {};\n", field, type);
    fmt::format_to(to, "  end record;\n\n  function {0} (exact : boolean) return {0}_t;\n\n", name);
    fmt::format_to(to_body, "  function {0} (exact : boolean) return {0}_t is\n", name);
  };
  out += "  type format_t is record\n    bits     : natural;\n    fraction : natural;\n  end record;\n\n";
  out += "  type slice_t is record\n    high : integer;\n    low  : natural;\n  end record;\n\n";
  std::vector<std::string_view> names;
  for (const Format& format : presets[0].formats) names.push_back(format.name);
  declare_record("formats", names, "format_t");
  body += by_preset(presets, [&](const PresetFormats& preset, std::string_view indent) {
    std::string text = "(\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Format& format = preset.formats[i];
      const std::string comment = commented(format, fmt::format("{}  -- ", indent));
      const bool again =
          &preset != &presets[0] && commented(format, "") == commented(presets[0].formats[i], "");
      fmt::format_to(std::back_inserter(text), "{}{}  {} => ({}, {}){}\n", again ? "" : comment, indent,
                     format.name, format.bits(), format.fraction_bits, i + 1 < names.size() ? "," : "");
    }
    return fmt::format("{}{})", text, indent);
  });
  for (std::size_t i = 0; i < presets[0].layouts.size(); ++i) {
    const std::string_view layout = presets[0].layouts[i].name;
    for (const auto& [part, members] :
         {std::pair{"header", &Layout::header}, std::pair{"channel", &Layout::channel}}) {
      const std::vector<std::string_view> fields = all_names(presets, i, members);
      if (fields.empty()) continue;
      declare_record(fmt::format("{}_{}", layout, part), fields, "slice_t");
      body += by_preset(presets, [&](const PresetFormats& preset, std::string_view indent) {
        return fmt::format(
            "(\n{}{})", vhdl_slices(preset, preset.layouts[i].*members, fields, fmt::format("{}  ", indent)),
            indent);
      });
    }
    const bool channels = !presets[0].layouts[i].channel.empty();
    const std::string bits = fmt::format("  function {}_bits (exact : boolean{}) return natural", layout,
                                         channels ? "; channels : natural" : "");
    fmt::format_to(to, "{};\n\n", bits);
    fmt::format_to(to_body, "{} is\n", bits);
    body += by_preset(presets, [&](const PresetFormats& preset, std::string_view) {
      const std::string header = fmt::format("{}", total_bits(preset, preset.layouts[i].header));
      return channels
                 ? fmt::format("{} + channels * {}", header, total_bits(preset, preset.layouts[i].channel))
                 : header;
    });
  }
  return out + body + "end package body;\n";
}

std::string cpp_header(const std::vector<PresetFormats>& presets) {
  std::string out = fmt::format(
      "// SPDX-License-Identifier: Apache-2.0\n// {}\n// Number formats and the layouts of the flat vectors, "
      "for both "
      "presets.\n{}#pragma once\n\n#include <array>\n#include <string_view>\n\n"
      "namespace halfway::words {{\n\n"
      "/// A named word in a flat vector, bit 0 first; in a channel's block `low` counts from the block's "
      "start.\n"
      "struct Field {{\n  std::string_view name;\n  int low, bits;\n  bool is_signed;\n  int "
      "fraction_bits;\n}};\n\n",
      c_formats_notice, names_in_bounds("// "));
  auto to = std::back_inserter(out);
  for (const PresetFormats& preset : presets) {
    fmt::format_to(to, "struct {} {{\n  static constexpr std::string_view c_name = \"{}\";\n",
                   upper_first(preset.name), preset.name);
    for (const Format& format : preset.formats)
      fmt::format_to(to,
                     "{}  static constexpr int c_{}_bits = {};\n"
                     "  static constexpr int c_{}_fraction_bits = {};\n",
                     commented(format, "  // "), format.name, format.bits(), format.name,
                     format.fraction_bits);
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
  out += "}  // namespace halfway::words\n";
  return out;
}

}  // namespace halfway::tables
