// SPDX-License-Identifier: Apache-2.0
// `halfway why`: one pixel stage by stage, golden model and RTL side by side.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "sim/cli/options.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/run/simulate.hpp"
#include "sim/run/why.hpp"

namespace halfway::cli {
namespace {

struct WhyCommand {
  DrawOptions draw;
  std::string scene;
  std::string pixel;
};

std::optional<FramePixel> parse_pixel(std::string_view text) {
  std::uint32_t x = 0, y = 0;
  const char* const end = text.data() + text.size();
  const auto [comma, x_error] = std::from_chars(text.data(), end, x);
  if (x_error != std::errc{} || comma == end || *comma != ',') return std::nullopt;
  const auto [rest, y_error] = std::from_chars(comma + 1, end, y);
  if (y_error != std::errc{} || rest != end) return std::nullopt;
  return FramePixel{x, y};
}

// Widths of the columns: the longest name and the longest golden word.
struct Widths {
  std::size_t name = 0, golden = 0;

  void take(const std::vector<StageValue>& values) {
    for (const StageValue& v : values) {
      name = std::max(name, v.name.size());
      golden = std::max(golden, text_of(v.golden, v).size());
    }
  }
};

Widths widths_of(const WhyReport& why) {
  Widths widths;
  for (const PixelStory& story : why.stories) {
    widths.take(story.init);
    widths.take(story.record);
    for (const StageState& stage : story.stages) widths.take(stage.values);
  }
  return widths;
}

void print_given(const std::string& what, const std::vector<StageValue>& values, const Widths& widths) {
  if (values.empty()) return;
  fmt::print("  {} (given to both)\n", what);
  for (const StageValue& v : values) fmt::print("    {:<{}} {}\n", v.name, widths.name, text_of(v.golden, v));
}

void print_stage(const StageState& stage, const Widths& widths) {
  if (stage.cycle)
    fmt::print("  {} stage, cycle {}\n", stage.stage, *stage.cycle);
  else
    fmt::print("  {} stage: the RTL never came here\n", stage.stage);
  for (const StageValue& v : stage.values) {
    fmt::print("    {:<{}} golden {:<{}} RTL {}{}\n", v.name, widths.name, text_of(v.golden, v),
               widths.golden,
               !stage.cycle ? "-"
               : v.rtl      ? text_of(*v.rtl, v)
                            : "no number",
               v.golden == v.rtl ? "" : "   <-- differs");
  }
}

int run(const Folders& folders, const WhyCommand& command) {
  const auto draw = checked(command.draw);
  const auto pixel = parse_pixel(command.pixel);
  if (!pixel) throw_bad_input("--pixel: '{}' is not x,y, such as 120,45", command.pixel);
  if (pixel->x >= draw.size.width || pixel->y >= draw.size.height)
    throw_bad_input("--pixel: {} lies outside the frame of {}x{}", command.pixel, draw.size.width,
                    draw.size.height);
  const auto scene = must(load_scene(command.scene, folders.scenes()));
  if (must(plan_scene(scene, draw.plan)).key.processors.objects > 0)
    throw_bad_input("why explains pixels of the rasterizer; leave out --objects, and the shadows");
  Progress progress(scene.name);
  WhySettings settings{draw};
  settings.pixel = *pixel;
  settings.folders = {folders.source, folders.cache()};
  settings.on_progress = [&](double done) { progress.show(done); };
  const auto why = explain_pixel(scene, settings);
  progress.clear();

  fmt::print("{}: pixel {},{} of {}x{}, hardware {}: {} triangles cover it\n", scene.name, settings.pixel.x,
             settings.pixel.y, settings.size.width, settings.size.height, why.key.name(), why.stories.size());
  const Widths widths = widths_of(why);
  for (const PixelStory& story : why.stories) {
    fmt::print("\ntriangle {}, init vector {}\n", story.triangle, story.vector);
    print_given("init vector", story.init, widths);
    print_given("its line's record", story.record, widths);
    for (const StageState& stage : story.stages) print_stage(stage, widths);
  }
  if (!why.fault.empty()) fmt::print("\n{}\n", why.fault);
  if (why.first) {
    fmt::print("\nfirst difference in the frame: {}\n", why.first->text());
    return static_cast<int>(ExitCode::differs);
  }
  if (why.fragments == 0 && !why.frame_difference && why.fault.empty()) {
    const auto nothing = nothing_compared(why.fragments, why.in_view, 0);
    say(fmt::format("{}: {}", scene.name, nothing.value_or("nothing was compared: no triangle is in view")));
    return static_cast<int>(ExitCode::differs);
  }
  if (why.frame_difference)
    fmt::print(
        "\nin Verilator's frame the first fragment that differs is number {}; in GHDL golden model and RTL "
        "agree at "
        "every\nstage of its triangle: what differs is the netlist, or comes from triangles long before\n",
        why.frame_difference->index);
  else if (why.fault.empty())
    fmt::print(
        "\ngolden model and RTL agree at every stage of these triangles, as GHDL simulates them,\n"
        "and in every fragment of the frame, as Verilator does\n");
  return static_cast<int>(why.fault.empty() && !why.frame_difference ? ExitCode::equal : ExitCode::differs);
}

}  // namespace

void add_why(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub = app.add_subcommand("why", "show one pixel stage by stage, in golden model and RTL");
  auto command = std::make_shared<WhyCommand>();
  sub->add_option("scene", command->scene, "as for sim")->required();
  sub->add_option("--pixel", command->pixel, "x,y from the frame's top left")->required();
  command->draw.add_to(*sub);
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli
