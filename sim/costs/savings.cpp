// SPDX-License-Identifier: Apache-2.0
#include "sim/costs/savings.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <mutex>
#include <string_view>

#include "sim/costs/simulation_cost.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/file.hpp"
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

constexpr const char* c_head =
    "scene,shader,preset,effects,hardware,luts,flip_flops,memory_bits,multipliers,cycles\n";

template <class Cost, class Visit>
void for_each_number(Cost& cost, const Visit& visit) {
  for (auto* number : {&cost.luts, &cost.flip_flops, &cost.memory_bits, &cost.multipliers, &cost.cycles})
    visit(*number);
}

std::string label(const SavingsCase& which, bool all) {
  return fmt::format("{},{},{},{}", which.scene, to_string(which.shader), to_string(which.preset),
                     all ? "all effects" : "called for");
}

std::string line_of(const SavingsCase& which, bool all, const HardwareCost& cost) {
  std::string line = label(which, all) + "," + cost.key;
  for_each_number(cost, [&](std::uint64_t number) { line += fmt::format(",{}", number); });
  return line + "\n";
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

Result<HardwareCost> read_cost(std::string_view line, const std::string& begin) {
  const auto wrong = [&] {
    return bad_input("wants a line '" + begin + ",…'; write it anew with make savings");
  };
  if (!line.starts_with(begin + ",")) return wrong();
  line.remove_prefix(begin.size() + 1);
  HardwareCost cost;
  cost.key = line.substr(0, line.find(','));
  line.remove_prefix(cost.key.size());
  bool right = true;
  for_each_number(cost, [&](std::uint64_t& number) {
    if (!line.starts_with(',')) right = false;
    if (!right) return;
    const auto [end, error] = std::from_chars(line.data() + 1, line.data() + line.size(), number);
    right = error == std::errc();
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  });
  if (!right || !line.empty()) return wrong();
  return cost;
}

// 58298 as "58 298".
std::string spaced(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3 && text.size() > 4;) text.insert(at -= 3, " ");
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
  // The largest hardware stands last.
  const std::size_t jobs = 2 * c_cases.size();
  Status measured = for_each_on_threads(threads, jobs, [&](std::size_t at) -> Status {
    const std::size_t job = jobs - 1 - at, which = job / 2;
    const bool all = job % 2 != 0;
    auto cost = measure(c_cases[which], all, folders);
    if (!cost) return cost.error();
    const std::scoped_lock lock(mutex);
    on_line(fmt::format("[{}/{}] {}", ++done, jobs, line_of(c_cases[which], all, *cost)));
    (all ? savings[which].everything : savings[which].called_for) = std::move(*cost);
    return Ok{};
  });
  if (!measured) return measured.error();
  return savings;
}

std::string to_csv(std::span<const Savings> savings) {
  std::string text = c_head;
  for (std::size_t i = 0; i < savings.size(); ++i)
    for (const bool all : {false, true})
      text += line_of(c_cases[i], all, all ? savings[i].everything : savings[i].called_for);
  return text;
}

Result<std::vector<Savings>> read_savings(const std::filesystem::path& csv) {
  auto reader = LineReader::open(csv);
  if (!reader) return reader.error();
  std::vector<Savings> savings(c_cases.size());
  std::string_view line;
  const auto next = [&] {
    line = {};
    return reader->next(line) != LineReader::Next::failed;
  };
  if (!next()) return reader->error();
  for (std::size_t i = 0; i < savings.size(); ++i)
    for (const bool all : {false, true}) {
      if (!next()) return reader->error();
      auto read = read_cost(line, label(c_cases[i], all));
      if (!read) return reader->at(read.error().message);
      (all ? savings[i].everything : savings[i].called_for) = std::move(*read);
    }
  return savings;
}

Result<std::string> with_savings(const std::string& readme, std::span<const Savings> savings) {
  std::string table =
      "| scene | shader | LUTs of 4 inputs, as called for | with all effects | saved | flip-flops saved |\n"
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
