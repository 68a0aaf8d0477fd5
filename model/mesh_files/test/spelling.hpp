// SPDX-License-Identifier: Apache-2.0
// Spellings of mesh files: each is read exactly, or refused with its place.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <ostream>
#include <string>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

struct Spelling {
  const char* name;
  std::string text;
  std::string wanted;  ///< triangles_of
};

inline void PrintTo(const Spelling& spelling, std::ostream* out) {
  *out << spelling.name;
}

/// The name of a case of a suite of spellings.
inline std::string name_of(const ::testing::TestParamInfo<Spelling>& test) {
  std::string name = test.param.name;
  std::ranges::replace(name, '.', '_');
  return name;
}

/// The triangle that most spellings describe.
inline const std::string c_triangle = "0,0,0 1,0,0 0,1,0";

/// The text with the first `what` replaced.
inline std::string changed(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// The triangles by their corners: "x,y,z x,y,z x,y,z; ...". A refusal as its message, with '!' in front.
inline std::string triangles_of(const Result<LoadedMesh>& loaded) {
  if (!loaded) return "! " + loaded.error().message;
  std::string text;
  const Mesh& mesh = loaded->mesh;
  for (const SceneTriangle& triangle : mesh.triangles) {
    if (!text.empty()) text += "; ";
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3& p = mesh.positions.at(triangle.position[i]);
      text += fmt::format("{}{},{},{}", i == 0 ? "" : " ", p.x, p.y, p.z);
    }
  }
  return text;
}

inline std::string normals_of(const LoadedMesh& loaded) {
  std::string text;
  for (const SceneTriangle& triangle : loaded.mesh.triangles) {
    for (const std::uint32_t normal : triangle.normal) {
      const glm::dvec3& n = loaded.mesh.normals.at(normal);
      text += fmt::format("{},{},{} ", n.x, n.y, n.z);
    }
  }
  return text;
}

/// The bytes of a number of a binary file.
template <class T>
std::string little_endian(T value) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    if constexpr (sizeof value == 8) {
      bytes += static_cast<char>(std::bit_cast<std::uint64_t>(value) >> (8 * i));
    } else if constexpr (sizeof value == 4) {
      bytes += static_cast<char>(std::bit_cast<std::uint32_t>(value) >> (8 * i));
    } else {
      bytes += static_cast<char>(static_cast<std::uint16_t>(value) >> (8 * i));
    }
  }
  return bytes;
}
template <class T>
std::string big_endian(T value) {
  const std::string bytes = little_endian(value);
  return {bytes.rbegin(), bytes.rend()};
}

/// The bytes of a buffer that is written into a glTF file.
inline std::string base64(const std::string& data) {
  constexpr char c_digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < data.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < data.size() ? static_cast<unsigned char>(data[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > data.size() ? '=' : c_digits[word >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

}  // namespace halfway
