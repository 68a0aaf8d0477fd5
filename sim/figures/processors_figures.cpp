// SPDX-License-Identifier: Apache-2.0
// The processors paper's tables 3, 4 and 5, and what its text says of highlights and perspective.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "plan/processor_count.hpp"
#include "scene/builtin_meshes.hpp"
#include "shading/shade.hpp"
#include "sim/figures/figure.hpp"
#include "sim/figures/pictures.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/stream_files/table4.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::figures {
namespace {

constexpr const char* c_paper = "processors";

// ---- Table 3 ----

enum class Source { ambient, directional, positional, spot };
constexpr std::array c_sources = {Source::ambient, Source::directional, Source::positional, Source::spot};
const char* name_of_source(Source source) {
  constexpr std::array c_names = {"ambient", "directional", "positional", "spot"};
  return c_names[static_cast<std::size_t>(source)];
}

enum class Reflection { ambient, diffuse, specular };
constexpr std::array c_reflections = {Reflection::ambient, Reflection::diffuse, Reflection::specular};
const char* name_of_reflection(Reflection reflection) {
  constexpr std::array c_names = {"ambient", "diffuse", "specular"};
  return c_names[static_cast<std::size_t>(reflection)];
}

// A sphere under one kind of light, reflecting it in one way.
Scene lit_sphere(Source source, Reflection reflection) {
  Scene scene = sphere_scene(17, 12, 20.0);
  Material& material = scene.materials[0];
  material.ambient = reflection == Reflection::ambient ? 0.6 : 0.0;
  material.diffuse = reflection == Reflection::diffuse ? 0.9 : 0.0;
  material.specular = reflection == Reflection::specular ? 0.9 : 0.0;
  const glm::dvec3 place{-0.8, 0.9, 2.4};
  scene.directional.clear();
  scene.ambient = glm::dvec3(source == Source::ambient ? 1.0 : 0.0);
  if (source == Source::directional) scene.directional.push_back({glm::normalize(place), glm::dvec3(1.0)});
  if (source == Source::positional) scene.positional.push_back({place, glm::dvec3(1.0)});
  if (source == Source::spot)
    scene.spots.push_back({.position_world = place, .axis_world = -glm::normalize(place)});
  return scene;
}

// Whether the hardware draws it: something is lit, and it is about what it should be.
struct Drawn {
  bool lit = false;
  bool normalizes = false;  // version II
};
Result<Drawn> draws(const Context& context, const Scene& scene, Preset preset) {
  constexpr FrameSize c_size{80, 60};
  constexpr double c_least_psnr_db = 18.0;
  const auto hardware =
      draw_in_hardware(context, scene, c_size,
                       {.shader = Shader::processors, .preset = preset, .form = ProcessorForm::folded});
  if (!hardware) return hardware.error();
  const Software software = draw_in_software(scene, c_size, context.threads);
  const bool lit = std::ranges::any_of(hardware->frame.rgb, [](std::uint8_t v) { return v > 25; });
  const bool right =
      distance(hardware->frame, software.phong.frame, software.phong.mask).psnr_db >= c_least_psnr_db;
  return Drawn{lit && right, hardware->key.processors.normalize};
}

std::string list_of(const std::vector<const char*>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

Status draw_table_3(const Context& context, Drawing& out) {
  // What either version has, by the hardware that a scene with nothing else calls for.
  std::vector<const char*> sources_1, sources_2, reflections_1, reflections_2;
  for (const Source source : c_sources) {
    const Reflection reflection = source == Source::ambient ? Reflection::ambient : Reflection::diffuse;
    const auto drawn = draws(context, lit_sphere(source, reflection), Preset::published);
    if (!drawn) return drawn.error();
    if (source == Source::spot) {
      out.measured["spot lights"] = {drawn->lit ? "drawn, in either preset" : "not drawn"};
      continue;
    }
    if (drawn->lit && !drawn->normalizes) sources_1.push_back(name_of_source(source));
    if (drawn->lit) sources_2.push_back(name_of_source(source));
  }
  for (const Reflection reflection : c_reflections)
    for (const Source source : {Source::directional, Source::positional}) {
      const Source of = reflection == Reflection::ambient ? Source::ambient : source;
      const auto drawn = draws(context, lit_sphere(of, reflection), Preset::published);
      if (!drawn) return drawn.error();
      const bool one = source == Source::directional;
      if (drawn->lit && drawn->normalizes == (!one && reflection != Reflection::ambient))
        (one ? reflections_1 : reflections_2).push_back(name_of_reflection(reflection));
    }
  out.measured["version I, without normalization: light sources"] = {list_of(sources_1)};
  out.measured["version I: reflection"] = {list_of(reflections_1)};
  out.measured["version II, with normalization: light sources"] = {list_of(sources_2)};
  out.measured["version II: reflection"] = {list_of(reflections_2)};

  // The same sphere under a directional light by version I, a positional one by version II, and by preset
  // exact.
  constexpr FrameSize c_shown_size{144, 108};
  std::vector<Frame> pictures;
  for (const Source source : {Source::directional, Source::positional}) {
    Scene scene = lit_sphere(source, Reflection::diffuse);
    scene.ambient = glm::dvec3(0.5);
    scene.materials[0].ambient = 0.1, scene.materials[0].diffuse = 0.65, scene.materials[0].specular = 0.4;
    for (const FrameSize size : {c_compared_size, c_shown_size}) {
      if (context.quick && size.width == c_compared_size.width) continue;
      const Software software = draw_in_software(scene, size, context.threads);
      for (const Preset preset : {Preset::published, Preset::exact}) {
        const auto drawn =
            draw_in_hardware(context, scene, size,
                             {.shader = Shader::processors, .preset = preset, .form = ProcessorForm::folded});
        if (!drawn) return drawn.error();
        if (size.width == c_shown_size.width) {
          pictures.push_back(drawn->frame);
          continue;
        }
        const auto alike = likeness(drawn->frame, software.phong.frame, software.phong.mask);
        if (!alike) return alike.error();
        const char* const version = preset == Preset::exact         ? "preset exact"
                                    : source == Source::directional ? "version I"
                                                                    : "version II";
        out.measured[fmt::format("{} light, {} against Phong shading", name_of_source(source), version)] =
            alike->measured();
      }
      if (size.width == c_shown_size.width) pictures.push_back(software.phong.frame);
    }
  }
  return save_picture(
      context, "processors-table-3", sheet(pictures, 3),
      "A sphere under a directional light above and a positional one below: the published processors, "
      "preset exact, Phong shading",
      out);
}

Figure table_3() {
  return {
      "processors-table-3",
      c_paper,
      "table 3",
      "capabilities of the two versions of the shading processor; spot lights cannot be treated, and "
      "perspective is "
      "not handled correctly.",
      "what scenes with one kind of light and of reflection call for in preset published, and draw; below, a "
      "sphere "
      "of 374 triangles under a directional light (version I) and a positional one (version II): preset "
      "published, "
      "preset exact, Phong shading.",
      {{"version I, without normalization: light sources", "ambient, directional", the_same()},
       {"version I: reflection", "ambient, diffuse, specular", the_same()},
       {"version II, with normalization: light sources", "ambient, directional, positional", the_same()},
       {"version II: reflection", "ambient, diffuse, specular", the_same()},
       {"spot lights", "cannot be treated", the_same(),
        "a gap that the paper admits and ours closes: a processor with a cone"},
       looks_alike("directional light, version I against Phong shading",
                   "a cheap Phong shading that can be accepted"),
       looks_alike("directional light, preset exact against Phong shading", "Phong shading"),
       looks_alike("positional light, version II against Phong shading", "Phong shading",
                   "N and P are interpolated without perspective, the highlight's vector is the printed one "
                   "(equation 3), words have 16 bits and light is an integer"),
       looks_alike("positional light, preset exact against Phong shading", "Phong shading")},
      draw_table_3};
}

// ---- Table 4 ----

struct Table4Row {
  const char* what;
  const char* run;  // as tb/illumination/table4_tb.vhd names it
  int clocks;
};
constexpr std::array<Table4Row, 8> c_table_4 = {
    {{"ambient, version I", "ambient, version I", 4},
     {"ambient, version II", "ambient, version II", 4},
     {"ambient, and normalization of N (version II)", "ambient and normalization", 6},
     {"directional light, diffuse", "directional diffuse", 6},
     {"directional light, specular", "directional specular", 7},
     {"positional light, diffuse (version II)", "positional diffuse", 12},
     {"positional light, specular (version II)", "positional specular", 13},
     {"shadow polygon", "shadow polygon", 2}}};

// Clocks by "run, preset", as the testbench reports them.
Result<std::map<std::string, int>> clocks_in_ghdl(const Context& context) {
  constexpr const char* c_top = "table4_tb";
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  auto sources = read_rtl_sources(context.folders.source);
  if (!sources) return sources.error();
  for (const char* name : {"tb/tb_pkg.vhd", "tb/illumination/table4_tb.vhd"}) {
    auto source = read_vhdl_source(context.folders.source, name);
    if (!source) return source.error();
    sources->push_back(std::move(*source));
  }
  const auto library = GhdlLibrary::open(*tool, *sources, c_top, context.folders.cache);
  if (!library) return library.error();
  auto scratch = TemporaryFolder::make(context.folders.cache);
  if (!scratch) return scratch.error();
  if (const Status written = vectors::write_table4(scratch->path()); !written) return written.error();
  Command command{.arguments = library->run_arguments(c_top), .working_folder = library->folder()};
  for (const std::string& option :
       {"-gg_folder=" + std::filesystem::absolute(scratch->path()).string(),
        std::string("--ieee-asserts=disable"), std::string("--assert-level=error")})
    command.arguments.push_back(option);
  const auto end = run_process(command, kInstallGhdl);
  if (!end) return end.error();
  if (!end->succeeded())
    return Error{ExitCode::differs, fmt::format("{}: {}\n{}", c_top, end->how(), end->output)};
  std::map<std::string, int> clocks;
  constexpr std::string_view c_mark = "(report note): table 4, ";
  for (std::size_t at = 0; (at = end->output.find(c_mark, at)) != std::string::npos;) {
    at += c_mark.size();
    const std::string line = end->output.substr(at, end->output.find('\n', at) - at);
    const std::size_t colon = line.rfind(": ");
    if (colon != std::string::npos) clocks[line.substr(0, colon)] = std::atoi(line.c_str() + colon + 2);
  }
  return clocks;
}

Status draw_table_4(const Context& context, Drawing& out) {
  if (context.quick) return Ok{};
  const auto clocks = clocks_in_ghdl(context);
  if (!clocks) return clocks.error();
  for (const Table4Row& row : c_table_4) {
    const auto published = clocks->find(fmt::format("{}, published", row.run)),
               exact = clocks->find(fmt::format("{}, exact", row.run));
    if (published == clocks->end() || exact == clocks->end())
      return tool_failed(fmt::format("table4_tb: has no run of '{}'", row.run));
    out.measured[row.what] = {fmt::format("{} (preset exact {})", published->second, exact->second),
                              static_cast<double>(published->second)};
  }
  return Ok{};
}

Figure table_4() {
  Figure figure{
      "processors-table-4",
      c_paper,
      "table 4",
      "cycles to compute the components of the illumination model, including loading.",
      "clocks from one token taken to the next, of the folded shading processor in GHDL (tb/illumination/"
      "table4_tb.vhd), preset published; what each clock of preset exact buys is in rtl/README.md.",
      {},
      draw_table_4};
  for (const Table4Row& row : c_table_4)
    figure.claims.push_back({.what = row.what,
                             .published = fmt::format("{}", row.clocks),
                             .criterion = within(row.clocks, 0),
                             .slow = true});
  return figure;
}

// ---- Table 5 ----

Status draw_table_5(const Context& context, Drawing& out) {
  const ShadingLoad load{.pixels = 1'000'000, .frames = 30, .objects = 3, .directional = 5, .positional = 5};
  const ProcessorCount one = count_processors(ProcessorVersion::one, load),
                       two = count_processors(ProcessorVersion::two, load);
  const auto note = [&](const char* what, double value, const std::string& more = "") {
    out.measured[what] = {fmt::format("{:g}{}", value, more), value};
  };
  note("ns a pixel in a pipeline, version I: 7·O·Δt", static_cast<double>(one.pipeline_ns));
  note("ns a pixel in a pipeline, version II: 13·O·Δt", static_cast<double>(two.pipeline_ns));
  note("ns a pixel in one processor, version I: (14R+4)·O·Δt", static_cast<double>(one.single_ns));
  note("ns a pixel in one processor, version II: (14R+26P+6)·O·Δt", static_cast<double>(two.single_ns));
  const double due = 1e9 / static_cast<double>(load.frames * load.pixels);
  out.measured["ns in which a pixel is due"] = {fmt::format("{:.2f}", due), due};
  note("pipelines, by 33 ns", static_cast<double>(two.published_pipelines.value_or(0)));
  note("pipelines, by the formula 30·M·13·O·Δt", static_cast<double>(two.pipelines),
       fmt::format(" ({:.1f})", two.pipelines_needed));
  const auto scene = load_scene("lights", context.scenes());
  if (!scene) return scene.error();
  const auto plan = plan_scene(*scene, {.shader = Shader::processors, .preset = Preset::published});
  if (!plan) return plan.error();
  const auto per_pipeline = static_cast<std::uint64_t>(processors_config(plan->key).processors());
  note("processors a pipeline, 2(P+R)+1, in the hardware for `lights`", static_cast<double>(per_pipeline));
  note("processors in all, by 33 ns",
       static_cast<double>(two.published_pipelines.value_or(0) * per_pipeline));
  note("processors in all, by the formula", static_cast<double>(two.pipelines * per_pipeline));
  if (context.quick) return Ok{};
  const auto drawn = draw_in_hardware(
      context, *scene, {96, 72},
      {.shader = Shader::processors, .preset = Preset::published, .form = ProcessorForm::folded});
  if (!drawn) return drawn.error();
  const double pace = static_cast<double>(drawn->cycles) / static_cast<double>(drawn->fragments);
  out.measured["clocks an object in that pipeline, in Verilator"] = {fmt::format("{:.2f}", pace), pace};
  return Ok{};
}

Figure table_5() {
  return {
      "processors-table-5",
      c_paper,
      "table 5",
      "shading processors needed for a configuration: M pixels, O objects a pixel, R directional and P "
      "positional "
      "lights, 30 frames a second, cycle Δt; worked example with M = 10⁶, O = 3, R = P = 5, Δt = 50 ns.",
      "the same formulas (`halfway plan lights --objects 3 --rate 30 --size 1000x1000`), and the "
      "pipeline that the "
      "built-in scene `lights`, 5 and 5 lights, calls for.",
      {{"ns a pixel in a pipeline, version I: 7·O·Δt", "7·3·50 = 1050", within(1050, 0)},
       {"ns a pixel in a pipeline, version II: 13·O·Δt", "1950", within(1950, 0)},
       {"ns a pixel in one processor, version I: (14R+4)·O·Δt", "(14·5+4)·3·50 = 11100", within(11100, 0)},
       {"ns a pixel in one processor, version II: (14R+26P+6)·O·Δt", "(14·5+26·5+6)·3·50 = 30900",
        within(30900, 0)},
       {"ns in which a pixel is due", "33", within(33, 0.5)},
       {"pipelines, by 33 ns", "60", within(60, 0)},
       {"pipelines, by the formula 30·M·13·O·Δt", "60", within(60, 0),
        "the worked example drops the third of 33.3 ns: 58.5 pipelines become 60 in place of 59"},
       {"processors a pipeline, 2(P+R)+1, in the hardware for `lights`", "21", within(21, 0)},
       {"processors in all, by 33 ns", "1260", within(1260, 0)},
       {"processors in all, by the formula", "1260", within(1260, 0), "59 pipelines, not 60: as above"},
       {.what = "clocks an object in that pipeline, in Verilator",
        .published = "13",
        .criterion = within(13, 0.1),
        .slow = true}},
      draw_table_5};
}

// ---- Equation 3 ----

Status draw_equation_3(const Context& context, Drawing& out) {
  const auto scene = load_scene("lights", context.scenes());
  if (!scene) return scene.error();
  double largest = 0.0;
  for (const ScreenTriangle& t : Projector(*scene, {320, 240}, {}).project_all())
    for (const ScreenVertex& v : t.vertex)
      for (const PositionalLight& light : scene->positional) {
        const glm::dvec3 to_light = light.position_world - v.position_world,
                         to_eye = direction(v.position_world, scene->camera.eye_world);
        const glm::dvec3 printed = glm::normalize(to_eye + to_light),
                         right = glm::normalize(to_eye + glm::normalize(to_light));
        largest = std::max(largest, std::acos(std::clamp(glm::dot(printed, right), -1.0, 1.0)));
      }
  const double degrees = largest * 180.0 / std::numbers::pi;
  out.measured["direction of a positional light's highlight, as printed"] = {
      fmt::format("off by up to {:.1f}°", degrees), degrees};
  return Ok{};
}

Figure equation_3() {
  return {"processors-equation-3",
          c_paper,
          "equation 3",
          "the highlight vector of a positional light, (E + P_p − P)/|E + P_p − P|.",
          "the printed vector against the halfway vector, at every vertex that is seen of the built-in scene "
          "`lights`.",
          {{"direction of a positional light's highlight, as printed", "half way between eye and light",
            at_most(0.1, "°"),
            "an error of the paper: the unit vector to the eye is added to one to the light of any length; "
            "preset "
            "published has it as printed, preset exact normalizes first"}},
          draw_equation_3};
}

}  // namespace

std::vector<Figure> processors_figures() {
  return {table_3(), table_4(), table_5(), equation_3()};
}

}  // namespace halfway::figures
