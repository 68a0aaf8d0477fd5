// SPDX-License-Identifier: Apache-2.0
#include "sim/scene_files/load_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
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
#include "scene/builtin_meshes.hpp"
#include "scene/camera.hpp"
#include "scene/lights.hpp"
#include "scene/mesh.hpp"
#include "sim/scene_files/load_mesh.hpp"
#include "sim/system/file.hpp"

namespace halfway {

namespace {

/// Larger numbers would overflow double in squares and products.
constexpr double c_max_number = 1e15;
/// Files may contain many positions that no triangle uses.
constexpr std::size_t c_max_positions = 3 * std::size_t{c_max_triangles};
constexpr std::uintmax_t c_max_scene_file_bytes = std::uintmax_t{16} << 20;
/// The longest keys have two parts, such as `rotate.axis`. toml++ parses the parts recursively.
constexpr int c_max_key_dots = 16;
const glm::dvec3 c_default_to_eye{0.4, 0.3, 1.0};

/// Exception that stops reading a scene file. `load_scene` returns its error.
class BadScene {
 public:
  explicit BadScene(Error error) : error_(std::move(error)) {}
  const Error& error() const { return error_; }

 private:
  Error error_;
};

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

/// Allowed range of a number.
struct Limits {
  double low = -c_max_number;
  double high = c_max_number;
  bool low_excluded = false;
  bool high_excluded = false;

  bool hold(double value) const {
    return (low_excluded ? value > low : value >= low) && (high_excluded ? value < high : value <= high);
  }
  std::string text() const {
    const std::string above =
        low <= -c_max_number ? "" : fmt::format("{} {:g}", low_excluded ? "greater than" : "at least", low);
    const std::string below = fmt::format("{} {:g}", high_excluded ? "less than" : "at most", high);
    return above.empty() ? below : above + " and " + below;
  }
};

constexpr Limits c_any{};
constexpr Limits c_not_negative{.low = 0.0};
constexpr Limits c_positive{.low = 0.0, .low_excluded = true};
constexpr Limits c_at_least_1{.low = 1.0};

/// A table of the scene file. Returns its values checked, and knows their line numbers.
class Table {
 public:
  /// `what` names the table in messages. A key that is not in `known` is an error.
  Table(const toml::table& table, std::string file, std::string what,
        const std::vector<std::string_view>& known)
      : table_(table), file_(std::move(file)), what_(std::move(what)) {
    for (const auto& [key, value] : table_) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      fail_at(key.source(), fmt::format("unknown key '{}' in {}; it may have: {}", key.str(), what_,
                                        fmt::join(known, ", ")));
    }
  }

  bool has(std::string_view key) const { return table_.contains(key); }

  [[noreturn]] void fail(std::string_view message) const { fail_at(table_.source(), message); }

  [[noreturn]] void fail(std::string_view key, std::string_view message) const {
    const toml::node* node = table_.get(key);
    fail_at(node != nullptr ? node->source() : table_.source(),
            fmt::format("{} of {} {}", key, what_, message));
  }

  const toml::node& required(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) fail(fmt::format("{} has no '{}'; give it one", what_, key));
    return *node;
  }

  double number(std::string_view key, double otherwise, const Limits& limits) const {
    return has(key) ? number_in(key, *table_.get(key), limits) : otherwise;
  }

  std::uint32_t count(std::string_view key, std::uint32_t otherwise, std::uint32_t least) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return otherwise;
    const std::optional<std::int64_t> value = node->value_exact<std::int64_t>();
    if (!value.has_value()) fail(key, "must be a whole number");
    if (*value < least || *value > c_max_triangles) {
      fail(key, fmt::format("is {}, but must be from {} to {}", *value, least, c_max_triangles));
    }
    return static_cast<std::uint32_t>(*value);
  }

  bool flag(std::string_view key, bool otherwise) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return otherwise;
    const std::optional<bool> value = node->value_exact<bool>();
    if (!value.has_value()) fail(key, "must be true or false");
    return *value;
  }

  std::string text(std::string_view key) const {
    const std::optional<std::string> value = required(key).value_exact<std::string>();
    if (!value.has_value()) fail(key, "must be a text in quotes");
    if (value->empty()) fail(key, "is empty");
    return *value;
  }

  glm::dvec3 vector(std::string_view key, const Limits& limits = c_any) const {
    const toml::array* array = required(key).as_array();
    if (array == nullptr || array->size() != 3) fail(key, "must be three numbers, as [1.0, 0.5, 0.0]");
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i) result[i] = number_in(key, (*array)[static_cast<std::size_t>(i)], limits);
    return result;
  }
  glm::dvec3 vector(std::string_view key, const glm::dvec3& otherwise, const Limits& limits = c_any) const {
    return has(key) ? vector(key, limits) : otherwise;
  }

  glm::dvec3 direction(std::string_view key) const {
    const glm::dvec3 result = vector(key);
    const double length = glm::length(result);
    if (!(length > 1e-100)) fail(key, "has no direction: it is zero; give it one");
    return result / length;
  }

  /// Three numbers, or one for all three.
  glm::dvec3 one_or_three(std::string_view key, const glm::dvec3& otherwise,
                          const Limits& limits = c_any) const {
    if (!has(key)) return otherwise;
    if (table_.get(key)->is_number()) return glm::dvec3(number(key, 0.0, limits));
    return vector(key, limits);
  }

  /// Radiance or reflectance. One number means grey.
  glm::dvec3 colour(std::string_view key, const glm::dvec3& otherwise) const {
    return one_or_three(key, otherwise, c_not_negative);
  }

  const toml::table& table() const { return table_; }
  const std::string& file() const { return file_; }

 private:
  [[noreturn]] void fail_at(const toml::source_region& where, std::string_view message) const {
    throw BadScene(bad_input(fmt::format("{}:{}: {}", file_, where.begin.line, message)));
  }

  double number_in(std::string_view key, const toml::node& node, const Limits& limits) const {
    if (!node.is_number()) fail(key, "must be a number");
    const double value =
        node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
    const auto complain = [&](std::string_view message) {
      fail_at(node.source(), fmt::format("{} of {} {}", key, what_, message));
    };
    if (!std::isfinite(value)) complain("is not finite; give it a number");
    if (!limits.hold(value)) complain(fmt::format("is {}, but must be {}", value, limits.text()));
    return value;
  }

  const toml::table& table_;
  std::string file_;
  std::string what_;
};

// ---- Reading a scene file

/// Data for fitting a camera after the meshes are loaded.
struct Fit {
  glm::dvec3 to_eye_world = c_default_to_eye;
  glm::dvec3 up_world{0.0, 1.0, 0.0};
  double vertical_fov_degrees = 40.0;
  double near = 0.0, far = 0.0;

  Camera camera(const Scene& scene) const {
    Camera fitted = fit_camera(bounding_sphere(scene), to_eye_world, up_world, vertical_fov_degrees);
    fitted.near = near;
    fitted.far = far;
    return fitted;
  }
};

class SceneReader {
 public:
  SceneReader(const std::filesystem::path& path, const LoadOptions& options)
      : path_(path), file_(path.string()), options_(options) {}

  /// Throws BadScene.
  Scene read() {
    const Result<std::string> text = read_file(path_);
    if (!text) throw BadScene(text.error());
    if (const std::size_t line = line_of_deep_key(*text); line != 0) {
      throw BadScene(bad_input(
          fmt::format("{}:{}: bad TOML: a key of more than {} parts", file_, line, c_max_key_dots)));
    }
    toml::table root_table;
    try {
      root_table = toml::parse(*text, file_);
    } catch (const toml::parse_error& error) {
      throw BadScene(bad_input(
          fmt::format("{}:{}: bad TOML: {}", file_, error.source().begin.line, error.description())));
    }
    const Table root(root_table, file_, "the scene",
                     {"camera", "ambient", "background", "shadows", "directional", "positional", "spot",
                      "material", "mesh"});
    scene_.name = path_.stem().string();
    scene_.ambient = root.colour("ambient", scene_.ambient);
    scene_.background = root.colour("background", scene_.background);
    scene_.shadows = root.flag("shadows", scene_.shadows);
    const std::optional<Fit> fit = read_camera(root);
    each(root, "directional", [this](const toml::table& table) { read_directional(table); });
    each(root, "positional", [this](const toml::table& table) { read_positional(table); });
    each(root, "spot", [this](const toml::table& table) { read_spot(table); });
    each(root, "material", [this](const toml::table& table) { read_material(table); });
    each(root, "mesh", [this](const toml::table& table) { read_mesh(table); });
    if (scene_.triangles.empty()) {
      throw BadScene(bad_input(file_ + ": the scene has no mesh; add a [[mesh]]"));
    }
    if (light_count(scene_) == 0) {
      scene_.notes.push_back(file_ + ": no light; only the ambient term is drawn");
    }
    if (fit.has_value()) scene_.camera = fit->camera(scene_);
    if (Status ok = check_view(scene_, file_); !ok) throw BadScene(ok.error());
    return std::move(scene_);
  }

