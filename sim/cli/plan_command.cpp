// SPDX-License-Identifier: Apache-2.0
// `halfway plan`: the hardware that a scene needs, the reasons, and the savings compared with all effects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "common/to_integer.hpp"
#include "frame/assemble.hpp"
#include "frame/metrics.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "plan/processor_clocks.hpp"
#include "projection/project.hpp"
#include "reference/renderer.hpp"
#include "setup/setup.hpp"
#include "sim/cli/options.hpp"
#include "sim/cost/cost.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/hardware_units.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/printable.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/simulation_cost.hpp"

namespace halfway::cli {
namespace {

struct PlanCommand {
  DrawOptions draw;
  std::string scene;
  bool measure = false;
  std::vector<std::string> simulators;
  std::optional<std::uint64_t> objects, rate;
  std::string netlist;  // file to write; empty: none
  const synth::Family* family = &synth::c_default_family;
};

using CellsByKey = std::map<std::string, Cells>;

// Entities in the netlists of a plan.
struct PlanUnits {
  UnitCounts called_for, everything;
  std::vector<UnitCounts> effects;  // in the plan's order
};

PlanUnits count_units(const Plan& plan, UnitCounter& counter) {
  PlanUnits units{.called_for = counter.count(plan.called_for),
                  .everything = counter.count(plan.everything),
                  .effects = {}};
  for (const PlannedEffect& effect : plan.effects) units.effects.push_back(counter.count(plan.key, effect));
  return units;
}

std::string units_text(const UnitCounts& units) {
  std::string text;
  for (const auto& [unit, count] : units)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, unit);
  return text;
}

// The cost of an effect: the difference in cells of the two keys.
std::string cells_text(const PlannedEffect& effect, const HardwareKey& key, const CellsByKey& cells) {
  const auto other = effect.other ? cells.find(effect.other->name()) : cells.end();
  if (other == cells.end()) return {};
  const Cells here = cells.at(key.name()), there = other->second;
  const auto difference = [&](std::uint64_t a, std::uint64_t b) {
    return (effect.elaborated ? 1 : -1) * (static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b));
  };
  std::string text = fmt::format(": {} LUTs, {} flip-flops", difference(here.luts, there.luts),
                                 difference(here.flip_flops, there.flip_flops));
  if (const auto n = difference(here.multipliers, there.multipliers); n != 0)
    text += fmt::format(", {} multipliers", n);
  if (const auto bits = difference(here.memory_bits, there.memory_bits); bits != 0)
    text += fmt::format(", {} bits of memory", bits);
  return text;
}

void print_effects(const Plan& plan, const std::optional<PlanUnits>& units, const CellsByKey& cells) {
  fmt::print("{:<23} {:<4} {:<9} {}\n", "effect", "", "done by", "why, and how");
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    const PlannedEffect& e = plan.effects[i];
    const char* by = e.by == DoneBy::hardware ? "hardware" : e.by == DoneBy::host ? "host" : "-";
    const bool done = e.called_for || e.elaborated || e.by == DoneBy::none;
    fmt::print("{:<23} {:<4} {:<9} {}{}{}\n", to_string(e.effect), e.called_for ? "yes" : "no", by,
               printable(e.why), done && !e.how.empty() ? "; " : "", done ? e.how : "");
    if (!units || units->effects[i].empty()) continue;
    const char* there = !e.elaborated ? "left out: " : e.called_for ? "" : "not needed, but present: ";
    fmt::print("{:<38} {}{}{}\n", "", there, units_text(units->effects[i]), cells_text(e, plan.key, cells));
  }
}

std::string saved(double called_for, double everything) {
  if (everything <= 0.0) return {};
  return fmt::format("{} %", to_integer<int>(std::round(100.0 * (1.0 - called_for / everything))));
}

void print_row(const std::string& name, const std::string& called_for, const std::string& everything,
               const std::string& saving) {
  fmt::print("{:<38} {:>14} {:>14} {:>8}\n", name, called_for, everything, saving);
}
void print_counts(const std::string& name, std::uint64_t called_for, std::uint64_t everything) {
  print_row(name, std::to_string(called_for), std::to_string(everything),
            saved(static_cast<double>(called_for), static_cast<double>(everything)));
}

void print_units(const PlanUnits& units) {
  print_row("units", "as needed", "all effects", "saved");
  for (const auto& [unit, count] : units.everything) {
    const auto it = units.called_for.find(unit);
    print_counts("  " + unit, it == units.called_for.end() ? 0 : static_cast<std::uint64_t>(it->second),
                 static_cast<std::uint64_t>(count));
  }
}

