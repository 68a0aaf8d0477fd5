// SPDX-License-Identifier: Apache-2.0
// Computes init vectors in a program of your own, for a grey quadratic_shader of preset exact. Prints one
// vector per line in hexadecimal, as build/halfway init writes them.
//
//   own_vectors scene    from a scene in world space
//   own_vectors screen   from triangles on the screen and six colours each
//
// Both print the same vectors: those of halfway init sim/report/timing.toml --size 16x12 --highlight-test
// none
#include <cstdio>
#include <string_view>
#include <vector>

#include "plan/plan.hpp"
#include "setup/quadratic_setup.hpp"
#include "setup/setup.hpp"
#include "setup/walk_header.hpp"
#include "shading/shade.hpp"
#include "words/init_vector.hpp"

namespace {

using namespace halfway;

constexpr FrameSize c_frame{16, 12};
constexpr int c_channels = 1;

/// Two triangles, one light.
Scene my_scene() {
  Scene scene;
  scene.camera.eye_world = {0.0, 0.0, 4.0};
  scene.camera.vertical_fov_degrees = 40.0;
  scene.directional = {
      {.to_light_world = glm::normalize(glm::dvec3(0.3, 0.4, 1.0)), .intensity = glm::dvec3(0.9)}};
  scene.materials = {{.colour = glm::dvec3(0.8), .diffuse = 0.7, .specular = 0.3, .exponent = 10.0}};
  scene.positions_world = {{-0.9, -0.8, 0.0}, {1.0, -0.6, 0.0}, {0.8, 0.9, 0.0}, {-0.7, 0.7, 0.0}};
  for (const glm::dvec3 normal : {glm::dvec3(-0.3, -0.3, 0.9), glm::dvec3(0.3, -0.3, 0.9),
                                  glm::dvec3(0.3, 0.3, 0.9), glm::dvec3(-0.3, 0.3, 0.9)})
    scene.normals_world.push_back(glm::normalize(normal));
  // Counter-clockwise seen from outside: positions, normals, material.
  scene.triangles = {{{0, 1, 2}, {0, 1, 2}, 0}, {{0, 2, 3}, {0, 2, 3}, 0}};
  return scene;
}

/// The project's set-up does everything: projection, six samples, splitting, fit.
std::vector<std::uint32_t> from_scene(const Scene& scene) {
  const HardwareKey key{.shader = Shader::quadratic, .preset = Preset::exact, .channels = c_channels};
  SetupOptions options;
  options.quadratic.test = HighlightTest::none;  // never split
  const auto setup = make_setup(scene, c_frame, key, options);
  std::vector<std::uint32_t> words;
  SetupCounts counts;
  setup->append_prologue(words, counts);
  setup->append_all(words, counts);
  return words;
}

/// Projection and illumination are yours; the project computes edges, depth and differences.
std::vector<std::uint32_t> from_screen(const Scene& scene) {
  constexpr int c_subpixel_bits = 4;
  std::vector<std::uint32_t> words;
  const Projector projector(scene, c_frame, {.subpixel_bits = c_subpixel_bits, .clip_to_frame = false});
  for (const ScreenTriangle& triangle : projector.project_all()) {
    // x and y in 1/16 pixel, y down; the triangle may leave the frame.
    const std::array<ScreenPoint, 3> points = screen_points(triangle);
    // Depth 0 to 2^24 - 1 with 15 fraction bits.
    const DepthFit depth(points, c_subpixel_bits, fixed_depths(triangle));
    // Colours in colour steps (255 is white): at vertices 1, 2, 3 and at the midpoints of edges 1-2, 1-3,
    // 2-3.
    ChannelSamples samples{};
    const glm::dvec3 barycentric[] = {{1, 0, 0},     {0, 1, 0},     {0, 0, 1},
                                      {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    for (std::size_t i = 0; i < 6; ++i) {
      const SurfacePoint point = surface_point(triangle, barycentric[i]);
      samples[0][i] =
          255.0 *
          radiance(scene, scene.materials[triangle.material], point.position_world, point.normal_world).r;
    }
    append_exact({words, c_channels}, {triangle.source, points, c_subpixel_bits,
                                       plan_walks(points, c_subpixel_bits, c_frame), depth, samples});
  }
  return words;
}

/// Print words of 32 bits, lowest first, as hexadecimal numbers of `bits` bits.
void print(const std::vector<std::uint32_t>& words, unsigned bits) {
  const std::size_t words_per_vector = (bits + 31) / 32, digits = (bits + 3) / 4;
  for (std::size_t at = 0; at < words.size(); at += words_per_vector) {
    for (std::size_t digit = digits; digit-- > 0;)
      std::putchar("0123456789abcdef"[words[at + digit / 8] >> (digit % 8 * 4) & 15]);
    std::putchar('\n');
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Scene scene = my_scene();
  const bool screen = argc > 1 && std::string_view(argv[1]) == "screen";
  print(screen ? from_screen(scene) : from_scene(scene),
        words::Exact::c_init_header_bits + c_channels * words::Exact::c_init_channel_bits);
}