 private:
  template <class Read>
  void each(const Table& root, std::string_view key, const Read& read) {
    if (!root.has(key)) return;
    const toml::array* array = root.required(key).as_array();
    if (array == nullptr) root.fail(key, fmt::format("must be written [[{}]]", key));
    for (const toml::node& node : *array) {
      if (!node.is_table()) root.fail(key, fmt::format("must be written [[{}]]", key));
      read(*node.as_table());
    }
  }

  std::optional<Fit> read_camera(const Table& root) {
    if (!root.has("camera")) return Fit{};
    const toml::table* node = root.required("camera").as_table();
    if (node == nullptr) root.fail("camera", "must be written [camera]");
    const Table camera(*node, file_, "camera",
                       {"fit", "direction", "eye", "target", "up", "fov", "near", "far"});
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
      Fit fit{.up_world = result.up_world,
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
    const Table light(node, file_, "directional", {"to_light", "intensity"});
    scene_.directional.push_back({light.direction("to_light"), light.colour("intensity", glm::dvec3(1.0))});
  }

  void read_positional(const toml::table& node) {
    const Table light(node, file_, "positional", {"position", "intensity"});
    scene_.positional.push_back({light.vector("position"), light.colour("intensity", glm::dvec3(1.0))});
  }

  void read_spot(const toml::table& node) {
    const Table light(node, file_, "spot", {"position", "axis", "inner", "outer", "intensity"});
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
    const Table table(node, file_, "material",
                      {"name", "brdf", "colour", "specular_colour", "k_a", "k_d", "k_s", "exponent",
                       "roughness", "reflectance"});
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
    std::optional<Table> table;
    const auto open = [&](auto... own) {
      table.emplace(node, file_, "mesh",
                    std::vector<std::string_view>{own..., "material", "translate", "rotate", "scale",
                                                  "crease_angle", "normals"});
    };
    LoadedMesh loaded;
    if (is_file) {
      if (kind_node != nullptr)
        Table(node, file_, "mesh", all_mesh_keys()).fail("kind", "cannot be given with file");
      open("file");
      if (options_.tessellation != 1.0)
        table->fail("file", "has the triangles it has: no other tessellation");
      loaded = read_mesh_file(*table);
    } else if (kind == "sphere") {
      open("kind", "slices", "stacks", "radius");
      const std::uint32_t slices = parts(*table, "slices", 24, 3);
      const std::uint32_t stacks = parts(*table, "stacks", 16, 2);
      const double radius = table->number("radius", 1.0, c_positive);
      check_triangles(*table, uv_sphere_triangles(slices, stacks));
      loaded.mesh = make_uv_sphere(slices, stacks, radius);
    } else if (kind == "teapot") {
      open("kind", "divisions");
      const std::uint32_t divisions = parts(*table, "divisions", 8, 2);
      check_triangles(*table, teapot_triangles(divisions));
      loaded.mesh = make_teapot(divisions);
    } else if (kind == "box") {
      open("kind", "size", "divisions");
      const glm::dvec3 size = table->one_or_three("size", glm::dvec3(1.0), c_positive);
      const std::uint32_t divisions = parts(*table, "divisions", 1, 1);
      check_triangles(*table, box_triangles(divisions));
      loaded.mesh = make_box(size, divisions);
    } else {
      const Table any(node, file_, "mesh", all_mesh_keys());
      if (kind_node == nullptr) any.fail("mesh has neither 'kind' nor 'file'; give it one");
      any.fail("kind", "must be \"sphere\", \"teapot\" or \"box\"; a mesh file goes under 'file'");
    }
    check_triangles(*table, loaded.mesh.triangles.size());
    place(*table, loaded);
  }

  // Number of parts of a generated mesh, with the tessellation factor applied.
  std::uint32_t parts(const Table& table, std::string_view key, std::uint32_t otherwise,
                      std::uint32_t least) const {
    const double wanted = std::round(options_.tessellation * table.count(key, otherwise, least));
    if (wanted > c_max_triangles) table.fail(key, "is too much at this tessellation");
    return std::max(least, to_integer<std::uint32_t>(wanted));
  }

  static std::vector<std::string_view> all_mesh_keys() {
    return {"kind",     "file",      "slices", "stacks", "radius",       "divisions", "size",
            "material", "translate", "rotate", "scale",  "crease_angle", "normals"};
  }

  LoadedMesh read_mesh_file(const Table& table) {
    const std::filesystem::path path = path_.parent_path() / table.text("file");
    // Report these as errors of the scene file, because it contains the wrong path.
    if (!is_mesh_file_name(path)) {
      table.fail("file", "is not a mesh file by its name; .obj, .ply, .stl, .gltf and .glb can be read");
    }
    if (Status ok = check_readable(path); !ok) table.fail("file", "cannot be used: " + ok.error().message);
    Result<LoadedMesh> loaded = load_mesh(path);
    if (!loaded) throw BadScene(loaded.error());
    return std::move(*loaded);
  }

  void check_triangles(const Table& table, std::uint64_t triangles) const {
    if (scene_.triangles.size() + triangles <= c_max_triangles) return;
    table.fail(
        fmt::format("the scene has {} triangles up to this mesh, but {} is the most; use coarser meshes",
                    scene_.triangles.size() + triangles, c_max_triangles));
  }

  void place(const Table& table, LoadedMesh& loaded) {
    Mesh& mesh = loaded.mesh;
    if (const glm::dmat4 matrix = read_transform(table); matrix != glm::dmat4(1.0)) transform(mesh, matrix);
    const std::string normals = table.has("normals") ? table.text("normals") : "";
    if (!normals.empty() && normals != "file" && normals != "computed") {
      table.fail("normals", fmt::format("is '{}', but must be \"file\" or \"computed\"", normals));
    }
    if (table.has("crease_angle") && normals == "file") {
      table.fail("crease_angle", "needs normals = \"computed\"");
    }
    const double crease =
        table.number("crease_angle", loaded.default_crease_degrees, {.low = 0.0, .high = 180.0});
    std::uint32_t first_material = 0;
    if (table.has("material")) {
      const std::string name = table.text("material");
      const std::optional<std::uint32_t> index = named_material(name);
      if (!index.has_value())
        table.fail("material", fmt::format("'{}' is not defined by any [[material]]", name));
      mesh.materials.clear();
      first_material = *index;
      for (SceneTriangle& triangle : mesh.triangles) triangle.material = 0;
    } else if (mesh.materials.empty()) {
      mesh.materials.push_back({.name = "default"});
    }
    scene_.notes.insert(scene_.notes.end(), loaded.notes.begin(), loaded.notes.end());
    const std::string what = table.has("file")
                                 ? (path_.parent_path() / table.text("file")).string()
                                 : fmt::format("{}:{}", file_, table.table().source().begin.line);
    if (!mesh.materials.empty()) first_material = static_cast<std::uint32_t>(scene_.materials.size());
    const std::size_t first_triangle = scene_.triangles.size();
    const Status added = add_mesh(scene_, mesh, what, first_material, crease,
                                  normals == "computed" || table.has("crease_angle"));
    if (!added) throw BadScene(added.error());
    if (!scene_.shadows) return;
    if (const std::size_t open = open_edges(std::span(scene_.triangles).subspan(first_triangle)); open > 0) {
      scene_.notes.push_back(
          fmt::format("{}: the mesh is open at {} edges; each of its triangles casts a shadow only where it "
                      "faces away from the light",
                      what, open));
    }
  }

  glm::dmat4 read_transform(const Table& table) const {
    const glm::dvec3 scale = table.one_or_three("scale", glm::dvec3(1.0));
    if (scale.x == 0.0 || scale.y == 0.0 || scale.z == 0.0) table.fail("scale", "must not be zero");
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), table.vector("translate", glm::dvec3(0.0)));
    if (table.has("rotate")) {
      const toml::table* node = table.required("rotate").as_table();
      if (node == nullptr) table.fail("rotate", "must be written { degrees = 90, axis = [0, 1, 0] }");
      const Table rotation(*node, file_, "rotate", {"degrees", "axis"});
      rotation.required("degrees");
      matrix = glm::rotate(matrix, glm::radians(rotation.number("degrees", 0.0, c_any)),
                           rotation.direction("axis"));
    }
    return glm::scale(matrix, scale);
  }

 public:
  /// A fitted camera fails for a tiny object far from the origin: rounding makes its eye equal to its target.
  static Status check_view(const Scene& scene, const std::string& what) {
    if (has_view(scene.camera)) return Ok{};
    return bad_input(
        what +
        ": a camera cannot be fitted, because the scene is too small for its distance from the origin, or "
        "too large; move it to the origin, or scale it");
  }

  /// Add a mesh in world space to a scene, with valid normals and materials. `what` is the prefix of
  /// messages.
  static Status add_mesh(Scene& scene, Mesh& mesh, const std::string& what, std::uint32_t first_material,
                         double crease_degrees, bool replace_normals) {
    if (scene.positions_world.size() + mesh.positions.size() > c_max_positions) {
      return bad_input(
          fmt::format("{}: more than {} vertices up to this mesh; use coarser ones", what, c_max_positions));
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec3 size = glm::abs(mesh.positions[i]);
      if (size.x <= c_max_number && size.y <= c_max_number && size.z <= c_max_number) continue;
      return bad_input(fmt::format("{}: vertex {} has a coordinate beyond {:g}; scale the mesh down", what,
                                   i + 1, c_max_number));
    }
    const std::size_t dropped = drop_zero_area(mesh);
    if (mesh.triangles.empty()) return bad_input(what + ": no triangle of the mesh has any area");
    if (dropped > 0) {
      scene.notes.push_back(fmt::format("{}: {} triangles without area left out", what, dropped));
    }
    const std::size_t corners = 3 * mesh.triangles.size();
    const std::size_t filled = fill_normals(mesh, crease_degrees, replace_normals);
    if (!replace_normals && filled > 0 && filled < corners) {
      scene.notes.push_back(
          fmt::format("{}: {} of {} corners have no normal; theirs were computed", what, filled, corners));
    }
    const auto first_position = static_cast<std::uint32_t>(scene.positions_world.size());
    const auto first_normal = static_cast<std::uint32_t>(scene.normals_world.size());
    scene.positions_world.insert(scene.positions_world.end(), mesh.positions.begin(), mesh.positions.end());
    // Unused normals may be zero.
    for (const glm::dvec3& normal : mesh.normals) {
      scene.normals_world.push_back(normal == glm::dvec3(0.0) ? glm::dvec3(0.0, 0.0, 1.0) : normal);
    }
    scene.materials.insert(scene.materials.end(), mesh.materials.begin(), mesh.materials.end());
    for (SceneTriangle triangle : mesh.triangles) {
      for (int corner = 0; corner < 3; ++corner) {
        triangle.position[corner] += first_position;
        triangle.normal[corner] += first_normal;
      }
      triangle.material += first_material;
      scene.triangles.push_back(triangle);
    }
    return Ok{};
  }

 private:
  std::filesystem::path path_;
  std::string file_;
  LoadOptions options_;
  Scene scene_;
  std::unordered_map<std::string, std::uint32_t> named_materials_;
};

