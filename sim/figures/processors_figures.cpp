// SPDX-License-Identifier: Apache-2.0
// The processors paper: tables 3, 4 and 5, and its statements on highlights and perspective.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "plan/processor_clocks.hpp"
#include "sim/figures/figure_pictures.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/files/table4.hpp"
#include "sim/os/file.hpp"
#include "sim/os/threads.hpp"
#include "words/object_limits.hpp"

namespace halfway::figures {
namespace {

// ---- Table 3 ----

// A sphere with one kind of light and one kind of reflection.
Scene lit_sphere(std::string_view source, std::string_view reflection) {
  Scene scene = sphere_scene(17, 12, 20.0);
  Material& material = scene.materials[0];
  material.ambient = reflection == "ambient" ? 0.6 : 0.0;
  material.diffuse = reflection == "diffuse" ? 0.9 : 0.0;
  material.specular = reflection == "specular" ? 0.9 : 0.0;
  const glm::dvec3 place{-0.8, 0.9, 2.4};
  scene.directional.clear();
  scene.ambient = glm::dvec3(source == "ambient" ? 1.0 : 0.0);
  if (source == "directional") scene.directional.push_back({glm::normalize(place), glm::dvec3(1.0)});
  if (source == "positional") scene.positional.push_back({place, glm::dvec3(1.0)});
  if (source == "spot")
    scene.spots.push_back({.position_world = place, .axis_world = -glm::normalize(place)});
  return scene;
}

constexpr PlanRequest c_published{
    .shader = Shader::processors, .preset = Preset::published, .form = ProcessorForm::folded};

// True if the hardware draws the scene lit and approximately correct. `normalize`: version II, which
// normalizes N for any lights; without it, false also if the scene needs hardware that normalizes.
bool draws(const Context& context, const Scene& scene, Preset preset, bool normalize) {
  constexpr FrameSize c_size{80, 60};
  constexpr double c_least_psnr_db = 18.0;
  PlanRequest plan = c_published;
  plan.preset = preset;
  SetupOptions options;
  options.processors.normalize = normalize;
  const Hardware hardware = draw_in_hardware(context, scene, c_size, plan, options);
  if (preset == Preset::published && hardware.key.processors.normalize != normalize) return false;
  const ReferenceImage phong = draw_in_software(scene, c_size, context.threads).phong;
  return std::ranges::any_of(hardware.frame.rgb, [](std::uint8_t v) { return v > 25; }) &&
         distance(hardware.frame, phong.frame, phong.mask).psnr_db >= c_least_psnr_db;
}

// By construction: the plan of preset published decides what is drawn.
Measured planned(const std::vector<std::string_view>& names) {
  return {.text = fmt::format("{}", fmt::join(names, ", ")), .by_construction = true};
}

void draw_table_3(const Context& context, Drawing& out) {
  // What each version draws of scenes with a single kind of light and of reflection.
  for (const bool normalize : {false, true}) {
    const auto draws_published = [&](std::string_view source, std::string_view reflection) {
      return draws(context, lit_sphere(source, reflection), Preset::published, normalize);
    };
    std::vector<std::string_view> sources, reflections;
    for (const std::string_view source : {"ambient", "directional", "positional"})
      if (draws_published(source, source == "ambient" ? "ambient" : "diffuse")) sources.push_back(source);
    for (const std::string_view reflection : {"ambient", "diffuse", "specular"}) {
      // Version II must draw a reflection under each kind of light.
      bool drawn = draws_published(reflection == "ambient" ? "ambient" : "directional", reflection);
      if (normalize && reflection != "ambient") drawn = drawn && draws_published("positional", reflection);
      if (drawn) reflections.push_back(reflection);
    }
    const char* const version = normalize ? "version II" : "version I";
    out.measured[fmt::format("{}, {} normalization: light sources", version,
                             normalize ? "with" : "without")] = planned(sources);
    out.measured[fmt::format("{}: reflection", version)] = planned(reflections);
  }
  std::vector<const char*> spot_presets;
  for (const Preset preset : {Preset::published, Preset::exact})
    if (draws(context, lit_sphere("spot", "diffuse"), preset, true))
      spot_presets.push_back(to_string(preset));
  out.measured["spot lights"] = {spot_presets.empty()
                                     ? "not drawn"
                                     : fmt::format("drawn in preset {}", fmt::join(spot_presets, " and "))};

  // The same sphere: with a directional light by version I, with a positional light by version II, and by
  // preset exact.
  constexpr FrameSize c_shown_size{144, 108};
  std::vector<Frame> pictures;
  for (const std::string_view source : {"directional", "positional"}) {
    Scene scene = lit_sphere(source, "diffuse");
    scene.ambient = glm::dvec3(0.5);
    scene.materials[0].ambient = 0.1, scene.materials[0].diffuse = 0.65, scene.materials[0].specular = 0.4;
    for (const FrameSize size : {c_compared_size, c_shown_size}) {
      const bool compared = size.width == c_compared_size.width;
      if (context.quick && compared) continue;
      const ReferenceImage phong = draw_in_software(scene, size, context.threads).phong;
      for (const Preset preset : {Preset::published, Preset::exact}) {
        PlanRequest plan = c_published;
        plan.preset = preset;
        const Frame frame = draw_in_hardware(context, scene, size, plan).frame;
        const char* const version = preset == Preset::exact   ? "preset exact"
                                    : source == "directional" ? "version I"
                                                              : "version II";
        if (compared)
          out.measured[fmt::format("{} light, {} against Phong shading", source, version)] =
              likeness(frame, phong.frame, phong.mask).measured();
        else
          pictures.push_back(frame);
      }
      if (!compared) pictures.push_back(phong.frame);
    }
  }
  save_picture(
      context, "processors-table-3", sheet(pictures, 3),
      "A sphere under a directional light above and a positional one below: the published processors, "
      "preset exact, Phong shading",
      out);
}

// ---- Table 4 ----

// The claims, and the names of the runs in tb/rtl/illumination/table4_tb.vhd.
constexpr std::array<std::pair<const char*, const char*>, 8> c_table_4 = {
    {{"ambient, version I", "ambient, version I"},
     {"ambient, version II", "ambient, version II"},
     {"ambient, and normalization of N (version II)", "ambient and normalization"},
     {"directional light, diffuse", "directional diffuse"},
     {"directional light, specular", "directional specular"},
     {"positional light, diffuse (version II)", "positional diffuse"},
     {"positional light, specular (version II)", "positional specular"},
     {"shadow polygon", "shadow polygon"}}};

// Clocks by "run, preset", as reported by the testbench.
std::map<std::string, int> clocks_in_ghdl(const Context& context) {
  const TemporaryFolder scratch = must(TemporaryFolder::make(context.folders.cache));
  vectors::write_table4(scratch.path());
  std::vector<VhdlSource> sources = must(read_rtl_sources(context.folders.source));
  for (const char* name : {"tb/rtl/tb_pkg.vhd", "tb/rtl/illumination/table4_tb.vhd"})
    sources.push_back(must(read_vhdl_source(context.folders.source, name)));
  const std::string output = must(run_testbench(
      "table4_tb", sources, {"-gg_folder=" + std::filesystem::absolute(scratch.path()).string()},
      context.folders.cache));
  std::map<std::string, int> clocks;
  constexpr std::string_view c_mark = "(report note): table 4, ";
  for (std::size_t at = 0; (at = output.find(c_mark, at)) != std::string::npos;) {
    at += c_mark.size();
    const std::string line = output.substr(at, output.find('\n', at) - at);
    const std::size_t colon = line.rfind(": ");
    if (colon != std::string::npos) clocks[line.substr(0, colon)] = std::atoi(line.c_str() + colon + 2);
  }
  return clocks;
}

void draw_table_4(const Context& context, Drawing& out) {
  if (context.quick) return;
  const auto clocks = clocks_in_ghdl(context);
  for (const auto& [what, run] : c_table_4) {
    const auto published = clocks.find(fmt::format("{}, published", run)),
               exact = clocks.find(fmt::format("{}, exact", run));
    if (published == clocks.end() || exact == clocks.end())
      throw_tool_failed("table4_tb: has no run of '{}'", run);
    out.measured[what] = constructed(published->second, "{} (preset exact {})", exact->second);
  }
}

// ---- Table 5 ----

void draw_table_5(const Context& context, Drawing& out) {
  const ShadingLoad load{.pixels = 1'000'000, .frames = 30, .objects = 3, .directional = 5, .positional = 5};
  const ProcessorCount one = count_processors(ProcessorVersion::one, load),
                       two = count_processors(ProcessorVersion::two, load);
  // Arithmetic on the published numbers.
  const auto note = [&](const char* what, double value, const std::string& more = "") {
    out.measured[what] = constructed(value, "{:g}{}", more);
  };
  note("ns a pixel in a pipeline, version I: 7·O·Δt", static_cast<double>(one.pipeline_ns));
  note("ns a pixel in a pipeline, version II: 13·O·Δt", static_cast<double>(two.pipeline_ns));
  note("ns of the second row, version I: (14R+4)·O·Δt", static_cast<double>(one.single_ns));
  note("ns of the second row, version II: (14R+26P+6)·O·Δt", static_cast<double>(two.single_ns));
  const double due = 1e9 / static_cast<double>(load.frames * load.pixels);
  out.measured["ns in which a pixel is due"] = constructed(due, "{:.2f}");
  note("pipelines, by 33 ns", static_cast<double>(two.published_pipelines.value_or(0)));
  note("pipelines, by the formula 30·M·13·O·Δt", static_cast<double>(two.pipelines),
       fmt::format(" ({:.1f})", two.pipelines_needed));
  const Scene scene = must(load_scene("lights", context.scenes()));
  const Plan plan = must(plan_scene(scene, {.shader = Shader::processors, .preset = Preset::published}));
  const auto per_pipeline = static_cast<std::uint64_t>(processors_config(plan.key).processors());
  note("processors a pipeline, 2(P+R)+1, in the hardware for `lights`", static_cast<double>(per_pipeline));
  note("processors in all, by 33 ns",
       static_cast<double>(two.published_pipelines.value_or(0) * per_pipeline));
  note("processors in all, by the formula", static_cast<double>(two.pipelines * per_pipeline));
  if (context.quick) return;
  const Hardware drawn = draw_in_hardware(context, scene, {96, 72}, c_published);
  out.measured["clocks an object in that pipeline, in Verilator"] =
      constructed(static_cast<double>(drawn.cycles) / static_cast<double>(drawn.fragments), "{:.2f}");
}

// ---- Equation 3 ----

void draw_equation_3(const Context& context, Drawing& out) {
  const Scene scene = must(load_scene("lights", context.scenes()));
  double largest = 0.0;
  for (const ScreenTriangle& t : Projector(scene, {320, 240}, {}).project_all())
    for (const ScreenVertex& v : t.vertex)
      for (const PositionalLight& light : scene.positional) {
        const glm::dvec3 to_light = light.position_world - v.position_world,
                         to_eye = direction(v.position_world, scene.camera.eye_world);
        const glm::dvec3 printed = glm::normalize(to_eye + to_light),
                         right = glm::normalize(to_eye + glm::normalize(to_light));
        largest = std::max(largest, std::acos(std::clamp(glm::dot(printed, right), -1.0, 1.0)));
      }
  out.measured["direction of a positional light's highlight, as printed"] =
      measured(largest * 180.0 / std::numbers::pi, "off by up to {:.1f}°");
}

// ---- Section 2: object processors and filter ----

// A part of a frame, each pixel as a square.
Frame enlarged(const Frame& frame, const Tile& part, std::uint32_t factor) {
  Frame out({part.size.width * factor, part.size.height * factor});
  for (std::uint32_t y = 0; y < out.size.height; ++y)
    for (std::uint32_t x = 0; x < out.size.width; ++x)
      std::copy_n(frame.rgb.begin() +
                      static_cast<std::ptrdiff_t>(frame.offset(part.x + x / factor, part.y + y / factor)),
                  3, out.rgb.begin() + static_cast<std::ptrdiff_t>(out.offset(x, y)));
  return out;
}

void draw_system(const Context& context, Drawing& out) {
  const Scene scene = must(load_scene("teapot", context.scenes()));
  const std::vector<ScreenTriangle> triangles = Projector(scene, c_compared_size, {}).project_all();
  const RenderOptions options{.frame = c_compared_size, .workers = on_threads(context.threads)};
  const ReferenceImage sampled = render_filtered(scene, triangles, options, words::c_filter_weights);
  const Tile spout{500, 152, {96, 64}};
  std::vector<Frame> pictures;
  for (const unsigned subpixels : {1U, 16U}) {
    const PlanRequest plan{.shader = Shader::processors, .objects = 16, .subpixels = subpixels};
    const Hardware drawn = draw_in_hardware(context, scene, c_compared_size, plan);
    out.measured[fmt::format("outlines with {} against 16 samples a pixel, filtered",
                             subpixels == 1 ? "one sample a pixel" : "16 subpixels and the filter")] =
        likeness(drawn.frame, sampled.frame, sampled.mask).measured();
    pictures.push_back(enlarged(drawn.frame, spout, 3));
    if (!context.quick)
      out.measured[fmt::format("clocks a fragment with {} subpixel{}, in Verilator", subpixels,
                               subpixels == 1 ? "" : "s")] =
          measured(static_cast<double>(drawn.cycles) / static_cast<double>(drawn.fragments), "{:.2f}");
  }
  pictures.push_back(enlarged(sampled.frame, spout, 3));
  save_picture(context, "processors-system", sheet(pictures, 3),
               "The tip of the teapot's spout: one sample a pixel, with the filter, the reference", out);
}

}  // namespace

std::map<std::string, Draw> processors_drawings() {
  return {{"processors-system", draw_system},
          {"processors-table-3", draw_table_3},
          {"processors-table-4", draw_table_4},
          {"processors-table-5", draw_table_5},
          {"processors-equation-3", draw_equation_3}};
}

}  // namespace halfway::figures
