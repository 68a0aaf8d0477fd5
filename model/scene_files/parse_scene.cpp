// SPDX-License-Identifier: Apache-2.0
#include "scene_files/parse_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/to_integer.hpp"
#include "mesh_files/mesh_file.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/camera.hpp"
#include "scene/lights.hpp"
#include "scene/mesh.hpp"
#include "scene_files/add_mesh.hpp"
#include "scene_files/toml_table.hpp"

namespace halfway {

namespace {

constexpr std::uintmax_t c_max_scene_file_bytes = std::uintmax_t{16} << 20;
/// The longest keys have two parts, such as `rotate.axis`. toml++ parses the parts recursively.
constexpr int c_max_key_dots = 16;

/// The line of the first key with too many parts, or 0. toml++ limits the nesting of values, but not of keys,
/// which would overflow the stack. If the text is not TOML the search may end early, as does toml++.
std::size_t line_of_deep_key(std::string_view text) {
  std::size_t line = 1;
  int dots = 0;  // since the last character that cannot be part of a key
  const auto at = [&](std::size_t i) { return i < text.size() ? text[i] : '\n'; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const bool many_lines = at(i + 1) == c && at(i + 2) == c;
      i += many_lines ? 3 : 1;
      const auto ends = [&] { return at(i) == c && (!many_lines || (at(i + 1) == c && at(i + 2) == c)); };
      for (; i < text.size() && !ends(); ++i) {
        if (text[i] == '\\' && c == '"') ++i;
        if (at(i) != '\n') continue;
        if (!many_lines) return 0;
        ++line;
      }
      if (many_lines) {
        i += 2;
        // Up to two more quotes belong to the text.
        for (int more = 0; more < 2 && at(i + 1) == c; ++more) ++i;
      }
    } else if (c == '#') {
      while (at(i + 1) != '\n') ++i;
    } else if (c == '.') {
      if (++dots > c_max_key_dots) return line;
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') {
      dots = 0;
      line += c == '\n' ? 1 : 0;
    }
  }
  return 0;
}

class SceneReader {
 public:
  SceneReader(std::string_view file, const ReadMesh& read_mesh, const LoadOptions& options)
      : file_(file), read_mesh_(read_mesh), options_(options) {}

  Result<Scene> read(std::string_view text) {
    if (const std::size_t line = line_of_deep_key(text); line != 0)
      return bad_input(
          fmt::format("{}:{}: bad TOML: a key of more than {} parts", file_, line, c_max_key_dots));
    const toml::parse_result parsed = toml::parse(text, file_);
    if (!parsed)
      return bad_input(fmt::format("{}:{}: bad TOML: {}", file_, parsed.error().source().begin.line,
                                   parsed.error().description()));
    read(parsed.table());
    if (error_) return *error_;
    return std::move(scene_);
  }

 private:
  void read(const toml::table& root_table) {
    const TomlTable root(root_table, file_, "the scene",
                         {"camera", "ambient", "background", "shadows", "directional", "positional", "spot",
                          "material", "mesh", "cull"},
                         error_);
    scene_.name = file_stem(file_);
    scene_.ambient = root.colour("ambient", scene_.ambient);
    scene_.background = root.colour("background", scene_.background);
    scene_.shadows = root.flag("shadows", scene_.shadows);
    culling_ = read_culling(root, std::nullopt);
    const std::optional<CameraFit> fit = read_camera(root);
    each(root, "directional", [this](const toml::table& table) { read_directional(table); });
    each(root, "positional", [this](const toml::table& table) { read_positional(table); });
    each(root, "spot", [this](const toml::table& table) { read_spot(table); });
    each(root, "material", [this](const toml::table& table) { read_material(table); });
    each(root, "mesh", [this](const toml::table& table) { read_mesh(table); });
    if (error_) return;
    if (scene_.triangles.empty()) {
      error_.set(bad_input(file_ + ": the scene has no mesh; add a [[mesh]]"));
      return;
    }
    if (light_count(scene_) == 0) {
      scene_.notes.push_back(file_ + ": no light; only the ambient term is drawn");
    }
    if (fit.has_value()) scene_.camera = fit->camera(scene_);
    if (Status ok = check_view(scene_, file_); !ok) error_.set(ok.error());
  }

  template <class Read>
  void each(const TomlTable& root, std::string_view key, const Read& read) {
    if (!root.has(key)) return;
    const toml::array* array = root.required(key)->as_array();
    if (array == nullptr) {
      root.fail(key, fmt::format("must be written [[{}]]", key));
      return;
    }
    for (const toml::node& node : *array) {
      if (error_) return;
      if (node.is_table())
        read(*node.as_table());
      else
        root.fail(key, fmt::format("must be written [[{}]]", key));
    }
  }

  std::optional<CameraFit> read_camera(const TomlTable& root) {
    if (!root.has("camera")) return CameraFit{};
    const toml::table* node = root.required("camera")->as_table();
    if (node == nullptr) {
      root.fail("camera", "must be written [camera]");
      return std::nullopt;
    }
    const TomlTable camera(*node, file_, "camera",
                           {"fit", "direction", "eye", "target", "up", "fov", "near", "far"}, error_);
    Camera& result = scene_.camera;
    result.up_world = camera.has("up") ? camera.direction("up") : result.up_world;
    result.vertical_fov_degrees =
        camera.number("fov", result.vertical_fov_degrees,
                      {.low = 0.0, .high = 180.0, .low_excluded = true, .high_excluded = true});
    result.near = camera.number("near", 0.0, c_positive);
    result.far = camera.number("far", 0.0, c_positive);
    if (camera.has("far") && result.far <= result.near) camera.fail("far", "must be greater than near");

    if (camera.flag("fit", false)) {
      for (const std::string_view key : {"eye", "target"}) {
        if (camera.has(key)) camera.fail(key, "cannot be given with fit = true; remove one of them");
      }
      CameraFit fit{.up_world = result.up_world,
                    .vertical_fov_degrees = result.vertical_fov_degrees,
                    .near = result.near,
                    .far = result.far};
      if (camera.has("direction")) fit.to_eye_world = camera.direction("direction");
      if (!has_view({.eye_world = fit.to_eye_world, .up_world = fit.up_world})) {
        camera.fail(camera.has("up") ? "up" : "direction", "makes up parallel to the view; turn one of them");
      }
      return fit;
    }
    if (camera.has("direction")) camera.fail("direction", "needs fit = true; otherwise give eye and target");
    result.eye_world = camera.vector("eye");
    result.target_world = camera.vector("target", result.target_world);
    if (!has_view({.eye_world = result.eye_world,
                   .target_world = result.target_world,
                   .up_world = orthogonal_to(result.eye_world - result.target_world)})) {
      camera.fail("eye", "is the target; move one of them");
    }
    if (!has_view(result)) {
      camera.fail(camera.has("up") ? "up" : "eye", "makes up parallel to the view; turn one of them");
    }
    return std::nullopt;
  }

  static glm::dvec3 orthogonal_to(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    return size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
           : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                : glm::dvec3(0.0, 0.0, 1.0);
  }

  void read_directional(const toml::table& node) {
    const TomlTable light(node, file_, "directional", {"to_light", "intensity"}, error_);
    scene_.directional.push_back({light.direction("to_light"), light.colour("intensity", glm::dvec3(1.0))});
  }

  void read_positional(const toml::table& node) {
    const TomlTable light(node, file_, "positional", {"position", "intensity"}, error_);
    scene_.positional.push_back({light.vector("position"), light.colour("intensity", glm::dvec3(1.0))});
  }

  void read_spot(const toml::table& node) {
    const TomlTable light(node, file_, "spot", {"position", "axis", "inner", "outer", "intensity"}, error_);
    constexpr Limits c_half_angle{.low = 0.0, .high = 90.0};
    light.required("outer");
    const double outer = light.number("outer", 0.0, c_half_angle);
    const double inner = light.number("inner", 0.0, c_half_angle);
    if (outer <= 0.0) light.fail("outer", "must be greater than 0: the cone is empty");
    if (inner > outer) light.fail("inner", fmt::format("is {}, but must be at most outer, {}", inner, outer));
    scene_.spots.push_back({light.vector("position"), light.direction("axis"), std::cos(glm::radians(inner)),
                            std::cos(glm::radians(outer)), light.colour("intensity", glm::dvec3(1.0))});
  }