// As options of GHDL, without the hyphen.
std::string generics_text(const HardwareKey& key) {
  std::string text;
  for (const auto& [name, value] : key.generics()) text += fmt::format(" {}={}", name, value);
  return text;
}

HardwareKey of_degree(HardwareKey key, int degree) {
  key.degree = degree;
  return key;
}

// Counts the cells of all keys in parallel: each takes seconds, or minutes for many lights.
CellsByKey count_all(const Plan& plan, const SimulatorFolders& folders, unsigned threads,
                     Progress& progress) {
  std::vector<HardwareKey> keys;
  std::set<std::string> names;
  const auto add = [&](const HardwareKey& key) {
    if (names.insert(key.name()).second) keys.push_back(key);
  };
  add(plan.called_for);
  add(plan.everything);
  for (const PlannedEffect& e : plan.effects)
    if (e.other) add(*e.other);
  if (plan.key.shader == Shader::quadratic)
    for (const int degree : {1, 2}) add(of_degree(plan.key, degree));

  const synth::Synthesizer synthesizer = synth::Synthesizer::open(folders.cache, false);
  progress.show(fmt::format("Yosys synthesizes {} netlists", keys.size()));
  std::mutex mutex;
  CellsByKey cells;
  must_for_each(threads, keys.size(), [&](std::size_t i) {
    const Cells counted = synthesizer.generic_cells(synth::design_of(keys[i], folders.source));
    const std::scoped_lock lock(mutex);
    cells[keys[i].name()] = counted;
  });
  return cells;
}

void print_seconds(const std::string& simulator, std::optional<double> called_for,
                   std::optional<double> everything) {
  if (!called_for || !everything) return;
  print_row("processor seconds in " + simulator, fmt::format("{:.4g}", *called_for),
            fmt::format("{:.4g}", *everything), saved(*called_for, *everything));
}

void print_measured(const Plan& plan, const CellsByKey& cells, const SimulationCost& called_for,
                    const SimulationCost& everything, bool same) {
  fmt::print("\n");
  print_row("measured", "as needed", "all effects", "saved");
  const Cells few = cells.at(plan.called_for.name()), all = cells.at(plan.everything.name());
  print_counts("LUTs of 4 inputs (Yosys, flattened)", few.luts, all.luts);
  if (all.multipliers != 0) {
    print_counts("multipliers, none of them in LUTs", few.multipliers, all.multipliers);
    print_counts("  bits of their products", few.product_bits, all.product_bits);
  }
  print_counts("flip-flops", few.flip_flops, all.flip_flops);
  if (all.memory_bits != 0) print_counts("bits of memory", few.memory_bits, all.memory_bits);
  print_counts("cycles", called_for.cycles, everything.cycles);
  print_seconds("GHDL", called_for.ghdl_seconds, everything.ghdl_seconds);
  print_seconds("Verilator", called_for.verilator_seconds, everything.verilator_seconds);
  fmt::print("the two frames {}, {} and {} fragments\n", same ? "are equal bit for bit" : "DIFFER",
             called_for.fragments, everything.fragments);
}

// The same for the pipelines that the scene needs, with the clocks of their slowest processor.
void print_own_processors(const Scene& scene, const ShadingLoad& load) {
  fmt::print(
      "as measured (table 4), of the pipeline that the scene calls for\n  {:<10} {:<9} {:<36} {:>6}  {:<20} "
      "{}\n",
      "preset", "form", "slowest processor", "clocks", "pipelines", "processors");
  for (const Preset preset : {Preset::published, Preset::exact}) {
    const auto plan = plan_scene(scene, {.shader = Shader::processors, .preset = preset});
    if (!plan) {
      fmt::print("  none: {}\n", plan.error().message);
      return;
    }
    const HardwareKey& key = plan->called_for;
    const ProcessorClocks& slowest = slowest_processor(key);
    const auto row = [&](ProcessorForm form, const char* what, unsigned clocks) {
      const auto per_pipeline = static_cast<std::uint64_t>(processors_config(key).processors());
      const PipelineCount n = count_pipelines(clocks, per_pipeline, load);
      fmt::print("  {:<10} {:<9} {:<36} {:>6}  {:<20} {} ({} a pipeline)\n", to_string(preset),
                 to_string(form), what, clocks, fmt::format("{} ({:.2f})", n.pipelines, n.pipelines_needed),
                 n.processors(), n.per_pipeline);
    };
    row(ProcessorForm::folded, slowest.what, *slowest.clocks(preset));
    row(ProcessorForm::unrolled, "all alike", 1);
  }
}

