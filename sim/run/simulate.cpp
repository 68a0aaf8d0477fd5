// SPDX-License-Identifier: Apache-2.0
#include "sim/run/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <nlohmann/json.hpp>

#include "frame/assemble.hpp"
#include "reference/renderer.hpp"
#include "scene/lights.hpp"
#include "setup/spherical_setup.hpp"
#include "shading/effects.hpp"
#include "sim/compare/limits.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/pictures/image.hpp"
#include "sim/run/ghdl_parts.hpp"
#include "sim/run/lane_feed.hpp"
#include "sim/run/rtl_stream.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/run/waveform.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/stream_files/trace.hpp"
#include "sim/system/file.hpp"
#include "sim/system/folder_lock.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/threads.hpp"
#include "sim/verilator/verilator_simulator.hpp"
#include "tables/cosine.hpp"

namespace halfway {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t c_chunk = 1 << 16;  // fragments

// Times white, past which a light's brightness is worth a note.
constexpr double c_bright = 2.0;

class Simulation {
 public:
  Simulation(const Scene& scene, const SimulateSettings& settings)
      : scene_(scene),
        s_(settings),
        files_(ResultFiles::of(settings.out, scene.name, settings.plan)),
        golden_(settings.size, scene.background) {
    summary_.scene = scene.name;
    summary_.shader = to_string(s_.plan.shader);
    summary_.all_effects = s_.plan.all_effects;
    summary_.size = s_.size;
    summary_.triangles = scene.triangles.size();
  }

  Result<SceneSummary> run() {
    const Clock::time_point start = Clock::now();
    auto plan = plan_scene(scene_, s_.plan);
    if (!plan) return plan.error();
    summary_.plan = std::move(*plan);
    if (Status status = make_folders(files_.folder); !status) return status.error();
    const auto lock = FolderLock::take(files_.folder, [this] { s_.on_wait(files_.folder); });
    if (!lock) return lock.error();
    if (Status status = forget_old_results(); !status) return status.error();
    std::future<ReferenceImage> reference =
        std::async(std::launch::async, [this] { return draw_reference(); });
    std::future<Result<GhdlRunner>> ghdl_runner;
    if (s_.ghdl) {
      s_.on_progress(fmt::format("building {} for GHDL", summary_.plan.key.name()), -1.0);
      ghdl_runner =
          std::async(std::launch::async, [this] { return GhdlRunner::open(summary_.plan.key, s_.folders); });
    }
    if (Status status = stream(); !status) return status.error();
    // GHDL takes the longest: all else is done meanwhile.
    std::future<Result<SimulatorRun>> ghdl;
    if (s_.ghdl) {
      if (ghdl_runner.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        s_.on_progress(fmt::format("building {} for GHDL", summary_.plan.key.name()), -1.0);
      const auto runner = ghdl_runner.get();
      if (!runner) return runner.error();
      ghdl = std::async(std::launch::async, [this, runner = *runner] { return run_ghdl(runner); });
      wait_for_threads_of(ghdl);
    }
    if (Status status = count_units(); !status) return status.error();
    if (Status status = write_png(files_.frame("golden"), golden_.frame()); !status) return status.error();
    for (auto& [run, frame] : drawn_)
      if (Status status = draw_pictures(run, frame); !status) return status.error();
    if (Status status = compare_with(reference.get()); !status) return status.error();
    if (s_.ghdl) {
      auto run = ghdl.get();
      if (!run) return run.error();
      summary_.runs.push_back(std::move(*run));
    }
    for (auto& [run, frame] : drawn_) summary_.runs.push_back(std::move(run));
    for (SimulatorRun& run : summary_.runs)
      if (!run.equal())
        if (Status status = keep_evidence(run); !status) return status.error();
    note_what_is_unusual();
    summary_.seconds = seconds_since(start);
    if (Status status = write_file(files_.summary(), to_json(summary_)); !status) return status.error();
    return summary_;
  }

 private:
  // What a broken run leaves must not pass for this run's.
  Status forget_old_results() const {
    for (const char* who : {"golden", "ghdl", "verilator", "lanes"}) {
      if (Status status = forget(files_.trace(who)); !status) return status;
      if (Status status = forget(files_.frame(who)); !status) return status;
      if (Status status = forget(files_.frame(fmt::format("mismatch-{}", who))); !status) return status;
      if (Status status = forget(files_.folder / fmt::format("mismatch-{}.fst", who)); !status) return status;
    }
    for (const char* who : {"reference", "diff"})
      if (Status status = forget(files_.frame(who)); !status) return status;
    if (Status status = forget(files_.init()); !status) return status;
    // Unfinished files: with the folder locked, of runs that were killed.
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(files_.folder, error)) {
      const std::string name = entry.path().filename().string();
      if (name.find(".part") != std::string::npos || name.starts_with(".halfway-"))
        if (Status status = forget(entry.path()); !status) return status;
    }
    return forget(files_.summary());
  }
  static Status forget(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::remove_all(path, error);
    if (error) return tool_failed(fmt::format("{}: cannot remove: {}", path.string(), error.message()));
    return Ok{};
  }

  // Count the hardware's entities, where any hardware is simulated.
  Status count_units() {
    if (!s_.ghdl && !s_.verilator && !s_.lanes) return Ok{};
    auto counter = UnitCounter::open(s_.folders);
    if (!counter) return counter.error();
    auto units = counter->count(summary_.plan.key);
    if (!units) return units.error();
    summary_.units = std::move(*units);
    return Ok{};
  }

  void note(std::string text) { summary_.notes.push_back(scene_.name + ": " + std::move(text)); }

  // A frame that proves little, or is worse than asked for, is not passed over in silence.
  void note_what_is_unusual() {
    if (scene_.shadows && s_.plan.shader != Shader::processors && !reflected_lights(scene_).empty())
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
    const bool near_fitted = scene_.camera.near <= 0.0;
    if (n.projection.behind_near != 0 && near_fitted)
      note(fmt::format(
          "{} triangles lie behind the eye or nearer than the near plane, which was fitted to {:.4g}; set "
          "near in [camera] to see nearer ones",
          n.projection.behind_near, depth_range(scene_.camera, bounding_sphere(scene_)).near));
    if (n.unresolved != 0 && s_.setup.quadratic.max_level > 0)
      note(fmt::format(
          "{} pieces may err by more than {} colour steps after {} levels of splitting; a finer mesh helps",
          n.unresolved, s_.setup.quadratic.threshold, s_.setup.quadratic.max_level));
    if (s_.plan.shader == Shader::spherical)
      note_of_bells();
    else if (n.overexposed != 0)
      note(
          fmt::format("{} samples are over-exposed more than four times and were held there", n.overexposed));
  }

  void note_of_bells() {
    const HardwareKey& key = summary_.plan.key;
    const bool exact = key.preset == Preset::exact;
    const std::vector<bool> worn = worn_materials(scene_);
    double brightest = 0.0;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      const Material& m = scene_.materials[i];
      if (!worn[i]) continue;
      for (const LightRef light : reflected_lights(scene_)) {
        const glm::dvec3 in = light_of(scene_, light).intensity;
        for (int c = 0; c < 3; ++c)
          brightest = std::max(brightest,
                               in[c] * std::max(m.diffuse * m.colour[c], m.specular * m.specular_colour[c]));
      }
      if (!has_specular(m)) continue;
      if (m.exponent > c_largest_exponent)
        note(fmt::format("material '{}': its exponent {:g} was held at {:g}", m.name, m.exponent,
                         c_largest_exponent));
      // At 1 the bell is the cosine itself.
      const double steps =
          exact && m.exponent < 2.0 ? 255.0 * fit_error(m.exponent, fitted_bell(m.exponent)) : 0.0;
      if (steps > 1.0)
        note(fmt::format(
            "material '{}': no bell fits exponents between 1 and 2 well; that of {:g} is off by up "
            "to {:.1f} colour steps where a highlight's peak is white",
            m.name, m.exponent, steps));
    }
    if (exact && brightest > c_bright)
      note(
          fmt::format("a light is reflected {:.3g} times as bright as white: where it has faded below white, "
                      "the errors of bells and tables are as many times larger",
                      brightest));
    const std::uint64_t held = summary_.setup.overexposed;
    if (held == 0 || (exact && key.spherical.tables.data_bits <= c_white_data_bits)) return;
    note(fmt::format(
        "{} factors are over-exposed more than {:.0f} times and were held there: all that they "
        "light comes out too dark, not only what is beyond white",
        held, (exact ? c_largest_factor<golden::Exact> : c_largest_factor<golden::Published>) / 255.0));
  }

  ReferenceImage draw_reference() const {
    const std::vector<ScreenTriangle> triangles = Projector(scene_, s_.size, {}).project_all();
    return render_reference(scene_, triangles,
                            {.frame = s_.size, .subpixel_bits = 4, .workers = on_threads(s_.threads)});
  }

  // Setup, golden model and Verilator, batch by batch; init file and traces written on the way.
  Status stream() {
    const std::unique_ptr<Setup> setup = make_setup(scene_, s_.size, summary_.plan.key, s_.setup);
    std::optional<VerilatorSimulator> verilator;
    std::optional<TraceWriter> verilator_trace;
    RtlStream rtl(s_.size, scene_.background);
    const std::string key = summary_.plan.key.name();
    if (s_.verilator) {
      s_.on_progress(fmt::format("building {} for Verilator", key), -1.0);
      auto opened = VerilatorSimulator::open(summary_.plan.key, s_.folders,
                                             {.stall_seed = s_.stall_seed, .idle_limit = c_idle_limit});
      if (!opened) return opened.error();
      verilator.emplace(std::move(*opened));
      auto trace = TraceWriter::open(files_.trace("verilator"), key);
      if (!trace) return trace.error();
      verilator_trace.emplace(std::move(*trace));
    }
    std::optional<LaneSimulator> lanes;
    std::optional<TraceWriter> lanes_trace;
    RtlStream rtl_in_lanes(s_.size, scene_.background);
    if (s_.lanes) {
      if (const auto possible = use_lanes(RtlEngine::lanes, summary_.plan.key, 0.0); !possible)
        return possible.error();
      s_.on_progress(fmt::format("building {} in lanes", key), -1.0);
      auto opened = LaneSimulator::open(
          summary_.plan.key, s_.folders,
          {.threads = s_.threads, .idle_limit = c_idle_limit, .stall_seed = s_.stall_seed});
      if (!opened) return opened.error();
      lanes.emplace(std::move(*opened));
      auto trace = TraceWriter::open(files_.trace("lanes"), key);
      if (!trace) return trace.error();
      lanes_trace.emplace(std::move(*trace));
    }
    for (const std::string& held : setup->notes()) note(held);
    auto init_file = InitFileWriter::open(files_.init(), key, setup->init_bits());
    if (!init_file) return init_file.error();
    auto golden_trace = TraceWriter::open(files_.trace("golden"), key);
    if (!golden_trace) return golden_trace.error();

    SceneStream stream(*setup, summary_.plan.key, s_.threads);
    Cuts cuts(summary_.plan.key);
    std::optional<VerilatorFeed> feed;
    if (verilator) feed.emplace(*verilator, rtl, [&](auto drawn) { verilator_trace->write(drawn); });
    std::optional<LaneFeed> lane_feed;
    if (lanes) lane_feed.emplace(*lanes, rtl_in_lanes, [&](auto drawn) { lanes_trace->write(drawn); });
    for (Batch batch; stream.next(batch);) {
      s_.on_progress("setup, golden model, Verilator", batch.done);
      if (Status status = check_shadow_counts(scene_, stream); !status) return status;
      init_file->write(batch.init_words);
      if (s_.ghdl) cuts.add(batch.init_words);
      golden_trace->write(batch.golden);
      if (Status status = golden_.add(batch.golden); !status)
        return tool_failed(fmt::format("{}: setup made a fragment outside the frame: {}; please report it",
                                       scene_.name, status.error().message));
      if (lane_feed)
        if (Status status = lane_feed->add(batch.init_words, batch.golden); !status) return status;
      if (!feed) continue;
      rtl.add_golden(batch.golden);
      if (Status status = feed->add(batch.init_words); !status) return status;
    }
    if (feed)
      if (Status status = feed->finish(); !status) return status;
    if (Status status = init_file->commit(); !status) return status;
    if (Status status = golden_trace->commit(); !status) return status;
    summary_.setup = stream.counts();
    if (Status status = check_projection(scene_, stream); !status) return status;
    summary_.setup_seconds = stream.setup_seconds();
    summary_.golden_seconds = stream.golden_seconds();
    summary_.fragments = golden_.fragments();
    first_vectors_ = cuts.parts();
    if (feed)
      if (Status status = keep_run("verilator", rtl, feed->alive() ? &*verilator_trace : nullptr,
                                   verilator->cycles(), feed->seconds());
          !status)
        return status;
    // Lanes' clocks are not the stream's: each part of it runs from idle to idle.
    if (lane_feed)
      return keep_run("lanes", rtl_in_lanes, lane_feed->alive() ? &*lanes_trace : nullptr, std::nullopt,
                      lane_feed->seconds());
    return Ok{};
  }

  // What a simulator in this process leaves, but for its pictures. A run that was broken off has no trace,
  // which could pass for whole.
  Status keep_run(const std::string& simulator, RtlStream& rtl, TraceWriter* trace,
                  std::optional<std::uint64_t> cycles, double seconds) {
    if (trace != nullptr)
      if (Status status = trace->commit(cycles); !status) return status;
    SimulatorRun run = rtl.finish(simulator);
    run.cycles = cycles;
    run.seconds = seconds;
    drawn_.push_back({std::move(run), rtl.assembler().frame()});
    return Ok{};
  }

  Status draw_pictures(SimulatorRun& run, const Frame& frame) const {
    if (Status status = write_png(files_.frame(run.simulator), frame); !status) return status;
    return show_difference(run, frame);
  }

  // While the pictures' library loads, 0.3 s, no thread can be made: so GHDL's are made first.
  void wait_for_threads_of(const std::future<Result<SimulatorRun>>& ghdl) const {
    const auto threads = std::min<std::size_t>(s_.threads, first_vectors_.size());
    while (ghdl_begun_ < threads &&
           ghdl.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    }
  }

  // Beside the pictures of the others.
  Result<SimulatorRun> run_ghdl(const GhdlRunner& runner) {
    const std::string key = summary_.plan.key.name();
    std::error_code ignored;
    const auto golden_bytes =
        static_cast<double>(std::filesystem::file_size(files_.trace("golden"), ignored));
    GhdlRunOptions options;
    options.idle_limit = c_idle_limit;
    options.stall_seed = s_.stall_seed;
    options.max_fragments = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(summary_.fragments + c_most_surplus, std::uint64_t{0x7fffffff}));
    options.on_progress = [&](std::uintmax_t bytes) {
      s_.on_progress("GHDL", std::min(1.0, static_cast<double>(bytes) / golden_bytes));
    };
    options.on_begin = [&] { ++ghdl_begun_; };
    s_.on_progress("GHDL", 0.0);
    RtlStream rtl(s_.size, scene_.background);
    std::optional<TraceReader> golden;
    const auto begin = [&]() -> Status {
      auto opened = TraceReader::open(files_.trace("golden"), key);
      if (!opened) return opened.error();
      golden.emplace(std::move(*opened));
      return Ok{};
    };
    std::vector<Fragment> expected;
    const auto add_golden = [&](std::size_t most) -> Result<std::size_t> {
      expected.clear();
      const auto count = golden->read(expected, most);
      if (count) rtl.add_golden(expected);
      return count;
    };
    if (Status status = begin(); !status) return status.error();
    const auto ran =
        run_in_parts(runner, summary_.plan.key, files_.init(), first_vectors_, files_.trace("ghdl"), options,
                     s_.threads, [&](std::span<const Fragment> fragments) -> Status {
                       if (const auto read = add_golden(fragments.size()); !read) return read.error();
                       rtl.add(fragments);
                       return Ok{};
                     });
    if (!ran && ran.error().code != ExitCode::differs) return ran.error();
    if (!ran) {
      // What came before a fault is worth no more than the rest.
      rtl = RtlStream(s_.size, scene_.background);
      rtl.set_fault(ran.error().message);
      if (Status status = begin(); !status) return status.error();
    }
    for (std::size_t count = 1; count != 0;) {
      const auto read = add_golden(c_chunk);
      if (!read) return read.error();
      count = *read;
    }
    SimulatorRun run = rtl.finish("ghdl");
    run.parts = first_vectors_.size();
    if (ran) {
      run.cycles = ran->cycles;
      run.seconds = ran->seconds;
    }
    if (Status status = draw_pictures(run, rtl.assembler().frame()); !status) return status.error();
    return run;
  }

  Status show_difference(SimulatorRun& run, const Frame& frame) const {
    if (run.equal()) return Ok{};
    const auto difference = difference_image(golden_.frame(), frame);
    if (!difference) return difference.error();
    const std::filesystem::path path = files_.frame(fmt::format("mismatch-{}", run.simulator));
    if (Status status = write_png(path, *difference); !status) return status;
    run.evidence.push_back(path);
    return Ok{};
  }

  Status compare_with(const ReferenceImage& reference) {
    std::vector<std::uint8_t> mask = golden_.mask();
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= reference.mask[i];
    const auto distance = frame_distance(golden_.frame(), reference.frame, mask);
    if (!distance) return distance.error();
    summary_.accuracy = *distance;
    const auto difference = difference_image(golden_.frame(), reference.frame);
    if (!difference) return difference.error();
    if (Status status = write_png(files_.frame("reference"), reference.frame); !status) return status;
    return write_png(files_.frame("diff"), *difference);
  }

  Status keep_evidence(SimulatorRun& run) const {
    s_.on_progress("waveform", -1.0);
    auto path = write_mismatch_waveform(
        summary_.plan.key, s_.folders, files_, run.simulator,
        run.first.empty() ? std::nullopt : std::optional(run.first.front().index), s_.stall_seed);
    // The mismatch is what there is to tell; a waveform that cannot be had must not hide it.
    if (!path) {
      run.description +=
          fmt::format("  no waveform: {}\n", path.error().message.substr(0, path.error().message.find('\n')));
      return Ok{};
    }
    run.evidence.push_back(*path);
    return Ok{};
  }

  const Scene& scene_;
  const SimulateSettings& s_;
  ResultFiles files_;
  FrameAssembler golden_;
  std::vector<std::uint64_t> first_vectors_;           ///< of the parts in which GHDL draws
  std::atomic<std::size_t> ghdl_begun_ = 0;            ///< parts that have begun
  std::vector<std::pair<SimulatorRun, Frame>> drawn_;  ///< in this process
  SceneSummary summary_;
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

Status forget_summary(const ResultFiles& files, const std::function<void()>& on_wait) {
  std::error_code error;
  if (!std::filesystem::exists(files.summary(), error)) return Ok{};
  const auto lock = FolderLock::take(files.folder, on_wait);
  if (!lock) return lock.error();
  std::filesystem::remove(files.summary(), error);
  if (error)
    return tool_failed(fmt::format("{}: cannot remove: {}", files.summary().string(), error.message()));
  return Ok{};
}

Result<SceneSummary> simulate(const Scene& scene, const SimulateSettings& settings) {
  return Simulation(scene, settings).run();
}

namespace {

template <class Number>
nlohmann::ordered_json number_or_null(std::optional<Number> number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

// " tables 4/4", where the hardware has tables of another size than the project's own.
std::string unusual_tables(const HardwareKey& key) {
  const tables::CosineSizes sizes;
  const tables::CosineSize usual = (key.preset == Preset::exact ? sizes.exact : sizes.published).front();
  const TableSize size = key.spherical.tables;
  if (key.shader != Shader::spherical || !key.spherical.records() ||
      size == TableSize{usual.address_bits, usual.data_bits})
    return {};
  return fmt::format(", tables {}/{}", size.address_bits, size.data_bits);
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
      // JSON has no infinity: null where golden and reference are the same.
      {"accuracy",
       {{"psnr_db", std::isfinite(s.accuracy.psnr_db) ? nlohmann::ordered_json(s.accuracy.psnr_db) : nullptr},
        {"max_lsb", s.accuracy.max_lsb},
        {"percentile99_lsb", s.accuracy.percentile99},
        {"rms_lsb", s.accuracy.rms},
        {"pixels", s.accuracy.pixels},
        {"pixels_off", s.accuracy.off}}},
      {"setup",
       {{"back_facing", s.setup.projection.back_facing},
        {"behind_near", s.setup.projection.behind_near},
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
  // A scene's name is a file's, and any bytes.
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
          to, "{} cycles{}, {:.3f} a fragment, ", *run.cycles,
          run.parts > 1 ? fmt::format(" in {} parts", run.parts) : "",
          run.fragments == 0 ? 0.0 : static_cast<double>(*run.cycles) / static_cast<double>(run.fragments));
    if (run.fragments == 0 && run.equal())
      line += "nothing compared";
    else
      fmt::format_to(to, "{} mismatches", run.mismatches);
    if (run.seconds) fmt::format_to(to, ", {:.2f} s", *run.seconds);
  }
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
