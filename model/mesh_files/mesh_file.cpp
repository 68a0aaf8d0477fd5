// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/mesh_file.hpp"

#include <fmt/format.h>

#include "mesh_files/number.hpp"
#include "mesh_files/ply.hpp"
#include "mesh_files/stl.hpp"
#include "mesh_files/text_lines.hpp"

namespace halfway {
namespace {

constexpr std::string_view c_endings[] = {".obj", ".ply", ".stl", ".gltf", ".glb"};

/// The place of the dot before the ending; npos if the name has no ending.
std::size_t dot_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == 0 || name == ".." ? std::string_view::npos : dot;
}

}  // namespace

std::string_view file_name(std::string_view path) {
  return path.substr(path.rfind('/') + 1);
}

std::string lower_ending(std::string_view path) {
  const std::string_view name = file_name(path);
  const std::size_t dot = dot_of(name);
  return dot == std::string_view::npos ? std::string() : lower_case(name.substr(dot));
}

std::string file_stem(std::string_view path) {
  const std::string_view name = file_name(path);
  return std::string(name.substr(0, dot_of(name)));
}

bool is_mesh_file_name(std::string_view path) {
  return contains(c_endings, lower_ending(path));
}

Result<LoadedMesh> read_mesh(std::string_view bytes, std::string_view file, const OtherFiles& others) {
  const std::string ending = lower_ending(file);
  if (const auto fault = utf16_fault(bytes);
      !fault.empty() && ending != ".stl")  // a binary STL has any bytes
    return bad_input(std::string(file) + ":1: " + std::string(fault));
  if (ending == ".ply") return read_ply(bytes, file);
  if (ending == ".stl") return read_stl(bytes, file);
  if (ending == ".obj") return read_obj(bytes, file, others.library);
  if (ending == ".gltf" || ending == ".glb") return read_gltf(bytes, file, others.buffer);
  return bad_input(fmt::format("{}: {}", file, c_no_mesh_file));
}

}  // namespace halfway
