// SPDX-License-Identifier: Apache-2.0
// Figure 15 of the spherical paper: tables of 4 address and 4 data bits leave rings around highlights on
// coarse spheres, tables of 6 and 6 do not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "frame/assemble.hpp"
#include "plan/plan.hpp"
#include "reference/spherical_renderer.hpp"
#include "run/scene_stream.hpp"
#include "scene/load_scene.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_frame{640, 480};

Frame published_frame(const Scene& scene, TableSize tables) {
  const auto plan = plan_scene(scene, {Shader::spherical, Preset::published, tables});
  if (!plan) throw std::runtime_error(plan.error().message);
  const auto setup = make_setup(scene, c_frame, plan->key, {});
  SceneStream stream(*setup, plan->key, 2);
  FrameAssembler assembler(c_frame, scene.background);
  for (Batch batch; stream.next(batch);)
    if (const Status status = assembler.add(batch.golden); !status)
      throw std::runtime_error(status.error().message);
  return assembler.frame();
}

// In discs around the three spheres' highlights, inside every bell: no ghost of the wrapping angle gets
// there.
struct Rings {
  int largest_step = 0;   // between neighbours on a line
  int largest_error = 0;  // against the same interpolation without tables
  double rms_error = 0.0;
  int levels = 0;  // different values on the lines through the highlights' centres
};

int blue(const Frame& frame, int x, int y) {
  return frame.rgb[frame.offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) + 2];
}

Rings measure(const Frame& frame, const Frame& without_tables) {
  constexpr int c_spheres = 3, c_radius = 40, c_third = static_cast<int>(c_frame.width) / c_spheres;
  Rings rings;
  double squares = 0.0;
  int count = 0;
  for (int sphere = 0; sphere < c_spheres; ++sphere) {
    int peak_x = 0, peak_y = 0;
    for (int y = c_radius; y < static_cast<int>(c_frame.height) - c_radius; ++y)
      for (int x = sphere * c_third + c_radius; x < (sphere + 1) * c_third - c_radius; ++x)
        if (blue(without_tables, x, y) > blue(without_tables, peak_x, peak_y) || peak_x == 0)
          peak_x = x, peak_y = y;
    std::set<int> levels;
    for (int dy = -c_radius; dy <= c_radius; ++dy) {
      const int y = peak_y + dy, half = static_cast<int>(std::sqrt(c_radius * c_radius - dy * dy));
      for (int x = peak_x - half; x <= peak_x + half; ++x) {
        rings.largest_step =
            std::max(rings.largest_step, std::abs(blue(frame, x + 1, y) - blue(frame, x, y)));
        const int error = std::abs(blue(frame, x, y) - blue(without_tables, x, y));
        rings.largest_error = std::max(rings.largest_error, error);
        squares += error * error;
        ++count;
        if (dy == 0) levels.insert(blue(frame, x, y));
      }
    }
    rings.levels += static_cast<int>(levels.size());
  }
  rings.rms_error = std::sqrt(squares / count);
  return rings;
}

TEST(Figure15, RingsOfFourBitsAreGoneAtSix) {
  const auto scene = load_scene("highlights", std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "scenes");
  ASSERT_TRUE(scene) << scene.error().message;
  const std::vector<ScreenTriangle> triangles =
      Projector(*scene, c_frame, {.subpixel_bits = 4}).project_all();
  const Frame without_tables =
      render_spherical(*scene, triangles, {.frame = c_frame, .subpixel_bits = 4, .threads = 2},
                       {.ends = SpanEnds::slerped_along_edges, .curve = HighlightCurve::squared_cosine})
          .frame;
  const Rings none = measure(without_tables, without_tables);
  const Rings four = measure(published_frame(*scene, {4, 4}), without_tables);
  const Rings six = measure(published_frame(*scene, {6, 6}), without_tables);
  const auto show = [](const char* name, const Rings& r) {
    fmt::print(
        "{:<14} largest step between neighbours {:>2}/255, largest error {:>2}/255, rms {:.2f}, {} levels\n",
        name, r.largest_step, r.largest_error, r.rms_error, r.levels);
  };
  show("no tables", none);
  show("4 bits", four);
  show("6 bits", six);
  EXPECT_GT(four.largest_step, 2 * six.largest_step);
  EXPECT_LT(six.largest_step, 16);
  EXPECT_GT(four.rms_error, 6.0);
  EXPECT_LT(six.rms_error, 2.5);
  EXPECT_LT(four.levels, 30);
  EXPECT_GT(six.levels, 100);
}

}  // namespace
}  // namespace halfway
