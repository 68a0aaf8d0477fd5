// SPDX-License-Identifier: Apache-2.0
#include "reference/renderer.hpp"

#include <array>
#include <limits>
#include <memory>

#include "projection/project.hpp"
#include "reference/ray_cast.hpp"
#include "reference/visible_pixels.hpp"
#include "shading/shade.hpp"

namespace halfway {

ReferenceImage render_reference(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                const RenderOptions& options) {
  const auto shadow_rays = scene.shadows ? std::make_unique<ShadowRays>(scene) : nullptr;
  return render_visible(scene, triangles, options, [&] {
    return [&](std::uint32_t index, std::uint32_t x, std::uint32_t y) {
      const ScreenTriangle& triangle = triangles[index];
      const SurfacePoint point =
          surface_point(triangle, barycentric_at_centre(triangle, options.subpixel_bits, x, y));
      const auto reaches = [&](LightRef light) {
        return shadow_rays->reaches(light, point.position_world, triangle.source, triangle.is_back);
      };
      return radiance(scene, scene.materials[triangle.material], point.position_world, point.normal_world,
                      shadow_rays ? LightFilter(reaches) : LightFilter());
    };
  });
}

ReferenceImage render_gouraud(const Scene& scene, std::span<const ScreenTriangle> triangles,
                              const RenderOptions& options) {
  return render_visible(scene, triangles, options, [&] {
    constexpr std::uint32_t c_none = std::numeric_limits<std::uint32_t>::max();
    // Keep the vertices of the last triangle: a span uses them for each pixel.
    return [&, last = c_none, at_vertex = std::array<glm::dvec3, 3>{}](std::uint32_t index, std::uint32_t x,
                                                                       std::uint32_t y) mutable {
      const ScreenTriangle& triangle = triangles[index];
      if (index != last) {
        for (std::size_t i = 0; i < 3; ++i) {
          const SurfacePoint point = surface_point(triangle, barycentric_at_vertex(i));
          at_vertex[i] =
              radiance(scene, scene.materials[triangle.material], point.position_world, point.normal_world);
        }
        last = index;
      }
      const glm::dvec3 weights = barycentric_at_centre(triangle, options.subpixel_bits, x, y);
      return weights.x * at_vertex[0] + weights.y * at_vertex[1] + weights.z * at_vertex[2];
    };
  });
}

}  // namespace halfway
