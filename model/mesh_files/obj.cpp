// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <glm/vec3.hpp>
#include <limits>
#include <unordered_map>
#include <vector>

#include "mesh_files/face_list.hpp"
#include "mesh_files/mtl.hpp"
#include "mesh_files/number.hpp"
#include "mesh_files/text_lines.hpp"

namespace halfway {

namespace {

constexpr std::uint32_t c_none = UINT32_MAX;
/// In place of a material's index: its faces are not drawn.
constexpr std::uint32_t c_nothing = UINT32_MAX - 1;

constexpr std::string_view c_without_effect[] = {"s", "mg", "lod", "bevel", "c_interp", "d_interp", "vp"};
/// Keywords before a name: it goes up to the end of the line, and a backslash at its end belongs to it.
constexpr std::string_view c_names[] = {"g",      "o",      "usemtl",     "mtllib",
                                        "usemap", "maplib", "shadow_obj", "trace_obj"};
constexpr std::string_view c_curves[] = {"cstype", "deg",   "bmat", "step", "curv", "curv2", "surf",
                                         "parm",   "trim",  "hole", "scrv", "sp",   "end",   "con",
                                         "ctech",  "stech", "bsp",  "bzp",  "cdc",  "cdp",   "res"};
constexpr std::string_view c_textures[] = {"usemap", "maplib"};

/// A name up to a comment.
std::string_view before_comment(std::string_view name) {
  constexpr std::string_view c_blank = " \t";
  std::size_t end = 0;
  while ((end = name.find('#', end)) != std::string_view::npos) {
    if (end == 0 || c_blank.find(name[end - 1]) != std::string_view::npos) break;
    ++end;
  }
  name = name.substr(0, end);
  return name.substr(0, name.find_last_not_of(c_blank) + 1);
}

class ObjReader {
 public:
  ObjReader(std::string_view text, std::string_view file, const ReadLibrary& read_library)
      : text_(text), file_(file), read_library_(read_library) {}

  Result<LoadedMesh> read() {
    if (Status ok = read_vertices(); !ok) return ok.error();
    if (Status ok = read_faces(); !ok) return ok.error();
    if (loaded_.mesh.triangles.empty()) {
      return bad_input(line_of_first_face_ == 0
                           ? fmt::format("{}: the mesh has no faces; export it with faces", file_)
                           : fmt::format("{}:{}: no face from here on has any area; correct the vertices",
                                         file_, line_of_first_face_));
    }
    if (!has_materials_) loaded_.mesh.materials.push_back(default_material());
    faces_.note_left_out(file_, notes_);
    loaded_.notes = notes_.list();
    join_positions(loaded_.mesh);
    return std::move(loaded_);
  }

 private:
  using Corner = FaceList::Corner;  ///< normal 0: none; the mesh's first normal is zero
  /// A list that corners index.
  struct Field {
    std::string_view what;
    std::uint64_t most = c_max_vertices;
    std::uint64_t so_far = 0;  ///< its items before the current line
    std::uint64_t all = 0;     ///< in the file
  };

  // ---- First pass: vertices and materials, because a face may name vertices of later lines.

  Status read_vertices() {
    loaded_.mesh.normals.emplace_back(0.0);
    bool uses_material = false;
    for (TextLines lines(text_, file_, {}); lines.next();) {
      const std::string_view keyword = lines.word();
      Status ok = Ok{};
      if (keyword == "v") {
        ok = read_position(lines);
      } else if (keyword == "vn") {
        ok = read_normal(lines);
      } else if (keyword == "vt") {
        ++texel_.all;
      } else if (keyword == "mtllib") {
        read_libraries(lines);
      } else if (contains(c_names, keyword)) {
        uses_material |= keyword == "usemtl";
        lines.rest();
      }
      if (!ok) return ok;
    }
    has_materials_ = uses_material && libraries_ > 0;
    return Ok{};
  }

  static Status count_item(const TextLines& lines, Field& field) {
    if (field.all++ < field.most) return Ok{};
    return lines.error(
        fmt::format("{} {}, but {} is the most; reduce the mesh", field.what, field.all, field.most));
  }

