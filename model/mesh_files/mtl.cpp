// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/mtl.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh_files/number.hpp"
#include "mesh_files/text_lines.hpp"

namespace halfway {

namespace {

/// Read one number or more, up to `most`, to the end of the line.
Result<int> read_numbers(TextLines& lines, std::string_view key, float* values, int most) {
  int count = 0;
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word()) {
    float value = 0.0f;
    if (const NumberFault fault = read_number(word, value); fault != NumberFault::none) {
      return lines.error(fmt::format("{}: {}; correct the number", key, fault_text(fault, word)));
    }
    if (count == most) return lines.error(fmt::format("{} has more than {} numbers", key, most));
    values[count++] = value;
  }
  if (count == 0) return lines.error(fmt::format("{} has no number", key));
  return count;
}

/// Read three numbers, or one for all three.
Result<glm::dvec3> read_colour(TextLines& lines, std::string_view key) {
  float values[3] = {};
  const Result<int> count = read_numbers(lines, key, values, 3);
  if (!count) return count.error();
  if (*count == 2) return lines.error(fmt::format("{} has 2 numbers; it must have 3, or 1 for grey", key));
  if (*count == 1) values[1] = values[2] = values[0];
  for (const float value : values) {
    if (value < 0.0f) return lines.error(fmt::format("{} is negative; correct the colour", key));
  }
  return glm::dvec3(values[0], values[1], values[2]);
}

}  // namespace

Material plain_material(std::string_view name) {
  constexpr float c_grey = 0.6f;
  Material material;
  material.name = name;
  material.colour = glm::dvec3(static_cast<double>(c_grey));
  material.diffuse = 1.0;
  material.specular = 0.0;
  material.exponent = 1.0;
  return material;
}

Status read_mtl(std::string_view text, std::string_view file, MtlMaterials& materials) {
  TextLines lines(text, file, {});
  MtlMaterial* current = nullptr;
  while (lines.next()) {
    const std::string_view word = lines.word();
    const std::string key = lower_case(word);
    const bool is_texture = key.starts_with("map_") || key == "bump" || key == "disp" || key == "decal" ||
                            key == "refl" || key == "norm";
    if (key == "newmtl") {
      const std::string name(lines.rest());
      if (name.empty()) return lines.error("newmtl has no name");
      const auto [entry, is_new] = materials.try_emplace(name);
      current = &entry->second;
      if (is_new) current->material = plain_material(name);
      continue;
    }
    if (key != "kd" && key != "ks" && key != "ns" && !is_texture) continue;
    if (current == nullptr) return lines.error(fmt::format("{} before the first newmtl", word));
    Material& material = current->material;
    if (key == "kd") {
      const Result<glm::dvec3> colour = read_colour(lines, word);
      if (!colour) return colour.error();
      material.colour = *colour;
      material.diffuse = *colour == glm::dvec3(0.0) ? 0.0 : 1.0;
    } else if (key == "ks") {
      const Result<glm::dvec3> colour = read_colour(lines, word);
      if (!colour) return colour.error();
      const bool is_black = *colour == glm::dvec3(0.0);
      material.specular_colour = is_black ? glm::dvec3(1.0) : *colour;
      material.specular = is_black ? 0.0 : 1.0;
    } else if (key == "ns") {
      float exponent = 0.0f;
      if (const Result<int> count = read_numbers(lines, word, &exponent, 1); !count) return count.error();
      current->file_exponent = static_cast<double>(exponent);
      material.exponent = std::max(current->file_exponent, 1.0);
    } else {
      current->has_textures = true;
    }
  }
  return Ok{};
}

}  // namespace halfway
