// SPDX-License-Identifier: Apache-2.0
// Section with the frames drawn by `sim`, the summaries of the runs, and the effects that each scene uses.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "plan/plan.hpp"
#include "sim/engines/ghdl/hardware_units.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"
#include "sim/run/result_files.hpp"

namespace halfway::report {
namespace {

constexpr std::array c_layers = {std::pair{"reference", "reference"}, std::pair{"golden", "golden model"},
                                 std::pair{"ghdl", "RTL in GHDL"}, std::pair{"verilator", "RTL in Verilator"},
                                 std::pair{"diff", "difference"}};

// The folders in a folder, sorted by name.
std::vector<std::filesystem::path> folders_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.is_directory()) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

std::string number(const Json& value, const char* format) {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "–";
}

struct Images {
  Json uris = Json::array();
  std::map<std::string, std::size_t> numbers;  // equal files are stored once

  std::size_t add(const std::filesystem::path& file) {
    auto uri = data_uri(file, "image/png");
    const auto [it, is_new] = numbers.emplace(uri, uris.size());
    if (is_new) uris.push_back(std::move(uri));
    return it->second;
  }
};

// A value of a simulator's run; "–" if the simulator did not run or could not measure it.
std::string figure(const Json& runs, const char* simulator, const char* name) {
  for (const Json& run : runs)
    if (run.value("simulator", "") == simulator && !run.at(name).is_null()) return run.at(name).dump();
  return "–";
}

// A run as a row of the table.
Json run_of(const std::string& scene, const std::string& shader, const Json& summary) {
  Json run = {{"scene", scene}, {"shader", shader}};
  for (const char* key : {"preset", "width", "height", "triangles", "fragments"}) run[key] = summary.at(key);
  for (const char* simulator : {"ghdl", "verilator"})
    for (const char* name : {"cycles", "mismatches"})
      run[simulator][name] = figure(summary.at("runs"), simulator, name);
  run["psnr_db"] = number(summary.at("accuracy").at("psnr_db"), "{:.1f}");
  run["max_lsb"] = number(summary.at("accuracy").at("max_lsb"), "{:.0f}");
  run["key"] = summary.at("hardware").at("key");
  return run;
}

// The plan's decision for each effect, and the units used, as a column of the scene's table.
void add_plan(Json& table, const std::string& shader, const Plan& plan, UnitCounter& counter) {
  table["plans"].push_back({{"shader", shader}, {"key", plan.key.name()}});
  for (std::size_t e = 0; e < c_effects; ++e) {
    const PlannedEffect& effect = plan.effects[e];
    Json& row = table["rows"][e];
    if (row.is_null())
      row = {{"effect", to_string(effect.effect)}, {"called_for", effect.called_for}, {"why", effect.why}};
    const auto counted = counter.count(plan.key, effect);
    std::vector<std::string> units;
    for (const auto& [unit, count] : counted) units.push_back(fmt::format("{}\u00a0{}", count, unit));
    std::string text = effect.by == DoneBy::hardware ? "hardware"
                       : effect.by == DoneBy::host   ? "host"
                                                     : "none";
    if ((effect.called_for || effect.elaborated || effect.by == DoneBy::none) && !effect.how.empty())
      text += "; " + effect.how;
    row["by"].push_back({{"text", text}, {"units", nullptr}});
    if (!units.empty())
      row["by"].back()["units"] =
          (effect.elaborated ? "" : "left out: ") + fmt::format("{}", fmt::join(units, ", "));
  }
}

// List the scenes that a shader has no complete frame of.
void add_gaps(Page& page, Json& missing) {
  for (const Shader shader : c_shaders) {
    std::vector<std::string> scenes;
    for (const std::string& scene : page.settings.scenes)
      if (!std::filesystem::exists(ResultFiles{page.settings.results / scene / to_string(shader)}.summary()))
        scenes.push_back(scene);
    if (!scenes.empty())
      missing.push_back(
          page.lacks(fmt::format("Frames by the shader {} of {}", to_string(shader), fmt::join(scenes, ", ")),
                     "make report"));
  }
}

}  // namespace

void add_frames(Page& page) {
  Images images;
  Json frames = Json::array(), runs = Json::array(), effects = Json::array();
  std::optional<UnitCounter> counter;
  for (const auto& scene_folder : folders_in(page.settings.results)) {
    const std::string scene_name = scene_folder.filename().string();
    Json table;
    for (const auto& folder : folders_in(scene_folder)) {
      const ResultFiles files{folder};
      if (!std::filesystem::exists(files.summary())) continue;  // a run that did not finish
      page.settings.on_progress("frames: " + scene_name);
      const auto text = must(read_file(files.summary()));
      const Json summary = Json::parse(text, nullptr, false);
      const std::string shader = folder.filename().string();
      try {
        runs.push_back(run_of(scene_name, shader, summary));
      } catch (const Json::exception& bad) {
        throw_bad_input("{}: {}; run make sim again", files.summary().string(), bad.what());
      }
      Json layers = Json::array();
      for (const auto& [file, name] : c_layers) {
        if (!std::filesystem::exists(files.frame(file))) continue;
        const auto image = images.add(files.frame(file));
        layers.push_back({{"id", file}, {"name", name}, {"image", image}});
      }
      frames.push_back({{"scene", scene_name}, {"shader", shader}, {"layers", std::move(layers)}});
      ++page.report.frames;
      const auto it = std::ranges::find_if(c_shaders, [&](Shader s) { return shader == to_string(s); });
      if (it == c_shaders.end())
        continue;  // drawn with all effects; the effects needed come from the shader's own frame
      const auto preset =
          summary["preset"] == to_string(Preset::published) ? Preset::published : Preset::exact;
      const auto scene = load_scene(scene_name, page.settings.folders.source / "sim" / "scenes");
      if (!scene) continue;  // a mesh from another place: the name alone does not identify it
      const auto plan = must(plan_scene(*scene, {.shader = *it, .preset = preset}));
      if (!counter) counter = must(UnitCounter::open(page.settings.folders));
      add_plan(table, shader, plan, *counter);
    }
    if (table.is_null()) continue;
    table["scene"] = scene_name;
    effects.push_back(std::move(table));
  }
  page.data["images"] = std::move(images.uris);
  page.data["frames"] = std::move(frames);
  Json no_frames = Json::array(), no_effects = Json::array();
  if (runs.empty()) {
    no_frames.push_back(page.lacks("Frames", "make sim"));
    no_effects.push_back(page.lacks("Effects", "make sim"));
  } else {
    add_gaps(page, no_frames);
  }
  page.view["frames"] = {{"table", nullptr}, {"missing", std::move(no_frames)}};
  if (!runs.empty()) page.view["frames"]["table"]["runs"] = std::move(runs);
  page.view["effects"] = {{"scenes", std::move(effects)}, {"missing", std::move(no_effects)}};
}

}  // namespace halfway::report
