// SPDX-License-Identifier: Apache-2.0
#include "sim/costs/savings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "common/to_integer.hpp"
#include "sim/costs/simulation_cost.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/csv.hpp"
#include "sim/system/page_part.hpp"
#include "sim/system/threads.hpp"

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

// Visit each number with its column name.
template <class Cost, class Visit>
void for_each_number(Cost& cost, const Visit& visit) {
  visit("luts", cost.luts);
  visit("flip_flops", cost.flip_flops);
  visit("memory_bits", cost.memory_bits);
  visit("multipliers", cost.multipliers);
  visit("cycles", cost.cycles);
}

// The first values of a line: the case and its hardware.
std::vector<std::string> label(const SavingsCase& which, bool all) {
  return {which.scene, to_string(which.shader), to_string(which.preset), all ? "all effects" : "called for"};
}

Table table_of(const SavingsCase& which, bool all, const HardwareCost& cost) {
  Table table{{"scene", "shader", "preset", "effects", "hardware"}, {label(which, all)}};
  table.rows[0].push_back(cost.key);
  for_each_number(cost, [&](const char* name, std::uint64_t number) {
    table.columns.emplace_back(name);
    table.rows[0].push_back(std::to_string(number));
  });
  return table;
}

Result<HardwareCost> measure(const SavingsCase& which, bool all, const SimulatorFolders& folders) {
  const auto scene = load_scene(which.scene, folders.source / "sim" / "scenes");
  if (!scene) return scene.error();
  const auto plan = plan_scene(*scene, which.request());
  if (!plan) return plan.error();
  const HardwareKey& key = all ? plan->everything : plan->called_for;
  const auto counter = CellCounter::open(folders);
  if (!counter) return counter.error();
  const auto cells = counter->count(key);
  if (!cells) return cells.error();
  CostSettings settings;
  settings.size = which.size();
  settings.ghdl = false;
  settings.folders = folders;
  const auto frame = simulation_cost(*scene, key, settings);
  if (!frame) return frame.error();
  return HardwareCost{key.name(),         cells->luts,        cells->flip_flops,
                      cells->memory_bits, cells->multipliers, frame->cycles};
}

// 58298 as "58 298".
std::string spaced(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3 && text.size() > 4;) text.insert(at -= 3, 1, ' ');
  return text;
}

std::string both(const Savings& s, std::uint64_t HardwareCost::*number) {
  return fmt::format("{} / {}", spaced(s.called_for.*number), spaced(s.everything.*number));
}

std::string saved(const Savings& s, std::uint64_t HardwareCost::*number) {
  const auto few = static_cast<double>(s.called_for.*number), all = static_cast<double>(s.everything.*number);
  return fmt::format("{:.0f} %", 100 * (1 - few / all));
}

}  // namespace

FrameSize SavingsCase::size() const {
  return shader == Shader::processors ? FrameSize{320, 240} : FrameSize{640, 480};
}

std::span<const SavingsCase> savings_cases() {
  return c_cases;
}

Result<std::vector<Savings>> measure_savings(const SimulatorFolders& folders, unsigned threads,
                                             const std::function<void(const std::string&)>& on_line) {
  std::vector<Savings> savings(c_cases.size());
  std::mutex mutex;
  std::size_t done = 0;
  // Largest hardware last.
  const std::size_t jobs = 2 * c_cases.size();
  Status measured = for_each_on_threads(threads, jobs, [&](std::size_t at) -> Status {
    const std::size_t job = jobs - 1 - at, which = job / 2;
    const bool all = job % 2 != 0;
    auto cost = measure(c_cases[which], all, folders);
    if (!cost) return cost.error();
    const std::scoped_lock lock(mutex);
    on_line(fmt::format("[{}/{}] {}\n", ++done, jobs,
                        fmt::join(table_of(c_cases[which], all, *cost).rows[0], ",")));
    (all ? savings[which].everything : savings[which].called_for) = std::move(*cost);
    return Ok{};
  });
  if (!measured) return measured.error();
  return savings;
}

std::string to_csv(std::span<const Savings> savings) {
  Table table;
  for (std::size_t i = 0; i < savings.size(); ++i)
    for (const bool all : {false, true}) {
      Table line = table_of(c_cases[i], all, all ? savings[i].everything : savings[i].called_for);
      table.columns = std::move(line.columns);
      table.rows.push_back(std::move(line.rows[0]));
    }
  return to_csv(table);
}

Result<std::vector<Savings>> read_savings(const std::filesystem::path& csv) {
  const auto table = read_csv(csv);
  if (!table) return table.error();
  std::vector<Savings> savings(c_cases.size());
  for (std::size_t row = 0; row < 2 * savings.size(); ++row) {
    const bool all = row % 2 != 0;
    const std::vector<std::string> begin = label(c_cases[row / 2], all);
    HardwareCost& cost = all ? savings[row / 2].everything : savings[row / 2].called_for;
    bool right =
        row < table->rows.size() && std::ranges::mismatch(begin, table->rows[row]).in1 == begin.end();
    for_each_number(cost, [&](const char* name, std::uint64_t& number) {
      const auto value = right ? table->number(row, name) : std::nullopt;
      right = value && *value >= 0;
      if (right) number = to_integer<std::uint64_t>(*value);
    });
    if (!right)
      return bad_input(fmt::format("{}:{}: expected a line '{},…'; make savings writes the file",
                                   csv.string(), row + 2, fmt::join(begin, ",")));
    cost.key = table->text(row, "hardware");
  }
  return savings;
}

Result<std::string> with_savings(const std::string& readme, std::span<const Savings> savings) {
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
  const auto text = with_page_part(readme, "savings", table);
  return text ? with_page_part(*text, "savings of processors", processors) : text;
}

}  // namespace halfway
