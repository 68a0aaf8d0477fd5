// SPDX-License-Identifier: Apache-2.0
#include "sim/run/view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <span>

#include "projection/project.hpp"
#include "reference/renderer.hpp"
#include "scene/camera.hpp"
#include "scene/turntable.hpp"
#include "setup/setup.hpp"
#include "setup/spherical_setup.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/simulate.hpp"

namespace halfway {
namespace {

using Clock = std::chrono::steady_clock;

// Each drawing thread has a copy of the scene, whose camera it moves. Use fewer threads for larger scenes.
constexpr std::size_t c_most_copied_bytes = std::size_t{1} << 30;

std::size_t bytes(const Scene& scene) {
  return sizeof(glm::dvec3) * (scene.positions_world.size() + scene.normals_world.size()) +
         sizeof(SceneTriangle) * scene.triangles.size();
}

struct DrawnFrame {
  std::uint64_t fragments = 0;
  FrameSeconds seconds;
  double image_seconds = 0.0;
  std::vector<std::string> notes;
  bool covered = false;
  std::uint64_t in_view = 0;           ///< triangles
  std::uint64_t reference_pixels = 0;  ///< covered by the reference; counted if no fragment was drawn
  bool again = false;                  ///< drawn again by Verilator
  std::optional<ViewDifference> difference;
};

// An engine with its copy of the scene, which it draws from different places.
class Easel {
 public:
  Easel(Scene scene, std::shared_ptr<Engine> engine, const ViewSettings& settings, const SetupOptions& setup,
        const HardwareKey& key, unsigned threads)
      : scene_(std::move(scene)),
        first_camera_(scene_.camera),
        s_(settings),
        setup_(setup),
        key_(key),
        threads_(threads),
        driver_(scene_, settings.size, key, {std::move(engine)}, options()) {}

  DrawnFrame draw(std::uint32_t number) {
    scene_.camera = turned(first_camera_, number, s_.frames);
    if (!has_view(scene_.camera))
      throw_bad_input(
          "{}: frame {} has no view: the camera's eye is too near its target, or to the axis through that",
          scene_.name, number);
    again_.reset();
    DrawnFrame drawn;
    SimulatorRun run = draw_in(driver_, drawn);
    if (!run.equal() && engine_kind() != EngineKind::verilator) run = draw_again(number, run, drawn);
    drawn.fragments = run.fragments;
    drawn.covered = run.fragments != 0;
    if (!drawn.covered && s_.compare) drawn.reference_pixels = count_reference_pixels();
    if (!run.equal()) drawn.difference = ViewDifference{number, scene_.camera, std::move(run)};

    const double images_start = thread_seconds();
    s_.on_drawn(number, frame());
    drawn.image_seconds = thread_seconds() - images_start;
    return drawn;
  }
  /// The last drawn frame; valid until the next call of draw.
  const Frame& frame() { return again_ ? *again_ : driver_.frame().assembler().frame(); }

 private:
  std::uint64_t count_reference_pixels() const {
    const ReferenceImage reference =
        render_reference(scene_, Projector(scene_, s_.size, {}).project_all(), {.frame = s_.size});
    return static_cast<std::uint64_t>(std::ranges::count(reference.mask, 1));
  }

  EngineKind engine_kind() { return driver_.frame().engine().kind(); }

  FrameOptions options() const {
    return {.setup = setup_,
            .golden = s_.compare ? GoldenDraws::beside : GoldenDraws::nothing,
            .workers = on_threads(threads_),
            .clocks = host_clocks()};
  }

  static SimulatorRun draw_in(FrameDriver& driver, DrawnFrame& drawn) {
    must(driver.draw());
    drawn.notes = driver.notes();
    drawn.in_view = triangles_in_view(driver.counts());
    drawn.seconds += driver.seconds();
    return driver.frame().result();
  }

  SimulatorRun draw_again(std::uint32_t number, const SimulatorRun& first, DrawnFrame& drawn) {
    const char* const engine = title(engine_kind());
    FrameDriver driver(scene_, s_.size, key_, {must(open_engine(EngineKind::verilator, key_, s_.folders))},
                       options());
    drawn.again = true;
    SimulatorRun run = draw_in(driver, drawn);
    again_ = driver.frame().assembler().frame();
    if (!run.equal()) return run;
    const std::string difference = first.fault.empty()
                                       ? fmt::format("{} fragments differ in {}", first.mismatches, engine)
                                       : first.fault;
    throw Failure{{ExitCode::differs,
                   fmt::format("{}: frame {}: {}; Verilator draws it without a difference. The {} are "
                               "wrong: please report it, and use --simulator verilator",
                               scene_.name, number, difference, engine)}};
  }

