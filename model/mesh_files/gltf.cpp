// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// The standard library for a browser has no file system.
#define JSON_HAS_FILESYSTEM 0
#include <nlohmann/json.hpp>

#include "common/to_integer.hpp"
#include "mesh_files/bytes.hpp"
#include "mesh_files/notes.hpp"
#include "mesh_files/number.hpp"
#include "mesh_files/text_lines.hpp"
#include "scene/check_numbers.hpp"

namespace halfway {

namespace {

using nlohmann::json;

constexpr std::uint64_t c_max_instances = 1'000'000;

/// Extensions that a file may require. Those of textures change only what is left out with the textures.
constexpr std::string_view c_visibility = "KHR_node_visibility", c_unlit = "KHR_materials_unlit",
                           c_glossiness = "KHR_materials_pbrSpecularGlossiness",
                           c_strength = "KHR_materials_emissive_strength",
                           c_instancing = "EXT_mesh_gpu_instancing", c_lights = "KHR_lights_punctual";
constexpr std::string_view c_extensions[] = {c_visibility,
                                             c_instancing,
                                             c_lights,
                                             c_unlit,
                                             c_glossiness,
                                             c_strength,
                                             "KHR_texture_transform",
                                             "KHR_texture_basisu",
                                             "EXT_texture_webp"};
/// In place of a material's index: its surfaces are not drawn.
constexpr std::uint32_t c_not_drawn = UINT32_MAX;

/// An object without keys, for one that a file leaves out.
const json& no_keys() {
  static const json c_none = json::object();
  return c_none;
}

/// A value of the file and its place for messages: "meshes[0].primitives[1]". The first failure of a file is
/// kept, without the file's name. A value that cannot be read is 0, empty or an object without keys: before
/// it is an index, a length or a divisor, the failure must be checked.
class Item {
 public:
  Item(const json& value, std::string place, std::string& failure)
      : value_(&value), place_(std::move(place)), failure_(&failure) {}

  void fail(std::string_view what) const {
    if (!has_failed()) *failure_ = fmt::format("{}{}{}", place_, place_.empty() ? "" : ": ", what);
  }
  /// True after the first failure of the file.
  bool has_failed() const { return !failure_->empty(); }
  const std::string& place() const { return place_; }
  /// An object without keys at the same place.
  Item without_keys() const { return {no_keys(), place_, *failure_}; }

  bool has(const char* key) const { return value_->contains(key); }
  /// The object's value under a key.
  Item at(const char* key) const {
    if (has(key))
      return {(*value_)[key], place_.empty() ? key : fmt::format("{}.{}", place_, key), *failure_};
    fail(fmt::format("no {}; export the file again", key));
    return without_keys();
  }
  Item object(const char* key) const {
    Item item = at(key);
    if (item.value_->is_object()) return item;
    item.fail("is not an object; export the file again");
    return item.without_keys();
  }
  /// The objects or numbers of an array; empty if there is none under the key.
  std::vector<Item> list(const char* key) const {
    std::vector<Item> items;
    if (!has(key)) return items;
    const Item array = at(key);
    if (!array.value_->is_array()) {
      array.fail("is not an array; export the file again");
      return items;
    }
    for (std::size_t i = 0; i < array.value_->size(); ++i) items.push_back(array[i]);
    return items;
  }
  std::vector<Item> objects(const char* key) const {
    std::vector<Item> items = list(key);
    for (const Item& item : items) {
      if (item.value_->is_object()) continue;
      item.fail("is not an object; export the file again");
      return {};
    }
    return items;
  }
  std::uint64_t unsigned_number() const {
    if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
    const double value = value_->is_number_float() ? value_->get<double>() : -1.0;  // 24.0 is a whole number
    constexpr double c_most = 1e15;
    if (value >= 0.0 && value <= c_most && value == std::floor(value))
      return to_integer<std::uint64_t>(value);
    fail("is not a whole number from 0; correct it");
    return 0;
  }
  std::uint64_t unsigned_number(const char* key, std::uint64_t if_missing) const {
    return has(key) ? at(key).unsigned_number() : if_missing;
  }
  /// An index into a list of this length.
  std::size_t index(std::size_t length) const {
    const std::uint64_t index = unsigned_number();
    if (index < length) return index;
    fail(fmt::format("is {}, but the file has {}, counted from 0; correct the index", index, length));
    return 0;
  }
  /// The item of this index. After a failure, an object without keys.
  Item in(const std::vector<Item>& items) const {
    const std::size_t i = index(items.size());
    return has_failed() ? without_keys() : items[i];
  }
  double number() const {
    if (!value_->is_number()) fail("is not a number; correct it");
    const double number = value_->is_number() ? value_->get<double>() : 0.0;
    if (std::isfinite(number)) return number;
    fail("is not finite; correct it");
    return 0.0;
  }
  bool flag(const char* key, bool if_missing) const {
    if (!has(key)) return if_missing;
    const Item item = at(key);
    if (item.value_->is_boolean()) return item.value_->get<bool>();
    item.fail("is not true or false; correct it");
    return false;
  }
  double number(const char* key, double if_missing) const { return has(key) ? at(key).number() : if_missing; }
  template <std::size_t N>
  std::array<double, N> numbers(const char* key) const {
    const std::vector<Item> items = list(key);
    std::array<double, N> values{};
    if (items.size() != N) at(key).fail(fmt::format("has {} numbers, not {}; correct it", items.size(), N));
    for (std::size_t i = 0; i < std::min(items.size(), N); ++i) values[i] = items[i].number();
    return values;
  }
  std::string_view text() const {
    if (value_->is_string()) return value_->get_ref<const std::string&>();
    fail("is not a string; correct it");
    return {};
  }
  std::string_view text(const char* key, std::string_view if_missing) const {
    return has(key) ? at(key).text() : if_missing;
  }
  /// The keys of an object.
  std::vector<std::string> keys() const {
    std::vector<std::string> keys;
    for (const auto& entry : value_->items()) keys.push_back(entry.key());
    return keys;
  }

 private:
  Item operator[](std::size_t i) const { return {(*value_)[i], fmt::format("{}[{}]", place_, i), *failure_}; }

  const json* value_;
  std::string place_;
  std::string* failure_;
};

// ---- Container and buffers

struct Chunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Divide a .glb into its chunks. A .gltf is JSON as a whole.
Result<Chunks> chunks_of(std::string_view bytes, std::string_view file) {
  constexpr std::uint32_t c_json = 0x4e4f534a, c_binary = 0x004e4942;
  constexpr std::size_t c_header = 12, c_chunk_header = 8;
  if (!bytes.starts_with("glTF")) return Chunks{.json = bytes, .binary = {}};
  const auto word = [bytes](std::size_t at) {
    return number_in<std::uint32_t>(bytes, at, ByteOrder::little);
  };
  const auto error = [file](std::size_t at, std::string_view what) {
    return bad_input(fmt::format("{}: byte {}: {}", file, at, what));
  };
  if (bytes.size() < c_header + c_chunk_header)
    return error(0, "the file ends in its header; it is truncated, export it again");
  if (word(4) != 2) return error(4, fmt::format("GLB version {}; export as version 2", word(4)));
  if (word(8) != bytes.size())
    return error(
        8, fmt::format("its header requires {} bytes, it has {}; export it again", word(8), bytes.size()));
  Chunks chunks;
  std::size_t at = c_header;
  for (int chunk = 0; at < bytes.size(); ++chunk) {
    const std::size_t left = bytes.size() - at;
    if (left < c_chunk_header || word(at) > left - c_chunk_header)
      return error(at, fmt::format("chunk {} is longer than the file; export the file again", chunk));
    const std::uint32_t type = word(at + 4);
    const std::string_view data = bytes.substr(at + c_chunk_header, word(at));
    if ((chunk == 0) != (type == c_json))
      return error(at, "the first chunk, and no other, must be JSON; export the file again");
    if (chunk == 0) chunks.json = data;
    if (chunk == 1 && type == c_binary) chunks.binary = data;
    at += c_chunk_header + data.size();
  }
  return chunks;
}

std::string decode_base64(const Item& uri, std::string_view text) {
  const auto value_of = [](char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
  };
  if (text.size() % 4 == 0) {
    for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  }
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = value_of(c);
    if (value < 0) {
      uri.fail(fmt::format("{} is not base64; export the file again", halfway::quoted({&c, 1})));
      return {};
    }
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> count);
    }
  }
  if (count == 6) uri.fail("its base64 is truncated; export the file again");
  return bytes;
}

std::string decode_percent(const Item& uri, std::string_view text) {
  const auto value_of = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      name += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? value_of(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? value_of(text[i + 2]) : -1;
    if (high < 0 || low < 0) {
      uri.fail("% is not followed by two hexadecimal digits; correct it");
      return {};
    }
    name += static_cast<char>(16 * high + low);
    i += 2;
  }
  return name;
}

/// Read a buffer's file. It must be in the folder of the glTF file or below.
std::string read_buffer_file(const Item& uri, const ReadBuffer& read_buffer) {
  const std::string name = decode_percent(uri, uri.text());
  if (name.find(':') != std::string::npos)
    uri.fail(halfway::quoted(name) + " is an address; store the buffer in a file next to this one");
  const bool is_up = ("/" + name + "/").find("/../") != std::string::npos;
  if (name.starts_with('/') || is_up || name.find('\0') != std::string::npos)
    uri.fail(halfway::quoted(name) + " is outside of the file's folder; move the buffer next to this file");
  if (uri.has_failed()) return {};
  BufferFile file = read_buffer(name);
  if (!file.refusal.empty()) uri.fail(halfway::quoted(name) + " " + file.refusal);
  return std::move(file.bytes);
}

// ---- Accessors

struct ComponentType {
  std::uint64_t code;
  std::size_t bytes;
};
constexpr std::uint64_t c_int8 = 5120, c_uint8 = 5121, c_int16 = 5122, c_uint16 = 5123, c_uint32 = 5125,
                        c_float = 5126;
constexpr ComponentType c_component_types[] = {{c_int8, 1},   {c_uint8, 1},  {c_int16, 2},
                                               {c_uint16, 2}, {c_uint32, 4}, {c_float, 4}};

/// Items of a buffer at equal distances.
struct Span {
  std::string_view bytes;
  std::uint64_t stride = 0;
};

class GltfReader {
 public:
  GltfReader(const json& root, std::optional<std::string_view> binary, std::string_view file,
             const ReadBuffer& read_buffer)
      : root_(root, "", failure_), binary_(binary), file_(file), read_buffer_(read_buffer) {}

  Result<LoadedMesh> read() {
    check_asset();
    meshes_ = root_.objects("meshes");
    nodes_ = root_.objects("nodes");
    accessors_ = root_.objects("accessors");
    views_ = root_.objects("bufferViews");
    buffers_ = root_.objects("buffers");
    materials_ = root_.objects("materials");
    lights_ = lights_of_file();
    buffer_bytes_.resize(buffers_.size());
    loaded_.mesh.normals.emplace_back(0.0);
    read_nodes();
    scale_lights();
    if (loaded_.mesh.triangles.empty()) root_.fail("the mesh has no faces; export it with faces");
    if (has_failed()) return bad_input(file_ + ": " + failure_);
    if (points_and_lines_ > 0) note(fmt::format("{} points and lines left out", points_and_lines_));
    loaded_.notes = notes_.list();
    join_positions(loaded_.mesh);
    return std::move(loaded_);
  }

 private:
  bool has_failed() const { return root_.has_failed(); }
  /// Call `read`. Its failure does not fail the file: it is noted with its consequence. True if there is
  /// none.
  template <class Read>
  bool attempt(const Read& read, std::string_view consequence) {
    std::string earlier = std::exchange(failure_, {});
    read();
    const std::string failure = std::exchange(failure_, std::move(earlier));
    if (!failure.empty()) note(failure + std::string(consequence));
    return failure.empty();
  }

  void note(std::string_view what) { note(root_, what); }
  /// After a failure nothing is noted.
  void note(const Item& item, std::string_view what) {
    if (!has_failed()) notes_.add(place_of(item), what);
  }
  std::string place_of(const Item& item) const {
    return item.place().empty() ? file_ : file_ + ": " + item.place();
  }

  /// Note the keys and extensions of an object that are not used. Any object may have a name and extras.
  void note_unused(const Item& item, std::initializer_list<std::string_view> used) {
    for (const std::string& key : item.keys()) {
      if (contains(used, key) || key == "name" || key == "extras" || key == "extensions") continue;
      note(item, halfway::quoted(key) + " is not used");
    }
    if (!item.has("extensions")) return;
    for (const std::string& key : item.object("extensions").keys())
      if (!contains(c_extensions, key)) note(item, "extension " + halfway::quoted(key) + " is not used");
  }
  /// An object's extension, or one without keys.
  static Item extension_of(const Item& item, std::string_view name) {
    const Item all = item.has("extensions") ? item.object("extensions") : item.without_keys();
    return all.has(name.data()) ? all.object(name.data()) : item.without_keys();
  }
  static bool has_extension(const Item& item, std::string_view name) {
    return item.has("extensions") && item.object("extensions").has(name.data());
  }

  void check_asset() {
    const Item asset = root_.object("asset");
    if (!asset.text("minVersion", "2.0").starts_with("2.0"))
      asset.at("minVersion").fail("is later than 2.0; export as glTF 2.0");
    note_unused(
        root_, {"asset", "scene", "scenes", "nodes", "meshes", "skins", "accessors", "bufferViews", "buffers",
                "materials", "textures", "images", "samplers", "extensionsUsed", "extensionsRequired"});
    const std::string_view version = asset.at("version").text();
    if (!version.starts_with("2.")) {
      root_.at("asset").fail(fmt::format("glTF {}; export as glTF 2.0", halfway::quoted(version)));
    }
    for (const Item& extension : root_.list("extensionsRequired")) {
      const std::string_view name = extension.text();
      if (!contains(c_extensions, name))
        extension.fail(halfway::quoted(name) + " cannot be read; export the file without it");
    }
  }

  // ---- Nodes

  /// Read the selected scene's nodes in the file's order.
  void read_nodes() {
    struct Pending {
      std::size_t node;
      glm::dmat4 to_file;
    };
    std::vector<Pending> pending;
    const std::vector<Item> roots = root_nodes();
    for (std::size_t i = roots.size(); i-- > 0;) {
      pending.push_back({roots[i].index(nodes_.size()), glm::dmat4(1.0)});
    }
    // The nodes are a tree: none is reached twice.
    std::vector<bool> is_read(nodes_.size());
    while (!pending.empty() && !has_failed()) {
      const Pending next = pending.back();
      pending.pop_back();
      const Item& node = nodes_[next.node];
      if (is_read[next.node]) return node.fail("is reached twice; export the file with a tree of nodes");
      is_read[next.node] = true;
      note_unused(node, {"mesh", "children", "skin", "weights", "matrix", "translation", "rotation", "scale",
                         "camera"});
      if (!extension_of(node, c_visibility).flag("visible", true)) {
        note(node, "it is not visible: it is not drawn");
        continue;
      }
      const glm::dmat4 to_file = next.to_file * transform_of(node);
      if (has_extension(node, c_lights)) read_light(node, to_file);
      if (node.has("skin")) note(node, "bones are omitted: the mesh is in its bind pose");
      // The transform of a node with a skin does not move its mesh.
      if (node.has("mesh")) {
        const auto places = node.has("skin") ? std::vector{glm::dmat4(1.0)} : places_of(node, to_file);
        add_mesh(node.at("mesh").in(meshes_), node, places);
      }
      const std::vector<Item> children = node.list("children");
      for (std::size_t i = children.size(); i-- > 0;) {
        pending.push_back({children[i].index(nodes_.size()), to_file});
      }
    }
  }

