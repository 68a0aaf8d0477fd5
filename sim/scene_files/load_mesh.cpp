// SPDX-License-Identifier: Apache-2.0
#include "sim/scene_files/load_mesh.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <string_view>

#include "mesh_files/number.hpp"
#include "mesh_files/obj.hpp"
#include "mesh_files/ply.hpp"
#include "mesh_files/stl.hpp"
#include "sim/scene_files/check_mesh_file.hpp"
#include "sim/scene_files/mesh_reply.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway {

namespace {

constexpr std::array<std::string_view, 5> c_endings = {".obj", ".ply", ".stl", ".gltf", ".glb"};
constexpr std::uintmax_t c_max_file_bytes = std::uintmax_t{4} << 30;
constexpr std::uintmax_t c_max_library_bytes = std::uintmax_t{64} << 20;

Material get_material(ReplySource& source) {
  Material material;
  material.name = source.get_text();
  material.colour = source.get<glm::dvec3>();
  material.specular_colour = source.get<glm::dvec3>();
  material.diffuse = source.get<double>();
  material.specular = source.get<double>();
  material.exponent = source.get<double>();
  return material;
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Run the reader and return the file with its reply.
Result<File> run_reader(const std::filesystem::path& path, const MeshFileSummary& summary) {
  const std::string name = path.string();
  const int descriptor = ::memfd_create("halfway-mesh", MFD_CLOEXEC);
  if (descriptor < 0) return tool_failed(name + ": no memory file for the reader; free some memory");
  File reply(::fdopen(descriptor, "rb"), &std::fclose);
  if (reply == nullptr) {
    ::close(descriptor);
    return tool_failed(name + ": no memory file for the reader; free some memory");
  }
  const auto told = [](const std::optional<std::uint64_t>& number) {
    return number ? std::to_string(*number) : std::string("-");
  };
  const auto end =
      run_process({.arguments = {HALFWAY_MESH_READER, name, told(summary.polygons), told(summary.vertices)},
                   .standard_output = fmt::format("/proc/self/fd/{}", descriptor)},
                  "make build");
  if (!end) return end.error();
  if (end->signal == SIGXCPU) {
    return bad_input(
        fmt::format("{}: reading it takes more than {} s; reduce the mesh", name, c_reader_cpu_seconds));
  }
  if (end->signal == SIGKILL)
    return bad_input(name + ": the reader was killed, perhaps for want of memory; reduce the mesh");
  constexpr int c_not_linked = 127;
  if (end->exit_status == c_not_linked)
    return tool_failed(fmt::format("{}: the reader cannot start: {}", name, end->output));
  if (!end->succeeded())
    return bad_input(name + ": the reader crashed; the file is damaged, export it again");
  return reply;
}

void append_instance(ReplySource& source, Mesh& mesh) {
  Mesh part;
  const auto to_file = source.get<glm::dmat4>();
  const auto material = source.get<std::uint32_t>();
  const auto get_vectors = [&source](std::uint32_t count, std::vector<glm::dvec3>& vectors) {
    for (std::uint32_t i = 0; i < count && !source.failed(); ++i) {
      const auto v = source.get<std::array<float, 3>>();
      vectors.emplace_back(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    }
  };
  const auto vertices = source.get<std::uint32_t>();
  get_vectors(vertices, part.positions);
  const bool has_normals = source.get<bool>();
  if (has_normals) {
    get_vectors(vertices, part.normals);
  } else {
    part.normals.emplace_back(0.0);
  }
  const auto triangles = source.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < triangles && !source.failed(); ++i) {
    const auto index = source.get<std::array<std::uint32_t, 3>>();
    part.triangles.push_back({index, has_normals ? index : std::array<std::uint32_t, 3>{}, material});
  }
  if (to_file != glm::dmat4(1.0)) transform(part, to_file);

  const auto first_position = static_cast<std::uint32_t>(mesh.positions.size());
  const auto first_normal = static_cast<std::uint32_t>(mesh.normals.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
  for (SceneTriangle& triangle : part.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      triangle.position[corner] += first_position;
      triangle.normal[corner] += first_normal;
    }
    mesh.triangles.push_back(triangle);
  }
}

/// Read a material library next to an OBJ file.
MaterialLibrary read_library(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path path = folder / name;
  MaterialLibrary library{.path = path.string(), .text = {}};
  // Skip pipes and devices, which may never end.
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault) ||
      std::filesystem::file_size(path, fault) > c_max_library_bytes || fault)
    return library;
  Result<std::string> text = read_file(path);
  if (text) library.text = std::move(*text);
  return library;
}

