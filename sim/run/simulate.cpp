// SPDX-License-Identifier: Apache-2.0
#include "sim/run/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <nlohmann/json.hpp>

#include "projection/project.hpp"
#include "reference/renderer.hpp"
#include "scene/lights.hpp"
#include "setup/setup.hpp"
#include "setup/spherical_setup.hpp"
#include "shading/effects.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/image.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/waveform.hpp"
#include "words/generator/cosine.hpp"
#include "words/object_limits.hpp"

namespace halfway {
namespace {

using Clock = std::chrono::steady_clock;

// In multiples of white: brighter lights get a note.
constexpr double c_bright = 2.0;

void forget(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove_all(path, error);
  if (error) throw_tool_failed("{}: cannot remove: {}", path.string(), error.message());
}

class Simulation {
 public:
  Simulation(const Scene& scene, const SimulateSettings& settings)
      : scene_(scene), s_(settings), files_(ResultFiles::of(settings.out, scene.name, settings.plan)) {
    summary_.scene = scene.name;
    summary_.shader = to_string(s_.plan.shader);
    summary_.all_effects = s_.plan.all_effects;
    summary_.size = s_.size;
    summary_.triangles = scene.triangles.size();
    summary_.notes = scene.notes;
  }

  SceneSummary run() {
    const Clock::time_point start = Clock::now();
    summary_.plan = must(plan_scene(scene_, s_.plan));
    // Engines may take minutes to build.
    must(check_objects(scene_, s_.size, summary_.plan.key, s_.setup));
    must(make_folders(files_.folder));
    const auto lock = must(lock_folder(files_.folder, [this] { s_.on_wait(files_.folder); }));
    forget_old_results();
    std::future<ReferenceImage> reference =
        std::async(std::launch::async, [this] { return draw_reference(); });
    open_engines();
    stream();
    // Engines that draw late take longest, so do all other work at the same time.
    for (std::size_t i = 0; i < drawings_.size(); ++i)
      drawings_[i].finished =
          std::async(std::launch::async, [&frame = driver_->frame(i)] { return frame.finish(); });
    wait_for_threads();
    if (!s_.engines.empty()) summary_.units = must(UnitCounter::open(s_.folders)).count(summary_.plan.key);
    must(write_png(files_.frame("golden"), golden().frame()));
    compare_with(reference.get());
    summary_.runs.resize(drawings_.size());
    for (std::size_t i = drawings_.size(); i-- != 0;)
      summary_.runs[i] = keep(drawings_[i], driver_->frame(i));
    for (SimulatorRun& run : summary_.runs)
      if (!run.equal()) keep_evidence(run);
    note_what_is_unusual();
    summary_.seconds = seconds_since(start);
    must(write_file(files_.summary(), to_json(summary_)));
    return summary_;
  }

 private:
  // The trace of an engine's fragments, and the end of its drawing.
  struct Drawing {
    TraceWriter trace;
    std::future<Status> finished{};
  };

  const FrameAssembler& golden() const { return driver_->golden_frame(); }

  // Remove old results: if this run is interrupted, they must not be taken for its own.
  void forget_old_results() const {
    std::vector<std::string> drawers{"golden"};
    for (const EngineKind kind : c_engine_kinds) drawers.emplace_back(to_string(kind));
    for (const std::string& who : drawers) {
      forget(files_.trace(who));
      forget(files_.frame(who));
      forget(files_.frame(fmt::format("mismatch-{}", who)));
      forget(files_.folder / fmt::format("mismatch-{}.fst", who));
    }
    for (const char* who : {"reference", "diff"}) forget(files_.frame(who));
    forget(files_.init());
    // Remove unfinished files. The folder is locked, so they are from killed runs.
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(files_.folder, error)) {
      const std::string name = entry.path().filename().string();
      if (name.find(".part") != std::string::npos || name.starts_with(".halfway-")) forget(entry.path());
    }
    forget(files_.summary());
  }

  void note(std::string text) { summary_.notes.push_back(scene_.name + ": " + std::move(text)); }

