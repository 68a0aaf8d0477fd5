// SPDX-License-Identifier: Apache-2.0
// Projects the scene's triangles to the screen: perspective, clipping, snapping, culling.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "common/recent_values.hpp"
#include "frame/tile.hpp"
#include "projection/edge.hpp"
#include "projection/screen_triangle.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Screen coordinates stay within [c_guard_begin, c_guard_end] pixels. For frames up to 4096x4096 any
/// coordinate difference is then below 2^13 pixels, for every scene.
inline constexpr int c_guard_begin = -2048;
inline constexpr int c_guard_end = 6143;

inline constexpr int c_max_subpixel_bits = 9;

/// A fitted near plane is at least this part of far. The step of a 24-bit depth at far, relative to far, is
/// then up to 0.6 %; with c_near_part_of_far it is 0.006 %.
inline constexpr double c_least_near_part = 1e-5;

struct ProjectionOptions {
  /// Fraction bits of a screen coordinate, 0 to 9. With 0, (x, y) names the pixel that contains the vertex,
  /// as in the papers. With more, the centre of pixel (0, 0) is at (1/2, 1/2) pixel.
  int subpixel_bits = 4;
  /// Clips at all four sides of the frame, not only where a coordinate would leave the guard band.
  bool clip_to_frame = false;
};

/// Ranges of depth in front of the eye.
enum class DepthSlice {
  visible,      ///< between the near and the far plane
  before_near,  ///< from c_least_near of the near distance to the near plane; drawn with depth 0
};
inline constexpr double c_least_near = 1.0 / 1024.0;

/// Number of the scene's triangles that are visible, and the reasons why the others are not.
struct ProjectionCounts {
  std::uint64_t visible = 0;      ///< scene triangles with at least one screen triangle
  std::uint64_t back_facing = 0;  ///< seen from behind, and not drawn from there
  std::uint64_t left_out = 0;     ///< those of them that may be in view: Culling::back
  std::uint64_t behind_near = 0;  ///< entirely in front of the near plane
  std::uint64_t cut_by_near = 0;  ///< a part between eye and near plane would be in the frame
  std::uint64_t outside = 0;      ///< beyond the far plane or outside the frame
  std::uint64_t degenerate = 0;   ///< zero area or reversed orientation after snapping
  /// Not finite; or too far away for an accurate cut (1e100 pixels, or 1e13 near distances if two corners are
  /// that far away); or camera or options are invalid. The scene is at fault.
  std::uint64_t unrepresentable = 0;

  ProjectionCounts& operator+=(const ProjectionCounts& other);
};

/// Names a corner of the scene's triangles: a position with a normal.
struct VertexKey {
  std::uint32_t position = std::numeric_limits<std::uint32_t>::max(), normal = position;
  std::size_t hash() const { return position ^ (std::size_t{normal} << 5); }
  friend auto operator<=>(const VertexKey&, const VertexKey&) = default;
};

/// The key of a corner, 0 to 2.
inline VertexKey vertex_key(const SceneTriangle& triangle, std::size_t corner) {
  return {triangle.position[corner], triangle.normal[corner]};
}

/// A corner in homogeneous coordinates and on the screen.
struct ProjectedVertex {
  double x, y, w;
  bool is_inside;       ///< of all planes: not clipped
  ScreenVertex screen;  ///< if it is inside
};

/// Projects triangle by triangle. A vertex or part of an edge that two triangles share has the same screen
/// coordinates in both. A closed mesh therefore has neither gaps nor double pixels along its edges.
class Projector {
 public:
  /// The scene must outlive the projector. Width and height: 1 to 4096.
  Projector(const Scene& scene, FrameSize frame, ProjectionOptions options);

  /// Appends the visible part of the triangle: nothing, one screen triangle, or the fan of a clipped polygon.
  void project(std::uint32_t triangle, std::vector<ScreenTriangle>& out, ProjectionCounts& counts) const;
  void project(std::uint32_t triangle, std::vector<ScreenTriangle>& out) const;

  /// A part of the frame that contains every pixel of the visible part of the triangle, and of any piece cut
  /// at the midpoints of its edges, rounded to whole pixels or not. Empty if nothing is visible.
  Tile reach(std::uint32_t triangle) const;

  /// Appends the part inside the slice of any triangle, whichever side it shows. It need not be a triangle of
  /// the scene. The pieces have number `source`, material 0 and no normals. Parts shared with other triangles
  /// have the same coordinates and depths.
  void project_two_sided(const std::array<glm::dvec3, 3>& corners_world, std::uint32_t source,
                         DepthSlice slice, std::vector<TwoSidedTriangle>& out,
                         ProjectionCounts& counts) const;

  /// Projects all triangles in the scene's order.
  std::vector<ScreenTriangle> project_all(ProjectionCounts* counts = nullptr) const;

  const ProjectionOptions& options() const { return options_; }
  FrameSize frame() const { return frame_; }
  /// That of the camera and the scene's bounding sphere. But where a fitted near plane would cut surfaces in
  /// view, near is just before the nearest of them, and at least `c_least_near_part` of far.
  const DepthRange& range() const { return depth_range_; }

 private:
  friend class MeshProjector;
  /// Homogeneous screen space: pixels are (x/w, y/w), w is the distance along the viewing axis.
  struct ClipVertex {
    double x, y, w;
    glm::dvec3 position_world, normal_world;
    double magnitude() const { return std::max({std::abs(x), std::abs(y), std::abs(w)}); }
  };
  /// x*X + y*Y + w*W + constant, >= 0 inside.
  struct Plane {
    double x, y, w, constant;
    double distance(const ClipVertex& v) const { return x * v.x + y * v.y + w * v.w + constant; }
  };

  ClipVertex transform(glm::dvec3 position_world, glm::dvec3 normal_world) const;
  static ClipVertex intersect(const ClipVertex& a, const ClipVertex& b, const Plane& plane);
  /// Returns false if the whole polygon is inside.
  static bool clip(std::vector<ClipVertex>& polygon, std::vector<ClipVertex>& scratch, const Plane& plane);
  bool is_representable(const ClipVertex& v) const;
  /// True if no plane clips the vertex.
  bool is_inside(const ClipVertex& v) const;
  ProjectedVertex project_vertex(const VertexKey& vertex) const;
  double nearest_in_frame(std::span<const ClipVertex> corners, double limit) const;
  void fit_near();
  bool is_outside_frame(std::span<const ScreenVertex> corners) const;
  /// Turns a piece of a triangle that is drawn from both sides to the eye.
  void turn_to_eye(ScreenTriangle& piece, bool faces_away) const;
  static void count_hidden(const SceneTriangle& triangle, bool faces_away, ProjectionCounts& counts);
  /// The polygon's corners on the screen, in its order. Empty if it is outside the frame or the slice; the
  /// counts then include it.
  std::vector<ScreenVertex> clip_and_snap(std::vector<ClipVertex>& polygon, const DepthRange& slice,
                                          ProjectionCounts& counts) const;
  ScreenVertex snap(const ClipVertex& v, double near) const;
  double depth(double w) const;

  const Scene* scene_;
  FrameSize frame_;
  ProjectionOptions options_;
  glm::dvec3 eye_world_;
  ViewBasis basis_;
  DepthRange depth_range_;
  double focal_pixels_;
  bool usable_;                                ///< camera and options are valid
  std::array<Plane, 4> planes_;                ///< left, right, top, bottom
  std::array<std::int32_t, 4> snapped_range_;  ///< least and greatest x, least and greatest y, in subpixels
};

/// Projects the triangles of a mesh for one thread. It keeps projected vertices, because the next triangles
/// share most of them. The result is that of Projector::project.
class MeshProjector {
 public:
  /// The projector must outlive it.
  explicit MeshProjector(const Projector& projector) : projector_(projector) {}
  /// The visible part of the triangle, valid until the next call.
  std::span<const ScreenTriangle> project(std::uint32_t triangle, ProjectionCounts& counts);

 private:
  const Projector& projector_;
  RecentValues<VertexKey, ProjectedVertex, 1024> vertices_;
  std::vector<ScreenTriangle> pieces_;
};

/// Weights of the triangle's vertices at a point of the screen, from the snapped coordinates. Exact up to the
/// last division; their sum is one up to rounding. The point is in 1/2^(subpixel_bits+1) of a pixel: the
/// centre of pixel (x, y) is ((2x+1) << subpixel_bits, (2y+1) << subpixel_bits), and the midpoint of an edge
/// is the sum of its ends.
glm::dvec3 barycentric_screen(const ScreenTriangle& triangle, std::int64_t x_half, std::int64_t y_half);

/// The same at the centre of a pixel. The triangle's coordinates are in 1/2^subpixel_bits of a pixel.
glm::dvec3 barycentric_at_centre(const ScreenTriangle& triangle, int subpixel_bits, std::int64_t x,
                                 std::int64_t y);

/// The same at a vertex, 0 to 2.
inline glm::dvec3 barycentric_at_vertex(std::size_t vertex) {
  return {vertex == 0, vertex == 1, vertex == 2};
}

struct SurfacePoint {
  glm::dvec3 position_world;
  glm::dvec3 normal_world;  ///< always unit
  double z, inverse_w;      ///< as in ScreenVertex
  double normal_length;  ///< of the interpolated normal; 0 if that is zero: the normal is the triangle's own
  bool is_smooth() const { return normal_length > 0.0; }
};

/// The surface at a point of the screen, perspective-correct. If the interpolated normal is zero (opposite
/// vertex normals), the triangle's own normal is used.
SurfacePoint surface_point(const ScreenTriangle& triangle, glm::dvec3 barycentric_screen);

}  // namespace halfway
