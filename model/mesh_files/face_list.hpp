// SPDX-License-Identifier: Apache-2.0
// The faces of a mesh file, divided into triangles of a mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_files/loaded_mesh.hpp"
#include "mesh_files/notes.hpp"
#include "mesh_files/triangulate.hpp"

namespace halfway {

class FaceList {
 public:
  struct Corner {
    std::uint32_t position;  ///< index of the file's vertex
    std::uint32_t normal;    ///< index of the mesh's normal
  };

  void add_position(const glm::dvec3& position);
  std::size_t positions() const { return positions_.size(); }

  /// Divide a face. Returns what is wrong with it, or nothing. A face of one or two corners is a point or a
  /// line. A face whose outline crosses itself is a fan around its first corner, with a note at this place.
  /// The corners must exist until `append`.
  std::string divide(std::span<const Corner> corners, const std::function<std::string()>& place,
                     Notes& notes);
  /// True if the last face has triangles.
  bool is_divided() const { return !divided_.empty(); }
  /// Append the triangles of the last `divide` to the mesh. Vertices are in the order of their first use.
  void append(std::uint32_t material, Mesh& mesh);

  /// Counts a point or line.
  void add_point_or_line() { ++points_and_lines_; }

  /// Faces whose corners are on one line; they have no triangles.
  std::uint64_t without_area() const { return without_area_; }
  /// Note what has no triangles.
  void note_left_out(std::string_view file, Notes& notes) const;

 private:
  std::vector<glm::dvec3> positions_;
  std::vector<std::uint32_t> new_index_;  ///< of each vertex in the mesh, or c_no_index before its first use
  std::span<const Corner> corners_;
  std::vector<glm::dvec3> places_;
  std::vector<Triangulator::Triangle> divided_;
  Triangulator triangulator_;
  std::uint64_t triangles_ = 0, points_and_lines_ = 0, without_area_ = 0;
};

}  // namespace halfway
