// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live_core/live_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "golden_run/golden_run.hpp"
#include "golden_run/walk_counts.hpp"
#include "projection/project.hpp"
#include "setup/check_counts.hpp"
#include "setup/spherical_setup.hpp"
#include "sim/driver/limits.hpp"
#include "sim/driver/stream_comparator.hpp"

namespace halfway::live {
namespace {

constexpr unsigned c_most_unrolled_lights = 4;  // of shading processors in preset `exact`
constexpr std::size_t c_batch_bytes = std::size_t{8} << 20;

/// A bright colour for a number; neighbours differ.
void paint(Fragment& fragment, std::uint32_t number) {
  const std::uint32_t mixed = (number + 1) * 2654435761U;
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>(96 + ((mixed >> shift) & 127)); };
  fragment.red = channel(24);
  fragment.green = channel(16);
  fragment.blue = channel(8);
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

Status LiveFrame::make_stream(const Settings& settings, const GoldenModel& golden, SetupCounts& counts,
                              const OnBatch& on_batch) {
  const SetupOptions options = setup_options(settings);
  const std::unique_ptr<Setup> setup = make_setup(scene_->scene(), settings.size(), *key_, options);
  const std::unique_ptr<SetupWorker> worker = setup->worker();
  std::vector<std::uint32_t> words;
  setup->append_prologue(words, counts);
  for (std::uint32_t unit = 0; unit < setup->units();) {
    std::uint64_t pixels = 0;
    const auto bytes = [&] { return words.size() * sizeof words[0] + pixels * sizeof(Fragment); };
    for (; unit < setup->units() && bytes() < c_batch_bytes; ++unit) {
      const std::size_t before = words.size();
      worker->append(unit, words, counts);
      pixels += golden.all_pixels(std::span(words).subspan(before));
    }
    if (Status status = on_batch(words, pixels); !status) return status;
    words.clear();
  }
  return Ok{};
}

Status LiveFrame::draw(const Settings& settings, Engine& engine) {
  if (Status status = check_planned(); !status) return status;
  if (Status status = check(settings); !status) return status;
  if (Status status = scene_->apply(settings); !status) return status;
  const Scene& scene = scene_->scene();
  const std::unique_ptr<GoldenModel> golden = make_golden_model(*key_);
  HardwareFrame hardware(settings.size(), whole_frame(settings.size()), scene.background);
  StreamComparator comparator;
  Figures figures;
  std::optional<WalkCounter> walk;
  if (has_walk_clocks(*key_)) walk.emplace(*key_);

  // Empty the hardware after a frame that ended early.
  if (Status empty = engine.drain(c_most_surplus, [](std::span<const Fragment>) {});
      !empty && empty.error().code != ExitCode::differs)
    return empty;

  // Add the time since the last call to a part of the frame.
  double last = now_();
  const auto add_time = [&](double& part) {
    const double now = now_();
    part += now - last;
    last = now;
  };
  std::vector<Fragment> drawn;
  const auto keep = [&](std::span<const Fragment> part) {
    drawn.insert(drawn.end(), part.begin(), part.end());
  };
  // Compare and assemble what the hardware has drawn.
  const auto take = [&](std::span<const Fragment> expected) {
    comparator.add(expected, drawn);
    add_time(figures.compare_ms);
    hardware.add(drawn);
    drawn.clear();
    add_time(figures.assemble_ms);
  };

  const Status made = make_stream(
      settings, *golden, figures.setup,
      [&](std::span<const std::uint32_t> init_words, std::uint64_t pixels) -> Status {
        add_time(figures.setup_ms);
        figures.words += init_words.size();
        hardware.expect(pixels);
        if (walk) walk->add(init_words);
        last = now_();
        if (hardware.alive())
          if (Status ended = hardware.ended(engine.draw(init_words, hardware.most(), keep)); !ended)
            return ended;
        add_time(figures.hardware_ms);
        const auto expected = golden->draw(init_words);
        add_time(figures.golden_ms);
        take(expected);
        return check_shadow_counts(scene, figures.setup, golden->fault());
      });
  if (!made) return made;
  if (Status status = check_projection(scene, figures.setup); !status) return status;
  if (hardware.alive())
    if (Status ended = hardware.ended(engine.drain(hardware.most(), keep)); !ended) return ended;
  add_time(figures.hardware_ms);
  take({});
  comparator.finish();

  figures.fragments = hardware.fragments();
  figures.mismatches = comparator.mismatches();
  figures.vectors = figures.words / ((golden->init_bits() + 31) / 32);
  if (walk) figures.hardware_clocks = walk->counts().clocks();
  figures.covered_pixels = hardware.assembler().covered_pixels();
  figures_ = figures;
  // A fragment after the last golden one belongs to the last triangle.
  first_wrong_ = UINT64_MAX;
  if (!comparator.first().empty() && comparator.golden_count() > 0)
    first_wrong_ = std::min(comparator.first().front().index, comparator.golden_count() - 1);
  hardware_ = std::move(hardware);
  drawn_ = settings;
  reference_.reset();
  if (figures.mismatches == 0 && hardware_->fault().empty()) return Ok{};
  std::string message = hardware_->fault();
  if (!message.empty()) message += '\n';
  if (figures.mismatches != 0) message += comparator.describe("RTL");
  return Error{ExitCode::differs, message};
}

Status LiveFrame::draw_reference() {
  if (!drawn_) return bad_input("no frame is drawn");
  if (Status status = scene_->apply(*drawn_); !status) return status;
  const Scene& scene = scene_->scene();
  const FrameSize size = drawn_->size();
  reference_ = render_reference(scene, Projector(scene, size, {}).project_all(), {.frame = size});
  const auto error = frame_distance(hardware_->assembler().frame(), reference_->frame, reference_->mask);
  if (!error) return error.error();
  figures_.error = *error;
  return Ok{};
}

Result<Frame> LiveFrame::picture(Picture kind) {
  if (!drawn_) return bad_input("no frame is drawn");
  const Frame& hardware = hardware_->assembler().frame();
  if (kind == Picture::hardware) return hardware;
  if (kind == Picture::golden || kind == Picture::split) return draw_golden(kind);
  if (!reference_) return bad_input("the reference is not drawn");
  return kind == Picture::reference ? reference_->frame : difference_image(hardware, reference_->frame);
}

Result<Way> LiveFrame::way(FramePixel pixel, const Observe& observe) {
  if (!drawn_) return bad_input("no frame is drawn");
  if (Status status = scene_->apply(*drawn_); !status) return status.error();
  PixelSearch search(*key_, pixel, first_wrong_);
  SetupCounts counts;
  const Status made = make_stream(*drawn_, *make_golden_model(*key_), counts,
                                  [&](std::span<const std::uint32_t> init_words, std::uint64_t) -> Status {
                                    search.add(init_words);
                                    return Ok{};
                                  });
  if (!made) return made.error();
  PixelWay way(*key_, pixel);
  way.draw_golden(search.found());
  if (way.fragments() == 0) return Way{};
  const auto observed = observe(search.found().words(), way.stages(), way.fragments() + c_most_surplus);
  if (!observed) return observed.error();
  way.compare(way.stages().read(*observed->trace));
  return Way{way.stories(), way.first(), observed->fault};
}

Result<Frame> LiveFrame::draw_golden(Picture kind) {
  if (Status status = scene_->apply(*drawn_); !status) return status.error();
  const std::unique_ptr<GoldenModel> golden = make_golden_model(*key_);
  FrameAssembler assembler(drawn_->size(), scene_->scene().background);
  const bool by_line = key_->shader == Shader::processors && key_->processors.shadows;
  SetupCounts counts;
  std::uint32_t header = 0;
  std::vector<Fragment> painted;
  const Status made = make_stream(*drawn_, *golden, counts,
                                  [&](std::span<const std::uint32_t> init_words, std::uint64_t) -> Status {
                                    if (kind == Picture::golden)
                                      return assembler.add(golden->draw(init_words));
                                    // Draw triangle by triangle.
                                    while (!init_words.empty()) {
                                      const auto drawn = golden->draw_next(init_words, 1);
                                      painted.assign(drawn.begin(), drawn.end());
                                      for (Fragment& fragment : painted)
                                        paint(fragment, by_line ? fragment.triangle : header);
                                      ++header;
                                      if (Status added = assembler.add(painted); !added) return added;
                                    }
                                    return Ok{};
                                  });
  if (!made) return made.error();
  return assembler.frame();
}

}  // namespace halfway::live
