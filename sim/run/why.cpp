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

class Explainer {
 public:
  Explainer(const Scene& scene, const WhySettings& settings, const HardwareKey& key)
      : scene_(scene), s_(settings), key_(key), way_(key, settings.pixel) {
    report_.key = key;
  }

  WhyReport run() {
    compare_frame();
    const PixelSearch search = search_triangles();
    way_.draw_golden(search.found());
    if (way_.fragments() == 0) return report_;
    const auto rtl =
        trace_stages(key_, way_.stages(), s_.folders, {init_bits_, search.found().words()}, way_.fragments());
    if (report_.fault.empty()) report_.fault = rtl.fault;
    way_.compare(rtl.events);
    report_.stories = way_.stories();
    report_.first = way_.first();
    return report_;
  }

 private:
  // Compare the whole frame in Verilator, fragment by fragment.
  void compare_frame() {
    FrameDriver driver(scene_, s_.size, key_, {must(open_engine(EngineKind::verilator, key_, s_.folders))},
                       options(GoldenDraws::batches));
    must(driver.draw([&](const Batch& batch) {
      s_.on_progress(batch.done);
      return Status(Ok{});
    }));
    init_bits_ = driver.init_bits();
    report_.fragments = driver.fragments();
    report_.in_view = triangles_in_view(driver.counts());
    const SimulatorRun run = driver.frame().result();
    report_.fault = run.fault;
    if (run.first.empty()) return;
    report_.frame_difference = run.first.front();
    // A fragment after the last golden one belongs to the last triangle.
    if (report_.fragments > 0) first_wrong_ = std::min(run.first.front().index, report_.fragments - 1);
  }

  // Choose the triangles that cover the pixel, and the one with the first fragment that differs.
  PixelSearch search_triangles() {
    PixelSearch search(key_, s_.pixel, first_wrong_);
    FrameDriver driver(scene_, s_.size, key_, {}, options(GoldenDraws::nothing));
    must(driver.draw([&](const Batch& batch) {
      search.add(batch.init_words);
      return Status(Ok{});
    }));
    return search;
  }

  FrameOptions options(GoldenDraws golden) const {
    return {.setup = s_.setup, .golden = golden, .workers = on_threads(s_.threads)};
  }

  const Scene& scene_;
  const WhySettings& s_;
  HardwareKey key_;
  unsigned init_bits_ = 0;
  PixelWay way_;
  WhyReport report_;
  std::uint64_t first_wrong_ = UINT64_MAX;  // fragment of the frame
};

}  // namespace

WhyReport explain_pixel(const Scene& scene, const WhySettings& settings) {
  return Explainer(scene, settings, must(plan_scene(scene, settings.plan)).key).run();
}

}  // namespace halfway
