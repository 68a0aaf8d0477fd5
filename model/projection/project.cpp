// SPDX-License-Identifier: Apache-2.0
#include "projection/project.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

#include "common/to_integer.hpp"
#include "projection/unit_vector.hpp"
#include "scene/mesh.hpp"

namespace halfway {
namespace {

// Larger than any scene, and small enough that no product below overflows.
constexpr double c_largest_coordinate = 1e100;

// In near distances. An edge whose nearer end is farther away may pass close to the eye and be cut there with
// an error of 1/64 pixel or more.
constexpr double c_largest_to_cut = 1e13;

// Interpolated normals shorter than this are rounding noise: their direction is meaningless.
constexpr double c_shortest_normal = 1e-8;

// In pixels: enlargement of a triangle by rounding to whole pixels and by an edge's rounded slope.
constexpr std::int32_t c_reach_margin = 2;
// Margin that keeps the nearest surface behind the near plane despite the rounding of a projection.
constexpr double c_before_nearest = 0.999;

// The sign of the volume spanned by eye and triangle distinguishes front from back without a division.
template <class Vertex>
bool faces_away(const Vertex& a, const Vertex& b, const Vertex& c) {
  return a.x * (b.y * c.w - b.w * c.y) + a.y * (b.w * c.x - b.x * c.w) + a.w * (b.x * c.y - b.y * c.x) > 0;
}

bool representable(double v) {
  return std::abs(v) <= c_largest_coordinate;
}  // false for NaN

glm::dvec3 geometric_normal_world(const ScreenTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertex;
  // Seen from outside the corners are clockwise on the screen, because y points down. Use c before b.
  const glm::dvec3 normal = unit_or_zero(glm::cross(unit_or_zero(c.position_world - a.position_world),
                                                    unit_or_zero(b.position_world - a.position_world)));
  if (normal != glm::dvec3(0.0)) return normal;
  for (const ScreenVertex& v : triangle.vertex)
    if (const glm::dvec3 n = unit_or_zero(v.normal_world); n != glm::dvec3(0.0)) return n;
  return {0.0, 0.0, 1.0};
}

}  // namespace

ProjectionCounts& ProjectionCounts::operator+=(const ProjectionCounts& other) {
  visible += other.visible;
  back_facing += other.back_facing;
  left_out += other.left_out;
  behind_near += other.behind_near;
  cut_by_near += other.cut_by_near;
  outside += other.outside;
  degenerate += other.degenerate;
  unrepresentable += other.unrepresentable;
  return *this;
}

Projector::Projector(const Scene& scene, FrameSize frame, ProjectionOptions options)
    : scene_(&scene), frame_(frame), options_(options) {
  options_.subpixel_bits = std::clamp(options.subpixel_bits, 0, c_max_subpixel_bits);
  const double width = frame.width, height = frame.height;
  const Camera& camera = scene.camera;
  eye_world_ = camera.eye_world;
  basis_ = view_basis(camera);
  depth_range_ = depth_range(camera, bounding_sphere(scene));
  focal_pixels_ = 0.5 * height / std::tan(0.5 * glm::radians(camera.vertical_fov_degrees));
  usable_ = has_view(camera) && depth_range_.near > 0 && depth_range_.near < depth_range_.far &&
            depth_range_.far <= c_largest_coordinate && focal_pixels_ > 0 &&
            options.subpixel_bits == options_.subpixel_bits;

  const bool to_frame = options.clip_to_frame;
  const double left = to_frame ? 0.0 : c_guard_begin, right = to_frame ? width : c_guard_end;
  const double top = to_frame ? 0.0 : c_guard_begin, bottom = to_frame ? height : c_guard_end;
  planes_ = {{{1, 0, -left, 0}, {-1, 0, right, 0}, {0, 1, -top, 0}, {0, -1, bottom, 0}}};

  // A vertex that names a pixel must name a pixel of the frame. A point of the plane may lie on the far
  // border of the frame.
  const int last = to_frame && options_.subpixel_bits == 0 ? 1 : 0;
  const auto units = [&](double pixels) {
    return to_integer<std::int32_t>(pixels) * (1 << options_.subpixel_bits);
  };
  snapped_range_ = {units(left), units(right) - last, units(top), units(bottom) - last};
  fit_near();
}

// Moves a fitted near plane before the surfaces in view that it would cut.
void Projector::fit_near() {
  const auto [near, far] = depth_range_;
  if (!usable_ || scene_->camera.near > 0.0 || near > c_near_part_of_far * far) return;
  double nearest = 2.0 * near;  // a surface behind it does not move the plane
  for (const SceneTriangle& triangle : scene_->triangles) {
    std::array<ClipVertex, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = transform(scene_->positions_world[triangle.position[i]], glm::dvec3(0.0));
    const bool is_drawn =
        triangle.culling == Culling::none || !faces_away(corners[0], corners[1], corners[2]);
    if (is_drawn &&
        std::all_of(corners.begin(), corners.end(), [&](const ClipVertex& v) { return is_representable(v); }))
      nearest = nearest_in_frame(corners, nearest);
  }
  depth_range_.near = std::min(near, std::max(c_before_nearest * nearest, c_least_near_part * far));
}

Projector::ClipVertex Projector::transform(glm::dvec3 position_world, glm::dvec3 normal_world) const {
  const glm::dvec3 from_eye = position_world - eye_world_;
  const double w = -glm::dot(from_eye, basis_.backward_world);
  return {focal_pixels_ * glm::dot(from_eye, basis_.right_world) + 0.5 * frame_.width * w,
          -focal_pixels_ * glm::dot(from_eye, basis_.up_world) + 0.5 * frame_.height * w, w, position_world,
          normal_world};
}

// Both triangles at an edge call this with the same two points in either order. Sort them, so that both get
// the same bits. Start from the smaller point, because the rounding of the sum is relative to the result.
Projector::ClipVertex Projector::intersect(const ClipVertex& a, const ClipVertex& b, const Plane& plane) {
  const bool in_order = std::tuple(a.magnitude(), a.x, a.y, a.w) < std::tuple(b.magnitude(), b.x, b.y, b.w);
  const ClipVertex& p = in_order ? a : b;
  const ClipVertex& q = in_order ? b : a;
  const double distance_p = plane.distance(p), distance_q = plane.distance(q);
  const double t = distance_p / (distance_p - distance_q);
  const auto mix = [t](auto from, auto to) { return from + t * (to - from); };
  return {mix(p.x, q.x), mix(p.y, q.y), mix(p.w, q.w), mix(p.position_world, q.position_world),
          mix(p.normal_world, q.normal_world)};
}

bool Projector::clip(std::vector<ClipVertex>& polygon, std::vector<ClipVertex>& scratch, const Plane& plane) {
  const auto inside = [&](const ClipVertex& v) { return plane.distance(v) >= 0; };
  if (std::all_of(polygon.begin(), polygon.end(), inside)) return false;
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex& here = polygon[i];
    const ClipVertex& next = polygon[(i + 1) % polygon.size()];
    if (inside(here)) scratch.push_back(here);
    if (inside(here) != inside(next)) scratch.push_back(intersect(here, next, plane));
  }
  std::swap(polygon, scratch);
  return true;
}

double Projector::depth(double w) const {
  const auto [near, far] = depth_range_;
  return std::clamp(far / w * ((w - near) / (far - near)), 0.0, 1.0);
}

ScreenVertex Projector::snap(const ClipVertex& v, double near) const {
  const double w = std::max(v.w, near);  // rounding may put an intersection before the near plane
  const double scale = 1 << options_.subpixel_bits;
  const double to_pixel = options_.subpixel_bits == 0 ? 0.5 : 0.0;
  const auto round_into = [&](double pixels, std::int32_t least, std::int32_t greatest) {
    const double rounded = std::floor((pixels - to_pixel) * scale + 0.5);
    return to_integer<std::int32_t>(
        std::clamp(rounded, static_cast<double>(least), static_cast<double>(greatest)));
  };
  return {round_into(v.x / w, snapped_range_[0], snapped_range_[1]),
          round_into(v.y / w, snapped_range_[2], snapped_range_[3]),
          depth(w),
          1.0 / w,
          v.position_world,
          v.normal_world};
}

bool Projector::is_representable(const ClipVertex& v) const {
  return usable_ && representable(v.x) && representable(v.y) && representable(v.w);
}

bool Projector::is_inside(const ClipVertex& v) const {
  return v.w >= depth_range_.near && v.w <= depth_range_.far &&
         std::all_of(planes_.begin(), planes_.end(),
                     [&](const Plane& plane) { return plane.distance(v) >= 0; });
}