  Status read_position(TextLines& lines) {
    if (Status ok = count_item(lines, position_); !ok) return ok;
    std::array<double, 4> v{};
    int count = 0;
    for (std::string_view word = lines.word(); !word.empty(); word = lines.word()) {
      double value = 0.0;
      const NumberFault fault = read_number(word, value);
      if (fault == NumberFault::not_a_number || (fault != NumberFault::none && count < 3)) {
        return lines.error(
            fmt::format("vertex {}: {}; correct the coordinate", position_.all, fault_text(fault, word)));
      }
      if (count < 4) v[static_cast<std::size_t>(count)] = fault == NumberFault::none ? value : 0.0;
      ++count;
    }
    if (count < 3 || count == 5)
      return lines.error(
          fmt::format("vertex {} has {} numbers; it must have 3, 4, 6 or more", position_.all, count));
    if (count == 4) {
      if (v[3] == 0.0) {
        return lines.error(
            fmt::format("vertex {} has the weight zero; correct the coordinate", position_.all));
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        v[axis] /= v[3];
        if (!is_in_float_range(v[axis])) {
          return lines.error(fmt::format("vertex {} is too large; correct the coordinate", position_.all));
        }
      }
    }
    if (count >= 6) notes_.add(lines.place(), "vertex colours are left out");
    faces_.add_position({v[0], v[1], v[2]});
    return Ok{};
  }

  Status read_normal(TextLines& lines) {
    if (Status ok = count_item(lines, normal_); !ok) return ok;
    glm::dvec3 normal(0.0);
    for (int axis = 0; axis < 3; ++axis)
      if (read_number(lines.word(), normal[axis]) != NumberFault::none)
        normal[axis] = std::numeric_limits<double>::quiet_NaN();
    loaded_.mesh.normals.emplace_back(known_normal(normal, notes_, [&] { return lines.place(); }));
    return Ok{};
  }

  /// The line is one name with blanks, or several names.
  void read_libraries(TextLines& lines) {
    const std::string_view names = lines.rest();
    if (names.empty()) return notes_.add(lines.place(), "mtllib names no file");
    MaterialLibrary whole = read_library_(names);
    if (whole.text || names.find_first_of(" \t") == std::string_view::npos) return read_library(whole);
    TextLines each(names, file_, {.continuation = false});
    each.next();
    for (std::string_view name = each.word(); !name.empty(); name = each.word())
      read_library(read_library_(name));
  }

  void read_library(const MaterialLibrary& library) {
    if (!library.text)
      return notes_.add(
          file_, fmt::format("material library {} cannot be read; its materials are grey", library.path));
    ++libraries_;
    read_mtl(*library.text, library.path, defined_, notes_);
  }

  // ---- Second pass: faces.

  Status read_faces() {
    for (TextLines lines(text_, file_, {}); lines.next();) {
      const std::string_view keyword = lines.word();
      Status ok = Ok{};
      if (keyword == "v") {
        ++position_.so_far;
      } else if (keyword == "vt") {
        ++texel_.so_far;
      } else if (keyword == "vn") {
        ++normal_.so_far;
      } else if (keyword == "f") {
        ok = read_face(lines);
      } else if (keyword == "l" || keyword == "p") {
        ok = read_corners(lines);
        faces_.add_point_or_line();
      } else if (keyword == "usemtl") {
        material_name_ = lines.rest();
        material_ = c_none;
      } else if (contains(c_textures, keyword)) {
        notes_.add(lines.place(), "textures are left out");
        lines.rest();
      } else if (contains(c_names, keyword)) {
        lines.rest();
      } else if (contains(c_curves, keyword)) {
        notes_.add(lines.place(), "curves and surfaces are left out");
      } else if (!keyword.empty() && !contains(c_without_effect, keyword)) {
        ok = lines.error(quoted(keyword) + " is not a keyword of OBJ; correct or remove the line");
      }
      if (!ok) return ok;
    }
    return Ok{};
  }

  Status read_corners(TextLines& lines) {
    corners_.clear();
    for (std::string_view word = lines.word(); !word.empty(); word = lines.word()) {
      const Result<Corner> corner = read_corner(lines, word);
      if (!corner) return corner.error();
      corners_.push_back(*corner);
    }
    if (corners_.empty()) return lines.error("a face, line or point without a corner");
    return Ok{};
  }

  /// Read vertex/texture/normal, of which all but the first may be missing.
  Result<Corner> read_corner(const TextLines& lines, std::string_view word) {
    std::array<std::uint32_t, 3> indices{};  // from 1; 0: none
    const Field* const fields[] = {&position_, &texel_, &normal_};
    std::string_view left = word;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t slash = std::min(left.find('/'), left.size());
      const std::string_view part = left.substr(0, slash);
      const bool is_last = slash == left.size();
      left.remove_prefix(is_last ? slash : slash + 1);
      if ((part.empty() && i == 0) || (i == 2 && !is_last)) {
        return lines.error(quoted(word) + " is not a corner of a face");
      }
      if (part.empty()) continue;
      const Result<std::uint32_t> index = read_index(lines, *fields[i], part, word);
      if (index) {
        indices[i] = *index;
      } else if (i == 0) {
        return index.error();
      } else {  // Nothing reads texture coordinates, and a normal can be computed.
        notes_.add(lines.place(),
                   fmt::format("a corner names a {} that the file does not have", fields[i]->what));
      }
    }
    return Corner{indices[0] - 1, indices[2]};
  }