  // Add notes about a frame that proves little or is less accurate than requested.
  void note_what_is_unusual() {
    if (s_.plan.shader != Shader::processors && calls_of(scene_)[Effect::shadow].called_for)
      note("its shadows are drawn by the shading processors alone; the frame has none, the reference has");
    const SetupCounts& n = summary_.setup;
    if (summary_.fragments == 0)
      note(fmt::format(
          "no triangle covers a pixel ({} back-facing, {} nearer than the near plane, {} outside, {} too "
          "small): the frame shows nothing of the hardware{}",
          n.projection.back_facing, n.projection.behind_near, n.projection.outside, n.projection.degenerate,
          triangles_in_view(n) != 0 ? ""
                                    : "; turn the camera to the scene, and give each triangle's corners "
                                      "counter-clockwise as seen from outside"));
    if (n.projection.left_out != 0)
      note(fmt::format(
          "{} triangles of surfaces that are not closed show their back and are left out, as cull = "
          "\"back\" or their glTF material wants; cull = \"none\" draws both sides",
          n.projection.left_out));
    if (n.projection.cut_by_near != 0 && scene_.camera.near <= 0.0)
      note(fmt::format(
          "{} triangles in view are cut by the near plane, which was fitted to {:.4g}; set a smaller near in "
          "[camera] to draw them whole",
          n.projection.cut_by_near, Projector(scene_, s_.size, {}).range().near));
    if (n.unresolved != 0 && s_.setup.quadratic.max_level > 0) {
      const bool by_pixel = draws_small_by_pixel(s_.plan.preset, s_.setup.quadratic.test);
      note(fmt::format(
          "{} pieces may err by more than {} colour steps; they are split {} times{}", n.unresolved,
          s_.setup.quadratic.threshold, s_.setup.quadratic.max_level,
          by_pixel ? "; a finer mesh helps"
                   : fmt::format(" or at most {} pixels wide and high; preset exact with the conservative "
                                 "test draws these without error",
                                 c_small_pixels)));
    }
    if (s_.plan.shader == Shader::spherical)
      note_of_bells();
    else if (n.overexposed != 0)
      note(fmt::format("{} samples exceed four times white and were clamped to it", n.overexposed));
  }

  void note_of_bells() {
    const HardwareKey& key = summary_.plan.key;
    const bool exact = key.preset == Preset::exact;
    const std::vector<bool> used = used_materials(scene_);
    double brightest = 0.0;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      const Material& m = scene_.materials[i];
      if (!used[i]) continue;
      for (const LightRef light : reflected_lights(scene_)) {
        const glm::dvec3 in = light_of(scene_, light).intensity;
        for (int c = 0; c < 3; ++c)
          brightest = std::max(brightest,
                               in[c] * std::max(m.diffuse * m.colour[c], m.specular * m.specular_colour[c]));
      }
      if (!has_specular(m)) continue;
      if (m.exponent > c_largest_exponent)
        note(fmt::format("material '{}': its exponent {:g} was clamped to {:g}", m.name, m.exponent,
                         c_largest_exponent));
      // At exponent 1 the bell is the cosine itself.
      const double steps = exact && key.spherical.own.empty() && m.exponent < 2.0
                               ? 255.0 * fit_error(m.exponent, fitted_bell(m.exponent))
                               : 0.0;
      if (steps > 1.0)
        note(fmt::format(
            "material '{}': no bell fits exponents between 1 and 2 well; that of {:g} is off by up "
            "to {:.1f} colour steps where a highlight's peak is white",
            m.name, m.exponent, steps));
    }
    if (exact && brightest > c_bright)
      note(
          fmt::format("a light is reflected {:.3g} times as bright as white: where it is below white, "
                      "the errors of bells and tables are larger by the same factor",
                      brightest));
    const std::uint64_t clamped = summary_.setup.overexposed;
    if (clamped == 0 || (exact && key.spherical.tables.data_bits <= c_white_data_bits)) return;
    note(fmt::format(
        "{} factors exceed {:.0f} times white and were clamped to it: whole lines are too dark, not only "
        "pixels above white",
        clamped, (exact ? c_largest_factor<words::Exact> : c_largest_factor<words::Published>) / 255.0));
  }

