// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live_core/way_lines.hpp"

#include <fmt/format.h>

namespace halfway::live {
namespace {

std::string lines_of_given(const char* what, const std::vector<StageValue>& values) {
  if (values.empty()) return {};
  std::string lines = fmt::format("given\t{}\n", what);
  for (const StageValue& v : values) lines += fmt::format("value\t{}\t{}\n", v.name, text_of(v.golden, v));
  return lines;
}

std::string lines_of_stage(const StageState& stage) {
  std::string lines =
      fmt::format("stage\t{}\t{}\n", stage.stage, stage.cycle ? std::to_string(*stage.cycle) : "");
  for (const StageValue& v : stage.values)
    lines += fmt::format("value\t{}\t{}\t{}\t{}\n", v.name, text_of(v.golden, v),
                         v.rtl ? text_of(*v.rtl, v) : "-", v.golden == v.rtl ? "equal" : "differs");
  return lines;
}

}  // namespace

std::string lines_of(const Way& way) {
  std::string lines;
  for (const PixelStory& story : way.stories) {
    lines += fmt::format("triangle\t{}\t{}\n", story.triangle, story.vector);
    lines += lines_of_given("init vector", story.init) + lines_of_given("line's record", story.record);
    for (const StageState& stage : story.stages) lines += lines_of_stage(stage);
  }
  if (way.first) lines += fmt::format("first\t{}\n", way.first->text());
  if (!way.fault.empty()) lines += fmt::format("fault\t{}\n", way.fault);
  return lines;
}

}  // namespace halfway::live