ProjectedVertex Projector::project_vertex(const VertexKey& vertex) const {
  const ClipVertex v =
      transform(scene_->positions_world[vertex.position], scene_->normals_world[vertex.normal]);
  ProjectedVertex projected{v.x, v.y, v.w, is_representable(v) && is_inside(v), {}};
  if (projected.is_inside) projected.screen = snap(v, depth_range_.near);
  return projected;
}

bool Projector::is_outside_frame(std::span<const ScreenVertex> corners) const {
  std::int32_t left = corners[0].x, right = left, top = corners[0].y, bottom = top;
  for (const ScreenVertex& corner : corners.subspan(1)) {
    left = std::min(left, corner.x);
    right = std::max(right, corner.x);
    top = std::min(top, corner.y);
    bottom = std::max(bottom, corner.y);
  }
  const std::int32_t unit = 1 << options_.subpixel_bits;
  return right < 0 || bottom < 0 || left > std::int64_t{frame_.width} * unit ||
         top > std::int64_t{frame_.height} * unit;
}

std::vector<ScreenVertex> Projector::clip_and_snap(std::vector<ClipVertex>& polygon, const DepthRange& slice,
                                                   ProjectionCounts& counts) const {
  std::vector<ClipVertex> scratch;
  const std::array<double, 3> magnitude{polygon[0].magnitude(), polygon[1].magnitude(),
                                        polygon[2].magnitude()};
  const double middle_magnitude = std::max(std::min(magnitude[0], magnitude[1]),
                                           std::min(std::max(magnitude[0], magnitude[1]), magnitude[2]));
  bool was_cut = clip(polygon, scratch, {0, 0, 1, -slice.near});
  if (polygon.empty()) {
    ++counts.behind_near;
    return {};
  }
  was_cut |= clip(polygon, scratch, {0, 0, -1, slice.far});
  for (std::size_t i = 0; i < planes_.size() && !polygon.empty(); ++i)
    was_cut |= clip(polygon, scratch, planes_[i]);
  if (polygon.empty()) {
    ++counts.outside;
    return {};
  }
  if (was_cut && middle_magnitude > c_largest_to_cut * slice.near) {
    ++counts.unrepresentable;
    return {};
  }

  std::vector<ScreenVertex> corner;
  corner.reserve(polygon.size());
  for (const ClipVertex& v : polygon) corner.push_back(snap(v, slice.near));
  if (!is_outside_frame(corner)) return corner;
  ++counts.outside;
  return {};
}

// The depth of the triangle's nearest point in the frame, whatever the near plane is; `limit` if it is not
// less.
double Projector::nearest_in_frame(std::span<const ClipVertex> corners, double limit) const {
  if (std::all_of(corners.begin(), corners.end(), [limit](const ClipVertex& v) { return v.w >= limit; }))
    return limit;
  const double width = frame_.width, height = frame_.height;
  const Plane sides[] = {{1, 0, 0, 0}, {-1, 0, width, 0}, {0, 1, 0, 0}, {0, -1, height, 0}};
  std::vector<ClipVertex> part(corners.begin(), corners.end()), scratch;
  for (const Plane& side : sides)
    if (!part.empty()) clip(part, scratch, side);
  for (const ClipVertex& v : part) limit = std::min(limit, v.w);
  return limit;
}

// The side that the eye sees is that of the exact corners. A triangle that snapping reversed shows the other
// side, and is not drawn.
void Projector::turn_to_eye(ScreenTriangle& piece, bool faces_away) const {
  if (has_averted_normals(*scene_, scene_->triangles[piece.source]) != faces_away) {
    for (ScreenVertex& v : piece.vertex) v.normal_world = -v.normal_world;
    piece.is_whole = false;
  }
  if (!faces_away) return;
  std::swap(piece.vertex[1], piece.vertex[2]);
  piece.is_whole = false;
  piece.is_back = true;
}