  ReferenceImage draw_reference() const {
    const std::vector<ScreenTriangle> triangles = Projector(scene_, s_.size, {}).project_all();
    const RenderOptions options{.frame = s_.size, .workers = on_threads(s_.threads)};
    if (words::has_filter(static_cast<int>(s_.plan.subpixels)))
      return render_filtered(scene_, triangles, options, words::c_filter_weights);
    return render_reference(scene_, triangles, options);
  }

  // Open the engines in parallel, because some take long.
  void open_engines() {
    const HardwareKey& key = summary_.plan.key;
    std::vector<std::future<Result<std::shared_ptr<Engine>>>> opening;
    for (const EngineKind kind : s_.engines)
      opening.push_back(std::async(std::launch::async, [this, &key, kind] {
        return open_engine(kind, key, s_.folders,
                           {.threads = s_.threads,
                            .stall_seed = s_.stall_seed,
                            .on_progress = [this, kind](std::uintmax_t bytes) { show_late(kind, bytes); }});
      }));
    std::vector<std::shared_ptr<Engine>> engines;
    for (std::size_t i = 0; i < opening.size(); ++i) {
      s_.on_progress(fmt::format("building {} for {}", key.name(), title(s_.engines[i])), -1.0);
      engines.push_back(must(opening[i].get()));
      drawings_.push_back({must(TraceWriter::open(files_.trace(to_string(s_.engines[i])), key.name()))});
    }
    driver_.emplace(scene_, s_.size, key, std::move(engines),
                    FrameOptions{.setup = s_.setup,
                                 .golden_picture = true,
                                 .workers = on_threads(s_.threads),
                                 .clocks = host_clocks(),
                                 .late_golden = [this] { return stored_fragments(files_.trace("golden")); },
                                 .on_drawn =
                                     [this](std::size_t engine, std::span<const Fragment> drawn) {
                                       drawings_[engine].trace.write(drawn);
                                     }});
  }

  // Write the init file and the golden trace on the way.
  void stream() {
    const std::string key = summary_.plan.key.name();
    auto init_file = must(InitFileWriter::open(files_.init(), key, driver_->init_bits()));
    auto golden_trace = must(TraceWriter::open(files_.trace("golden"), key));
    must(driver_->stream([&](const Batch& batch) {
      s_.on_progress("setup, golden model, Verilator", batch.done);
      init_file.write(batch.init_words);
      golden_trace.write(batch.golden);
      return Status(Ok{});
    }));
    must(init_file.commit());
    must(golden_trace.commit());
    for (const std::string& text : driver_->notes()) note(text);
    summary_.setup = driver_->counts();
    summary_.setup_seconds = driver_->seconds().setup;
    summary_.golden_seconds = driver_->seconds().golden;
    summary_.fragments = driver_->fragments();
  }

  // Show the progress of an engine that draws late: its trace is about as long as the golden one.
  void show_late(EngineKind kind, std::uintmax_t bytes) {
    late_began_ = true;
    std::error_code ignored;
    const auto golden = static_cast<double>(std::filesystem::file_size(files_.trace("golden"), ignored));
    s_.on_progress(title(kind), std::min(1.0, static_cast<double>(bytes) / golden));
  }

  // While OpenImageIO is loaded (0.3 s), glibc starts no thread. So wait until the engines that draw late
  // have started theirs.
  void wait_for_threads() {
    for (std::size_t i = 0; i < drawings_.size(); ++i)
      while (driver_->frame(i).engine().draws_late() && !late_began_ &&
             drawings_[i].finished.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
      }
  }

  // Store the results of an engine. A trace is committed only if it is complete.
  SimulatorRun keep(Drawing& drawing, RtlFrame& drawn) const {
    must(drawing.finished.get());
    SimulatorRun run = drawn.result();
    if (drawn.alive()) must(drawing.trace.commit(run.cycles));
    const Frame& frame = drawn.assembler().frame();
    must(write_png(files_.frame(run.simulator), frame));
    if (run.equal()) return run;
    run.evidence.push_back(files_.frame(fmt::format("mismatch-{}", run.simulator)));
    must(write_png(run.evidence.back(), must(difference_image(golden().frame(), frame))));
    return run;
  }