Result<Scene> load_scene_file(const std::filesystem::path& path, const LoadOptions& options) {
  if (Status ok = check_readable(path); !ok) return ok.error();
  std::error_code fault;
  if (std::filesystem::file_size(path, fault) > c_max_scene_file_bytes || fault) {
    return bad_input(
        fmt::format("{}: larger than {} MiB, which no scene file is; meshes go into files of their own",
                    path.string(), c_max_scene_file_bytes >> 20));
  }
  try {
    return SceneReader(path, options).read();
  } catch (const BadScene& bad) {
    return bad.error();
  }
}

Result<Scene> load_mesh_as_scene(const std::filesystem::path& path) {
  Result<LoadedMesh> loaded = load_mesh(path);
  if (!loaded) return loaded.error();
  Scene scene;
  scene.name = path.stem().string();
  scene.notes = std::move(loaded->notes);
  if (Status ok =
          SceneReader::add_mesh(scene, loaded->mesh, path.string(), 0, loaded->default_crease_degrees, false);
      !ok) {
    return ok.error();
  }
  scene.camera = Fit{}.camera(scene);
  if (Status ok = SceneReader::check_view(scene, path.string()); !ok) return ok.error();
  const ViewBasis view = view_basis(scene.camera);
  scene.directional.push_back(
      {glm::normalize(-0.6 * view.right_world + 0.7 * view.up_world + view.backward_world), glm::dvec3(1.0)});
  return scene;
}

std::string known_scenes(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code fault;
  for (std::filesystem::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names.empty() ? "none, for want of files in " + folder.string()
                       : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

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
    if (lower_ending(path) == ".toml") return load_scene_file(path, options);
    if (is_mesh_file_name(path)) {
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
      return ok ? bad_input(path.string() +
                            ": not a scene by its name; .toml, .obj, .ply, .stl, .gltf and .glb are")
                : ok.error();
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
