// SPDX-License-Identifier: Apache-2.0
// From the scene's triangles to triangles on the screen: perspective, clipping, snapping, culling.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "frame/tile.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"
#include "setup/edge.hpp"
#include "setup/screen_triangle.hpp"

namespace halfway {

/// Screen coordinates stay within [c_guard_begin, c_guard_end] pixels: with a frame of at most 4096x4096 a
/// coordinate difference is below 2^13 pixels, whatever the scene.
inline constexpr int c_guard_begin = -2048;
inline constexpr int c_guard_end = 6143;

inline constexpr int c_max_subpixel_bits = 9;

struct ProjectionOptions {
  /// Fraction bits of a screen coordinate, 0 to 9. With 0 a vertex is a pixel: (x, y) names the pixel it
  /// falls in, as the papers have it. With more, pixel (0, 0)'s centre lies at half a pixel.
  int subpixel_bits = 4;
  /// Cut at the frame's four sides, and not only where a coordinate would leave the guard band.
  bool clip_to_frame = false;
};

/// Slices of the space before the eye.
enum class DepthSlice {
  visible,      ///< between the near and the far plane
  before_near,  ///< down to c_least_near of the near distance; drawn at depth 0
};
inline constexpr double c_least_near = 1.0 / 1024.0;

/// How many triangles of the scene came to the screen, and why the others did not.
struct ProjectionCounts {
  std::uint64_t visible = 0;      ///< scene triangles with at least one screen triangle
  std::uint64_t back_facing = 0;  ///< seen from behind
  std::uint64_t behind_near = 0;  ///< wholly nearer than the near plane
  std::uint64_t outside = 0;      ///< past the far plane or beside the frame
  std::uint64_t degenerate = 0;   ///< of no area, or turned over, once snapped
  /// Not finite, too far away to be cut where it should (1e100 pixels; 1e13 near distances where two corners
  /// are out there), or camera and options make no sense: the scene is at fault.
  std::uint64_t unrepresentable = 0;

  ProjectionCounts& operator+=(const ProjectionCounts& other);
};

/// Projects triangle by triangle. What two triangles share, a vertex or a piece of an edge, comes out with
/// the same screen coordinates, so that a closed mesh has neither gaps nor double pixels along its edges.
class Projector {
 public:
  /// The scene must outlive the projector. Width and height 1 to 4096.
  Projector(const Scene& scene, FrameSize frame, ProjectionOptions options);

  /// Appends what is seen of the triangle: nothing, one screen triangle, or the fan of a clipped polygon.
  void project(std::uint32_t triangle, std::vector<ScreenTriangle>& out, ProjectionCounts& counts) const;
  void project(std::uint32_t triangle, std::vector<ScreenTriangle>& out) const;

  /// A part of the frame that holds every pixel of what is seen of the triangle, and of any piece that its
  /// edges' midpoints cut off, rounded to whole pixels or not; empty where nothing is seen.
  Tile reach(std::uint32_t triangle) const;

  /// Appends what lies in the slice of a triangle that need not be the scene's, whichever way it faces:
  /// pieces numbered `source`, of material 0, without normals. What it shares with others comes out with the
  /// same coordinates and depths.
  void project_two_sided(const std::array<glm::dvec3, 3>& corners_world, std::uint32_t source,
                         DepthSlice slice, std::vector<TwoSidedTriangle>& out,
                         ProjectionCounts& counts) const;

  /// All triangles in the scene's order.
  std::vector<ScreenTriangle> project_all(ProjectionCounts* counts = nullptr) const;

  const ProjectionOptions& options() const { return options_; }
  FrameSize frame() const { return frame_; }

 private:
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
  /// False if all of it is inside.
  static bool clip(std::vector<ClipVertex>& polygon, std::vector<ClipVertex>& scratch, const Plane& plane);
  bool is_representable(const ClipVertex& v) const;
  /// The polygon's corners on the screen, in its order: none where it is beside the frame or the slice, which
  /// is then counted.
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
  bool usable_;                                ///< camera and options make sense
  std::array<Plane, 4> planes_;                ///< left, right, top, bottom
  std::array<std::int32_t, 4> snapped_range_;  ///< least and greatest x, least and greatest y, in subpixels
};

/// Weights of the triangle's vertices at a point of the screen, from the snapped coordinates, exact up to the
/// last division; they sum to one up to rounding. The point is in 1/2^(subpixel_bits+1) of a pixel, so that
/// the centre of pixel (x, y) is ((2x+1) << subpixel_bits, (2y+1) << subpixel_bits) and an edge midpoint is
/// the sum of its ends.
glm::dvec3 barycentric_screen(const ScreenTriangle& triangle, std::int64_t x_half, std::int64_t y_half);

struct SurfacePoint {
  glm::dvec3 position_world;
  glm::dvec3 normal_world;  ///< unit, always
  double z;                 ///< as ScreenVertex::z
};

/// The surface behind a point of the screen, perspective-correct. Where the interpolated normal vanishes
/// (opposed vertex normals) the triangle's own normal takes its place.
SurfacePoint surface_point(const ScreenTriangle& triangle, glm::dvec3 barycentric_screen);

}  // namespace halfway
