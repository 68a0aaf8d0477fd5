// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/face_list.hpp"

#include <fmt/format.h>

namespace halfway {

namespace {

constexpr std::uint32_t c_no_index = UINT32_MAX;

}  // namespace

void FaceList::add_position(const glm::dvec3& position) {
  positions_.push_back(position);
  new_index_.push_back(c_no_index);
}

std::string FaceList::divide(std::span<const Corner> corners, const std::function<std::string()>& place,
                             Notes& notes) {
  corners_ = corners;
  divided_.clear();
  if (corners.size() < 3) {
    add_point_or_line();
    return {};
  }
  triangles_ += corners.size() - 2;
  if (triangles_ > c_max_triangles)
    return fmt::format("more than {} triangles; reduce the mesh", c_max_triangles);
  if (corners.size() == 3) {
    divided_.push_back({0, 1, 2});
    return {};
  }
  places_.clear();
  for (const Corner& corner : corners) places_.push_back(positions_[corner.position]);
  switch (triangulator_.divide(places_, divided_)) {
    case PolygonKind::divided:
      break;
    case PolygonKind::no_area:
      ++without_area_;
      break;
    case PolygonKind::crossing:
      for (std::uint32_t i = 2; i < corners.size(); ++i) divided_.push_back({0, i - 1, i});
      notes.add(place(),
                "the outline of a face crosses itself; it is drawn as a fan around its first corner");
      break;
    case PolygonKind::out_of_work:
      return "the concave faces up to here have too many corners; divide them into triangles";
  }
  return {};
}

void FaceList::note_left_out(std::string_view file, Notes& notes) const {
  if (points_and_lines_ > 0) notes.add(file, fmt::format("{} points and lines left out", points_and_lines_));
  if (without_area_ > 0) notes.add(file, fmt::format("{} faces without area left out", without_area_));
}

void FaceList::append(std::uint32_t material, Mesh& mesh) {
  for (const Triangulator::Triangle& triangle : divided_) {
    SceneTriangle added{.position = {}, .normal = {}, .material = material};
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner& corner = corners_[triangle[i]];
      std::uint32_t& index = new_index_[corner.position];
      if (index == c_no_index) {
        index = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(positions_[corner.position]);
      }
      added.position[i] = index;
      added.normal[i] = corner.normal;
    }
    mesh.triangles.push_back(added);
  }
}

}  // namespace halfway
