// SPDX-License-Identifier: Apache-2.0
#include "sim/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>
#include <thread>
#include <tuple>

#include "common/to_integer.hpp"
#include "frame/frame.hpp"
#include "sim/os/must.hpp"
#include "words/generator/cosine.hpp"

namespace halfway::cli {
namespace {

constexpr int c_most_levels = 5;  // of subdivision

// Hardware to which an option applies: a shader, in one preset or in both.
struct Hardware {
  Shader shader;
  std::optional<Preset> preset = std::nullopt;
};

std::string name_of(const Hardware& hardware) {
  std::string name = fmt::format("the {} shader", to_string(hardware.shader));
  if (hardware.preset) name += fmt::format(" in preset {}", to_string(*hardware.preset));
  return name;
}

// An option for other hardware would be ignored, so refuse it.
void check_hardware(const DrawOptions& o, Shader shader, Preset preset) {
  struct Option {
    const char* name;
    bool given;
    std::vector<Hardware> belongs_to;
  };
  const Option options[] = {
      {"--highlight-test", o.highlight_test.has_value(), {{Shader::quadratic}}},
      {"--max-level", o.max_level.has_value(), {{Shader::quadratic}}},
      {"--threshold", o.threshold.has_value(), {{Shader::quadratic}, {Shader::spherical, Preset::exact}}},
      {"--span-ends", o.span_ends.has_value(), {{Shader::spherical, Preset::exact}}},
      {"--address-bits", o.address_bits.has_value(), {{Shader::spherical}}},
      {"--data-bits", o.data_bits.has_value(), {{Shader::spherical}}},
      {"--lights", o.lights.has_value(), {{Shader::spherical}, {Shader::processors}}},
      {"--degree", o.degree.has_value(), {{Shader::quadratic}}},
      {"--form", o.form.has_value(), {{Shader::processors}}}};
  for (const Option& option : options) {
    if (!option.given || std::ranges::any_of(option.belongs_to, [&](const Hardware& hardware) {
          return hardware.shader == shader && hardware.preset.value_or(preset) == preset;
        }))
      continue;
    std::vector<std::string> names;
    std::ranges::transform(option.belongs_to, std::back_inserter(names), name_of);
    const std::string owners = fmt::format("{}", fmt::join(names, " and "));
    throw Failure{bad_input(
        fmt::format("{} in preset {}", of_other_hardware(option.name, owners, shader), to_string(preset)))};
  }
}

void check_table_size(const DrawOptions& o) {
  for (const auto& [name, given, bits] :
       {std::tuple{"--address-bits", o.address_bits, &tables::CosineSize::address_bits},
        std::tuple{"--data-bits", o.data_bits, &tables::CosineSize::data_bits}}) {
    const int smallest = tables::c_smallest_cosine_size.*bits, largest = tables::c_largest_cosine_size.*bits;
    if (given && (*given < smallest || *given > largest))
      throw Failure{bad_input(fmt::format("{}: {} is not {} to {}", name, *given, smallest, largest))};
  }
  if (o.address_bits.has_value() != o.data_bits.has_value())
    throw Failure{bad_input("--address-bits and --data-bits go together; give both")};
}

}  // namespace

std::string of_other_hardware(std::string_view option, std::string_view owners, Shader shader) {
  return fmt::format("{} belongs to {}, and does not apply to the {} shader", option, owners,
                     to_string(shader));
}

void DrawOptions::add_to(CLI::App& command) {
  command.add_option("--shader", shader, c_shader_names)->capture_default_str();
  command.add_option("--preset", preset, "exact, or published: the paper's word lengths and edges")
      ->capture_default_str();
  command.add_option("--size", size, "WIDTHxHEIGHT in pixels, each 1 to 4096")->capture_default_str();
  command.add_option("--out", out, "folder for results")->capture_default_str();
  command.add_option("--highlight-test", highlight_test,
                     "quadratic: test for splitting a triangle in four: none, centroid (as published), or\n"
                     "conservative (default: conservative in preset exact, centroid in published)");
  command.add_option(
      "--threshold", threshold,
      fmt::format("error above which a triangle is split (quadratic) or cut into strips (spherical, preset\n"
                  "exact), in colour steps of 1/255 (default: {})",
                  QuadraticSetupOptions{}.threshold));
  command.add_option("--max-level", max_level,
                     fmt::format("quadratic: levels of splitting, 0 to {0} (default: {0})", c_most_levels));
  command.add_option(
      "--address-bits", address_bits,
      "spherical: address bits of the cosine tables; with --data-bits, a size that `make tables`\n"
      "has made (default: the preset's)");
  command.add_option("--data-bits", data_bits, "spherical: data bits of the cosine tables");
  command.add_flag(
      "--all-effects", all_effects,
      "elaborate every effect of the shader, not only those that the scene needs; unused effects\n"
      "have coefficients of zero, and the frame stays the same");
  command.add_option(
      "--lights", lights,
      "spherical and processors, with --all-effects: number of lights, up to 16 (default: that\n"
      "of the scene, at least one)");
  command.add_option(
      "--degree", degree,
      "quadratic: 2, or 1: planes through the colours at the vertices, as in Gouraud's shading,\n"
      "by hardware without second differences (default: 2)");
  command.add_option("--form", form,
                     "processors: unrolled, one object per clock, or folded, as published: one datapath\n"
                     "per processor, several clocks per object (default: unrolled)");
  command.add_option(
      "--span-ends", span_ends,
      "spherical, preset exact: surface or slerp: vectors at a span's ends from the surface, or by\n"
      "slerp along the edges, as published: never cut into strips, so errors are large close to a\n"
      "light (default: surface)");
  command.add_option("--threads", threads, "threads for setup and golden model (0: all cores)")
      ->capture_default_str();
}

Shader checked_shader(const std::string& name) {
  for (const Shader shader : c_shaders)
    if (name == to_string(shader)) return shader;
  throw Failure{bad_input(
      fmt::format("--shader: '{}' is not a shader of this program; take {}", name, c_shader_names))};
}

FrameSize checked_size(const std::string& text, const char* option) {
  const std::optional<FrameSize> size = parse_frame_size(text);
  if (!size)
    throw Failure{
        bad_input(fmt::format("{}: '{}' is not WIDTHxHEIGHT in pixels, such as 640x480", option, text))};
  if (size->width < 1 || size->height < 1 || size->width > c_max_frame_side ||
      size->height > c_max_frame_side)
    throw Failure{bad_input(fmt::format("{}: {} is out of range; width and height are 1 to {} pixels", option,
                                        text, c_max_frame_side))};
  return *size;
}

DrawSettings checked(const DrawOptions& o) {
  DrawSettings s;
  s.plan.shader = checked_shader(o.shader);
  if (o.preset != "exact" && o.preset != "published")
    throw Failure{
        bad_input(fmt::format("--preset: '{}' is not a preset; take exact or published", o.preset))};
  s.plan.preset = o.preset == "exact" ? Preset::exact : Preset::published;
  check_hardware(o, s.plan.shader, s.plan.preset);
  check_table_size(o);
  if (o.address_bits) s.plan.tables = words::CosineSize{*o.address_bits, *o.data_bits};
  s.plan.all_effects = o.all_effects;
  if (o.form == "folded")
    s.plan.form = ProcessorForm::folded;
  else if (o.form && o.form != "unrolled")
    throw Failure{bad_input(fmt::format("--form: '{}' is not a form; take folded or unrolled", *o.form))};
  if (o.degree && *o.degree != 1 && *o.degree != 2)
    throw Failure{bad_input(fmt::format("--degree: {} is not 1 or 2", *o.degree))};
  s.plan.degree = o.degree;
  if (o.lights && !o.all_effects) throw Failure{bad_input("--lights goes with --all-effects; give both")};
  s.plan.lights = o.lights;
  if (o.span_ends == "slerp")
    s.setup.spherical.ends = SpanEnds::slerped_along_edges;
  else if (o.span_ends && o.span_ends != "surface")
    throw Failure{
        bad_input(fmt::format("--span-ends: '{}' is not a way; take surface or slerp", *o.span_ends))};
  s.size = checked_size(o.size);
  s.setup.quadratic.test =
      s.plan.preset == Preset::exact ? HighlightTest::conservative : HighlightTest::centroid;
  if (o.highlight_test == "none")
    s.setup.quadratic.test = HighlightTest::none;
  else if (o.highlight_test == "centroid")
    s.setup.quadratic.test = HighlightTest::centroid;
  else if (o.highlight_test == "conservative")
    s.setup.quadratic.test = HighlightTest::conservative;
  else if (o.highlight_test)
    throw Failure{bad_input(fmt::format(
        "--highlight-test: '{}' is not a test; take none, centroid or conservative", *o.highlight_test))};
  if (o.threshold) {
    if (!(*o.threshold > 0.0) || !std::isfinite(*o.threshold))
      throw Failure{bad_input(fmt::format("--threshold: {} is not above 0", *o.threshold))};
    if (s.plan.shader == Shader::spherical && s.setup.spherical.ends == SpanEnds::slerped_along_edges)
      throw Failure{bad_input("--threshold goes with --span-ends surface: with slerp no triangle is cut")};
    s.setup.quadratic.threshold = s.setup.spherical.threshold = *o.threshold;
  }
  if (o.max_level) {
    if (*o.max_level < 0 || *o.max_level > c_most_levels)
      throw Failure{bad_input(fmt::format("--max-level: {} is not 0 to {}", *o.max_level, c_most_levels))};
    s.setup.quadratic.max_level = *o.max_level;
  }
  if (o.threads > 1024) throw Failure{bad_input(fmt::format("--threads: {} is more than 1024", o.threads))};
  s.threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  if (o.out.empty()) throw Failure{bad_input("--out: the folder has no name")};
  if (std::ranges::any_of(o.out, [](unsigned char c) { return std::iscntrl(c); }))
    throw Failure{bad_input("--out: the folder's name holds a control character")};
  s.out = o.out;
  return s;
}

std::vector<EngineKind> checked_simulators(const std::vector<std::string>& names,
                                           std::span<const EngineKind> known) {
  if (names.empty()) return std::vector{EngineKind::ghdl, EngineKind::verilator};
  std::vector<EngineKind> chosen;
  std::vector<std::string> known_names;
  for (const EngineKind kind : known) {
    known_names.emplace_back(to_string(kind));
    if (std::ranges::find(names, known_names.back()) != names.end()) chosen.push_back(kind);
  }
  for (const std::string& name : names)
    if (std::ranges::find(known_names, name) == known_names.end())
      throw Failure{bad_input(fmt::format("--simulator: '{}' is not a simulator; take {} or {}", name,
                                          fmt::join(known_names.begin(), known_names.end() - 1, ", "),
                                          known_names.back()))};
  return chosen;
}

std::vector<std::string> builtin_scenes(const Folders& folders) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folders.scenes(), error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  if (error || names.empty())
    throw Failure{bad_input(
        fmt::format("{}: no built-in scenes here; is the checkout whole?", folders.scenes().string()))};
  std::ranges::sort(names);
  return names;
}

std::string result_name(const std::string& scene) {
  const std::filesystem::path path(scene);
  return path.has_extension() ? path.stem().string() : path.filename().string();
}

void say_waiting(const std::filesystem::path& folder) {
  fmt::print(stderr, "waiting for {} (another halfway sim draws into it, or compares)\n", folder.string());
  std::fflush(stderr);
}

Progress::Progress(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  clear();
}

void Progress::show(double done) {
  const int percent = to_integer<int>(100.0 * done);
  if (percent == last_percent_) return;
  last_percent_ = percent;
  show(fmt::format("{} %", percent));
}

void Progress::show(const std::string& text) {
  if (!terminal_) return;
  fmt::print(stderr, "\r\033[K{}: {}", what_, text);
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace halfway::cli
