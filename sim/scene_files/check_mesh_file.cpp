// SPDX-License-Identifier: Apache-2.0
#include "sim/scene_files/check_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "scene/scene.hpp"

namespace halfway {

namespace {

Status too_many_triangles(const std::filesystem::path& path, std::uint64_t triangles) {
  if (triangles <= c_max_triangles) return Ok{};
  return bad_input(fmt::format("{}: {} triangles, but {} is the most; reduce the mesh", path.string(),
                               triangles, c_max_triangles));
}

// ---- glTF

/// The JSON text of a .gltf, or of the first chunk of a .glb.
Result<std::string> gltf_json(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 20> header{};
  file.read(header.data(), header.size());
  const bool is_binary = file.gcount() == 20 && std::string_view(header.data(), 4) == "glTF";
  std::error_code fault;
  std::uint64_t size = std::filesystem::file_size(path, fault);
  if (fault || !file.is_open()) return bad_input(path.string() + ": cannot be read");
  if (is_binary) {
    std::uint32_t whole = 0;
    std::uint32_t length = 0;
    std::memcpy(&whole, header.data() + 8, sizeof whole);
    std::memcpy(&length, header.data() + 12, sizeof length);
    if (whole > size || length > size - header.size()) {
      return bad_input(fmt::format("{}: its header requires {} bytes, it has {}; it is truncated",
                                   path.string(), std::max<std::uint64_t>(whole, 20ull + length), size));
    }
    size = length;
  } else {
    file.clear();
    file.seekg(0);
  }
  std::string text(size, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(size)))
    return bad_input(path.string() + ": cannot be read");
  return text;
}

/// The unsigned number under a key; std::nullopt if there is none.
std::optional<std::uint64_t> number_at(const nlohmann::json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  return found->get<std::uint64_t>();
}

/// The array under a key, empty if there is none.
const nlohmann::json& array_at(const nlohmann::json& object, const char* key) {
  static const nlohmann::json c_empty = nlohmann::json::array();
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() && found->is_array() ? *found : c_empty;
}

/// assimp omits faces with an index out of range without a message, so count the expected faces.
Result<MeshFileSummary> check_gltf(const std::filesystem::path& path) {
  Result<std::string> text = gltf_json(path);
  if (!text) return text.error();
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return bad_input(path.string() + ": not glTF 2.0: its JSON cannot be read");
  const nlohmann::json& accessors = array_at(json, "accessors");
  std::uint64_t polygons = 0;
  for (const nlohmann::json& mesh : array_at(json, "meshes")) {
    for (const nlohmann::json& primitive : array_at(mesh, "primitives")) {
      std::optional<std::uint64_t> accessor = number_at(primitive, "indices");
      if (!accessor && primitive.is_object() && primitive.contains("attributes")) {
        accessor = number_at(primitive["attributes"], "POSITION");
      }
      if (!accessor) continue;
      if (*accessor >= accessors.size()) {
        return bad_input(
            fmt::format("{}: a primitive names accessor {}, but the file has {}; correct the index",
                        path.string(), *accessor, accessors.size()));
      }
      const std::uint64_t count = number_at(accessors[*accessor], "count").value_or(0);
      const std::uint64_t mode = number_at(primitive, "mode").value_or(4);
      if (count > 3ull * c_max_triangles) return too_many_triangles(path, count / 3).error();
      if (mode == 4) polygons += count / 3;
      if ((mode == 5 || mode == 6) && count > 2) polygons += count - 2;
    }
  }
  if (Status ok = too_many_triangles(path, polygons); !ok) return ok.error();
  MeshFileSummary summary;
  summary.polygons = polygons;
  return summary;
}

}  // namespace

Result<MeshFileSummary> check_mesh_file(const std::filesystem::path& path) {
  return check_gltf(path);
}

}  // namespace halfway