  void read_material(const toml::table& node) {
    const TomlTable table(node, file_, "material",
                          {"name", "brdf", "colour", "specular_colour", "emission", "k_a", "k_d", "k_s",
                           "exponent", "roughness", "reflectance"},
                          error_);
    Material material;
    material.name = table.text("name");
    if (named_material(material.name).has_value()) {
      table.fail("name", fmt::format("'{}' is taken by another material; choose a new one", material.name));
    }
    if (table.has("brdf")) {
      const std::string brdf = table.text("brdf");
      if (brdf == "blinn") {
        material.brdf = Brdf::blinn;
      } else if (brdf == "phong") {
        material.brdf = Brdf::phong;
      } else if (brdf == "cook_torrance") {
        material.brdf = Brdf::cook_torrance;
      } else {
        table.fail("brdf", fmt::format("is '{}', but must be blinn, phong or cook_torrance", brdf));
      }
    }
    material.colour = table.colour("colour", material.colour);
    material.specular_colour = table.colour("specular_colour", material.specular_colour);
    material.emission = table.colour("emission", material.emission);
    material.ambient = table.number("k_a", material.ambient, c_not_negative);
    material.diffuse = table.number("k_d", material.diffuse, c_not_negative);
    material.specular = table.number("k_s", material.specular, c_not_negative);
    material.exponent = table.number("exponent", material.exponent, c_at_least_1);
    material.roughness =
        table.number("roughness", material.roughness, {.low = 0.0, .high = 1.0, .low_excluded = true});
    material.reflectance = table.number("reflectance", material.reflectance, {.low = 0.0, .high = 1.0});
    named_materials_.emplace(material.name, static_cast<std::uint32_t>(scene_.materials.size()));
    scene_.materials.push_back(std::move(material));
  }

  /// Search the scene file's own materials only. Materials of mesh files follow them in the list and may have
  /// the same names.
  std::optional<std::uint32_t> named_material(const std::string& name) const {
    const auto found = named_materials_.find(name);
    return found == named_materials_.end() ? std::nullopt : std::optional(found->second);
  }

  void read_mesh(const toml::table& node) {
    const bool is_file = node.contains("file");
    const toml::node* kind_node = node.get("kind");
    const std::string kind =
        is_file || kind_node == nullptr ? "" : kind_node->value<std::string>().value_or(std::string());
    std::optional<TomlTable> table;
    const auto open = [&](auto... own) {
      table.emplace(node, file_, "mesh",
                    std::vector<std::string_view>{own..., "material", "translate", "rotate", "scale",
                                                  "crease_angle", "normals", "cull"},
                    error_);
    };
    LoadedMesh loaded;
    std::string path;
    if (is_file) {
      if (kind_node != nullptr)
        TomlTable(node, file_, "mesh", all_mesh_keys(), error_).fail("kind", "cannot be given with file");
      open("file");
      if (options_.tessellation != 1.0)
        table->fail("file", "has the triangles it has: no other tessellation");
      if (!read_mesh_file(*table, loaded, path)) return;
    } else if (kind == "sphere") {
      open("kind", "slices", "stacks", "radius");
      const std::uint32_t slices = parts(*table, "slices", 24, 3);
      const std::uint32_t stacks = parts(*table, "stacks", 16, 2);
      const double radius = table->number("radius", 1.0, c_positive);
      if (!check_triangles(*table, uv_sphere_triangles(slices, stacks))) return;
      loaded.mesh = make_uv_sphere(slices, stacks, radius);
    } else if (kind == "teapot") {
      open("kind", "divisions");
      const std::uint32_t divisions = parts(*table, "divisions", 8, 2);
      if (!check_triangles(*table, teapot_triangles(divisions))) return;
      loaded.mesh = make_teapot(divisions);
    } else if (kind == "box") {
      open("kind", "size", "divisions");
      const glm::dvec3 size = table->one_or_three("size", glm::dvec3(1.0), c_positive);
      const std::uint32_t divisions = parts(*table, "divisions", 1, 1);
      if (!check_triangles(*table, box_triangles(divisions))) return;
      loaded.mesh = make_box(size, divisions);
    } else {
      const TomlTable any(node, file_, "mesh", all_mesh_keys(), error_);
      if (kind_node == nullptr) any.fail("mesh has neither 'kind' nor 'file'; give it one");
      any.fail("kind", "must be \"sphere\", \"teapot\" or \"box\"; a mesh file goes under 'file'");
      return;
    }
    if (!check_triangles(*table, loaded.mesh.triangles.size())) return;
    if (path.empty()) path = fmt::format("{}:{}", file_, node.source().begin.line);
    place(*table, loaded, path);
  }