// The fewest object processors that draw the scene: those of strips that are as narrow as possible.
std::uint64_t fewest_object_processors(const Scene& scene, const DrawSettings& draw, HardwareKey key) {
  key.processors.objects = 1;
  std::vector<std::uint32_t> words;
  SetupCounts counts;
  make_setup(scene, draw.size, key, draw.setup)->append_prologue(words, counts);
  return counts.objects;
}

// The same with the objects that the chain of object processors lets through, instead of O objects at each
// pixel.
void print_measured_processors(const Scene& scene, const DrawSettings& draw, const HardwareKey& key,
                               ShadingLoad load) {
  const FrameStream stream = must(whole_stream(
      scene, draw.size, key,
      {.setup = draw.setup, .golden = GoldenDraws::nothing, .workers = on_threads(draw.threads)}));
  const std::uint64_t objects = count_objects(key, stream.words);
  fmt::print(
      "measured behind {} object processors, {} subpixel{}: {} objects a frame, O = {:.3f}; "
      "the scene needs {} object processors\n",
      key.processors.objects, key.processors.subpixels, key.processors.subpixels == 1 ? "" : "s", objects,
      static_cast<double>(objects) / static_cast<double>(load.pixels),
      fewest_object_processors(scene, draw, key));
  load.pixels = objects;  // M O
  load.objects = 1;
  for (const ProcessorVersion version : {ProcessorVersion::one, ProcessorVersion::two}) {
    const ProcessorCount n = count_processors(version, load);
    fmt::print("  version {}, with this O: {} ({:.2f}) pipelines, {} processors\n",
               version == ProcessorVersion::one ? "I" : "II", n.pipelines, n.pipelines_needed,
               n.processors());
  }
  print_own_processors(scene, load);
}

// Table 5 of the processors paper.
ShadingLoad print_processors(const Scene& scene, const PlanCommand& command, FrameSize size) {
  const SceneCalls calls = calls_of(scene);
  ShadingLoad load;
  load.pixels = std::uint64_t{size.width} * size.height;
  load.frames = command.rate.value_or(30);
  load.objects = command.objects.value_or(1);
  load.directional = calls.count(LightKind::directional);
  load.positional = calls.count(LightKind::positional) + calls.count(LightKind::spot);
  fmt::print(
      "\nshading processors (processors paper, table 5): M = {} pixels, {} frames a second, O = {} objects a "
      "pixel,\nR = {} directional lights, P = {} positional ones (spots among them), a cycle of dt = {} ns\n",
      load.pixels, load.frames, load.objects, load.directional, load.positional, c_processor_cycle_ns);
  for (const ProcessorVersion version : {ProcessorVersion::one, ProcessorVersion::two}) {
    const bool one = version == ProcessorVersion::one;
    const ProcessorCount n = count_processors(version, load);
    fmt::print("version {}{}\n", one ? "I, without normalization" : "II, with it and positional lights",
               one && load.positional != 0 ? " and without the positional lights" : "");
    const auto row = [](const std::string& what, const std::string& formula, const std::string& value) {
      fmt::print("  {:<28} {:<24} {}\n", what, formula, value);
    };
    row("a pixel in a pipeline", one ? "7 O dt" : "13 O dt", fmt::format("{} ns", n.pipeline_ns));
    row("its terms one after another", one ? "(14 R + 4) O dt" : "(14 R + 26 P + 6) O dt",
        fmt::format("{} ns", n.single_ns));
    const std::string p = fmt::format("{} M {} O dt", load.frames, pipeline_clocks(version));
    row("pipelines side by side, p", p, fmt::format("{} ({:.2f})", n.pipelines, n.pipelines_needed));
    row("processors", one ? "p (2 R + 1)" : "p (2 R + 2 P + 1)",
        fmt::format("{} ({} a pipeline)", n.processors(), n.per_pipeline));
    if (n.published_pipelines && *n.published_pipelines != n.pipelines)
      row("as the paper rounds", fmt::format("a pixel due in {} ns", *n.published_due_ns),
          fmt::format("{} pipelines, {} processors", *n.published_pipelines,
                      *n.published_pipelines * n.per_pipeline));
  }
  print_own_processors(scene, load);
  return load;
}

