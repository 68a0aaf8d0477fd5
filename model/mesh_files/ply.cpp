// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/to_integer.hpp"
#include "mesh_files/bytes.hpp"
#include "mesh_files/face_list.hpp"
#include "mesh_files/notes.hpp"
#include "mesh_files/number.hpp"
#include "mesh_files/text_lines.hpp"

namespace halfway {

namespace {

// ---- Types

/// A type of numbers. A double represents the values of all types.
struct Type {
  std::string_view name, other_name;
  std::size_t size;  ///< bytes
  bool is_real;
  std::int64_t least, greatest;  ///< of integers
  double (*value_at)(std::string_view bytes, std::size_t at, ByteOrder order);
};

template <class T>
double value_at(std::string_view bytes, std::size_t at, ByteOrder order) {
  return static_cast<double>(number_in<T>(bytes, at, order));
}

template <class T>
constexpr Type type_of(std::string_view name, std::string_view other_name) {
  using Limits = std::numeric_limits<T>;
  if constexpr (std::is_floating_point_v<T>)
    return {name, other_name, sizeof(T), true, 0, 0, value_at<T>};
  else
    return {name, other_name, sizeof(T), false, Limits::min(), Limits::max(), value_at<T>};
}

constexpr Type c_types[] = {
    type_of<std::int8_t>("char", "int8"),    type_of<std::uint8_t>("uchar", "uint8"),
    type_of<std::int16_t>("short", "int16"), type_of<std::uint16_t>("ushort", "uint16"),
    type_of<std::int32_t>("int", "int32"),   type_of<std::uint32_t>("uint", "uint32"),
    type_of<float>("float", "float32"),      type_of<double>("double", "float64")};

/// Null if there is none.
const Type* find_type(std::string_view name) {
  for (const Type& type : c_types) {
    if (name == type.name || name == type.other_name) return &type;
  }
  return nullptr;
}

// ---- Header

/// What a property of a vertex or face is used for. x to nz are indices of a vertex's numbers.
enum class Use { x, y, z, nx, ny, nz, corners, none };
/// The value of a word that is no finite number.
constexpr double c_unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view c_numbers[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::string_view c_other_numbers[] = {"normal_x", "normal_y", "normal_z"};
constexpr std::string_view c_colours[] = {"red",         "green",         "blue",
                                          "diffuse_red", "diffuse_green", "diffuse_blue"};

template <std::size_t N>
std::size_t index_in(const std::string_view (&words)[N], std::string_view word) {
  return static_cast<std::size_t>(std::find(std::begin(words), std::end(words), word) - std::begin(words));
}

/// The word without a point and zeros at its end.
std::string_view without_zeros(std::string_view word) {
  const std::size_t point = std::min(word.find('.'), word.size());
  return word.find_first_not_of('0', point + 1) == std::string_view::npos ? word.substr(0, point) : word;
}

struct Property {
  std::string_view name;
  const Type* type = nullptr;
  const Type* length_type = nullptr;  ///< of a list; null if it is none
  Use use = Use::none;
};

enum class Kind { vertex, face, tristrips, other };

struct Element {
  std::string_view name;
  Kind kind = Kind::other;
  std::uint64_t count = 0;
  std::uint64_t line = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, std::string_view file)
      : bytes_(bytes), file_(file), lines_(bytes, file, {.comments = false, .continuation = false}) {}

  Result<LoadedMesh> read() {
    if (Status ok = read_header(); !ok) return ok.error();
    loaded_.mesh.normals.emplace_back(0.0);
    loaded_.mesh.materials.push_back(default_material());
    if (!is_text_) at_ = data_start();
    for (const Element& element : elements_) {
      if (Status ok = read_element(element); !ok) return ok.error();
    }
    if (Status ok = check_end(); !ok) return ok.error();
    if (loaded_.mesh.triangles.empty()) {
      return bad_input(fmt::format("{}: {}", file_,
                                   faces_.without_area() > 0
                                       ? "no face of the mesh has any area; correct the vertices"
                                       : "the mesh has no faces; export it with faces"));
    }
    if (has_colours_) note("vertex colours are left out");
    faces_.note_left_out(file_, notes_);
    loaded_.notes = notes_.list();
    join_positions(loaded_.mesh);
    return std::move(loaded_);
  }

 private:
  // ---- Header

  Status read_header() {
    lines_.next();
    if (lines_.word() != "ply" || !lines_.word().empty()) {
      return lines_.error("not a PLY file: its first line is not 'ply'; export it again");
    }
    bool has_format = false;
    while (lines_.next()) {
      const std::string_view keyword = lines_.word();
      Status ok = Ok{};
      if (keyword.empty() || keyword == "comment" || keyword == "obj_info") {
        lines_.rest();
      } else if (keyword == "format") {
        if (has_format) return lines_.error("a second format; remove it");
        has_format = true;
        ok = read_format();
      } else if (keyword == "element") {
        ok = read_element_line();
      } else if (keyword == "property") {
        ok = read_property();
      } else if (keyword == "end_header") {
        if (!has_format) return lines_.error("the PLY header names no format; export the file again");
        if (!lines_.word().empty()) return lines_.error("a word after end_header; remove it");
        return check_elements();
      } else {
        return lines_.error(quoted(keyword) +
                            " is not a keyword of a PLY header; correct or remove the line");
      }
      if (!ok) return ok;
      if (const std::string_view word = lines_.word(); !word.empty()) {
        return lines_.error(fmt::format("{} at the end of a {} line; remove it", quoted(word), keyword));
      }
    }
    return lines_.error("the PLY header has no end_header; the file is truncated, export it again");
  }

  Status read_format() {
    const std::string_view format = lines_.word(), version = lines_.word();
    is_text_ = format == "ascii";
    order_ = format == "binary_big_endian" ? ByteOrder::big : ByteOrder::little;
    if (!is_text_ && format != "binary_big_endian" && format != "binary_little_endian") {
      return lines_.error(quoted(format) + " is not a format of PLY; export the file again");
    }
    if (version != "1.0") {
      return lines_.error(quoted(version) + " is not a version of PLY that can be read; export as 1.0");
    }
    return Ok{};
  }

  Status read_element_line() {
    Element element{.name = lines_.word(), .line = lines_.line()};
    const std::string_view count = integer_of(lines_.word());
    const auto [end, fault] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (fault != std::errc() || end != count.data() + count.size()) {
      return lines_.error(quoted(count) + " is not a count of items; correct it");
    }
    if (has_element(element.name)) {
      return lines_.error(fmt::format("a second element {}; rename or remove it", quoted(element.name)));
    }
    if (element.name == "vertex") {
      element.kind = Kind::vertex;
      vertices_ = element.count;
      if (vertices_ > c_max_vertices) {
        return lines_.error(
            fmt::format("{} vertices, but {} is the most; reduce the mesh", vertices_, c_max_vertices));
      }
    } else if (element.name == "face" || element.name == "tristrips") {
      element.kind = element.name == "face" ? Kind::face : Kind::tristrips;
      if (!has_element("vertex")) {
        return lines_.error(fmt::format("element {} before element vertex; reorder them", element.name));
      }
    }
    elements_.push_back(std::move(element));
    return Ok{};
  }
  std::string_view integer_of(std::string_view word) {
    const std::string_view integer = without_zeros(word);
    if (integer != word) notes_.add(lines_.place(), "an integer is written with a point");
    return integer;
  }
  bool has_element(std::string_view name) const {
    return std::any_of(elements_.begin(), elements_.end(),
                       [name](const Element& element) { return element.name == name; });
  }

  Status read_property() {
    if (elements_.empty()) return lines_.error("a property before the first element; reorder them");
    Element& element = elements_.back();
    Property property;
    std::string_view type = lines_.word();
    if (type == "list") {
      const std::string_view length_type = lines_.word();
      property.length_type = find_type(length_type);
      if (property.length_type == nullptr || property.length_type->is_real) {
        return lines_.error(quoted(length_type) + " is not a type for the length of a list; correct it");
      }
      type = lines_.word();
    }
    property.type = find_type(type);
    if (property.type == nullptr) return lines_.error(quoted(type) + " is not a type of PLY; correct it");
    property.name = lines_.word();
    if (property.name.empty()) return lines_.error("a property without a name; give it one");
    if (has_property(element, &Property::name, property.name)) {
      return lines_.error(fmt::format("a second property {} of {}; rename or remove it",
                                      quoted(property.name), quoted(element.name)));
    }

    // Decide what it is used for.
    const std::size_t other_number = index_in(c_other_numbers, property.name);
    const std::size_t number = other_number < std::size(c_other_numbers)
                                   ? static_cast<std::size_t>(Use::nx) + other_number
                                   : index_in(c_numbers, property.name);
    const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
    if (element.kind == Kind::vertex && number < std::size(c_numbers)) {
      if (property.length_type) return lines_.error(fmt::format("{} is a list; correct it", property.name));
      property.use = static_cast<Use>(number);
      if (uses(element, property.use))
        return lines_.error(fmt::format("a second property {}; remove it", c_numbers[number]));
    } else if (has_corners(element) && is_corners) {
      if (!property.length_type || property.type->is_real) {
        return lines_.error(fmt::format("{} is not a list of integers; correct it", property.name));
      }
      if (uses(element, Use::corners)) return lines_.error("a second list of corners; remove it");
      property.use = Use::corners;
    }
    const bool is_colour =
        element.kind == Kind::vertex && index_in(c_colours, property.name) < std::size(c_colours);
    has_colours_ |= is_colour;
    if (element.kind != Kind::other && property.use == Use::none && !is_colour)
      notes_.add(lines_.place(), fmt::format("property {} is not used", quoted(property.name)));
    element.properties.push_back(property);
    return Ok{};
  }
  static bool has_corners(const Element& element) {
    return element.kind == Kind::face || element.kind == Kind::tristrips;
  }
  template <class Value>
  static bool has_property(const Element& element, Value Property::* member, const Value& value) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& property) { return property.*member == value; });
  }
  static bool uses(const Element& element, Use use) { return has_property(element, &Property::use, use); }

  Status check_elements() {
    for (const Element& element : elements_) {
      const std::string at = fmt::format("{}:{}", file_, element.line);
      const auto error = [&](std::string_view what) { return bad_input(fmt::format("{}: {}", at, what)); };
      if (element.count == 0) continue;
      // Items without properties take no bytes, so the file could request any number.
      if (element.properties.empty()) {
        return error(fmt::format("the {} items of {} have no property; remove the element", element.count,
                                 quoted(element.name)));
      }
      if (element.kind == Kind::vertex) {
        for (const Use use : {Use::x, Use::y, Use::z}) {
          if (uses(element, use)) continue;
          return error(fmt::format("vertices have no property {}; export the file again",
                                   c_numbers[static_cast<std::size_t>(use)]));
        }
        has_normals_ = uses(element, Use::nx);
        if (uses(element, Use::ny) != has_normals_ || uses(element, Use::nz) != has_normals_) {
          notes_.add(at, "vertices have only a part of nx, ny and nz; normals are computed");
          has_normals_ = false;
        }
      }
      if (has_corners(element) && !uses(element, Use::corners)) {
        return error(
            fmt::format("element {} has no list vertex_indices; export the file again", element.name));
      }
    }
    return Ok{};
  }

  /// The byte after the header. The line ends of the header are those of its first line, because the data may
  /// start with the byte of a line end.
  std::size_t data_start() const {
    const std::size_t first = bytes_.find_first_of("\r\n");
    const std::string end(bytes_.substr(first, bytes_.substr(first, 2) == "\r\n" ? 2 : 1));
    const std::size_t last_line = std::min(bytes_.find(end + "end_header"), bytes_.size());
    const std::size_t last_end = bytes_.find(end, std::min(last_line + 1, bytes_.size()));
    return last_end == std::string_view::npos ? bytes_.size() : last_end + end.size();
  }

  // ---- Data

  Status read_element(const Element& element) {
    for (item_ = 0; item_ < element.count; ++item_) {
      if (is_text_ && !next_line()) return truncated(element);
      corners_.clear();
      std::array<double, 6> numbers{};
      for (const Property& property : element.properties) {
        double length = 1.0;
        if (property.length_type) {
          if (Status ok = read_value(element, property, *property.length_type, true, length); !ok) return ok;
          if (length < 0.0) return error(element, fmt::format("a list of {} values; correct it", length));
        }
        // A face needs its corners and their positions. Other numbers may be anything.
        const bool is_needed = property.use <= Use::z || property.use == Use::corners;
        for (double i = 0.0; i < length; i += 1.0) {
          double value = 0.0;
          if (Status ok = read_value(element, property, *property.type, is_needed, value); !ok) return ok;
          if (property.use == Use::corners) {
            if (Status ok = add_corner(element, value); !ok) return ok;
          } else if (property.use != Use::none) {
            numbers[static_cast<std::size_t>(property.use)] = value;
          }
        }
      }
      if (Status ok = check_line_end(element); !ok) return ok;
      if (Status ok = add_item(element, numbers); !ok) return ok;
    }
    if (element.kind == Kind::other && element.count > 0) {
      note(fmt::format("elements {} are left out", quoted(element.name)));
    }
    return Ok{};
  }

  Error error(const Element& element, std::string_view what) const {
    return error(fmt::format("{} {}: {}", element.name, item_, what));
  }
  Error truncated(const Element& element) const {
    return error(
        fmt::format("the file ends at item {} of {} of {}; it is truncated, or the count in its header is "
                    "wrong; export it again",
                    item_, element.count, quoted(element.name)));
  }
  /// An error at the current line or byte.
  Error error(std::string_view what) const { return bad_input(fmt::format("{}: {}", place(), what)); }
  std::string place() const { return is_text_ ? lines_.place() : fmt::format("{}: byte {}", file_, at_); }

  /// Go to the next line that is not empty.
  bool next_line() {
    word_ = {};
    while (word_.empty() && lines_.next()) {
      word_ = lines_.word();
      if (!word_.starts_with(c_byte_order_mark)) continue;
      notes_.add(lines_.place(), "a byte order mark in the file is left out");
      word_.remove_prefix(c_byte_order_mark.size());
      if (word_.empty()) word_ = lines_.word();
    }
    return !word_.empty();
  }
  Status check_line_end(const Element& element) const {
    if (!is_text_ || word_.empty()) return Ok{};
    return error(element, quoted(word_) + " follows its last number; remove it");
  }
  Status check_end() {
    if (is_text_ ? !next_line() : at_ == bytes_.size()) return Ok{};
    if (!is_text_ && bytes_.find_first_not_of("\r\n", at_) == std::string_view::npos) {
      notes_.add(place(), "line ends after the last element are left out");
      return Ok{};
    }
    return error(is_text_ ? quoted(word_) +
                                " follows the last element; correct the counts in the header, or remove it"
                          : fmt::format("{} bytes follow the last element; correct the counts in the header, "
                                        "or remove them",
                                        bytes_.size() - at_));
  }

  /// Read the next number of this type. A number that is needed is in the range of float.
  Status read_value(const Element& element, const Property& property, const Type& type, bool is_needed,
                    double& value) {
    if (!is_text_) {
      if (bytes_.size() - at_ < type.size) return truncated(element);
      value = type.value_at(bytes_, at_, order_);
      if (type.is_real && !is_in_float_range(value)) {
        if (is_needed)
          return error(element, fmt::format("{} is not finite, or too large; correct it", property.name));
        value = c_unknown;
      }
      at_ += type.size;
      return Ok{};
    }
    if (word_.empty()) {
      return error(element, fmt::format("{} is missing at the end of the line; add it", property.name));
    }
    if (type.is_real || !is_needed) {
      double number = 0.0;
      const NumberFault fault = read_number(word_, number);
      if (fault != NumberFault::none && is_needed)
        return error(element, fault_text(fault, word_) + "; correct the number");
      value = fault == NumberFault::none ? number : c_unknown;
    } else {
      std::int64_t number = 0;
      const std::string_view word = integer_of(word_);
      const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (fault == std::errc::invalid_argument || end != word.data() + word.size()) {
        return error(element, quoted(word_) + " is not an integer; correct it, or the type in the header");
      }
      if (fault != std::errc() || number < type.least || number > type.greatest) {
        return error(element, quoted(word_) +
                                  " is out of the range of its type; correct it, or the type in the header");
      }
      value = static_cast<double>(number);
    }
    word_ = lines_.word();
    return Ok{};
  }

  // ---- Mesh

  Status add_corner(const Element& element, double index) {
    if (element.kind == Kind::tristrips && index == -1.0) return end_strip(element);
    if (index < 0.0 || index >= static_cast<double>(vertices_)) {
      return error(element, fmt::format("its corner is vertex {}, but the file has {}, counted from 0; "
                                        "correct the index",
                                        index, vertices_));
    }
    const auto vertex = to_integer<std::uint32_t>(index);
    corners_.push_back({vertex, has_normals_ ? vertex + 1 : 0});
    return Ok{};
  }

  Status add_item(const Element& element, const std::array<double, 6>& numbers) {
    switch (element.kind) {
      case Kind::vertex:
        faces_.add_position({numbers[0], numbers[1], numbers[2]});
        if (has_normals_)
          loaded_.mesh.normals.emplace_back(
              known_normal({numbers[3], numbers[4], numbers[5]}, notes_, [&] { return place(); }));
        return Ok{};
      case Kind::face:
        return add_face(element, corners_);
      case Kind::tristrips:
        return end_strip(element);
      case Kind::other:
        return Ok{};
    }
    return Ok{};
  }

  Status add_face(const Element& element, std::span<const FaceList::Corner> corners) {
    const std::string fault = faces_.divide(corners, [&] { return place(); }, notes_);
    if (!fault.empty()) return error(element, fault);
    faces_.append(0, loaded_.mesh);
    return Ok{};
  }

  /// Add the triangles of the corners so far. Every second triangle of a strip is in the opposite direction.
  /// Triangles that use a vertex twice connect parts of a strip.
  Status end_strip(const Element& element) {
    for (std::size_t i = 0; i + 2 < corners_.size(); ++i) {
      std::array<FaceList::Corner, 3> triangle = {corners_[i], corners_[i + 1], corners_[i + 2]};
      if (i % 2 == 1) std::swap(triangle[0], triangle[1]);
      const auto [a, b, c] = triangle;
      if (a.position == b.position || b.position == c.position || c.position == a.position) continue;
      if (Status ok = add_face(element, triangle); !ok) return ok;
    }
    corners_.clear();
    return Ok{};
  }

  void note(std::string_view what) { notes_.add(file_, what); }

  std::string_view bytes_;
  std::string_view file_;
  TextLines lines_;
  bool is_text_ = false;
  ByteOrder order_ = ByteOrder::little;
  std::vector<Element> elements_;
  std::uint64_t vertices_ = 0;
  bool has_normals_ = false, has_colours_ = false;

  std::uint64_t item_ = 0;  ///< of the current element
  std::string_view word_;   ///< next word of the line, of text
  std::size_t at_ = 0;      ///< next byte, of binary data

  std::vector<FaceList::Corner> corners_;  ///< of the current face or strip
  FaceList faces_;
  LoadedMesh loaded_;
  Notes notes_;
};

}  // namespace

Result<LoadedMesh> read_ply(std::string_view bytes, std::string_view file) {
  return PlyReader(bytes, file).read();
}

}  // namespace halfway
