// SPDX-License-Identifier: Apache-2.0
#include "sim/files/load_mesh.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "mesh_files/mesh_file.hpp"
#include "sim/os/file.hpp"

namespace halfway {

namespace {

constexpr std::uintmax_t c_max_file_bytes = std::uintmax_t{4} << 30;
constexpr std::uintmax_t c_max_library_bytes = std::uintmax_t{64} << 20;

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

/// Read a buffer of a glTF file in this folder.
BufferFile read_buffer(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path path = folder / name;
  // Skip pipes and devices, which may never end.
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault))
    return {.refusal = "is not a file; export the file with its buffers", .bytes = {}};
  if (std::filesystem::file_size(path, fault) > c_max_file_bytes || fault)
    return {.refusal = fmt::format("is larger than {} GiB; reduce the mesh", c_max_file_bytes >> 30),
            .bytes = {}};
  Result<std::string> bytes = read_file(path);
  if (!bytes) return {.refusal = "cannot be read; check its permissions", .bytes = {}};
  return {.refusal = {}, .bytes = std::move(*bytes)};
}

}  // namespace

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
  if (Status ok = check_readable(path); !ok) return ok.error();
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  const std::filesystem::path folder = path.parent_path();
  return read_mesh(*bytes, name,
                   {.library = [&](std::string_view library) { return read_library(folder, library); },
                    .buffer = [&](std::string_view buffer) { return read_buffer(folder, buffer); }});
}

}  // namespace halfway
