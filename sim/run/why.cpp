// SPDX-License-Identifier: Apache-2.0
#include "sim/run/why.hpp"

#include <algorithm>

#include "sim/driver/frame_driver.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/simulate.hpp"
#include "sim/run/stage_trace.hpp"

namespace halfway {
namespace {

FrameOptions options_of(const WhySettings& s, GoldenDraws golden) {
  return {.setup = s.setup, .golden = golden, .workers = on_threads(s.threads)};
}

// Compare the whole frame in Verilator, fragment by fragment. Return the number of the first fragment that
// differs; UINT64_MAX if there is none.
std::uint64_t compare_frame(const Scene& scene, const WhySettings& s, WhyReport& report) {
  FrameDriver driver(scene, s.size, report.key,
                     {must(open_engine(EngineKind::verilator, report.key, s.folders))},
                     options_of(s, GoldenDraws::batches));
  must(driver.draw([&](const Batch& batch) {
    s.on_progress(batch.done);
    return Status(Ok{});
  }));
  report.fragments = driver.fragments();
  report.in_view = triangles_in_view(driver.counts());
  const SimulatorRun run = driver.frame().result();
  report.fault = run.fault;
  if (run.first.empty()) return UINT64_MAX;
  report.frame_difference = run.first.front();
  // A fragment after the last golden one belongs to the last triangle.
  return report.fragments > 0 ? std::min(run.first.front().index, report.fragments - 1) : UINT64_MAX;
}

}  // namespace

WhyReport explain_pixel(const Scene& scene, const WhySettings& s) {
  WhyReport report{.key = must(plan_scene(scene, s.plan)).key};
  // Choose the triangles that cover the pixel, and the one with the first fragment that differs.
  PixelSearch search(report.key, s.pixel, compare_frame(scene, s, report));
  FrameDriver driver(scene, s.size, report.key, {}, options_of(s, GoldenDraws::nothing));
  must(driver.draw([&](const Batch& batch) {
    search.add(batch.init_words);
    return Status(Ok{});
  }));
  PixelWay way(report.key, s.pixel);
  way.draw_golden(search.found());
  if (way.fragments() == 0) return report;
  const auto rtl = trace_stages(report.key, way.stages(), s.folders,
                                {driver.init_bits(), search.found().words()}, way.fragments());
  if (report.fault.empty()) report.fault = rtl.fault;
  way.compare(rtl.events);
  report.stories = way.stories();
  report.first = way.first();
  return report;
}

}  // namespace halfway
