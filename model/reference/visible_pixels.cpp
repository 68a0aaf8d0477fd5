// SPDX-License-Identifier: Apache-2.0
#include "reference/visible_pixels.hpp"

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "projection/edge.hpp"
#include "projection/project.hpp"

namespace halfway {
namespace {

// Lines for which one thread stores the visibility: few enough for its cache at 4096 pixels per line.
constexpr std::uint32_t c_band_lines = 16;
constexpr std::uint32_t c_nothing = std::numeric_limits<std::uint32_t>::max();

/// Bands of the tile that a triangle may cover; none if first > last.
struct BandRange {
  std::uint16_t first = 1, last = 0;
};

BandRange bands_touched(const ScreenTriangle& triangle, const Tile& tile, int subpixel_bits) {
  const auto [top, bottom] = std::minmax({triangle.vertex[0].y, triangle.vertex[1].y, triangle.vertex[2].y});
  const std::int64_t first = std::max<std::int64_t>(first_line(top, subpixel_bits) - tile.y, 0);
  const std::int64_t last =
      std::min<std::int64_t>(first_line(bottom, subpixel_bits) - tile.y, tile.size.height) - 1;
  if (first > last) return {};
  return {static_cast<std::uint16_t>(first / c_band_lines), static_cast<std::uint16_t>(last / c_band_lines)};
}

/// The visible triangle at each pixel of a band, and its depth if the triangle is not c_nothing.
struct Visibility {
  std::vector<double> z;
  std::vector<std::uint32_t> triangle;
};

void find_visible(std::span<const ScreenTriangle> triangles, std::span<const BandRange> ranges,
                  std::uint32_t band, const Tile& tile, int subpixel_bits, Visibility& visible) {
  const std::uint32_t begin = tile.y + band * c_band_lines;
  const std::uint32_t right = tile.x + tile.size.width;
  const FrameSize lines{right, std::min(c_band_lines, tile.y + tile.size.height - begin)};
  std::fill(visible.triangle.begin(), visible.triangle.end(), c_nothing);
  const std::int32_t shift = static_cast<std::int32_t>(begin) << subpixel_bits;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (band < ranges[i].first || band > ranges[i].last) continue;
    const ScreenTriangle& t = triangles[i];
    const auto in_band = [&](const ScreenVertex& v) { return ScreenPoint{v.x, v.y - shift}; };
    const glm::dvec3 z{t.vertex[0].z, t.vertex[1].z, t.vertex[2].z};
    for_each_span({in_band(t.vertex[0]), in_band(t.vertex[1]), in_band(t.vertex[2])}, subpixel_bits, lines,
                  [&](std::uint32_t line, std::uint32_t x_begin, std::uint32_t x_end) {
                    for (std::uint32_t x = std::max(x_begin, tile.x); x < x_end; ++x) {
                      const double here =
                          glm::dot(barycentric_at_centre(t, subpixel_bits, x, begin + line), z);
                      const std::size_t pixel = std::size_t{line} * tile.size.width + x - tile.x;
                      if (visible.triangle[pixel] != c_nothing && !(here < visible.z[pixel])) continue;
                      visible.z[pixel] = here;
                      visible.triangle[pixel] = i;
                    }
                  });
  }
}

}  // namespace

ReferenceImage render_visible(const Scene& scene, std::span<const ScreenTriangle> triangles,
                              const RenderOptions& options, const std::function<PixelShader()>& make_shader) {
  const Tile tile = options.tile.value_or(whole_frame(options.frame));
  const std::uint32_t width = tile.size.width, height = tile.size.height;
  ReferenceImage image{Frame(tile.size), std::vector<std::uint8_t>(Frame::pixels(tile.size))};
  const std::uint32_t bands = (height + c_band_lines - 1) / c_band_lines;
  std::vector<BandRange> ranges(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    ranges[i] = bands_touched(triangles[i], tile, options.subpixel_bits);

  std::atomic<std::uint32_t> next_band{0};
  const auto work = [&] {
    const std::size_t pixels = std::size_t{c_band_lines} * width;
    Visibility visible{std::vector<double>(pixels), std::vector<std::uint32_t>(pixels)};
    for (std::uint32_t band = next_band++; band < bands; band = next_band++) {
      find_visible(triangles, ranges, band, tile, options.subpixel_bits, visible);
      const PixelShader shader = make_shader();
      const std::uint32_t begin = band * c_band_lines;
      const std::uint32_t end = std::min(begin + c_band_lines, height);
      for (std::uint32_t y = begin; y < end; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
          const std::uint32_t index = visible.triangle[std::size_t{y - begin} * width + x];
          const glm::dvec3 colour =
              index == c_nothing ? scene.background : shader(index, tile.x + x, tile.y + y);
          const std::size_t rgb = image.frame.offset(x, y);
          for (int channel = 0; channel < 3; ++channel)
            image.frame.rgb[rgb + channel] = to_byte(colour[channel]);
          image.mask[rgb / 3] = index != c_nothing;
        }
    }
  };
  options.workers.run(bands, work);
  return image;
}

}  // namespace halfway
