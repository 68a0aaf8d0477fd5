// SPDX-License-Identifier: Apache-2.0
// Frames that sim left, what their runs say, and the effects that each scene calls for.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "plan/plan.hpp"
#include "sim/ghdl/hardware_units.hpp"
#include "sim/report/html.hpp"
#include "sim/report/section.hpp"
#include "sim/run/result_files.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/file.hpp"

namespace halfway::report {
namespace {

struct Layer {
  const char* file;
  const char* name;
};
constexpr std::array c_layers = {Layer{"reference", "reference"}, Layer{"golden", "golden model"},
                                 Layer{"ghdl", "RTL in GHDL"}, Layer{"verilator", "RTL in Verilator"},
                                 Layer{"diff", "difference"}};

// Folders in a folder, by name.
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
  std::map<std::string, std::size_t> numbers;  // equal files are one

  Result<std::size_t> add(const std::filesystem::path& file) {
    auto uri = data_uri(file, "image/png");
    if (!uri) return uri.error();
    const auto [it, is_new] = numbers.emplace(*uri, uris.size());
    if (is_new) uris.push_back(std::move(*uri));
    return it->second;
  }
};

// A simulator's figure of the runs; "–" where it did not run, or could not tell.
std::string told(const Json& runs, const char* simulator, const char* figure) {
  for (const Json& run : runs)
    if (run.value("simulator", "") == simulator && !run.at(figure).is_null()) return run.at(figure).dump();
  return "–";
}

std::string by(const PlannedEffect& effect) {
  return effect.by == DoneBy::hardware ? "hardware" : effect.by == DoneBy::host ? "host" : "nobody";
}

// The plan of one frame, and the entities of each of its effects.
struct FramePlan {
  std::string shader;
  Plan plan;
  std::vector<UnitCounts> units;
};

Result<FramePlan> frame_plan(const std::string& shader, Plan plan, UnitCounter& counter) {
  FramePlan result{shader, std::move(plan), {}};
  for (const PlannedEffect& effect : result.plan.effects) {
    auto counted = counter.count(result.plan.key, effect);
    if (!counted) return counted.error();
    result.units.push_back(std::move(*counted));
  }
  return result;
}

std::string effects_table(const std::string& scene, const std::vector<FramePlan>& plans) {
  std::vector<std::string> head = {"effect", "called for", "why"};
  for (const auto& [shader, plan, effect_units] : plans)
    head.push_back(fmt::format("{}<br><small>{}</small>", escaped(shader), escaped(plan.key.name())));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t e = 0; e < c_effects; ++e) {
    const PlannedEffect& first = plans.front().plan.effects[e];
    std::vector<std::string> row = {to_string(first.effect), first.called_for ? "<strong>yes</strong>" : "no",
                                    escaped(first.why)};
    for (const auto& [shader, plan, effect_units] : plans) {
      const PlannedEffect& effect = plan.effects[e];
      std::string text = by(effect);
      if ((effect.called_for || effect.elaborated || effect.by == DoneBy::nobody) && !effect.how.empty())
        text += "; " + escaped(effect.how);
      std::string units;
      for (const auto& [unit, count] : effect_units[e])
        units += fmt::format("{}{}&nbsp;{}", units.empty() ? "" : ", ", count, escaped(unit));
      if (!units.empty())
        text += fmt::format("<br><small>{}{}</small>", effect.elaborated ? "" : "left out: ", units);
      row.push_back(std::move(text));
    }
    rows.push_back(std::move(row));
  }
  return table("Effects of " + scene, head, rows);
}

// Scenes that a shader has no frame of, a run of which did not end among them.
std::string gaps(Page& page) {
  std::string html;
  for (const Shader shader : c_shaders) {
    std::string scenes;
    for (const std::string& scene : page.settings.scenes)
      if (!std::filesystem::exists(ResultFiles{page.settings.results / scene / to_string(shader)}.summary()))
        scenes += (scenes.empty() ? "" : ", ") + scene;
    if (!scenes.empty())
      html +=
          page.lacks(fmt::format("Frames by the shader {} of {}", to_string(shader), scenes), "make report");
  }
  return html;
}

}  // namespace

