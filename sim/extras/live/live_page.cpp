// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live/live_page.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "plan/plan.hpp"
#include "sim/cost/cost.hpp"
#include "sim/driver/shader_stages.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/extras/lanes/lane_simulator.hpp"
#include "sim/extras/live/core_module.hpp"
#include "sim/extras/live_core/live_frame.hpp"
#include "sim/extras/live_core/live_scene.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/files/template.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/shared_library.hpp"
#include "sim/os/threads.hpp"
#include "sim/report/html.hpp"

namespace halfway::live {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array c_presets = {Preset::exact, Preset::published};
constexpr const char* c_mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// Scenes as a mesh file makes them: one with the default material, one with a colour.
std::vector<Scene> mesh_scenes() {
  const auto grey = must(read_scene("mesh.obj", c_mesh, 1.0));
  Scene coloured = grey;
  coloured.materials.front().colour = {0.8, 0.4, 0.2};
  return std::vector<Scene>{grey, std::move(coloured)};
}

template <class Enumerators>
Json names_of(const Enumerators& enumerators) {
  Json names = Json::array();
  for (const auto enumerator : enumerators) names.push_back(to_string(enumerator));
  return names;
}

// The module, compressed, in base64. `-n` omits name and time, so that equal modules give equal pages.
std::string packed(const std::filesystem::path& module) {
  const auto scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path file = scratch.path() / "module.gz";
  must(run_tool({.arguments = {"gzip", "-9", "-n", "-c", module.string()}, .standard_output = file},
                "apt-get install gzip", module.filename().string()));
  return report::base64_of(file);
}

// The file of a shader's RTL as a WebAssembly module in build/cache/lanes/, built unless it exists.
// hardware_harness.cpp lists its functions.
std::filesystem::path build_hardware_module(const HardwareKey& key, const SimulatorFolders& folders) {
  LaneBuild build = lane_build_of(key, folders);
  build.harness = folders.source / "sim/extras/live/hardware_harness.cpp";
  build.target = LaneTarget::web_assembly;
  const GhdlLibrary library = rtl_library(folders);
  build.names = RegisterNames(must(library.synthesize_vhdl(key.entity(), key.generics())), library.folder());
  build.ports.top = build.top;
  for (const TracedPart& part : make_stages(key)->parts())
    build.ports.observed.push_back(
        {part.netlist_path, static_cast<unsigned>(part.low), static_cast<unsigned>(part.bits)});
  return build_lanes(build, folders.cache);
}

// Everything on the page that depends on a key.
struct Hardware {
  std::string module;
  std::optional<double> mhz;
};

std::map<std::string, Hardware> build_hardware(const std::vector<HardwareKey>& keys,
                                               const LiveSettings& settings) {
  std::map<std::string, Hardware> built;
  std::mutex mutex;
  std::size_t begun = 0;
  must_for_each(settings.threads, keys.size(), [&](std::size_t i) {
    const std::string name = keys[i].name();
    {
      const std::lock_guard lock(mutex);
      settings.on_progress(fmt::format("hardware {} of {}: {}", ++begun, keys.size(), name));
    }
    std::string text = packed(build_hardware_module(keys[i], settings.folders));
    const synth::Cost cost = synth::Costing(settings.folders, *settings.family)
                                 .stored(synth::design_of(keys[i], settings.folders.source));
    const std::lock_guard lock(mutex);
    built.emplace(name, Hardware{std::move(text), cost.mhz});
  });
  return built;
}

// The hardware of the page, each key once, sorted by name. A shader that cannot draw a scene has no key for
// it.
std::vector<HardwareKey> live_keys(const LiveSettings& settings) {
  std::vector<Scene> drawn;
  if (settings.meshes) drawn = mesh_scenes();
  for (const std::string& name : settings.scenes)
    drawn.push_back(must(load_scene(name, settings.folders.source / "sim/scenes")));
  std::map<std::string, HardwareKey> keys;
  for (const Scene& scene : drawn)
    for (const Shader shader : c_shaders)
      for (const Preset preset : c_presets)
        for (const words::CosineSize size : cosine_sizes(preset)) {
          PlanRequest request{.shader = shader, .preset = preset};
          if (shader == Shader::spherical) request.tables = size;
          // Lanes do not simulate object processors.
          if (const auto key = planned_key(scene, request); key && key->processors.objects == 0)
            keys.emplace(key->name(), *key);
        }
  std::vector<HardwareKey> sorted;
  for (auto& [name, key] : keys) sorted.push_back(std::move(key));
  return sorted;
}

}  // namespace

LivePage write_live(const LiveSettings& settings) {
  const std::filesystem::path sources = settings.folders.source / "sim", here = sources / "extras/live";
  const auto keys = live_keys(settings);
  settings.on_progress("core");
  std::string packed_core = packed(build_core_module(settings.folders));
  const auto hardware = build_hardware(keys, settings);

  // Collect the page's data.
  Json data = {{"device", settings.family->device->title},
               {"clocks", Json::object()},
               {"names",
                {{"settings", c_setting_names},
                 {"figures", c_figure_names},
                 {"shaders", names_of(c_shaders)},
                 {"presets", names_of(c_presets)},
                 {"pictures", c_picture_names}}}};
  for (const Preset preset : c_presets)
    for (const words::CosineSize size : cosine_sizes(preset))
      data["tables"][to_string(preset)].push_back(to_string(size));
  Json modules = {{{"name", "core"}, {"text", std::move(packed_core)}}};
  for (const auto& [name, built] : hardware) {
    modules.push_back({{"name", name}, {"text", built.module}});
    if (built.mhz) data["clocks"][name] = *built.mhz;
  }
  for (const std::string& name : settings.scenes)
    data["scenes"].push_back(
        {{"name", name + ".toml"}, {"text", must(read_file(sources / "scenes" / (name + ".toml")))}});

  // Fill the template.
  Json view = {{"commit", report::commit_of(settings.folders.source)},
               {"data", report::script_safe(data.dump())},
               {"modules", std::move(modules)}};
  view["still"] = report::data_uri(settings.folders.source / "docs/results/gallery/teapot.png", "image/png");
  for (const auto& [file, name] : {std::pair{sources / "report/report.css", "style"},
                                   {here / "live_page.css", "style"},
                                   {here / "live_page.js", "script"},
                                   {here / "worker.js", "worker"}})
    view[name] = view.value(name, "") + must(read_file(file));
  const auto text = must(filled_template(here / "live_page.html.mustache", view, Escape::html));
  if (const auto folder = settings.page.parent_path(); !folder.empty()) must(make_folders(folder));
  must(write_file(settings.page, text));
  return LivePage{text.size(), keys.size()};
}

}  // namespace halfway::live