void Projector::count_hidden(const SceneTriangle& triangle, bool faces_away, ProjectionCounts& counts) {
  const bool is_culled = faces_away && triangle.culling != Culling::none;
  ++(is_culled ? counts.back_facing : counts.degenerate);
  counts.left_out += is_culled && triangle.culling == Culling::back;
}

void Projector::project(std::uint32_t triangle, std::vector<ScreenTriangle>& out,
                        ProjectionCounts& counts) const {
  const SceneTriangle& source = scene_->triangles[triangle];
  std::vector<ClipVertex> polygon;
  polygon.reserve(9);  // each of the six planes adds at most one corner
  for (int i = 0; i < 3; ++i) {
    polygon.push_back(
        transform(scene_->positions_world[source.position[i]], scene_->normals_world[source.normal[i]]));
    if (is_representable(polygon.back())) continue;
    ++counts.unrepresentable;
    return;
  }
  const bool away = faces_away(polygon[0], polygon[1], polygon[2]);
  counts.cut_by_near += (!away || source.culling == Culling::none) &&
                        nearest_in_frame(polygon, depth_range_.near) < depth_range_.near;
  const std::vector<ScreenVertex> corner = clip_and_snap(polygon, depth_range_, counts);
  if (corner.empty()) return;
  // The snapped area alone decides the orientation of a triangle. If snapping reversed a triangle, its
  // neighbours, which share the moved vertices, cover its pixels.
  bool any = false;
  for (std::size_t i = 1; i + 1 < corner.size(); ++i) {
    ScreenTriangle piece{triangle, source.material, {corner[0], corner[i + 1], corner[i]}, false};
    if (source.culling == Culling::none) turn_to_eye(piece, away);
    if (piece.twice_area() <= 0) continue;
    out.push_back(piece);
    any = true;
  }
  if (any)
    ++counts.visible;
  else
    count_hidden(source, away, counts);
}

std::span<const ScreenTriangle> MeshProjector::project(std::uint32_t triangle, ProjectionCounts& counts) {
  pieces_.clear();
  const SceneTriangle& source = projector_.scene_->triangles[triangle];
  std::array<ProjectedVertex, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexKey key = vertex_key(source, i);
    corner[i] = vertices_.get(key, [&] { return projector_.project_vertex(key); });
    if (!corner[i].is_inside) {
      projector_.project(triangle, pieces_, counts);
      return pieces_;
    }
  }
  const bool away = faces_away(corner[0], corner[1], corner[2]);
  ScreenTriangle whole{
      triangle, source.material, {corner[0].screen, corner[2].screen, corner[1].screen}, true};
  if (source.culling == Culling::none) projector_.turn_to_eye(whole, away);
  if (projector_.is_outside_frame(whole.vertex)) {
    ++counts.outside;
  } else if (whole.twice_area() > 0) {
    pieces_.push_back(whole);
    ++counts.visible;
  } else {
    Projector::count_hidden(source, away, counts);
  }
  return pieces_;
}

Tile Projector::reach(std::uint32_t triangle) const {
  std::vector<ScreenTriangle> pieces;
  project(triangle, pieces);
  if (pieces.empty()) return {};
  constexpr std::int32_t c_far = std::numeric_limits<std::int32_t>::max();
  ScreenPoint least{c_far, c_far}, greatest{-c_far, -c_far};
  for (const ScreenTriangle& piece : pieces)
    for (const ScreenVertex& v : piece.vertex) {
      least = {std::min(least.x, v.x), std::min(least.y, v.y)};
      greatest = {std::max(greatest.x, v.x), std::max(greatest.y, v.y)};
    }
  const auto pixels = [&](std::int32_t first, std::int32_t last, std::uint32_t side) {
    const auto in_frame = [&](std::int32_t units, std::int32_t margin) {
      const std::int64_t pixel = floor_divide(units, 1 << options_.subpixel_bits).quotient + margin;
      return static_cast<std::uint32_t>(std::clamp<std::int64_t>(pixel, 0, side));
    };
    return std::pair(in_frame(first, -c_reach_margin), in_frame(last, c_reach_margin + 1));
  };
  const auto [left, right] = pixels(least.x, greatest.x, frame_.width);
  const auto [top, bottom] = pixels(least.y, greatest.y, frame_.height);
  if (left == right || top == bottom) return {};
  return {left, top, {right - left, bottom - top}};
}