Result<LoadedMesh> load_obj(const std::filesystem::path& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return text.error();
  return read_obj(*text, path.string(),
                  [&path](std::string_view name) { return read_library(path.parent_path(), name); });
}

}  // namespace

std::string lower_ending(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

bool is_mesh_file_name(const std::filesystem::path& path) {
  return std::find(c_endings.begin(), c_endings.end(), lower_ending(path)) != c_endings.end();
}

Status check_readable(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code fault;
  const std::filesystem::file_status status = std::filesystem::status(path, fault);
  if (!std::filesystem::exists(status)) return bad_input(name + ": no such file; check the path");
  if (std::filesystem::is_directory(status)) return bad_input(name + ": a directory; name a file in it");
  // A pipe or a device may never end.
  if (!std::filesystem::is_regular_file(status))
    return bad_input(name + ": not a regular file; copy it to one");
  if (!std::ifstream(path)) return bad_input(name + ": cannot be read; check its permissions");
  const std::uintmax_t size = std::filesystem::file_size(path, fault);
  if (fault) return bad_input(name + ": cannot be read: " + fault.message());
  if (size == 0) return bad_input(name + ": the file is empty");
  if (size > c_max_file_bytes) {
    return bad_input(fmt::format("{}: larger than {} GiB; reduce the mesh", name, c_max_file_bytes >> 30));
  }
  return Ok{};
}

Result<LoadedMesh> load_mesh(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (!is_mesh_file_name(path)) {
    return bad_input(name + ": not a mesh file by its name; .obj, .ply, .stl, .gltf and .glb can be read");
  }
  if (Status ok = check_readable(path); !ok) return ok.error();
  if (lower_ending(path) == ".obj") return load_obj(path);
  if (lower_ending(path) == ".ply" || lower_ending(path) == ".stl") {
    const Result<std::string> bytes = read_file(path);
    if (!bytes) return bytes.error();
    return lower_ending(path) == ".ply" ? read_ply(*bytes, name) : read_stl(*bytes, name);
  }
  Result<MeshFileSummary> summary = check_mesh_file(path);
  if (!summary) return summary.error();
  if (summary->polygons == 0u) return bad_input(name + ": the mesh has no faces; export it with faces");

  auto reply = run_reader(path, *summary);
  if (!reply) return reply.error();
  ReplySource source(reply->get());
  if (source.get<ReplyKind>() == ReplyKind::error) return bad_input(name + ": " + source.get_text());

  LoadedMesh loaded;
  for (auto left = source.get<std::uint32_t>(); left > 0 && !source.failed(); --left) {
    loaded.mesh.materials.push_back(get_material(source));
  }
  for (auto left = source.get<std::uint32_t>(); left > 0 && !source.failed(); --left) {
    loaded.notes.push_back(name + ": " + source.get_text());
  }
  for (auto left = source.get<std::uint32_t>(); left > 0 && !source.failed(); --left) {
    append_instance(source, loaded.mesh);
  }
  if (source.failed()) return tool_failed(name + ": the reader's reply is truncated");
  if (loaded.mesh.materials.empty()) {
    loaded.mesh.materials.push_back(default_material());
    for (SceneTriangle& triangle : loaded.mesh.triangles) triangle.material = 0;
  }
  join_positions(loaded.mesh);
  return loaded;
}

}  // namespace halfway
