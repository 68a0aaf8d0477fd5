// SPDX-License-Identifier: Apache-2.0
#include "sim/files/load_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <new>
#include <utility>

#include "mesh_files/mesh_file.hpp"
#include "sim/files/load_mesh.hpp"
#include "sim/os/file.hpp"

namespace halfway {

namespace {

/// Read a mesh file that a scene file in this folder names.
MeshFile read_mesh_of_scene(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path path = folder / name;
  MeshFile file{.path = path.string(), .refusal = {}, .mesh = LoadedMesh{}};
  // Report these as errors of the scene file, because it contains the wrong path.
  if (!is_mesh_file_name(path.string()))
    file.refusal = fmt::format("is {}", c_no_mesh_file);
  else if (Status ok = check_readable(path); !ok)
    file.refusal = "cannot be used: " + ok.error().message;
  else
    file.mesh = load_mesh(path);
  return file;
}

Result<Scene> load_scene_file(const std::filesystem::path& path, const LoadOptions& options) {
  if (Status ok = check_readable(path); !ok) return ok.error();
  std::error_code fault;
  const std::uintmax_t bytes = std::filesystem::file_size(path, fault);
  if (Status ok = check_scene_size(bytes, path.string()); !ok) return ok.error();
  const Result<std::string> text = read_file(path);
  if (!text) return text.error();
  const auto read_mesh = [&](std::string_view name) { return read_mesh_of_scene(path.parent_path(), name); };
  return parse_scene(*text, path.string(), read_mesh, options);
}

Result<Scene> load_mesh_as_scene(const std::filesystem::path& path) {
  Result<LoadedMesh> loaded = load_mesh(path);
  if (!loaded) return loaded.error();
  return scene_of_mesh(std::move(*loaded), path.string());
}

std::string known_scenes(const std::filesystem::path& folder) {
  const std::vector<std::string> names = scene_names(folder);
  return names.empty() ? "none: no scene file in " + folder.string()
                       : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<std::string> scene_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code fault;
  for (std::filesystem::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault))
    if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
  std::ranges::sort(names);
  return names;
}

Result<Scene> load_scene(std::string_view name_or_path, const std::filesystem::path& scenes_folder,
                         const LoadOptions& options) {
  if (name_or_path.empty()) return bad_input("the scene has no name; give a built-in name or a file");
  // The system would use the part before a zero byte as the path.
  if (name_or_path.find('\0') != std::string_view::npos)
    return bad_input("the scene's name holds a zero byte");
  const std::filesystem::path path(name_or_path);
  // The scene's name is also the name of the results' folder.
  const std::string name = path.stem().string();
  if (name == "." || name == ".." ||
      std::ranges::any_of(name, [](unsigned char c) { return std::iscntrl(c); }))
    return bad_input(fmt::format("{}: a scene cannot be called '{}'; rename the file", name_or_path, name));
  try {
    if (lower_ending(path.string()) == ".toml") return load_scene_file(path, options);
    if (is_mesh_file_name(path.string())) {
      if (options.tessellation != 1.0)
        return bad_input(path.string() + ": a mesh file has the triangles it has: no other tessellation");
      return load_mesh_as_scene(path);
    }
    const std::filesystem::path built_in = scenes_folder / (std::string(name_or_path) + ".toml");
    std::error_code fault;
    if (!path.has_parent_path() && std::filesystem::is_regular_file(built_in, fault)) {
      return load_scene_file(built_in, options);
    }
    if (std::filesystem::exists(path, fault)) {
      const Status ok = check_readable(path);
      return ok ? bad_input(fmt::format("{}: {}", path.string(), c_no_scene_file)) : ok.error();
    }
    return bad_input(fmt::format("{}: neither a built-in scene nor a file; built in are: {}", name_or_path,
                                 known_scenes(scenes_folder)));
  } catch (const std::bad_alloc&) {
    return bad_input(fmt::format("{}: not enough memory to load it; reduce the mesh", name_or_path));
  } catch (const std::exception& exception) {
    return bad_input(fmt::format("{}: cannot be loaded: {}", name_or_path, exception.what()));
  }
}

}  // namespace halfway