  void compare_with(const ReferenceImage& reference) {
    std::vector<std::uint8_t> mask = golden().mask();
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= reference.mask[i];
    summary_.accuracy = must(frame_distance(golden().frame(), reference.frame, mask));
    must(write_png(files_.frame("reference"), reference.frame));
    must(write_png(files_.frame("diff"), must(difference_image(golden().frame(), reference.frame))));
  }

  void keep_evidence(SimulatorRun& run) const {
    s_.on_progress("waveform", -1.0);
    const auto path = caught([&] {
      return write_mismatch_waveform(
          summary_.plan.key, s_.folders, files_, run.simulator,
          run.first.empty() ? std::nullopt : std::optional(run.first.front().index), s_.stall_seed);
    });
    // The mismatch must be reported even if the waveform cannot be written.
    if (path)
      run.evidence.push_back(path->string());
    else
      run.description +=
          fmt::format("  no waveform: {}\n", path.error().message.substr(0, path.error().message.find('\n')));
  }

  const Scene& scene_;
  const SimulateSettings& s_;
  ResultFiles files_;
  SceneSummary summary_;
  std::atomic<bool> late_began_ = false;  ///< an engine that draws late has started to draw
  std::vector<Drawing> drawings_;         ///< in the order of s_.engines, as the driver's frames
  std::optional<FrameDriver> driver_;
};

}  // namespace

bool SceneSummary::equal() const {
  return std::ranges::all_of(runs, [](const SimulatorRun& run) { return run.equal(); });
}

std::optional<std::string> nothing_compared(std::uint64_t fragments, std::uint64_t in_view,
                                            std::uint64_t reference_pixels) {
  if (fragments != 0 || (in_view == 0 && reference_pixels == 0)) return std::nullopt;
  if (in_view == 0)
    return fmt::format(
        "nothing was compared: setup finds no triangle in view, but the reference covers {} pixels; please "
        "report it",
        reference_pixels);
  return fmt::format(
      "nothing was compared: {} triangle{} in view, but no pixel is drawn; take a larger --size "
      "(make: SIZE), or move the camera closer",
      in_view, in_view == 1 ? " is" : "s are");
}

std::optional<std::string> SceneSummary::nothing_compared() const {
  return halfway::nothing_compared(fragments, triangles_in_view(setup), accuracy.pixels);
}

void forget_summary(const ResultFiles& files, const std::function<void()>& on_wait) {
  std::error_code error;
  if (!std::filesystem::exists(files.summary(), error)) return;
  const auto lock = must(lock_folder(files.folder, on_wait));
  forget(files.summary());
}

SceneSummary simulate(const Scene& scene, const SimulateSettings& settings) {
  return Simulation(scene, settings).run();
}