  // Number of parts of a generated mesh, with the tessellation factor applied.
  std::uint32_t parts(const TomlTable& table, std::string_view key, std::uint32_t otherwise,
                      std::uint32_t least) const {
    const double wanted = std::round(options_.tessellation * table.count(key, otherwise, least));
    if (wanted > c_max_triangles) {
      table.fail(key, "is too much at this tessellation");
      return least;
    }
    return std::max(least, to_integer<std::uint32_t>(wanted));
  }

  static std::vector<std::string_view> all_mesh_keys() {
    return {"kind",     "file",      "slices", "stacks", "radius",       "divisions", "size",
            "material", "translate", "rotate", "scale",  "crease_angle", "normals",   "cull"};
  }

  // Returns false after an error, as check_triangles.
  bool read_mesh_file(const TomlTable& table, LoadedMesh& loaded, std::string& path) {
    const std::string name = table.text("file");
    if (error_) return false;
    MeshFile file = read_mesh_(name);
    path = std::move(file.path);
    if (!file.refusal.empty())
      table.fail("file", file.refusal);
    else if (!file.mesh)
      error_.set(file.mesh.error());
    else
      loaded = std::move(*file.mesh);
    if (!loaded.lights.empty())
      scene_.notes.push_back(path + ": its lights are left out; the scene has its own");
    return !error_;
  }

  bool check_triangles(const TomlTable& table, std::uint64_t triangles) {
    if (scene_.triangles.size() + triangles > c_max_triangles)
      table.fail(
          fmt::format("the scene has {} triangles up to this mesh, but {} is the most; use coarser meshes",
                      scene_.triangles.size() + triangles, c_max_triangles));
    return !error_;
  }

  void place(const TomlTable& table, LoadedMesh& loaded, const std::string& what) {
    Mesh& mesh = loaded.mesh;
    const glm::dmat4 matrix = read_transform(table);
    const std::string normals = table.has("normals") ? table.text("normals") : "";
    if (!normals.empty() && normals != "file" && normals != "computed") {
      table.fail("normals", fmt::format("is '{}', but must be \"file\" or \"computed\"", normals));
    }
    if (table.has("crease_angle") && normals == "file") {
      table.fail("crease_angle", "needs normals = \"computed\"");
    }
    const double crease =
        table.number("crease_angle", loaded.default_crease_degrees, {.low = 0.0, .high = 180.0});
    const std::optional<Culling> culling = read_culling(table, culling_);
    std::uint32_t first_material = 0;
    if (table.has("material")) {
      const std::string name = table.text("material");
      const std::optional<std::uint32_t> index = named_material(name);
      if (!index.has_value())
        table.fail("material", fmt::format("'{}' is not defined by any [[material]]", name));
      mesh.materials.clear();
      first_material = index.value_or(0);
      for (SceneTriangle& triangle : mesh.triangles) triangle.material = 0;
    } else if (mesh.materials.empty()) {
      mesh.materials.push_back({.name = "default"});
    }
    if (error_) return;
    if (matrix != glm::dmat4(1.0)) transform(mesh, matrix);
    scene_.notes.insert(scene_.notes.end(), loaded.notes.begin(), loaded.notes.end());
    if (!mesh.materials.empty()) first_material = static_cast<std::uint32_t>(scene_.materials.size());
    const std::size_t first_triangle = scene_.triangles.size();
    const Status added = add_mesh(scene_, mesh, what, first_material,
                                  {.crease_degrees = crease,
                                   .replace_normals = normals == "computed" || table.has("crease_angle"),
                                   .culling = culling});
    if (!added) error_.set(added.error());
    if (error_ || !scene_.shadows) return;
    if (const std::size_t open = open_edges(std::span(scene_.triangles).subspan(first_triangle)); open > 0) {
      scene_.notes.push_back(
          fmt::format("{}: the mesh is open at {} edges; each of its triangles casts a shadow only where it "
                      "faces away from the light",
                      what, open));
    }
  }

  // Empty: automatic.
  static std::optional<Culling> read_culling(const TomlTable& table, std::optional<Culling> otherwise) {
    if (!table.has("cull")) return otherwise;
    const std::string cull = table.text("cull");
    if (cull == "back") return Culling::back;
    if (cull == "none") return Culling::none;
    if (cull != "auto")
      table.fail("cull", fmt::format("is '{}', but must be \"auto\", \"back\" or \"none\"", cull));
    return std::nullopt;
  }

  glm::dmat4 read_transform(const TomlTable& table) {
    const glm::dvec3 scale = table.one_or_three("scale", glm::dvec3(1.0));
    if (scale.x == 0.0 || scale.y == 0.0 || scale.z == 0.0) table.fail("scale", "must not be zero");
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), table.vector("translate", glm::dvec3(0.0)));
    if (table.has("rotate")) {
      const toml::table* node = table.required("rotate")->as_table();
      if (node == nullptr) {
        table.fail("rotate", "must be written { degrees = 90, axis = [0, 1, 0] }");
        return matrix;
      }
      const TomlTable rotation(*node, file_, "rotate", {"degrees", "axis"}, error_);
      rotation.required("degrees");
      matrix = glm::rotate(matrix, glm::radians(rotation.number("degrees", 0.0, c_any)),
                           rotation.direction("axis"));
    }
    return glm::scale(matrix, scale);
  }

  std::string file_;
  const ReadMesh& read_mesh_;
  LoadOptions options_;
  Scene scene_;
  std::optional<Culling> culling_;  // of the scene's meshes without their own
  FirstError error_;
  std::unordered_map<std::string, std::uint32_t> named_materials_;
};

}  // namespace

Status check_scene_size(std::uintmax_t bytes, std::string_view file) {
  if (bytes <= c_max_scene_file_bytes) return Ok{};
  return bad_input(
      fmt::format("{}: larger than {} MiB, which no scene file is; meshes go into files of their own", file,
                  c_max_scene_file_bytes >> 20));
}

Result<Scene> parse_scene(std::string_view text, std::string_view file, const ReadMesh& read_mesh,
                          const LoadOptions& options) {
  if (Status ok = check_scene_size(text.size(), file); !ok) return ok.error();
  return SceneReader(file, read_mesh, options).read(text);
}

Result<Scene> scene_of_mesh(LoadedMesh loaded, std::string_view file) {
  const std::string name(file);
  Scene scene;
  scene.name = file_stem(file);
  scene.notes = std::move(loaded.notes);
  if (Status ok = add_mesh(scene, loaded.mesh, name, 0, {.crease_degrees = loaded.default_crease_degrees});
      !ok)
    return ok.error();
  scene.camera = CameraFit{}.camera(scene);
  if (Status ok = check_view(scene, name); !ok) return ok.error();
  if (loaded.lights.empty()) {
    const ViewBasis view = view_basis(scene.camera);
    loaded.lights.directional.push_back(
        {glm::normalize(-0.6 * view.right_world + 0.7 * view.up_world + view.backward_world),
         glm::dvec3(1.0)});
  }
  scene.directional = std::move(loaded.lights.directional);
  scene.positional = std::move(loaded.lights.positional);
  scene.spots = std::move(loaded.lights.spots);
  return scene;
}

}  // namespace halfway
