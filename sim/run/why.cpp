// SPDX-License-Identifier: Apache-2.0
#include "sim/run/why.hpp"

#include <algorithm>
#include <memory>

#include "plan/plan.hpp"
#include "sim/os/must.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/rtl_frame.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/run/simulate.hpp"
#include "sim/run/stage_trace.hpp"

namespace halfway {
namespace {

class Explainer {
 public:
  Explainer(const Scene& scene, const WhySettings& settings, const HardwareKey& key)
      : scene_(scene),
        s_(settings),
        key_(key),
        setup_(make_setup(scene, settings.size, key, settings.setup)),
        way_(key, settings.pixel) {
    report_.key = key;
  }

  WhyReport run() {
    compare_frame();
    const PixelSearch search = search_triangles();
    way_.draw_golden(search.found());
    if (way_.fragments() == 0) return report_;
    const auto rtl = trace_stages(key_, way_.stages(), s_.folders,
                                  {setup_->init_bits(), search.found().words()}, way_.fragments());
    if (report_.fault.empty()) report_.fault = rtl.fault;
    way_.compare(rtl.events);
    report_.stories = way_.stories();
    report_.first = way_.first();
    return report_;
  }

 private:
  // Compare the whole frame in Verilator, fragment by fragment.
  void compare_frame() {
    RtlFrame rtl(must(open_engine(EngineKind::verilator, key_, s_.folders)), s_.size, scene_.background);
    SceneStream stream(*setup_, key_, s_.threads);
    for (Batch batch; rtl.alive() && stream.next(batch);) {
      s_.on_progress(batch.done);
      report_.fragments += batch.golden.size();
      must(rtl.add(batch.init_words, batch.golden));
    }
    must(rtl.finish());
    report_.in_view = triangles_in_view(stream.counts());
    const SimulatorRun run = rtl.result();
    report_.fault = run.fault;
    if (run.first.empty()) return;
    report_.frame_difference = run.first.front();
    // A fragment after the last golden one belongs to the last triangle.
    if (report_.fragments > 0) first_wrong_ = std::min(run.first.front().index, report_.fragments - 1);
  }

  // Choose the triangles that cover the pixel, and the one with the first fragment that differs.
  PixelSearch search_triangles() {
    PixelSearch search(key_, s_.pixel, first_wrong_);
    SceneStream stream(*setup_, key_, s_.threads, {.golden = false});
    for (Batch batch; stream.next(batch);) search.add(batch.init_words);
    return search;
  }

  const Scene& scene_;
  const WhySettings& s_;
  HardwareKey key_;
  std::unique_ptr<Setup> setup_;
  PixelWay way_;
  WhyReport report_;
  std::uint64_t first_wrong_ = UINT64_MAX;  // fragment of the frame
};

}  // namespace

WhyReport explain_pixel(const Scene& scene, const WhySettings& settings) {
  return Explainer(scene, settings, must(plan_scene(scene, settings.plan)).key).run();
}

}  // namespace halfway
