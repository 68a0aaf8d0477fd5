// SPDX-License-Identifier: Apache-2.0
#include "sim/study/savings.hpp"

#include <fmt/format.h>

#include <mutex>

#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/page_part.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/simulation_cost.hpp"

namespace halfway {
namespace {

constexpr std::array c_cases = {
    SavingsCase{"matte", "grey, no highlights", Shader::quadratic, Preset::exact},
    SavingsCase{"matte", "", Shader::spherical, Preset::published},
    SavingsCase{"spheres", "white highlights", Shader::spherical, Preset::published},
    SavingsCase{"teapot", "two lights, one exponent", Shader::spherical, Preset::exact},
    SavingsCase{"matte", "", Shader::processors, Preset::exact},
    SavingsCase{"matte", "", Shader::processors, Preset::published},
    SavingsCase{"spheres", "", Shader::processors, Preset::exact},
    SavingsCase{"spheres", "", Shader::processors, Preset::published},
};

HardwareCost measure(const SavingsCase& which, bool all, const SimulatorFolders& folders) {
  const Scene scene = must(load_scene(which.scene, folders.source / "sim" / "scenes"));
  const auto plan = must(plan_scene(scene, PlanRequest{.shader = which.shader, .preset = which.preset}));
  const HardwareKey& key = all ? plan.everything : plan.called_for;
  const Cells cells =
      synth::Synthesizer::open(folders.cache, false).generic_cells(synth::design_of(key, folders.source));
  const FrameSize size = which.shader == Shader::processors ? FrameSize{320, 240} : FrameSize{640, 480};
  CostSettings settings;
  settings.size = size;
  settings.ghdl = false;
  settings.folders = folders;
  return {cells, simulation_cost(scene, key, settings).cycles};
}

// 58298 as "58 298".
std::string spaced(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3 && text.size() > 4;) text.insert(at -= 3, 1, ' ');
  return text;
}

std::string both(const Savings& s, std::uint64_t HardwareCost::* number) {
  return fmt::format("{} / {}", spaced(s.called_for.*number), spaced(s.everything.*number));
}

std::string saved(const Savings& s, std::uint64_t HardwareCost::* number) {
  const auto few = static_cast<double>(s.called_for.*number), all = static_cast<double>(s.everything.*number);
  return fmt::format("{:.0f} %", 100 * (1 - few / all));
}

}  // namespace

std::span<const SavingsCase> savings_cases() {
  return c_cases;
}

std::vector<Savings> measure_savings(const SimulatorFolders& folders, unsigned threads,
                                     const std::function<void(const std::string&)>& on_line) {
  std::vector<Savings> savings(c_cases.size());
  std::mutex mutex;
  std::size_t done = 0;
  // Largest hardware first.
  const std::size_t jobs = 2 * c_cases.size();
  must_for_each(threads, jobs, [&](std::size_t at) {
    const std::size_t job = jobs - 1 - at;
    const SavingsCase& which = c_cases[job / 2];
    const bool all = job % 2 != 0;
    const HardwareCost cost = measure(which, all, folders);
    const std::scoped_lock lock(mutex);
    on_line(fmt::format("[{}/{}] {}, {}, {}, {}: {} LUTs, {} flip-flops, {} cycles\n", ++done, jobs,
                        which.scene, to_string(which.shader), to_string(which.preset),
                        all ? "all effects" : "as needed", cost.luts, cost.flip_flops, cost.cycles));
    (all ? savings[job / 2].everything : savings[job / 2].called_for) = cost;
  });
  return savings;
}

std::string with_savings(const std::string& page, std::span<const Savings> savings) {
  std::string table =
      "| scene | shader | LUTs of 4 inputs, as needed | with all effects | saved | flip-flops saved |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  std::string processors =
      "| scene, preset | LUTs of 4 inputs | multipliers | flip-flops | bits of memory | cycles |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (std::size_t i = 0; i < savings.size(); ++i) {
    const SavingsCase& which = c_cases[i];
    const Savings& s = savings[i];
    if (which.shader == Shader::processors) {
      processors += fmt::format("| `{}`, `{}` | {} | {} | {} | {} | {} |\n", which.scene,
                                to_string(which.preset), both(s, &HardwareCost::luts),
                                both(s, &HardwareCost::multipliers), both(s, &HardwareCost::flip_flops),
                                both(s, &HardwareCost::memory_bits), both(s, &HardwareCost::cycles));
      continue;
    }
    const std::string what = which.what[0] == '\0' ? "" : fmt::format(": {}", which.what);
    table += fmt::format("| `{}`{} | {}{} | {} | {} | {} | {} |\n", which.scene, what,
                         to_string(which.shader), which.preset == Preset::published ? ", `published`" : "",
                         spaced(s.called_for.luts), spaced(s.everything.luts), saved(s, &HardwareCost::luts),
                         saved(s, &HardwareCost::flip_flops));
  }
  return must(
      with_page_part(must(with_page_part(page, "savings", table)), "savings of processors", processors));
}

}  // namespace halfway
