// SPDX-License-Identifier: Apache-2.0
// Figure 15 of the spherical paper: tables of 4 address and 4 data bits leave rings around highlights on
// coarse spheres, tables of 6 and 6 do not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "frame/assemble.hpp"
#include "plan/plan.hpp"
#include "reference/spherical_renderer.hpp"
#include "sim/figures/rings.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/threads.hpp"

namespace halfway {
namespace {

using figures::Rings;

constexpr FrameSize c_frame = figures::c_rings_frame;

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

TEST(Figure15, RingsOfFourBitsAreGoneAtSix) {
  const auto scene = load_scene("highlights", std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "scenes");
  ASSERT_TRUE(scene) << scene.error().message;
  const std::vector<ScreenTriangle> triangles =
      Projector(*scene, c_frame, {.subpixel_bits = 4}).project_all();
  const Frame without_tables =
      render_spherical(*scene, triangles, {.frame = c_frame, .subpixel_bits = 4, .workers = on_threads(2)},
                       {.ends = SpanEnds::slerped_along_edges, .curve = HighlightCurve::squared_cosine})
          .frame;
  const Rings none = figures::measure_rings(without_tables, without_tables);
  const Rings four = figures::measure_rings(published_frame(*scene, {4, 4}), without_tables);
  const Rings six = figures::measure_rings(published_frame(*scene, {6, 6}), without_tables);
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
