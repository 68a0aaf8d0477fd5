// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/mtl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "mesh_files/number.hpp"
#include "mesh_files/text_lines.hpp"

namespace halfway {

namespace {

/// Read one number or more, as many as there are values at most, to the end of the line. Returns what is
/// wrong, or nothing.
std::string read_numbers(TextLines& lines, std::span<double> values, std::size_t& count) {
  count = 0;
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word()) {
    double value = 0.0;
    if (const NumberFault fault = read_number(word, value); fault != NumberFault::none)
      return fault_text(fault, word);
    if (value < 0.0) return quoted(word) + " is negative";
    if (count == values.size()) return fmt::format("more than {} numbers", values.size());
    values[count++] = value;
  }
  return count == 0 ? "no number" : "";
}

/// Read three numbers, or one for all three.
std::string read_colour(TextLines& lines, glm::dvec3& colour) {
  std::array<double, 3> values{};
  std::size_t count = 0;
  if (std::string fault = read_numbers(lines, values, count); !fault.empty()) return fault;
  if (count == 2) return "2 numbers instead of 3, or 1 for grey";
  if (count == 1) values[1] = values[2] = values[0];
  colour = glm::dvec3(values[0], values[1], values[2]);
  return {};
}

/// Keys that change nothing at this value; the other values are noted.
struct NeutralKey {
  std::string_view key;
  double value;
};
constexpr NeutralKey c_neutral[] = {{"tf", 1.0}, {"illum", 2.0}};

/// True if all numbers of the line have the key's neutral value.
bool is_neutral(TextLines& lines, std::string_view key) {
  // Refraction is of transparent surfaces.
  if (key == "ni") return true;
  const auto* const neutral = std::find_if(std::begin(c_neutral), std::end(c_neutral),
                                           [key](const NeutralKey& known) { return known.key == key; });
  if (neutral == std::end(c_neutral)) return false;
  bool is_equal = true;
  double value = 0.0;
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word())
    is_equal &= read_number(word, value) == NumberFault::none && value == neutral->value;
  return is_equal;
}

/// Read a key of a material. Returns what is wrong, or nothing.
std::string read_key(TextLines& lines, std::string_view key, MtlMaterial& read, Notes& notes) {
  Material& material = read.material;
  const bool is_texture = key.starts_with("map_") || key == "bump" || key == "disp" || key == "decal" ||
                          key == "refl" || key == "norm";
  glm::dvec3 colour;
  if (key == "kd") {
    if (std::string fault = read_colour(lines, colour); !fault.empty()) return fault;
    material.colour = colour;
    material.diffuse = colour == glm::dvec3(0.0) ? 0.0 : 1.0;
  } else if (key == "ks") {
    if (std::string fault = read_colour(lines, colour); !fault.empty()) return fault;
    const bool is_black = colour == glm::dvec3(0.0);
    material.specular_colour = is_black ? glm::dvec3(1.0) : colour;
    material.specular = is_black ? 0.0 : 1.0;
  } else if (key == "ke") {
    return read_colour(lines, material.emission);
  } else if (key == "ns" || key == "d" || key == "tr") {
    std::array<double, 1> number{};
    std::size_t count = 0;
    if (std::string fault = read_numbers(lines, number, count); !fault.empty()) return fault;
    if (key == "d") read.d = number[0];
    if (key == "tr") read.tr = number[0];
    if (key != "ns") return {};
    read.file_exponent = number[0];
    material.exponent = std::max(read.file_exponent, 1.0);
  } else if (is_texture) {
    read.has_textures = true;
    lines.rest();
  } else if (!key.empty()) {
    const std::string place = lines.place();
    if (!is_neutral(lines, key)) notes.add(place, fmt::format("{} is not used", quoted(key)));
    lines.rest();
  }
  return {};
}

}  // namespace

Material plain_material(std::string_view name) {
  constexpr double c_grey = 0.6;
  Material material;
  material.name = name;
  material.colour = glm::dvec3(c_grey);
  material.diffuse = 1.0;
  material.specular = 0.0;
  material.exponent = 1.0;
  return material;
}

void read_mtl(std::string_view text, std::string_view file, MtlMaterials& materials, Notes& notes) {
  TextLines lines(text, file, {});
  MtlMaterial nameless;
  MtlMaterial* current = nullptr;
  while (lines.next()) {
    const std::string_view word = lines.word();
    const std::string key = lower_case(word);
    if (key == "newmtl") {
      const std::string name(lines.rest());
      if (name.empty()) notes.add(lines.place(), "newmtl has no name; its material is left out");
      const bool is_new = !name.empty() && materials.try_emplace(name).second;
      current = name.empty() ? &nameless : &materials.at(name);
      if (is_new) current->material = plain_material(name);
    } else if (current == nullptr) {
      if (!word.empty()) notes.add(lines.place(), "a line before the first newmtl is left out");
      lines.rest();
    } else if (const std::string fault = read_key(lines, key, *current, notes); !fault.empty()) {
      notes.add(lines.place(), fmt::format("{}: {}; the line is left out", word, fault));
      lines.rest();
    }
  }
}

}  // namespace halfway
