// SPDX-License-Identifier: Apache-2.0
#include "sim/scene_files/check_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>
#include <utility>

#include "common/to_integer.hpp"
#include "mesh_files/number.hpp"
#include "scene/scene.hpp"
#include "sim/scene_files/load_mesh.hpp"

namespace halfway {

namespace {

constexpr std::string_view c_blank = " \t\r\v\f";
/// A line with a face of 32767 corners, assimp's limit, is far shorter.
constexpr std::size_t c_longest_line = std::size_t{16} << 20;

/// Exception that stops the check. check_mesh_file returns its error.
struct OverlongLine {
  Error error;
};

/// The lines of a text file with their numbers, without line ends.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path) : name_(path.string()), file_(path, std::ios::binary) {}

  bool next() {
    ++number_;
    return get_line(line_);
  }
  /// Return the next word of the line; empty at its end.
  std::string_view word() {
    const std::size_t first = std::min(line_.find_first_not_of(c_blank, at_), line_.size());
    at_ = std::min(line_.find_first_of(c_blank, first), line_.size());
    return std::string_view(line_).substr(first, at_ - first);
  }
  /// Read the next line, joined with its continuation lines (after a backslash).
  bool next_joined() {
    at_ = 0;
    if (!next()) return false;
    first_number_ = number_;
    for (;;) {
      while (!line_.empty() && line_.back() == '\r') line_.pop_back();
      if (line_.empty() || line_.back() != '\\') return true;
      line_.back() = ' ';
      std::string more;
      if (!get_line(more)) return true;
      ++number_;
      line_ += more;
      if (line_.size() > c_longest_line) throw OverlongLine{overlong()};
    }
  }
  std::ifstream& file() { return file_; }
  bool opened() const { return file_.is_open(); }
  Error error(std::string_view what) const {
    return bad_input(fmt::format("{}:{}: {}", name_, first_number_, what));
  }

 private:
  /// Like std::getline, with limited memory for a file without line ends.
  bool get_line(std::string& line) {
    line.clear();
    for (;;) {
      file_.getline(chunk_.data(), chunk_.size());
      const auto got = static_cast<std::size_t>(file_.gcount());
      if (file_.good()) {  // `got` includes the line end, which is not in the chunk
        line.append(chunk_.data(), got - 1);
        return true;
      }
      line.append(chunk_.data(), got);
      if (line.size() > c_longest_line) throw OverlongLine{overlong()};
      if (file_.eof() || file_.bad()) return !line.empty();
      if (got == 0) return false;
      file_.clear();  // the line is longer than the chunk
    }
  }
  Error overlong() const {
    return bad_input(fmt::format("{}:{}: a line of more than {} MiB; the file is damaged", name_, number_,
                                 c_longest_line >> 20));
  }

  std::string name_;
  std::ifstream file_;
  std::array<char, 4096> chunk_;
  std::string line_;
  std::size_t at_ = 0;
  std::uint64_t number_ = 0;
  std::uint64_t first_number_ = 0;
};

/// Empty if the word is a number in the range of float; otherwise the reason.
std::string number_fault(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault == std::errc::invalid_argument || end != word.data() + word.size()) {
    return fmt::format("{} is not a number", quoted(word));
  }
  // Out of range also means too small; assimp reads such numbers as zero.
  if (fault == std::errc::result_out_of_range) {
    const std::size_t exponent = word.find_first_of("eE");
    if (exponent != std::string_view::npos && exponent + 1 < word.size() && word[exponent + 1] == '-')
      return {};
    return fmt::format("{} is too large", quoted(word));
  }
  if (!std::isfinite(value)) return fmt::format("{} is not finite", quoted(word));
  if (std::abs(value) > std::numeric_limits<float>::max())
    return fmt::format("{} is too large", quoted(word));
  return {};
}

Status too_many_triangles(const std::filesystem::path& path, std::uint64_t triangles) {
  if (triangles <= c_max_triangles) return Ok{};
  return bad_input(fmt::format("{}: {} triangles, but {} is the most; reduce the mesh", path.string(),
                               triangles, c_max_triangles));
}

// ---- STL

