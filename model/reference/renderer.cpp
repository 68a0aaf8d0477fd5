// SPDX-License-Identifier: Apache-2.0
#include "reference/renderer.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>
#include <memory>

#include "projection/project.hpp"
#include "reference/ray_cast.hpp"
#include "reference/visible_pixels.hpp"
#include "shading/shade.hpp"

namespace halfway {

namespace {

// Shades a triangle at the centre of a pixel, in 1/2^subpixel_bits pixels.
class ReferenceShader {
 public:
  ReferenceShader(const Scene& scene, std::span<const ScreenTriangle> triangles)
      : scene_(scene),
        triangles_(triangles),
        shadow_rays_(scene.shadows ? std::make_unique<ShadowRays>(scene) : nullptr) {}

  glm::dvec3 shade(std::uint32_t index, int subpixel_bits, std::uint32_t x, std::uint32_t y) const {
    const ScreenTriangle& triangle = triangles_[index];
    const SurfacePoint point = surface_point(triangle, barycentric_at_centre(triangle, subpixel_bits, x, y));
    const auto reaches = [&](LightRef light) {
      return shadow_rays_->reaches(light, point.position_world, triangle.source, triangle.is_back);
    };
    return radiance(scene_, scene_.materials[triangle.material], point.position_world, point.normal_world,
                    shadow_rays_ ? LightFilter(reaches) : LightFilter());
  }

 private:
  const Scene& scene_;
  std::span<const ScreenTriangle> triangles_;
  std::unique_ptr<ShadowRays> shadow_rays_;
};

constexpr std::uint32_t c_side = 4;  // samples per row of a pixel
constexpr int c_side_bits = 2;

// The samples of a pixel that triangles cover.
struct Samples {
  glm::dvec3 sum{0.0};
  std::uint32_t covered = 0;
};

}  // namespace

ReferenceImage render_reference(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                const RenderOptions& options) {
  const ReferenceShader shader(scene, triangles);
  return render_visible(scene, triangles, options, [&] {
    return [&](std::uint32_t index, std::uint32_t x, std::uint32_t y) {
      return shader.shade(index, options.subpixel_bits, x, y);
    };
  });
}

ReferenceImage render_filtered(const Scene& scene, std::span<const ScreenTriangle> triangles,
                               const RenderOptions& options, const std::array<std::int64_t, 4>& weights) {
  // Lines of pixels at a time. Each thread draws whole lines of pixels of them: 16 lines of samples.
  constexpr std::uint32_t c_lines = 32;
  const std::uint32_t width = options.frame.width, height = options.frame.height;
  const ReferenceShader shader(scene, triangles);
  RenderOptions finer = options;
  finer.frame = {c_side * width, c_side * height};
  finer.subpixel_bits = options.subpixel_bits - c_side_bits;

  // The line above the first one, and these lines, each after an empty pixel.
  const std::size_t pitch = width + 1;
  std::vector<Samples> pixels((c_lines + 1) * pitch);
  const auto samples =
      static_cast<double>(c_side * c_side * (weights[0] + weights[1] + weights[2] + weights[3]));
  ReferenceImage image{Frame(options.frame), std::vector<std::uint8_t>(Frame::pixels(options.frame))};
  for (std::uint32_t top = 0; top < height; top += c_lines) {
    const std::uint32_t lines = std::min(c_lines, height - top);
    std::copy(pixels.end() - static_cast<std::ptrdiff_t>(pitch), pixels.end(), pixels.begin());
    std::fill(pixels.begin() + static_cast<std::ptrdiff_t>(pitch), pixels.end(), Samples{});
    finer.tile = Tile{0, c_side * top, {c_side * width, c_side * lines}};
    render_visible(scene, triangles, finer, [&] {
      return [&](std::uint32_t index, std::uint32_t x, std::uint32_t y) {
        const glm::dvec3 colour = shader.shade(index, finer.subpixel_bits, x, y);
        Samples& pixel = pixels[(y / c_side - top + 1) * pitch + x / c_side + 1];
        pixel.sum += glm::clamp(colour, 0.0, 1.0);
        ++pixel.covered;
        return colour;
      };
    });
    for (std::uint32_t y = 0; y < lines; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const std::size_t here = (y + 1) * pitch + x + 1;
        const std::array<std::size_t, 4> support = {here, here - 1, here - pitch, here - pitch - 1};
        glm::dvec3 colour(0.0);
        std::uint32_t covered = 0;
        for (std::size_t i = 0; i < support.size(); ++i) {
          const Samples& pixel = pixels[support[i]];
          const auto rest = static_cast<double>(c_side * c_side - pixel.covered);
          colour +=
              static_cast<double>(weights[i]) * (pixel.sum + rest * glm::clamp(scene.background, 0.0, 1.0));
          if (weights[i] > 0) covered += pixel.covered;
        }
        const std::size_t rgb = image.frame.offset(x, top + y);
        for (int channel = 0; channel < 3; ++channel)
          image.frame.rgb[rgb + static_cast<std::size_t>(channel)] = to_byte(colour[channel] / samples);
        image.mask[rgb / 3] = covered != 0;
      }
  }
  return image;
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