// A scene in the quadratic shader of a degree: what setup makes of it, and the golden model's frame.
struct DegreeFrame {
  SetupCounts counts;
  FrameDistance error{};  // from the reference, over the pixels that either covers
};
DegreeFrame draw_degree(const Scene& scene, const ReferenceImage& reference, const HardwareKey& key,
                        const QuadraticSetupOptions& options) {
  FrameDriver driver(scene, reference.frame.size, key, {},
                     {.setup = {.quadratic = options}, .golden_picture = true});
  must(driver.draw());
  const FrameAssembler& drawn = driver.golden_frame();
  std::vector<std::uint8_t> mask = drawn.mask();
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= reference.mask[i];
  return {driver.counts(), must(frame_distance(drawn.frame(), reference.frame, mask))};
}

void print_errors(const std::string& which, const FrameDistance& planes, const FrameDistance& quadratics) {
  print_row("rms error, steps of 1/255, " + which, fmt::format("{:.3g}", planes.rms),
            fmt::format("{:.3g}", quadratics.rms), "");
  print_row("largest error, " + which, std::to_string(planes.max_lsb), std::to_string(quadratics.max_lsb),
            "");
}

// The stored clocks, without placement.
void print_clocks(const HardwareKey& planes, const HardwareKey& quadratics, const SimulatorFolders& folders,
                  const synth::Family& family) {
  const auto text = [&](const HardwareKey& key) -> std::string {
    const auto figures =
        caught([&] { return synth::Costing(folders, family).stored(synth::design_of(key, folders.source)); });
    return figures && figures->mhz ? fmt::format("{:.1f}", *figures->mhz) : "-";
  };
  print_row(fmt::format("stored clock, MHz, {}", family.device->title), text(planes), text(quadratics), "");
}

// Quadratics and planes: for which triangles a plane is enough, what either costs, and their errors.
void print_degrees(const Scene& scene, const DrawSettings& draw, const HardwareKey& key,
                   const CellsByKey& cells, const SimulatorFolders& folders, const synth::Family& family) {
  QuadraticSetupOptions options = draw.setup.quadratic, whole = options;
  if (options.test == HighlightTest::none) options.max_level = 0;
  whole.test = options.test = HighlightTest::conservative;
  whole.max_level = 0;
  const HardwareKey planes = of_degree(key, 1), quadratics = of_degree(key, 2);
  const ReferenceImage reference =
      render_reference(scene, Projector(scene, draw.size, {}).project_all(), {.frame = draw.size});
  const auto draw_by = [&](const HardwareKey& of, const QuadraticSetupOptions& how) {
    return draw_degree(scene, reference, of, how);
  };
  const DegreeFrame whole_planes = draw_by(planes, whole), whole_quadratics = draw_by(quadratics, whole),
                    split_planes = draw_by(planes, options), split_quadratics = draw_by(quadratics, options);
  const SetupCounts& unsplit = whole_planes.counts;
  const SetupCounts &few = split_planes.counts, &all = split_quadratics.counts;
  const std::uint64_t enough = unsplit.leaves - unsplit.unresolved;
  fmt::print(
      "\nplanes (--degree 1, Gouraud's shading) at {}x{}: {} of {} triangles are within {} steps, {}\n",
      draw.size.width, draw.size.height, enough, unsplit.leaves, options.threshold,
      enough == unsplit.leaves ? "so planes are enough" : "so the others are split");
  print_row("", "planes", "quadratics", "saved");
  const auto bits = [&](const HardwareKey& of) { return std::uint64_t{make_golden_model(of)->init_bits()}; };
  print_counts("bits of an init vector", bits(planes), bits(quadratics));
  print_counts("init vectors", few.vectors, all.vectors);
  print_counts("bits of all init vectors", few.vectors * bits(planes), all.vectors * bits(quadratics));
  print_counts("samples shaded", few.shaded, all.shaded);
  print_counts("pieces above the threshold", few.unresolved, all.unresolved);
  print_errors("never split", whole_planes.error, whole_quadratics.error);
  print_errors("split", split_planes.error, split_quadratics.error);
  print_clocks(planes, quadratics, folders, family);
  const std::uint64_t mixed = enough * bits(planes) + unsplit.unresolved * bits(quadratics);
  fmt::print(
      "With a plane for each triangle that planes draw within the threshold, and a quadratic for each other\n"
      "one, none split, the init vectors have {} fewer bits than with quadratics only. The host shades the\n"
      "same samples: the test needs all six. Hardware of degree 2 draws a plane if its second differences\n"
      "are zero.\n",
      saved(static_cast<double>(mixed), static_cast<double>(unsplit.leaves * bits(quadratics))));
  if (cells.empty()) return;
  print_counts("LUTs of 4 inputs", cells.at(planes.name()).luts, cells.at(quadratics.name()).luts);
  print_counts("flip-flops", cells.at(planes.name()).flip_flops, cells.at(quadratics.name()).flip_flops);
}