Result<MeshFileSummary> check_ascii_stl(const std::filesystem::path& path) {
  Lines lines(path);
  MeshFileSummary summary;
  std::uint64_t facets = 0;
  std::uint64_t vertices = 0;
  std::uint64_t vertices_of_facet = 0;
  bool in_facet = false;
  bool ended = false;
  while (lines.next_joined()) {
    const std::string_view keyword = lines.word();
    if (keyword == "facet") {
      if (in_facet) return lines.error("a facet begins inside another; the file is damaged");
      in_facet = true;
      vertices_of_facet = 0;
    } else if (keyword == "vertex") {
      ++vertices;
      ++vertices_of_facet;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = lines.word();
        const std::string fault = word.empty() ? "a coordinate is missing" : number_fault(word);
        if (!fault.empty()) {
          return lines.error(fmt::format("vertex {}: {}; correct the coordinate", vertices, fault));
        }
      }
    } else if (keyword == "endfacet") {
      if (!in_facet || vertices_of_facet != 3) {
        return lines.error(
            fmt::format("a facet of {} vertices; it must have three", in_facet ? vertices_of_facet : 0));
      }
      in_facet = false;
      ++facets;
    } else if (keyword == "endsolid") {
      ended = true;
    } else if (keyword == "solid") {
      ended = false;
    }
  }
  if (in_facet || !ended) return lines.error("the file ends before its endsolid; it is truncated");
  if (Status ok = too_many_triangles(path, facets); !ok) return ok.error();
  summary.polygons = facets;
  summary.vertices = 3 * facets;
  return summary;
}

Result<MeshFileSummary> check_stl(const std::filesystem::path& path) {
  constexpr std::uint64_t c_header = 84, c_facet = 50;
  std::error_code fault;
  const std::uint64_t size = std::filesystem::file_size(path, fault);
  std::ifstream file(path, std::ios::binary);
  std::array<char, c_header> header{};
  file.read(header.data(), header.size());
  if (fault || file.bad() || !file.is_open()) return bad_input(path.string() + ": cannot be read");
  std::uint32_t facets = 0;
  std::memcpy(&facets, header.data() + 80, sizeof facets);
  static_assert(std::endian::native == std::endian::little);  // as binary STL is
  const bool is_binary = size >= c_header && size == c_header + c_facet * facets;
  if (!is_binary) {
    std::string_view start(header.data(), static_cast<std::size_t>(file.gcount()));
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
    // A binary header may start with "solid" too, but text contains no zero byte.
    if (start.starts_with("solid") && start.find('\0') == std::string_view::npos)
      return check_ascii_stl(path);
    if (size < c_header)
      return bad_input(path.string() + ": not an STL file, or truncated within its header");
    return bad_input(fmt::format(
        "{}: not an STL file, or damaged: its header requires {} facets and so {} bytes, it has {}",
        path.string(), facets, c_header + c_facet * facets, size));
  }
  if (Status ok = too_many_triangles(path, facets); !ok) return ok.error();
  MeshFileSummary summary;
  summary.polygons = facets;
  summary.vertices = 3ull * facets;
  return summary;
}

// ---- PLY

struct PlyProperty {
  std::string name;
  int size = 0;        // bytes of the value, or of each item of a list
  int count_size = 0;  // bytes of the list's length; 0: not a list
  bool is_float = false;
  bool is_signed = false;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

int ply_type_size(std::string_view type) {
  for (const auto& [name, size] : {std::pair<std::string_view, int>{"char", 1},
                                   {"uchar", 1},
                                   {"int8", 1},
                                   {"uint8", 1},
                                   {"short", 2},
                                   {"ushort", 2},
                                   {"int16", 2},
                                   {"uint16", 2},
                                   {"int", 4},
                                   {"uint", 4},
                                   {"int32", 4},
                                   {"uint32", 4},
                                   {"float", 4},
                                   {"float32", 4},
                                   {"double", 8},
                                   {"float64", 8}}) {
    if (type == name) return size;
  }
  return 0;
}

class PlyCheck {
 public:
  explicit PlyCheck(const std::filesystem::path& path) : path_(path), lines_(path) {}

  Result<MeshFileSummary> run() {
    if (!lines_.opened()) return bad_input(path_.string() + ": cannot be read");
    if (Status ok = read_header(); !ok) return ok.error();
    std::error_code fault;
    const std::uint64_t size = std::filesystem::file_size(path_, fault);
    for (const PlyElement& element : elements_) {
      // Each item takes at least one byte, so a count above the file's size is wrong.
      if (element.count > size) {
        return bad_input(fmt::format("{}: its header requires {} items of '{}', more than the file can hold",
                                     path_.string(), element.count, element.name));
      }
      // Items without properties take no bytes, so the file could request any number.
      if (element.properties.empty() && element.count > 0) {
        return bad_input(fmt::format("{}: its header gives the {} items of {} no property", path_.string(),
                                     element.count, quoted(std::string_view(element.name))));
      }
      if (element.name == "vertex") vertices_ = element.count;
    }
    for (const PlyElement& element : elements_) {
      if (Status ok = is_ascii_ ? walk_ascii(element) : walk_binary(element); !ok) return ok.error();
    }
    if (Status ok = too_many_triangles(path_, triangles_); !ok) return ok.error();
    MeshFileSummary summary;
    if (has_faces_) summary.polygons = polygons_;
    return summary;
  }

 private:
  Status read_header() {
    if (!lines_.next_joined() || lines_.word() != "ply") {
      return lines_.error("not a PLY file: it does not begin with 'ply'");
    }
    bool has_format = false;
    while (lines_.next_joined()) {
      const std::string_view keyword = lines_.word();
      if (keyword == "end_header") {
        return has_format ? Status(Ok{}) : Status(lines_.error("the PLY header names no format"));
      }
      if (keyword == "format") {
        const std::string_view format = lines_.word();
        is_ascii_ = format == "ascii";
        is_big_endian_ = format == "binary_big_endian";
        has_format = true;
        if (!is_ascii_ && !is_big_endian_ && format != "binary_little_endian") {
          return lines_.error(fmt::format("{} is not a format of PLY", quoted(format)));
        }
      } else if (keyword == "element") {
        PlyElement element;
        element.name = lines_.word();
        const std::string_view count = lines_.word();
        const auto [end, fault] = std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (fault != std::errc() || end != count.data() + count.size()) {
          return lines_.error(fmt::format("{} is not a count", quoted(count)));
        }
        if (element.name == "face") has_faces_ = true;
        elements_.push_back(std::move(element));
      } else if (keyword == "property") {
        if (elements_.empty()) return lines_.error("a property before the first element");
        PlyProperty property;
        std::string_view type = lines_.word();
        if (type == "list") {
          property.count_size = ply_type_size(lines_.word());
          if (property.count_size == 0) return lines_.error("a list whose length has no known type");
          type = lines_.word();
        }
        property.size = ply_type_size(type);
        property.is_float = type.starts_with("float") || type == "double";
        property.is_signed = !property.is_float && !type.starts_with('u');
        if (property.size == 0) return lines_.error(fmt::format("{} is not a type of PLY", quoted(type)));
        property.name = lines_.word();
        elements_.back().properties.push_back(std::move(property));
      }
    }
    return lines_.error("the PLY header has no end_header; the file is truncated");
  }