  std::vector<Item> root_nodes() {
    const std::vector<Item> scenes = root_.objects("scenes");
    if (root_.has("scene")) return root_.at("scene").in(scenes).list("nodes");
    if (!scenes.empty()) return scenes[0].list("nodes");
    std::vector<bool> is_child(nodes_.size());
    for (const Item& node : nodes_) {
      for (const Item& child : node.list("children")) is_child[child.index(nodes_.size())] = true;
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!is_child[i]) all_roots_.emplace_back(i);
    }
    std::vector<Item> roots;
    for (const json& index : all_roots_) roots.emplace_back(index, "nodes", failure_);
    return roots;
  }

  glm::dmat4 transform_of(const Item& node) {
    if (node.has("matrix")) {
      if (node.has("translation") || node.has("rotation") || node.has("scale")) {
        node.fail("has both a matrix and translation, rotation or scale; remove one");
      }
      const auto m = node.numbers<16>("matrix");
      glm::dmat4 matrix;
      for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
      // The row may be rounded, as floats of a file are.
      constexpr double c_rounding = 1e-5;
      if (glm::any(glm::greaterThan(glm::abs(glm::row(matrix, 3) - glm::dvec4(0, 0, 0, 1)),
                                    glm::dvec4(c_rounding)))) {
        node.at("matrix").fail("its last row is not 0 0 0 1; export the file again");
      }
      return glm::row(matrix, 3, glm::dvec4(0, 0, 0, 1));
    }
    glm::dmat4 matrix(1.0);
    if (node.has("translation")) {
      const auto t = node.numbers<3>("translation");
      matrix = glm::translate(matrix, glm::dvec3(t[0], t[1], t[2]));
    }
    if (node.has("rotation")) {
      const auto r = node.numbers<4>("rotation");
      matrix *= rotation_of({r[0], r[1], r[2], r[3]}, node);
    }
    if (node.has("scale")) {
      const auto s = node.numbers<3>("scale");
      matrix = glm::scale(matrix, glm::dvec3(s[0], s[1], s[2]));
    }
    return matrix;
  }

  glm::dmat4 rotation_of(const glm::dvec4& xyzw, const Item& node) {
    const glm::dquat rotation(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
    const double length = glm::length(rotation);
    if (!(std::abs(length - 1.0) < 0.01))
      note(node, "its rotation does not have the length 1; only its direction is used");
    return length > 0.0 ? glm::mat4_cast(rotation / length) : glm::dmat4(1.0);
  }

  /// The transform of each instance of a node's mesh.
  std::vector<glm::dmat4> places_of(const Item& node, const glm::dmat4& to_file) {
    if (!has_extension(node, c_instancing)) return {to_file};
    const Item attributes = extension_of(node, c_instancing).object("attributes");
    note_unused(attributes, {"TRANSLATION", "ROTATION", "SCALE"});
    std::vector<glm::dmat4> places;  // empty until the first of the three
    const auto move = [&](const auto& values, auto&& matrix_of) {
      if (places.empty()) places.assign(values.size(), to_file);
      if (values.size() != places.size())
        attributes.fail(
            fmt::format("has {} and {} instances; export the file again", places.size(), values.size()));
      for (std::size_t i = 0; i < values.size() && !has_failed(); ++i) places[i] *= matrix_of(values[i]);
    };
    for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"}) {
      if (!attributes.has(key)) continue;
      const Item index = attributes.at(key);
      if (index.in(accessors_).at("count").unsigned_number() > c_max_instances)
        index.fail(fmt::format("more than {} instances; export fewer", c_max_instances));
      if (key[0] == 'T')
        move(read_vectors(index, true),
             [](const glm::dvec3& t) { return glm::translate(glm::dmat4(1.0), t); });
      else if (key[0] == 'R')
        move(read_rotations(index), [&](const glm::dvec4& r) { return rotation_of(r, node); });
      else
        move(read_vectors(index, true), [](const glm::dvec3& s) { return glm::scale(glm::dmat4(1.0), s); });
    }
    return places.empty() ? std::vector{to_file} : places;
  }

  // ---- Lights

  /// The descriptions of the file's lights; none if they cannot be read.
  std::vector<Item> lights_of_file() {
    std::vector<Item> lights;
    attempt([&] { lights = extension_of(root_, c_lights).objects("lights"); }, "; the lights are left out");
    return lights;
  }

  void read_light(const Item& node, const glm::dmat4& to_file) {
    attempt([&] { add_light(extension_of(node, c_lights).at("light").in(lights_), to_file); },
            "; the light is left out");
  }

  /// Add a light at the origin of its node, which shines along the node's negative z axis.
  void add_light(const Item& light, const glm::dmat4& to_file) {
    const auto is_small = [](const glm::dvec3& v) {
      const glm::dvec3 size = glm::abs(v);
      return size.x <= c_max_number && size.y <= c_max_number && size.z <= c_max_number;
    };
    const double scale = light.number("intensity", 1.0);
    const glm::dvec3 intensity = scale * glm::dvec3(colour(light, "color", glm::dvec4(1.0)));
    if (scale < 0.0 || !is_small(intensity))
      light.fail(fmt::format("its intensity is not 0 to {:g}", c_max_number));
    const glm::dvec3 position(to_file[3]), z(to_file[2]);
    const std::string_view type = light.at("type").text();
    if (!is_small(position) || !is_small(z) || (type != "point" && z == glm::dvec3(0.0)))
      light.fail(fmt::format("its node has no direction, or is beyond {:g}", c_max_number));
    if (has_failed()) return;
    if (type == "directional") {
      loaded_.lights.directional.push_back({glm::normalize(z), intensity});
    } else if (type == "point") {
      loaded_.lights.positional.push_back({position, intensity});
    } else if (type == "spot") {
      const Item cone = light.has("spot") ? light.object("spot") : light.without_keys();
      constexpr double c_right_angle = 1.5707964;  // as a float
      const double inner = cone.number("innerConeAngle", 0.0),
                   outer = cone.number("outerConeAngle", 0.785398163397);
      if (!(inner >= 0.0 && inner <= outer && outer > 0.0 && outer <= c_right_angle))
        light.fail("its angles do not increase from 0 to 90 degrees");
      if (has_failed()) return;
      note_unused(cone, {"innerConeAngle", "outerConeAngle"});
      loaded_.lights.spots.push_back(
          {position, -glm::normalize(z), std::cos(inner), std::max(std::cos(outer), 0.0), intensity});
    } else {
      light.fail(halfway::quoted(type) + " is not a type of light");
    }
    note_unused(light, {"type", "color", "intensity", "spot"});
    if (type != "directional") note(light, "its intensity is the same at all distances");
  }

  /// Scale the intensities, so that the greatest is 1. Their units depend on the type and on the distance.
  void scale_lights() {
    FileLights& lights = loaded_.lights;
    double greatest = 0.0;
    const auto each = [&](auto&& use) {
      for (DirectionalLight& light : lights.directional) use(light.intensity);
      for (PositionalLight& light : lights.positional) use(light.intensity);
      for (SpotLight& light : lights.spots) use(light.intensity);
    };
    each([&](const glm::dvec3& i) { greatest = std::max({greatest, i.x, i.y, i.z}); });
    if (greatest > 0.0) each([&](glm::dvec3& i) { i /= greatest; });
  }

  // ---- Meshes

  void add_mesh(const Item& mesh, const Item& node, const std::vector<glm::dmat4>& places) {
    if (mesh.has("weights") || node.has("weights")) note("morph targets are left out");
    for (const Item& primitive : mesh.objects("primitives")) {
      const Mesh part = read_primitive(primitive);
      if (has_failed()) return;
      if (part.triangles.empty()) continue;
      const std::uint64_t copies = places.size() - 1;
      count(primitive, copies * part.positions.size(), copies * part.triangles.size());
      for (std::size_t i = 0; i < places.size() && !has_failed(); ++i) add_part(part, node, places[i]);
    }
  }

  void count(const Item& primitive, std::uint64_t vertices, std::uint64_t triangles) {
    vertices_ += vertices;
    triangles_ += triangles;
    if (vertices_ > c_max_vertices)
      primitive.fail(fmt::format("more than {} vertices up to here; reduce the mesh", c_max_vertices));
    if (triangles_ > c_max_triangles)
      primitive.fail(fmt::format("more than {} triangles up to here; reduce the mesh", c_max_triangles));
  }

  void add_part(Mesh part, const Item& node, const glm::dmat4& to_file) {
    if (to_file != glm::dmat4(1.0)) {
      if (glm::determinant(glm::dmat3(to_file)) == 0.0) {
        // A flat node has triangles, but the directions of its normals are lost.
        part.normals.assign(part.normals.size(), glm::dvec3(0.0));
        note(node, "its transform has a scale of zero: it is flat, or not drawn");
      }
      transform(part, to_file);
      if (drop_zero_area(part) > 0) note(node, "triangles without area are left out");
      for (const glm::dvec3& p : part.positions) {
        for (int axis = 0; axis < 3; ++axis) {
          if (!is_in_float_range(p[axis]))
            node.fail("its transform moves a vertex beyond the range of float; correct it");
        }
      }
    }
    append(part);
  }

  /// Read the triangles of a primitive, in the space of its node.
  Mesh read_primitive(const Item& primitive) {
    Mesh part;
    const std::uint64_t mode = primitive.unsigned_number("mode", 4);
    if (mode > 6) primitive.at("mode").fail(fmt::format("{} is not a mode of glTF; correct it", mode));
    const Item attributes = primitive.object("attributes");
    if (mode < 4) {
      ++points_and_lines_;
      return part;
    }
    if (!attributes.has("POSITION")) {
      note(primitive, "without POSITION it is not drawn");
      return part;
    }
    const auto positions = read_vectors(attributes.at("POSITION"), true);
    const bool has_normals = attributes.has("NORMAL");
    if (attributes.has("COLOR_0")) note(primitive, "vertex colours are left out");
    if (primitive.has("targets")) note(primitive, "morph targets are left out");
    const std::vector<std::uint32_t> corners = read_corners(primitive, positions.size());

    count(primitive, positions.size(), 0);
    part.positions = positions;
    part.normals.emplace_back(0.0);
    if (has_normals) {
      part.normals = read_vectors(attributes.at("NORMAL"), false);
      if (part.normals.size() != positions.size()) {
        attributes.at("NORMAL").fail(fmt::format("has {} normals for {} positions; export the file again",
                                                 part.normals.size(), positions.size()));
      }
    }
    if (has_failed()) return Mesh{};
    note_unused(primitive, {"attributes", "indices", "material", "mode", "targets"});
    const std::optional<std::size_t> source = material_source(primitive);
    const std::uint32_t material = material_of(source);
    if (material == c_not_drawn) return Mesh{};
    const Culling culling = culling_of(source);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (has_failed()) return;
      const std::array<std::uint32_t, 3> index = {corners[a], corners[b], corners[c]};
      // Triangles that use a vertex twice connect parts of a strip.
      if (mode != 4 && (index[0] == index[1] || index[1] == index[2] || index[2] == index[0])) return;
      count(primitive, 0, 1);
      part.triangles.push_back(
          {index, has_normals ? index : std::array<std::uint32_t, 3>{}, material, culling});
    };
    if (mode == 4) {
      if (corners.size() % 3 != 0) {
        primitive.fail(
            fmt::format("{} corners are not whole triangles; export the file again", corners.size()));
      }
      for (std::size_t i = 0; i < corners.size(); i += 3) add(i, i + 1, i + 2);
    } else {
      for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        if (mode == 6) {
          add(0, i + 1, i + 2);
        } else if (i % 2 == 0) {
          add(i, i + 1, i + 2);
        } else {
          add(i + 1, i, i + 2);
        }
      }
    }
    return part;
  }

  void append(const Mesh& part) {
    Mesh& mesh = loaded_.mesh;
    const auto first_position = static_cast<std::uint32_t>(mesh.positions.size());
    const auto first_normal = static_cast<std::uint32_t>(mesh.normals.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for (SceneTriangle triangle : part.triangles) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        triangle.position[corner] += first_position;
        triangle.normal[corner] += first_normal;
      }
      mesh.triangles.push_back(triangle);
    }
  }

  // ---- Accessors

  std::string_view buffer(const Item& index) {
    const Item buffer = index.in(buffers_);
    const std::uint64_t length = buffer.at("byteLength").unsigned_number();
    if (has_failed()) return {};
    const std::size_t i = index.index(buffers_.size());
    if (!buffer.has("uri") && i == 0 && binary_) return checked(buffer, *binary_, length);
    if (!buffer.has("uri"))
      buffer.fail("has no uri; export the file with its buffers");
    else if (!buffer_bytes_[i])
      buffer_bytes_[i] = bytes_of(buffer.at("uri"));
    return has_failed() ? std::string_view() : checked(buffer, *buffer_bytes_[i], length);
  }
  std::string bytes_of(const Item& uri) const {
    const std::string_view text = uri.text();
    if (!text.starts_with("data:")) return read_buffer_file(uri, read_buffer_);
    constexpr std::string_view c_mark = ";base64,";
    const std::size_t mark = text.find(c_mark);
    if (mark != std::string_view::npos) return decode_base64(uri, text.substr(mark + c_mark.size()));
    uri.fail("its data are not base64; export the file again");
    return {};
  }
  static std::string_view checked(const Item& buffer, std::string_view bytes, std::uint64_t length) {
    if (length > bytes.size()) {
      buffer.fail(fmt::format("must have {} bytes, it has {}; export the file with its buffers", length,
                              bytes.size()));
    }
    return bytes.substr(0, length);
  }

  /// The bytes of `count` items of `size` bytes; none after a failure. `item` has bufferView and byteOffset.
  Span span_of(const Item& item, std::uint64_t count, std::size_t size, bool may_have_stride) {
    const Item view = item.at("bufferView").in(views_);
    std::string_view bytes = buffer(view.at("buffer"));
    const std::uint64_t view_offset = view.unsigned_number("byteOffset", 0);
    const std::uint64_t view_length = view.at("byteLength").unsigned_number();
    if (view_offset > bytes.size() || view_length > bytes.size() - view_offset) {
      view.fail(fmt::format("ends after its buffer of {} bytes; export the file again", bytes.size()));
    }
    const std::uint64_t stride = view.unsigned_number("byteStride", size);
    if (view.has("byteStride") && (!may_have_stride || stride < size || stride > 252)) {
      view.at("byteStride").fail(fmt::format("is {} for items of {} bytes; correct it", stride, size));
    }
    const std::uint64_t offset = item.unsigned_number("byteOffset", 0);
    if (has_failed()) return {};
    bytes = bytes.substr(view_offset, view_length);
    const bool fits = offset <= bytes.size() && bytes.size() - offset >= size &&
                      (count - 1) <= (bytes.size() - offset - size) / stride;
    if (fits) return {.bytes = bytes.substr(offset), .stride = stride};
    item.fail(fmt::format("{} items of {} bytes end after the buffer view of {} bytes; export the file again",
                          count, size, bytes.size()));
    return {};
  }

  struct Accessor {
    Item item;
    std::uint64_t count;
    std::uint64_t component_type;
    std::size_t component_bytes;
  };
  /// After a failure it has no items.
  Accessor accessor(const Item& index, std::string_view type) {
    const Item item = index.in(accessors_);
    const std::uint64_t count = item.at("count").unsigned_number();
    if (count == 0 || count > c_max_vertices) {
      item.at("count").fail(fmt::format("{}, not 1 to {}; correct the mesh", count, c_max_vertices));
    }
    if (item.at("type").text() != type) {
      item.at("type").fail(fmt::format("{} is not {}, as {} requires; export the file again",
                                       halfway::quoted(item.at("type").text()), type, index.place()));
    }
    const std::uint64_t code = item.at("componentType").unsigned_number();
    for (const ComponentType& known : c_component_types) {
      if (known.code == code && !has_failed()) return {item, count, code, known.bytes};
    }
    item.at("componentType").fail(fmt::format("{} is not a type of glTF; export the file again", code));
    return {item.without_keys(), 0, 0, 0};
  }

  /// An unsigned integer of a Span.
  static std::uint32_t integer_at(const Span& span, std::size_t i, std::uint64_t component_type) {
    const std::size_t at = i * span.stride;
    if (component_type == c_uint8) return number_in<std::uint8_t>(span.bytes, at, ByteOrder::little);
    if (component_type == c_uint16) return number_in<std::uint16_t>(span.bytes, at, ByteOrder::little);
    return number_in<std::uint32_t>(span.bytes, at, ByteOrder::little);
  }
  static void check_integer(const Item& item, std::uint64_t component_type) {
    if (component_type == c_uint8 || component_type == c_uint16 || component_type == c_uint32) return;
    item.at("componentType")
        .fail(fmt::format("{} is not an unsigned integer; export the file again", component_type));
  }

  /// Call `set(i, bytes, at)` for the items of an accessor's buffer view, then for those that replace some of
  /// them.
  template <class Set>
  void read_items(const Accessor& accessor, std::size_t item_bytes, bool may_have_stride, const Set& set) {
    if (accessor.item.has("bufferView")) {
      const Span span = span_of(accessor.item, accessor.count, item_bytes, may_have_stride);
      for (std::size_t i = 0; i < accessor.count && !has_failed(); ++i) set(i, span, i);
    }
    if (!accessor.item.has("sparse")) return;
    const Item sparse = accessor.item.object("sparse");
    const std::uint64_t count = sparse.at("count").unsigned_number();
    if (count == 0 || count > accessor.count) {
      sparse.at("count").fail(fmt::format("{}, not 1 to {}; export the file again", count, accessor.count));
    }
    const Item indices = sparse.object("indices");
    const std::uint64_t type = indices.at("componentType").unsigned_number();
    check_integer(indices, type);
    const std::size_t index_bytes = type == c_uint8 ? 1 : type == c_uint16 ? 2 : 4;
    const Span places = span_of(indices, count, index_bytes, false);
    const Span values = span_of(sparse.object("values"), count, item_bytes, false);
    for (std::size_t i = 0; i < count && !has_failed(); ++i) {
      const std::uint32_t place = integer_at(places, i, type);
      if (place < accessor.count)
        set(place, values, i);
      else
        indices.fail(fmt::format("index {} is {}, but the accessor has {} items; correct it", i, place,
                                 accessor.count));
    }
  }

  /// Read vectors of three floats. Those that are not needed are normals. After a failure the values of these
  /// three functions are of no use.
  std::vector<glm::dvec3> read_vectors(const Item& index, bool is_needed) {
    const Accessor source = accessor(index, "VEC3");
    if (source.component_type != c_float) {
      source.item.at("componentType")
          .fail(fmt::format("{} is not float (5126), as {} requires; export the file without quantization",
                            source.component_type, index.place()));
    }
    if (has_failed()) return {};
    constexpr std::size_t c_bytes = 12;
    // Without a buffer view the values are zero.
    std::vector<glm::dvec3> vectors(source.count, glm::dvec3(0.0));
    const auto set = [&](std::size_t place, const Span& span, std::size_t i) {
      glm::vec3 vector;
      for (std::size_t axis = 0; axis < 3; ++axis)
        vector[static_cast<int>(axis)] =
            number_in<float>(span.bytes, i * span.stride + 4 * axis, ByteOrder::little);
      if (!is_needed)
        vectors[place] = known_normal(vector, notes_, [&] { return place_of(index); });
      else if (is_finite(vector))
        vectors[place] = vector;
      else
        source.item.fail(fmt::format("vector {} has a number that is not finite; correct it", place));
    };
    read_items(source, c_bytes, true, set);
    return vectors;
  }

  /// Read the rotations of instances: x, y, z and w as floats, or as integers that stand for -1 to 1.
  std::vector<glm::dvec4> read_rotations(const Item& index) {
    const Accessor source = accessor(index, "VEC4");
    const std::uint64_t type = source.component_type;
    if (type != c_float && type != c_int8 && type != c_int16)
      source.item.at("componentType")
          .fail(fmt::format("{} is not a type of rotations; export the file again", type));
    if (has_failed()) return {};
    const std::size_t size = source.component_bytes;
    std::vector<glm::dvec4> rotations(source.count, glm::dvec4(0.0, 0.0, 0.0, 1.0));
    const auto set = [&](std::size_t place, const Span& span, std::size_t i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t at = i * span.stride + k * size;
        const double value =
            type == c_int8    ? number_in<std::int8_t>(span.bytes, at, ByteOrder::little) / 127.0
            : type == c_int16 ? number_in<std::int16_t>(span.bytes, at, ByteOrder::little) / 32767.0
                              : number_in<float>(span.bytes, at, ByteOrder::little);
        if (!std::isfinite(value))
          source.item.fail(fmt::format("rotation {} has a number that is not finite; correct it", place));
        rotations[place][static_cast<int>(k)] = value;
      }
    };
    read_items(source, 4 * size, true, set);
    return rotations;
  }

  /// Read the indices of a primitive; without them the vertices are used in their order.
  std::vector<std::uint32_t> read_corners(const Item& primitive, std::size_t positions) {
    std::vector<std::uint32_t> corners;
    if (!primitive.has("indices")) {
      corners.resize(positions);
      for (std::size_t i = 0; i < positions; ++i) corners[i] = static_cast<std::uint32_t>(i);
      return corners;
    }
    const Accessor source = accessor(primitive.at("indices"), "SCALAR");
    check_integer(source.item, source.component_type);
    if (has_failed()) return {};
    corners.resize(source.count);
    const auto set = [&](std::size_t place, const Span& span, std::size_t i) {
      corners[place] = integer_at(span, i, source.component_type);
    };
    read_items(source, source.component_bytes, false, set);
    for (std::size_t i = 0; i < corners.size() && !has_failed(); ++i) {
      if (corners[i] < positions) continue;
      primitive.at("indices").fail(
          fmt::format("index {} names vertex {}, but the primitive has {}, counted from 0; correct the index",
                      i, corners[i], positions));
    }
    return corners;
  }

  // ---- Materials

  std::optional<std::size_t> material_source(const Item& primitive) {
    std::size_t source = 0;
    const auto read = [&] { source = primitive.at("material").index(materials_.size()); };
    if (primitive.has("material") && attempt(read, "; it has the default material")) return source;
    return std::nullopt;
  }

  /// The index of a material in the mesh. A material gets its index when the first primitive uses it.
  std::uint32_t material_of(std::optional<std::size_t> source) {
    const auto next = static_cast<std::uint32_t>(loaded_.mesh.materials.size());
    const auto [entry, is_new] = material_index_.try_emplace(source, next);
    if (!is_new) return entry->second;
    if (auto material = source ? material_or_default(materials_[*source]) : default_material())
      loaded_.mesh.materials.push_back(*std::move(material));
    else
      entry->second = c_not_drawn;
    return entry->second;
  }
  std::optional<Material> default_material() {
    return read_material(Item(no_keys(), "material", failure_), "default");
  }
  std::optional<Material> material_or_default(const Item& source) {
    std::optional<Material> material;
    const auto read = [&] { material = read_material(source, ""); };
    return attempt(read, "; it is the default material") ? material : default_material();
  }

  Culling culling_of(std::optional<std::size_t> source) {
    bool is_double_sided = false;
    attempt([&] { is_double_sided = source && materials_[*source].flag("doubleSided", false); }, "");
    return is_double_sided ? Culling::none : Culling::back;
  }

  /// Empty: its surfaces are not drawn.
  std::optional<Material> read_material(const Item& source, std::string_view name) {
    Material material;
    material.name = source.text("name", name);
    const bool is_glossy = has_extension(source, c_glossiness);
    const Item look = is_glossy                            ? extension_of(source, c_glossiness)
                      : source.has("pbrMetallicRoughness") ? source.object("pbrMetallicRoughness")
                                                           : source.without_keys();
    const glm::dvec4 base = colour(look, is_glossy ? "diffuseFactor" : "baseColorFactor", glm::dvec4(1.0));
    material.colour = glm::dvec3(base);
    double roughness = 1.0;
    if (is_glossy) {
      roughness = std::max(1.0 - factor(look, "glossinessFactor"), 0.05);
      material.specular_colour = glm::dvec3(colour(look, "specularFactor", glm::dvec4(1.0)));
    } else {
      const double metal = factor(look, "metallicFactor");
      roughness = std::max(factor(look, "roughnessFactor"), 0.05);
      material.specular_colour = glm::dvec3(1.0 - metal) + metal * material.colour;
    }
    const double exponent = 2.0 / std::pow(roughness, 4.0) - 2.0;
    material.specular *= 1.0 - std::min(roughness, 1.0);  // a rough surface has a weak highlight
    material.exponent = std::max(exponent, 1.0);
    if (exponent < 1.0 && material.specular > 0.0) {
      note(fmt::format("material {}: exponent {} raised to 1", halfway::quoted(material.name), exponent));
    }
    read_emission(source, material);
    const bool is_drawn = read_alpha(source, base.w) > 0.0;
    note_unused(source, {"pbrMetallicRoughness", "emissiveFactor", "alphaMode", "alphaCutoff", "doubleSided",
                         "normalTexture", "occlusionTexture", "emissiveTexture"});
    note_unused(look, {"baseColorFactor", "metallicFactor", "roughnessFactor", "baseColorTexture",
                       "metallicRoughnessTexture", "diffuseFactor", "specularFactor", "glossinessFactor",
                       "diffuseTexture", "specularGlossinessTexture"});
    const auto is_texture = [](const std::string& key) { return key.ends_with("Texture"); };
    const std::vector<std::string> keys = source.keys(), look_keys = look.keys();
    if (std::any_of(keys.begin(), keys.end(), is_texture) ||
        std::any_of(look_keys.begin(), look_keys.end(), is_texture)) {
      note(fmt::format("material {}: textures are left out", halfway::quoted(material.name)));
    }
    return is_drawn ? std::optional(material) : std::nullopt;
  }
  /// A colour of three or four numbers. Alpha is 1 if it is missing.
  static glm::dvec4 colour(const Item& look, const char* key, glm::dvec4 value) {
    const std::vector<Item> numbers = look.list(key);
    if (!look.has(key)) return value;
    if (numbers.size() != 3 && numbers.size() != 4) {
      look.at(key).fail(fmt::format("has {} numbers, not 3 or 4; correct it", numbers.size()));
      return value;
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      value[static_cast<int>(i)] = numbers[i].number();
      if (value[static_cast<int>(i)] < 0.0) look.at(key).fail("is negative; correct the colour");
    }
    return value;
  }

  /// A surface without lighting emits its colour and reflects nothing.
  void read_emission(const Item& source, Material& material) {
    material.emission = glm::dvec3(colour(source, "emissiveFactor", glm::dvec4(0.0)));
    if (has_extension(source, c_strength)) {
      const Item strength = extension_of(source, c_strength);
      const double times = strength.number("emissiveStrength", 1.0);
      if (times < 0.0) strength.at("emissiveStrength").fail("is negative; correct the strength");
      material.emission *= times;
    }
    if (!has_extension(source, c_unlit)) return;
    material.emission = material.colour;
    material.ambient = material.diffuse = material.specular = 0.0;
  }

  double read_alpha(const Item& source, double alpha) {
    const std::string_view mode = source.text("alphaMode", "OPAQUE");
    if (mode == "OPAQUE") alpha = 1.0;
    if (mode == "MASK") alpha = alpha < source.number("alphaCutoff", 0.5) ? 0.0 : 1.0;
    if (alpha == 0.0) note(source, "it is transparent: its surfaces are not drawn");
    if (alpha > 0.0 && alpha < 1.0) note(source, "transparency is left out");
    return alpha;
  }
  double factor(const Item& look, const char* key) {
    constexpr double c_rounding = 1e-5;
    const double value = look.number(key, 1.0);
    if (value < -c_rounding || value > 1.0 + c_rounding)
      note(look.at(key), fmt::format("{} is limited to 0 to 1", value));
    return std::clamp(value, 0.0, 1.0);
  }

  std::string failure_;  ///< the first one, without the file's name; empty if there is none
  Item root_;
  std::optional<std::string_view> binary_;
  std::string file_;
  const ReadBuffer& read_buffer_;
  std::vector<Item> meshes_, nodes_, accessors_, views_, buffers_, materials_, lights_;
  std::vector<json> all_roots_;
  std::vector<std::optional<std::string>> buffer_bytes_;  ///< of buffers with a uri, once they are read
  std::map<std::optional<std::size_t>, std::uint32_t> material_index_;
  LoadedMesh loaded_;
  Notes notes_;
  std::uint64_t points_and_lines_ = 0, vertices_ = 0, triangles_ = 0;
};

/// Finds the first fault of text that is not JSON.
struct JsonFault final : nlohmann::json_sax<json> {
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t byte, const std::string& last_word, const json::exception& error) override {
    constexpr int c_number_overflow = 406;
    place = byte;
    if (error.id == c_number_overflow) number = last_word;
    return false;
  }

  std::size_t place = 0;  ///< the bytes up to it
  std::string number;     ///< beyond the range of double; empty if the fault is another
};

/// The error of text that is not JSON, with its line.
Error json_error(std::string_view text, std::string_view file) {
  JsonFault fault;
  json::sax_parse(text, &fault);
  const std::string_view before = text.substr(0, std::min(fault.place, text.size()));
  return bad_input(fmt::format(
      "{}:{}: {}", file, 1 + std::count(before.begin(), before.end(), '\n'),
      fault.number.empty()
          ? "not glTF 2.0: its JSON is damaged here; export the file again"
          : fmt::format("the number {} is too large; correct it", halfway::quoted(fault.number))));
}

}  // namespace

Result<LoadedMesh> read_gltf(std::string_view bytes, std::string_view file, const ReadBuffer& read_buffer) {
  const Result<Chunks> chunks = chunks_of(bytes, file);
  if (!chunks) return chunks.error();
  if (const auto fault = utf16_fault(chunks->json); !fault.empty())
    return bad_input(fmt::format("{}:1: {}", file, fault));
  const json root = json::parse(chunks->json, nullptr, false);
  if (root.is_discarded()) return json_error(chunks->json, file);
  if (!root.is_object()) return bad_input(fmt::format("{}:1: not glTF 2.0: its JSON is not an object", file));
  return GltfReader(root, chunks->binary, file, read_buffer).read();
}

}  // namespace halfway