Status add_frames(Page& page) {
  Images images;
  Json frames = Json::array();
  std::vector<std::vector<std::string>> rows;
  std::string effects;
  std::optional<UnitCounter> counter;
  for (const auto& scene_folder : folders_in(page.settings.results)) {
    std::vector<FramePlan> plans;
    const std::string scene_name = scene_folder.filename().string();
    for (const auto& folder : folders_in(scene_folder)) {
      const ResultFiles files{folder};
      if (!std::filesystem::exists(files.summary())) continue;  // a run that did not end
      page.settings.on_progress("frames: " + scene_name);
      const auto text = read_file(files.summary());
      if (!text) return text.error();
      const Json summary = Json::parse(*text, nullptr, false);
      const std::string shader = folder.filename().string();
      Json frame = {{"scene", scene_name}, {"shader", shader}, {"layers", Json::array()}};
      try {
        frame["width"] = summary.at("width");
        frame["height"] = summary.at("height");
        frame["preset"] = summary.at("preset");
        const Json& accuracy = summary.at("accuracy");
        rows.push_back(
            {fmt::format("<a href=\"#frame/{0}/{1}\">{0}</a>", escaped(scene_name), escaped(shader)),
             escaped(shader), escaped(summary.at("preset").get<std::string>()),
             fmt::format("{}×{}", summary.at("width").dump(), summary.at("height").dump()),
             summary.at("triangles").dump(), summary.at("fragments").dump(),
             told(summary.at("runs"), "ghdl", "cycles"), told(summary.at("runs"), "verilator", "cycles"),
             told(summary.at("runs"), "ghdl", "mismatches"),
             told(summary.at("runs"), "verilator", "mismatches"), number(accuracy.at("psnr_db"), "{:.1f}"),
             number(accuracy.at("max_lsb"), "{:.0f}"),
             fmt::format("<small class=\"key\">{}</small>",
                         escaped(summary.at("hardware").at("key").get<std::string>()))});
      } catch (const Json::exception& bad) {
        return bad_input(fmt::format("{}: {}; run make sim again", files.summary().string(), bad.what()));
      }
      for (const Layer& layer : c_layers) {
        if (!std::filesystem::exists(files.frame(layer.file))) continue;
        const auto image = images.add(files.frame(layer.file));
        if (!image) return image.error();
        frame["layers"].push_back({{"id", layer.file}, {"name", layer.name}, {"image", *image}});
      }
      frames.push_back(std::move(frame));
      ++page.report.frames;
      const auto is_called = [&](Shader s) { return shader == to_string(s); };
      const auto it = std::ranges::find_if(c_shaders, is_called);
      const auto preset =
          summary["preset"] == to_string(Preset::published) ? Preset::published : Preset::exact;
      if (it == c_shaders.end()) continue;  // with all effects: what is called for is told beside it
      const auto scene = load_scene(scene_name, page.settings.folders.source / "sim" / "scenes");
      if (!scene) continue;  // a mesh from elsewhere: its name alone does not load it
      auto plan = plan_scene(*scene, {.shader = *it, .preset = preset});
      if (!plan) return plan.error();
      if (!counter) {
        auto opened = UnitCounter::open(page.settings.folders);
        if (!opened) return opened.error();
        counter = std::move(*opened);
      }
      auto counted = frame_plan(shader, std::move(*plan), *counter);
      if (!counted) return counted.error();
      plans.push_back(std::move(*counted));
    }
    if (!plans.empty())
      effects += fmt::format("<details id=\"effects/{0}\"><summary>{0}</summary>\n{1}</details>\n",
                             escaped(scene_name), effects_table(scene_name, plans));
  }
  page.data["images"] = std::move(images.uris);
  page.data["frames"] = std::move(frames);
  if (rows.empty()) {
    page.parts["frames"] = page.lacks("Frames", "make sim");
    page.parts["effects"] = page.lacks("Effects", "make sim");
    return Ok{};
  }
  page.parts["frames"] =
      "<div id=\"frame-viewer\" class=\"viewer\"></div>\n" +
      table(
          "Runs: every fragment of the RTL against the golden model's, and the frame against the reference",
          {"scene", "shader", "preset", "size", "triangles", "fragments", "clocks, GHDL", "clocks, Verilator",
           "mismatches, GHDL", "mismatches, Verilator", "PSNR, dB", "largest error, /255", "hardware"},
          rows) +
      gaps(page);
  page.parts["effects"] = std::move(effects);
  return Ok{};
}

}  // namespace halfway::report