namespace {

template <class Number>
nlohmann::ordered_json number_or_null(std::optional<Number> number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

// For example " tables 4x4", if the hardware has tables of another size than the default.
std::string unusual_tables(const HardwareKey& key) {
  const tables::CosineSizes sizes;
  const tables::CosineSize usual = (key.preset == Preset::exact ? sizes.exact : sizes.published).front();
  const words::CosineSize size = key.spherical.tables;
  if (key.shader != Shader::spherical || !key.spherical.records() || size == usual) return {};
  return fmt::format(", {}tables {}", key.spherical.own.empty() ? "" : "own ", to_string(size));
}

}  // namespace

std::string to_json(const SceneSummary& s) {
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  for (const SimulatorRun& run : s.runs) {
    nlohmann::ordered_json entry = {{"simulator", run.simulator},   {"cycles", number_or_null(run.cycles)},
                                    {"parts", run.parts},           {"fragments", run.fragments},
                                    {"mismatches", run.mismatches}, {"seconds", number_or_null(run.seconds)}};
    if (!run.fault.empty()) entry["fault"] = run.fault;
    runs.push_back(std::move(entry));
  }
  nlohmann::ordered_json units = nlohmann::ordered_json::object();
  for (const auto& [unit, count] : s.units) units[unit] = count;
  const nlohmann::ordered_json json = {
      {"scene", s.scene},
      {"shader", s.shader},
      {"preset", to_string(s.plan.key.preset)},
      {"width", s.size.width},
      {"height", s.size.height},
      {"triangles", s.triangles},
      {"fragments", s.fragments},
      {"hardware", {{"key", s.plan.key.name()}, {"all_effects", s.all_effects}, {"units", units}}},
      {"runs", runs},
      // JSON has no infinity: null if golden and reference frame are equal.
      {"accuracy",
       {{"psnr_db", std::isfinite(s.accuracy.psnr_db) ? nlohmann::ordered_json(s.accuracy.psnr_db) : nullptr},
        {"max_lsb", s.accuracy.max_lsb},
        {"percentile99_lsb", s.accuracy.percentile99},
        {"rms_lsb", s.accuracy.rms},
        {"pixels", s.accuracy.pixels},
        {"pixels_off", s.accuracy.off}}},
      {"setup",
       {{"back_facing", s.setup.projection.back_facing},
        {"left_out", s.setup.projection.left_out},
        {"behind_near", s.setup.projection.behind_near},
        {"cut_by_near", s.setup.projection.cut_by_near},
        {"outside", s.setup.projection.outside},
        {"degenerate", s.setup.projection.degenerate},
        {"on_screen", s.setup.triangles},
        {"subdivided", s.setup.subdivided},
        {"leaves", s.setup.leaves},
        {"unresolved", s.setup.unresolved},
        {"init_vectors", s.setup.vectors},
        {"line_records", s.setup.records},
        {"shadow_vectors", s.setup.shadows},
        {"shaded_points", s.setup.shaded},
        {"overexposed_samples", s.setup.overexposed}}},
      {"setup_seconds", s.setup_seconds},
      {"golden_seconds", s.golden_seconds},
      {"seconds", s.seconds}};
  // A scene's name is that of a file, so it may contain any bytes.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string to_line(const SceneSummary& s) {
  std::string line =
      fmt::format("{:<12} {:<10} {:<9} {:>4}x{:<4} {:>8} triangles {:>9} fragments", s.scene, s.shader,
                  to_string(s.plan.key.preset), s.size.width, s.size.height, s.triangles, s.fragments);
  if (s.all_effects) line += ", all effects";
  line += unusual_tables(s.plan.key);
  for (const SimulatorRun& run : s.runs) {
    const auto to = std::back_inserter(line);
    fmt::format_to(to, " | {}: ", run.simulator);
    if (run.cycles)
      fmt::format_to(
          to, "{} cycles{}, {:.3f} per fragment, ", *run.cycles,
          run.parts > 1 ? fmt::format(" in {} parts", run.parts) : "",
          run.fragments == 0 ? 0.0 : static_cast<double>(*run.cycles) / static_cast<double>(run.fragments));
    if (run.fragments == 0 && run.equal())
      line += "nothing compared";
    else
      fmt::format_to(to, "{} mismatches", run.mismatches);
    if (run.seconds) fmt::format_to(to, ", {:.2f} s", *run.seconds);
  }
  if (s.setup.unresolved != 0)
    fmt::format_to(std::back_inserter(line), " | {} unresolved", s.setup.unresolved);
  if (std::isfinite(s.accuracy.psnr_db))
    fmt::format_to(std::back_inserter(line), " | reference: PSNR {:.2f} dB, largest error {}/255",
                   s.accuracy.psnr_db, s.accuracy.max_lsb);
  else
    fmt::format_to(std::back_inserter(line), " | reference: equal");
  if (s.accuracy.off != 0)
    fmt::format_to(std::back_inserter(line), ", {} of {} pixels ({:.2g} %) off by more than {}",
                   s.accuracy.off, s.accuracy.pixels,
                   100.0 * static_cast<double>(s.accuracy.off) / static_cast<double>(s.accuracy.pixels),
                   c_close);
  fmt::format_to(std::back_inserter(line), " | {:.2f} s", s.seconds);
  return line;
}

}  // namespace halfway