  static bool is_index_list(const PlyElement& element, const PlyProperty& property) {
    return element.name == "face" && property.count_size > 0 &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  Status check_index(double index, std::uint64_t face) const {
    if (index >= 0.0 && index < static_cast<double>(vertices_)) return Ok{};
    return bad_input(
        fmt::format("{}: face {} names vertex {}, but the file has {}, counted from 0; correct the index",
                    path_.string(), face, index, vertices_));
  }

  void count_polygon(double corners) {
    if (corners < 3.0) return;
    ++polygons_;
    triangles_ += to_integer<std::uint64_t>(corners) - 2;
  }

  Status walk_ascii(const PlyElement& element) {
    for (std::uint64_t item = 0; item < element.count; ++item) {
      std::string_view word;
      do {  // empty lines and comments between items
        if (!lines_.next_joined()) {
          return lines_.error(fmt::format("the file ends at item {} of {} of '{}'; it is truncated", item,
                                          element.count, element.name));
        }
        word = lines_.word();
      } while (word.empty() || word == "comment");
      for (const PlyProperty& property : element.properties) {
        std::uint64_t values = 1;
        const bool is_index = is_index_list(element, property);
        if (property.count_size > 0) {
          const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), values);
          if (fault != std::errc() || end != word.data() + word.size()) {
            return lines_.error(fmt::format("{} is not the length of a list", quoted(word)));
          }
          word = lines_.word();
          if (is_index) count_polygon(static_cast<double>(values));
        }
        for (std::uint64_t i = 0; i < values; ++i, word = lines_.word()) {
          if (word.empty()) {
            return lines_.error(fmt::format("{} {} has too few numbers", element.name, item));
          }
          const std::string fault_text = number_fault(word);
          if (!fault_text.empty()) {
            return lines_.error(fmt::format("{} {}: {}; correct it", element.name, item, fault_text));
          }
          if (!is_index) continue;
          double index = 0.0;
          std::from_chars(word.data(), word.data() + word.size(), index);
          if (Status ok = check_index(index, item); !ok) {
            return lines_.error(
                fmt::format("a face names vertex {}, but the file has {}, counted from 0; correct the index",
                            index, vertices_));
          }
        }
      }
    }
    return Ok{};
  }

  /// Read the next value as a double, which can represent all types of PLY. False at the end of the file.
  bool read_value(const PlyProperty& type, double& value) {
    const auto [size, is_float, is_signed] = std::tuple(type.size, type.is_float, type.is_signed);
    std::array<unsigned char, 8> bytes{};
    if (!lines_.file().read(reinterpret_cast<char*>(bytes.data()), size)) return false;
    if (is_big_endian_) std::reverse(bytes.begin(), bytes.begin() + size);
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes.data(), sizeof bits);
    if (is_float && size == 4) {
      value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    } else if (is_float) {
      value = std::bit_cast<double>(bits);
    } else if (is_signed && (bits >> (8 * size - 1)) != 0) {
      value = static_cast<double>(bits) - std::ldexp(1.0, 8 * size);
    } else {
      value = static_cast<double>(bits);
    }
    return true;
  }

  Status walk_binary(const PlyElement& element) {
    for (std::uint64_t item = 0; item < element.count; ++item) {
      for (const PlyProperty& property : element.properties) {
        double values = 1.0;
        const auto cut_off = [&] {
          return bad_input(fmt::format("{}: the file ends at item {} of {} of '{}'; it is truncated",
                                       path_.string(), item, element.count, element.name));
        };
        const bool is_index = is_index_list(element, property);
        if (property.count_size > 0) {
          const PlyProperty length{.name = {}, .size = property.count_size};
          if (!read_value(length, values)) return cut_off();
          if (is_index) count_polygon(values);
        }
        for (double i = 0.0; i < values; i += 1.0) {
          double value = 0.0;
          if (!read_value(property, value)) return cut_off();
          if (!std::isfinite(value) || std::abs(value) > std::numeric_limits<float>::max()) {
            return bad_input(fmt::format("{}: {} {}: '{}' is not finite, or too large; correct it",
                                         path_.string(), element.name, item, property.name));
          }
          if (!is_index) continue;
          if (Status ok = check_index(value, item); !ok) return ok.error();
        }
      }
    }
    return Ok{};
  }

  std::filesystem::path path_;
  Lines lines_;
  bool is_ascii_ = false;
  bool is_big_endian_ = false;
  bool has_faces_ = false;
  std::vector<PlyElement> elements_;
  std::uint64_t vertices_ = 0;
  std::uint64_t polygons_ = 0;
  std::uint64_t triangles_ = 0;
};

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
  const std::string ending = lower_ending(path);
  try {
    if (ending == ".stl") return check_stl(path);
    if (ending == ".ply") return PlyCheck(path).run();
    return check_gltf(path);
  } catch (const OverlongLine& overlong) {
    return overlong.error;
  }
}

}  // namespace halfway