  static Result<std::uint32_t> read_index(const TextLines& lines, const Field& field, std::string_view part,
                                          std::string_view word) {
    std::int64_t index = 0;
    const auto [end, fault] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (fault == std::errc::invalid_argument || end != part.data() + part.size()) {
      return lines.error(quoted(word) + " is not a corner of a face");
    }
    const bool is_relative = part.starts_with('-');
    const std::uint64_t count = is_relative ? field.so_far : field.all;
    const std::uint64_t distance =
        is_relative ? 0 - static_cast<std::uint64_t>(index) : static_cast<std::uint64_t>(index);
    if (fault != std::errc() || distance == 0 || distance > count) {
      return lines.error(fmt::format("a face names {} {}, but the file has {}{}; correct the index",
                                     field.what, part, count, is_relative ? " so far" : ""));
    }
    return static_cast<std::uint32_t>(is_relative ? count - distance + 1 : distance);
  }

  Status read_face(TextLines& lines) {
    if (Status ok = read_corners(lines); !ok) return ok;
    if (material_ == c_none) material_ = has_materials_ ? find_material() : 0;
    if (material_ == c_nothing) return Ok{};
    if (line_of_first_face_ == 0 && corners_.size() > 2) line_of_first_face_ = lines.line();
    const std::string fault = faces_.divide(corners_, [&] { return lines.place(); }, notes_);
    if (!fault.empty()) return lines.error(fault);
    if (!faces_.is_divided()) return Ok{};
    faces_.append(material_, loaded_.mesh);
    return Ok{};
  }

  /// The index of the current material. A material gets its index when the first face uses it.
  std::uint32_t find_material() {
    auto defined = defined_.find(std::string(material_name_));
    std::string_view name = material_name_;
    if (defined == defined_.end()) {
      name = before_comment(name);
      defined = defined_.find(std::string(name));
    }
    const auto [index, is_new] =
        indices_.try_emplace(std::string(name), static_cast<std::uint32_t>(loaded_.mesh.materials.size()));
    if (!is_new) return index->second;
    if (defined == defined_.end()) {
      loaded_.mesh.materials.push_back(plain_material(name.empty() ? "default" : name));
      note(name.empty() ? "faces without a material are grey"
                        : fmt::format("material {} is not defined; it is grey", quoted(name)));
      return index->second;
    }
    const MtlMaterial& found = defined->second;
    if (found.opacity() <= 0.0) {
      note(fmt::format("material '{}' is transparent: its faces are not drawn", name));
      return index->second = c_nothing;
    }
    loaded_.mesh.materials.push_back(found.material);
    if (found.opacity() < 1.0) note(fmt::format("material '{}': transparency is left out", name));
    if (found.file_exponent < 1.0 && found.material.specular > 0.0) {
      note(fmt::format("material '{}': exponent {} raised to 1", name, found.file_exponent));
    }
    if (found.has_textures) note(fmt::format("material '{}': textures are left out", name));
    return index->second;
  }

  // ---- Notes

  void note(std::string_view what) { notes_.add(file_, what); }

  std::string_view text_;
  std::string_view file_;
  const ReadLibrary& read_library_;
  LoadedMesh loaded_;

  // Texture coordinates are counted only.
  Field position_{.what = "vertex"}, texel_{.what = "texture coordinate", .most = UINT64_MAX},
      normal_{.what = "normal"};

  MtlMaterials defined_;
  int libraries_ = 0;
  bool has_materials_ = false;
  std::string_view material_name_;  ///< after the last usemtl
  std::uint32_t material_ = c_none;
  std::unordered_map<std::string, std::uint32_t> indices_;  ///< of materials in the mesh

  std::vector<Corner> corners_;  ///< of the current face
  FaceList faces_;
  std::uint64_t line_of_first_face_ = 0;

  Notes notes_;
};

}  // namespace

Result<LoadedMesh> read_obj(std::string_view text, std::string_view file, const ReadLibrary& read_library) {
  return ObjReader(text, file, read_library).read();
}

}  // namespace halfway