void Projector::project_two_sided(const std::array<glm::dvec3, 3>& corners_world, std::uint32_t source,
                                  DepthSlice slice, std::vector<TwoSidedTriangle>& out,
                                  ProjectionCounts& counts) const {
  std::vector<ClipVertex> polygon;
  polygon.reserve(9);
  for (const glm::dvec3& corner_world : corners_world) {
    polygon.push_back(transform(corner_world, glm::dvec3(0.0)));
    if (is_representable(polygon.back())) continue;
    ++counts.unrepresentable;
    return;
  }
  const double near = depth_range_.near;
  const bool is_visible = slice == DepthSlice::visible;
  std::vector<ScreenVertex> corner =
      clip_and_snap(polygon, is_visible ? depth_range_ : DepthRange{c_least_near * near, near}, counts);
  if (corner.empty()) return;
  if (!is_visible)  // an intersection with the near plane may be one rounding beyond it
    for (ScreenVertex& v : corner) v.z = 0.0;
  bool any = false;
  for (std::size_t i = 1; i + 1 < corner.size(); ++i) {
    const ScreenTriangle front{source, 0, {corner[0], corner[i + 1], corner[i]}, false};
    const ScreenTriangle back{source, 0, {corner[0], corner[i], corner[i + 1]}, false};
    if (front.twice_area() == 0) continue;
    const bool faces_eye = front.twice_area() > 0;
    out.push_back({faces_eye ? front : back, faces_eye});
    any = true;
  }
  ++(any ? counts.visible : counts.degenerate);
}

void Projector::project(std::uint32_t triangle, std::vector<ScreenTriangle>& out) const {
  ProjectionCounts ignored;
  project(triangle, out, ignored);
}

std::vector<ScreenTriangle> Projector::project_all(ProjectionCounts* counts) const {
  std::vector<ScreenTriangle> out;
  ProjectionCounts all;
  MeshProjector mesh(*this);
  for (std::uint32_t i = 0; i < scene_->triangles.size(); ++i) {
    const std::span<const ScreenTriangle> pieces = mesh.project(i, all);
    out.insert(out.end(), pieces.begin(), pieces.end());
  }
  if (counts != nullptr) *counts += all;
  return out;
}

glm::dvec3 barycentric_screen(const ScreenTriangle& triangle, std::int64_t x_half, std::int64_t y_half) {
  const auto& vertex = triangle.vertex;
  // Twice the area of (point, p, q), doubled because of the half units. Each product is below 2^46: exact.
  const auto area = [&](const ScreenVertex& p, const ScreenVertex& q) {
    return (2 * std::int64_t{p.x} - x_half) * (q.y - p.y) - (2 * std::int64_t{p.y} - y_half) * (q.x - p.x);
  };
  const double whole = 2.0 * static_cast<double>(triangle.twice_area());
  const auto weight = [&](int i) {
    return static_cast<double>(area(vertex[(i + 1) % 3], vertex[(i + 2) % 3])) / whole;
  };
  return {weight(0), weight(1), weight(2)};
}

glm::dvec3 barycentric_at_centre(const ScreenTriangle& triangle, int subpixel_bits, std::int64_t x,
                                 std::int64_t y) {
  return barycentric_screen(triangle, (2 * x + 1) << subpixel_bits, (2 * y + 1) << subpixel_bits);
}

SurfacePoint surface_point(const ScreenTriangle& triangle, glm::dvec3 barycentric_screen) {
  const auto& [a, b, c] = triangle.vertex;
  glm::dvec3 weight = barycentric_screen * glm::dvec3(a.inverse_w, b.inverse_w, c.inverse_w);
  const double inverse_w = weight.x + weight.y + weight.z;
  weight /= inverse_w;
  const glm::dvec3 normal = weight.x * a.normal_world + weight.y * b.normal_world + weight.z * c.normal_world;
  const double length = glm::length(normal);
  const bool is_smooth = length > c_shortest_normal;
  return {weight.x * a.position_world + weight.y * b.position_world + weight.z * c.position_world,
          is_smooth ? normal / length : geometric_normal_world(triangle),
          glm::dot(barycentric_screen, glm::dvec3(a.z, b.z, c.z)), inverse_w, is_smooth ? length : 0.0};
}

}  // namespace halfway