  Scene scene_;
  Camera first_camera_;
  const ViewSettings& s_;
  const SetupOptions& setup_;
  const HardwareKey& key_;
  unsigned threads_;
  FrameDriver driver_;
  std::optional<Frame> again_;  // the frame if it was drawn again
};

// Gives the numbers of the frames to the threads, and outputs their frames in that order.
class Turn {
 public:
  Turn(const ViewSettings& settings, ViewSummary& summary) : s_(settings), summary_(summary) {}

  /// std::nullopt if all frames are taken or one failed.
  std::optional<std::uint32_t> next() {
    const std::scoped_lock lock(mutex_);
    if (stop_ || next_ == s_.frames) return std::nullopt;
    return next_++;
  }

  void take(std::uint32_t number, const Result<DrawnFrame>& drawn, const Frame& frame) {
    std::unique_lock lock(mutex_);
    if (!drawn) {
      fail(number, drawn.error());
      return;
    }
    in_turn_.wait(lock, [&] { return taken_ == number || failed_ < number; });
    if (failed_ < number) return;
    // Only one thread gets here until `taken_` is incremented.
    lock.unlock();
    const auto taken = caught([&] { s_.on_next(number, frame); });
    lock.lock();
    summary_.fragments += drawn->fragments;
    summary_.parts += drawn->seconds;
    summary_.image_seconds += drawn->image_seconds;
    for (const std::string& note : drawn->notes) add_note(note);
    if (!drawn->covered) ++bare_;
    summary_.in_view = std::max(summary_.in_view, drawn->in_view);
    summary_.reference_pixels = std::max(summary_.reference_pixels, drawn->reference_pixels);
    if (drawn->again) summary_.drawn_again.push_back(number);
    ++summary_.frames;
    ++taken_;
    if (drawn->difference) {  // this is the last frame; ignore all later ones
      summary_.difference = drawn->difference;
      error_.reset();
      failed_ = number;
      stop_ = true;
    }
    if (!taken) {
      failed_ = number;
      error_ = taken.error();
      stop_ = true;
    }
    in_turn_.notify_all();
  }
  /// Ends all waiting after an exception in a thread, such as lack of memory.
  void abandon() {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
    failed_ = 0;
    in_turn_.notify_all();
  }

  const std::optional<Error>& error() const { return error_; }
  std::uint32_t bare() const { return bare_; }

 private:
  // Frames start in order, so all frames before the first failure are drawn, however fast each thread is.
  void fail(std::uint32_t number, const Error& error) {
    stop_ = true;
    if (number < failed_) {
      failed_ = number;
      error_ = error;
    }
    in_turn_.notify_all();
  }
  void add_note(const std::string& note) {
    const std::string text = fmt::format("{}: {}", summary_.scene, note);
    if (std::ranges::find(summary_.notes, text) == summary_.notes.end()) summary_.notes.push_back(text);
  }

  const ViewSettings& s_;
  ViewSummary& summary_;
  std::mutex mutex_;
  std::condition_variable in_turn_;
  std::uint32_t next_ = 0, taken_ = 0;
  std::uint32_t failed_ = c_most_view_frames;  ///< the first frame that must not be output
  bool stop_ = false;
  std::optional<Error> error_;
  std::uint32_t bare_ = 0;
};

// For example "lanes", or "lanes, verilator in frames 3, 8".
std::string engine_words(const ViewSummary& s) {
  if (s.drawn_again.empty()) return to_string(s.engine);
  constexpr std::size_t c_named = 10;
  const auto named = std::span(s.drawn_again).first(std::min(c_named, s.drawn_again.size()));
  const std::size_t others = s.drawn_again.size() - named.size();
  return fmt::format("{}, verilator in frame{} {}{}", to_string(s.engine),
                     s.drawn_again.size() == 1 ? "" : "s", fmt::join(named, ", "),
                     others == 0 ? "" : fmt::format(" and {} others", others));
}

}  // namespace

ViewSummary view(const Scene& scene, const ViewSettings& settings) {
  ViewSummary summary{.scene = scene.name,
                      .plan = must(plan_scene(scene, settings.plan)),
                      .size = settings.size,
                      .triangles = scene.triangles.size(),
                      .compared = settings.compare,
                      .threads = settings.threads};
  const HardwareKey& key = summary.plan.key;
  // Engines may take minutes to build.
  must(check_objects(scene, settings.size, key, settings.setup));
  const double pixels = double(settings.size.width) * double(settings.size.height) * double(settings.frames);
  summary.engine =
      settings.engine.value_or(pixels >= c_least_lane_pixels ? EngineKind::lanes : EngineKind::verilator);
  settings.on_build(key.name(), summary.engine);
  auto engine = open_engine(summary.engine, key, settings.folders);
  if (!engine && !settings.engine && summary.engine != EngineKind::verilator) {
    summary.notes.push_back(fmt::format("{}: Verilator draws, for {} cannot be had: {}", scene.name,
                                        title(summary.engine), engine.error().message));
    summary.engine = EngineKind::verilator;
    settings.on_build(key.name(), summary.engine);
    engine = open_engine(summary.engine, key, settings.folders);
  }
  const auto fit = static_cast<unsigned>(std::clamp<std::size_t>(
      c_most_copied_bytes / std::max<std::size_t>(bytes(scene), 1), 1, settings.threads));
  std::vector<std::shared_ptr<Engine>> engines{must(std::move(engine))};
  while (engines.size() < std::min({settings.threads, fit, settings.frames}))
    engines.push_back(must(engines.front()->another()));
  settings.on_ready();

  const Clock::time_point start = Clock::now();
  SetupOptions setup = settings.setup;
  if (key.shader == Shader::spherical && key.preset == Preset::exact)
    setup.spherical.bells = std::make_shared<const Bells>(fitted_bells(scene));
  const auto easels = static_cast<unsigned>(engines.size());
  std::atomic<std::size_t> next = 0;
  Turn turn(settings, summary);
  work_on_threads(easels, [&] {
    try {
      Easel easel(scene, engines[next++], settings, setup, key, std::max(1U, settings.threads / easels));
      while (const auto number = turn.next()) {
        const auto drawn = caught([&] { return easel.draw(*number); });
        turn.take(*number, drawn, easel.frame());
      }
    } catch (...) {
      turn.abandon();
      throw;
    }
  });
  summary.seconds = seconds_since(start);
  if (turn.error()) throw Failure{*turn.error()};
  if (turn.bare() != 0)
    summary.notes.push_back(
        fmt::format("{}: {} of {} frames show no triangle, and so nothing of the hardware", scene.name,
                    turn.bare(), summary.frames));
  return summary;
}

std::optional<std::string> ViewSummary::nothing_compared() const {
  if (!compared) return std::nullopt;
  return halfway::nothing_compared(fragments, in_view, reference_pixels);
}

std::string to_lines(const ViewSummary& s) {
  const std::string compared = !s.compared        ? "not compared with the golden model"
                               : s.difference     ? fmt::format("{} mismatches in frame {}",
                                                                s.difference->run.mismatches, s.difference->frame)
                               : s.fragments == 0 ? "nothing compared"
                                                  : "0 mismatches";
  std::string text = fmt::format(
      "{:<12} {:<10} {:<9} {:>4}x{:<4} {:>4} frame{} of {} triangles, {} fragments | {}: {} | {:.2f} "
      "frames a second, {:.2f} s on {} thread{}\n",
      s.scene, to_string(s.plan.key.shader), to_string(s.plan.key.preset), s.size.width, s.size.height,
      s.frames, s.frames == 1 ? "" : "s", s.triangles, s.fragments, engine_words(s), compared, s.rate(),
      s.seconds, s.threads, s.threads == 1 ? "" : "s");
  if (s.frames == 0) return text;
  const auto ms = [&](double seconds) { return 1e3 * seconds / s.frames; };
  text += fmt::format("processor time a frame: setup {:.1f} ms, ", ms(s.parts.setup));
  if (s.compared) text += fmt::format("golden model {:.1f}, ", ms(s.parts.golden));
  text += fmt::format("{} {:.1f}, ", title(s.engine), ms(s.parts.rtl));
  if (s.compared) text += fmt::format("comparison {:.1f}, ", ms(s.parts.compare));
  return text + fmt::format("assembly {:.1f}, images {:.1f}\n", ms(s.parts.assemble), ms(s.image_seconds));
}

}  // namespace halfway
