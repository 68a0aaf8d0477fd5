// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live_core/live_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "golden_run/golden_run.hpp"
#include "golden_run/walk_counts.hpp"
#include "projection/project.hpp"
#include "setup/spherical_setup.hpp"
#include "sim/driver/limits.hpp"

namespace halfway::live {
namespace {

constexpr unsigned c_most_unrolled_lights = 4;  // of shading processors in preset `exact`

/// A bright colour for a number; neighbours differ.
void paint(Fragment& fragment, std::uint32_t number) {
  const std::uint32_t mixed = (number + 1) * 2654435761U;
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>(96 + ((mixed >> shift) & 127)); };
  fragment.red = channel(24);
  fragment.green = channel(16);
  fragment.blue = channel(8);
}

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

Result<HardwareKey> planned_key(const Scene& scene, PlanRequest request) {
  const Result<Plan> plan = plan_scene(scene, request);
  if (!plan) return plan.error();
  if (request.shader != Shader::processors || request.preset == Preset::published ||
      plan->key.processors.lights() <= c_most_unrolled_lights)
    return plan->key;
  request.form = ProcessorForm::folded;
  const Result<Plan> folded = plan_scene(scene, request);
  if (!folded) return folded.error();
  return folded->key;
}

Status LiveFrame::load(std::string_view file, std::string_view text, double tessellation) {
  scene_.reset();
  key_.reset();
  bells_.reset();
  drawn_.reset();
  Result<Scene> scene = read_scene(file, text, tessellation);
  if (!scene) return scene.error();
  scene_.emplace(std::move(*scene));
  return Ok{};
}

Result<HardwareKey> LiveFrame::plan(const PlanRequest& request) {
  key_.reset();
  bells_.reset();
  drawn_.reset();
  if (!scene_) return bad_input("no scene is loaded");
  if (Status status = scene_->apply({}); !status) return status.error();
  const Result<HardwareKey> key = planned_key(scene_->scene(), request);
  if (key) key_ = *key;
  return key;
}

Status LiveFrame::check_planned() const {
  return scene_ && key_ ? Status(Ok{}) : bad_input("no hardware is planned for a scene");
}

// The bells are fitted once, because the camera does not change them. For other exponents than the scene's
// they are fitted to the tables that the hardware has.
SetupOptions LiveFrame::setup_options(const Settings& settings) {
  SetupOptions options;
  options.quadratic.threshold = options.spherical.threshold = settings.threshold;
  if (key_->shader != Shader::spherical || key_->preset != Preset::exact) return options;
  if (!bells_ || bells_factor_ != settings.exponent_factor) {
    const bool own = settings.exponent_factor == 1.0 || key_->spherical.powers == 0;
    bells_ = std::make_shared<const Bells>(
        fitted_bells(scene_->scene(), own ? c_all_powers : key_->spherical.powers));
    bells_factor_ = settings.exponent_factor;
  }
  options.spherical.bells = bells_;
  return options;
}

FrameDriver LiveFrame::driver_of(const Settings& settings, std::vector<std::shared_ptr<Engine>> engines,
                                 GoldenDraws golden) {
  FrameOptions options{.setup = setup_options(settings), .golden = golden};
  options.clocks = {.elapsed = now_, .processor = now_};
  return {scene_->scene(), settings.size(), *key_, std::move(engines), std::move(options)};
}

Status LiveFrame::draw(const Settings& settings, Engine& engine) {
  if (Status status = check_planned(); !status) return status;
  if (Status status = check(settings); !status) return status;
  if (Status status = scene_->apply(settings); !status) return status;

  // Empty the hardware after a frame that ended early.
  if (Status empty = engine.drain(c_most_surplus, [](std::span<const Fragment>) {});
      !empty && empty.error().code != ExitCode::differs)
    return empty;

  std::optional<WalkCounter> walk;
  if (has_walk_clocks(*key_)) walk.emplace(*key_);
  FrameDriver driver = driver_of(settings, {{std::shared_ptr<Engine>(), &engine}}, GoldenDraws::batches);
  const Status drawn = driver.draw([&](const Batch& batch) -> Status {
    if (walk) walk->add(batch.init_words);
    return Ok{};
  });
  if (!drawn) return drawn;
  RtlFrame& rtl = driver.frame();
  const SimulatorRun run = rtl.result();
  figures_ = {.fragments = run.fragments,
              .mismatches = run.mismatches,
              .words = driver.words(),
              .setup = driver.counts(),
              .seconds = driver.seconds()};
  if (walk) figures_.hardware_clocks = walk->counts().clocks();
  // A fragment after the last golden one belongs to the last triangle.
  first_wrong_ = UINT64_MAX;
  if (!run.first.empty() && driver.fragments() > 0)
    first_wrong_ = std::min(run.first.front().index, driver.fragments() - 1);
  hardware_ = rtl.assembler().frame();
  drawn_ = settings;
  reference_.reset();
  if (run.equal()) return Ok{};
  std::string message = run.fault;
  if (!message.empty()) message += '\n';
  if (run.mismatches != 0) message += rtl.comparator().describe("RTL");
  return Error{ExitCode::differs, message};
}

Status LiveFrame::draw_reference() {
  if (!drawn_) return bad_input("no frame is drawn");
  if (Status status = scene_->apply(*drawn_); !status) return status;
  const Scene& scene = scene_->scene();
  const FrameSize size = drawn_->size();
  reference_ = render_reference(scene, Projector(scene, size, {}).project_all(), {.frame = size});
  const auto error = frame_distance(*hardware_, reference_->frame, reference_->mask);
  if (!error) return error.error();
  figures_.error = *error;
  return Ok{};
}

Result<Frame> LiveFrame::picture(Picture kind) {
  if (!drawn_) return bad_input("no frame is drawn");
  if (kind == Picture::hardware) return *hardware_;
  if (kind == Picture::golden || kind == Picture::split) return draw_golden(kind);
  if (!reference_) return bad_input("the reference is not drawn");
  return kind == Picture::reference ? reference_->frame : difference_image(*hardware_, reference_->frame);
}

Result<Way> LiveFrame::way(FramePixel pixel, const Observe& observe) {
  if (!drawn_) return bad_input("no frame is drawn");
  if (Status status = scene_->apply(*drawn_); !status) return status.error();
  PixelSearch search(*key_, pixel, first_wrong_);
  FrameDriver driver = driver_of(*drawn_, {}, GoldenDraws::nothing);
  const Status made = driver.draw([&](const Batch& batch) -> Status {
    search.add(batch.init_words);
    return Ok{};
  });
  if (!made) return made.error();
  PixelWay way(*key_, pixel);
  way.draw_golden(search.found());
  if (way.fragments() == 0) return Way{};
  const auto observed = observe(search.found().words(), way.stages(), way.fragments() + c_most_surplus);
  if (!observed) return observed.error();
  way.compare(way.stages().read(observed->trace));
  return Way{way.stories(), way.first(), observed->fault};
}

Result<Frame> LiveFrame::draw_golden(Picture kind) {
  if (Status status = scene_->apply(*drawn_); !status) return status.error();
  const std::unique_ptr<GoldenModel> golden = make_golden_model(*key_);
  FrameAssembler assembler(drawn_->size(), scene_->scene().background);
  const bool by_strip = key_->processors.objects > 0;
  std::uint32_t header = 0;
  std::vector<Fragment> painted;
  FrameDriver driver = driver_of(*drawn_, {}, GoldenDraws::nothing);
  const Status made = driver.draw([&](const Batch& batch) -> Status {
    if (kind == Picture::golden) return assembler.add(golden->draw(batch.init_words));
    // Draw triangle by triangle, or strip by strip.
    for (std::span<const std::uint32_t> words = batch.init_words; !words.empty(); ++header) {
      const auto drawn = golden->draw_next(words, 1);
      painted.assign(drawn.begin(), drawn.end());
      for (Fragment& fragment : painted) paint(fragment, by_strip ? fragment.triangle : header);
      if (Status added = assembler.add(painted); !added) return added;
    }
    return Ok{};
  });
  if (!made) return made.error();
  return assembler.frame();
}

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