int run(const Folders& folders, const PlanCommand& command) {
  const DrawSettings draw = checked(command.draw);
  constexpr EngineKind c_measured[] = {EngineKind::ghdl, EngineKind::verilator};
  const std::vector<EngineKind> simulators = checked_simulators(command.simulators, c_measured);
  const Scene scene = must(load_scene(command.scene, folders.scenes()));
  const Plan plan = must(plan_scene(scene, draw.plan));
  const SimulatorFolders simulator_folders{folders.source, folders.cache()};
  // Without GHDL the plan has no units.
  auto counter = UnitCounter::open(simulator_folders);
  std::optional<PlanUnits> units;
  if (counter) units = count_units(plan, *counter);

  CellsByKey cells;
  SimulationCost called_for, everything;
  if (command.measure) {
    Progress progress(scene.name);
    cells = count_all(plan, simulator_folders, draw.threads, progress);
    const CostSettings settings{.size = draw.size,
                                .setup = draw.setup,
                                .threads = draw.threads,
                                .ghdl = std::ranges::count(simulators, EngineKind::ghdl) != 0,
                                .verilator = std::ranges::count(simulators, EngineKind::verilator) != 0,
                                .folders = simulator_folders,
                                .on_progress = [&](const std::string& what) { progress.show(what); }};
    called_for = simulation_cost(scene, plan.called_for, settings);
    everything = simulation_cost(scene, plan.everything, settings);
  }
  if (!command.netlist.empty()) must(write_file(command.netlist, netlist_of(plan.key, simulator_folders)));

  fmt::print(
      "scene {}, shader {}, preset {}\n  as needed      {}\n  all effects    {}\n  generics      {}\n\n",
      printable(scene.name), to_string(plan.key.shader), to_string(plan.key.preset), plan.called_for.name(),
      plan.everything.name(), generics_text(plan.key));
  print_effects(plan, units, cells);
  fmt::print("\n");
  if (units)
    print_units(*units);
  else
    fmt::print("units are not counted: {}\n", counter.error().message);
  const bool same =
      called_for.frame.rgb == everything.frame.rgb && called_for.fragments == everything.fragments;
  if (command.measure) print_measured(plan, cells, called_for, everything, same);
  if (plan.key.shader == Shader::quadratic)
    print_degrees(scene, draw, plan.key, cells, simulator_folders, *command.family);
  if (command.objects || command.rate) {
    const ShadingLoad load = print_processors(scene, command, draw.size);
    if (plan.key.processors.objects > 0) print_measured_processors(scene, draw, plan.key, load);
  }
  return static_cast<int>(same ? ExitCode::equal : ExitCode::differs);
}

}  // namespace

void add_plan(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub = app.add_subcommand("plan", "list the hardware that a scene needs, with reasons");
  auto command = std::make_shared<PlanCommand>();
  sub->add_option("scene", command->scene, "as for sim")->required();
  command->draw.add_to(*sub);
  sub->add_flag(
      "--measure", command->measure,
      "count cells by Yosys, and cycles and seconds by simulation, for the scene and with all effects;\n"
      "also the cells of each effect. Takes minutes for shading processors, longer for ten lights");
  sub->add_option("--simulator", command->simulators, "for --measure: ghdl or verilator (default: both)");
  sub->add_option("--objects-per-pixel", command->objects,
                  "objects per pixel, for the number of processors (processors paper, table 5)")
      ->check(CLI::Range(1, 1000));
  sub->add_option("--rate", command->rate, "frames per second, for the same table (default: 30)")
      ->check(CLI::Range(1, 1000));
  add_device(*sub, command->family);
  sub->add_option("--netlist", command->netlist,
                  "file to write: the planned hardware as Verilog, GHDL's netlist with its faults repaired");
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli
