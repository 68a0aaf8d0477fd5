// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "mesh_files/bytes.hpp"
#include "mesh_files/notes.hpp"
#include "mesh_files/number.hpp"
#include "mesh_files/text_lines.hpp"

namespace halfway {

namespace {

constexpr std::size_t c_count_at = 80, c_header_bytes = 84, c_facet_bytes = 50;
/// Within a binary facet: three normal components come first, the attribute last.
constexpr std::size_t c_corners_at = 12, c_corner_bytes = 12, c_attribute_at = 48;

void add_corner(Mesh& mesh, const glm::dvec3& position) {
  const auto index = static_cast<std::uint32_t>(mesh.positions.size());
  if (index % 3 == 0) mesh.triangles.emplace_back();
  mesh.triangles.back().position[index % 3] = index;
  mesh.positions.emplace_back(position);
}

Result<LoadedMesh> finish(LoadedMesh loaded, std::string_view file) {
  if (loaded.mesh.triangles.empty()) {
    return bad_input(fmt::format("{}: the mesh has no faces; export it with faces", file));
  }
  loaded.mesh.normals.emplace_back(0.0);
  loaded.mesh.materials.push_back(default_material());
  loaded.default_crease_degrees = c_stl_crease_degrees;
  join_positions(loaded.mesh);
  return loaded;
}

// ---- Text

class TextReader {
 public:
  TextReader(std::string_view text, std::string_view file)
      : lines_(text, file, {.comments = false, .continuation = false}), file_(file) {}

  Result<LoadedMesh> read() {
    lines_.next();
    for (next_word(); !word_.empty(); next_word()) {
      if (Status ok = read_solid(); !ok) return ok.error();
    }
    loaded_.notes = notes_.list();
    return finish(std::move(loaded_), file_);
  }

 private:
  /// Go to the next word, on this line or a later one; empty at the end of the file.
  void next_word() {
    for (word_ = lines_.word(); word_.empty() && lines_.next();) word_ = lines_.word();
  }
  bool is(std::string_view keyword) const { return lower_case(word_.substr(0, 16)) == keyword; }
  bool starts(std::string_view keyword) const {
    return lower_case(word_.substr(0, keyword.size())) == keyword;
  }
  /// True at "endloop" or "end loop". A name may follow "endsolid" without a blank.
  bool ends(std::string_view what) {
    if (!is("end")) return starts("end") && lower_case(word_.substr(3, what.size())) == what;
    next_word();
    return starts(what);
  }
  Error wanted(std::string_view what) const {
    if (word_.empty()) {
      return lines_.error(
          fmt::format("the file ends where {} must follow; it is truncated, export it again", what));
    }
    return lines_.error(fmt::format("{} instead of {}; correct the line", quoted(word_), what));
  }
  Status expect(std::string_view keyword) {
    next_word();
    if (!is(keyword)) return wanted(fmt::format("'{}'", keyword));
    return Ok{};
  }

  /// Read a solid whose first word was read.
  Status read_solid() {
    if (!starts("solid")) return wanted("'solid'");
    lines_.rest();  // its name
    next_word();
    while (is("facet")) {
      if (Status ok = read_facet(); !ok) return ok;
    }
    if (!ends("solid")) return wanted("'facet' or 'endsolid'");
    lines_.rest();
    return Ok{};
  }

  Status read_facet() {
    if (loaded_.mesh.triangles.size() == c_max_triangles) {
      return lines_.error(fmt::format("more than {} triangles; reduce the mesh", c_max_triangles));
    }
    ++facets_;
    // Nothing reads the normal: skip its four words, or those of them that are there.
    next_word();
    for (int skipped = 0; skipped < 4 && !is("outer") && !word_.empty(); ++skipped) next_word();
    if (!is("outer")) return wanted("'outer'");
    glm::dvec3 numbers;
    if (Status ok = expect("loop"); !ok) return ok;
    for (int corner = 0; corner < 3; ++corner) {
      if (Status ok = expect("vertex"); !ok) return ok;
      if (Status ok = read_numbers(numbers); !ok) return ok;
      add_corner(loaded_.mesh, numbers);
    }
    next_word();
    if (is("vertex")) {
      return lines_.error(
          fmt::format("facet {} has more than 3 vertices; divide it into triangles", facets_));
    }
    if (!ends("loop")) return wanted("'endloop'");
    next_word();
    if (!ends("facet")) return wanted("'endfacet'");
    // Go to the next keyword.
    word_ = lines_.word();
    while (!word_.empty() && !is("facet") && !starts("end")) {
      notes_.add(lines_.place(), "words after endfacet are left out");
      word_ = lines_.word();
    }
    if (word_.empty()) next_word();
    return Ok{};
  }

  Status read_numbers(glm::dvec3& numbers) {
    for (int axis = 0; axis < 3; ++axis) {
      next_word();
      if (word_.empty()) return wanted("a number");
      const NumberFault fault = read_number(word_, numbers[axis]);
      if (fault == NumberFault::none) continue;
      return lines_.error(fmt::format("facet {}: {}; correct the number", facets_, fault_text(fault, word_)));
    }
    return Ok{};
  }

  TextLines lines_;
  std::string_view file_;
  std::string_view word_;
  std::uint64_t facets_ = 0;
  LoadedMesh loaded_;
  Notes notes_;
};

// ---- Binary

Result<LoadedMesh> read_binary(std::string_view bytes, std::string_view file, std::uint32_t facets) {
  if (facets > c_max_triangles) {
    return bad_input(
        fmt::format("{}: {} triangles, but {} is the most; reduce the mesh", file, facets, c_max_triangles));
  }
  LoadedMesh loaded;
  loaded.mesh.positions.reserve(3 * std::size_t{facets});
  loaded.mesh.triangles.reserve(facets);
  bool has_colours = false;
  for (std::size_t facet = 0; facet < facets; ++facet) {
    const std::size_t start = c_header_bytes + c_facet_bytes * facet;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = start + c_corners_at + c_corner_bytes * corner;
      glm::vec3 position;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = number_in<float>(bytes, at + 4 * axis, ByteOrder::little);
        if (!std::isfinite(value)) {
          return bad_input(
              fmt::format("{}: facet {} (byte {}): vertex {} has a coordinate that is not finite; correct it",
                          file, facet + 1, at + 4 * axis, corner + 1));
        }
        position[static_cast<int>(axis)] = value;
      }
      add_corner(loaded.mesh, position);
    }
    has_colours |= number_in<std::uint16_t>(bytes, start + c_attribute_at, ByteOrder::little) != 0;
  }
  const std::size_t end = c_header_bytes + c_facet_bytes * std::size_t{facets};
  if (bytes.size() > end) {
    loaded.notes.push_back(
        fmt::format("{}: byte {}: {} bytes after the facets are left out", file, end, bytes.size() - end));
  }
  if (has_colours) loaded.notes.push_back(fmt::format("{}: colours of facets are left out", file));
  return finish(std::move(loaded), file);
}

}  // namespace

Result<LoadedMesh> read_stl(std::string_view bytes, std::string_view file) {
  std::uint32_t facets = 0;
  if (bytes.size() >= c_header_bytes) {
    facets = number_in<std::uint32_t>(bytes, c_count_at, ByteOrder::little);
    if (bytes.size() == c_header_bytes + c_facet_bytes * std::uint64_t{facets}) {
      return read_binary(bytes, file, facets);
    }
  }
  // A binary header may start with "solid" too, but text contains no zero byte.
  std::string_view start = bytes.substr(0, c_header_bytes);
  if (start.starts_with(c_byte_order_mark)) start.remove_prefix(c_byte_order_mark.size());
  start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n\v\f"), start.size()));
  if (lower_case(start.substr(0, 5)) == "solid" && start.find('\0') == std::string_view::npos) {
    return TextReader(bytes, file).read();
  }
  if (const auto fault = utf16_fault(bytes); !fault.empty())
    return bad_input(fmt::format("{}:1: {}", file, fault));
  if (facets > 0 && bytes.size() > c_header_bytes + c_facet_bytes * std::uint64_t{facets}) {
    return read_binary(bytes, file, facets);
  }
  if (bytes.size() < c_header_bytes) {
    return bad_input(fmt::format(
        "{}: not an STL file, or truncated: it neither starts with 'solid' nor has the {} bytes of a "
        "binary header; export it again",
        file, c_header_bytes));
  }
  return bad_input(fmt::format(
      "{}: not an STL file, or damaged: its header (byte {}) requires {} facets and so {} bytes, it has {}; "
      "export it again",
      file, c_count_at, facets, c_header_bytes + c_facet_bytes * std::uint64_t{facets}, bytes.size()));
}

}  // namespace halfway
