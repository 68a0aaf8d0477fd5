// SPDX-License-Identifier: Apache-2.0
#include "sim/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <iterator>
#include <thread>
#include <utility>

#include "common/to_integer.hpp"
#include "frame/frame.hpp"
#include "sim/files/load_scene.hpp"
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

// The text of a given option, and its value.
struct Given {
  const char* flag;
  const std::string& text;

  [[noreturn]] void fail(std::string_view what) const { throw_bad_input("{}: {}", flag, what); }

  int whole_number(int least, int most) const {
    int value = 0;
    if (!read(value, "a whole number") || value < least || value > most)
      fail(fmt::format("{} is not {} to {}", text, least, most));
    return value;
  }

  double above_zero() const {
    double value = 0.0;
    if (!read(value, "a number") || !(value > 0.0) || !std::isfinite(value))
      fail(fmt::format("{} is not above 0", text));
    return value;
  }

  template <class Value>
  Value one_of(std::initializer_list<Value> choices) const {
    std::vector<const char*> names;
    for (const Value value : choices) {
      if (text == to_string(value)) return value;
      names.push_back(to_string(value));
    }
    fail(fmt::format("'{}' is not one of its values; take {}", text, fmt::join(names, " or ")));
  }

 private:
  // False if the number is out of the type's range.
  template <class Number>
  bool read(Number& number, const char* what) const {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (stop != end || error == std::errc::invalid_argument) fail(fmt::format("'{}' is not {}", text, what));
    return error == std::errc();
  }
};

// An option of some shaders.
struct Option {
  const char* flag;
  std::vector<Hardware> belongs_to;
  bool selects_hardware;  // otherwise it applies to the set-up only
  std::string help;
  void (*apply)(const Given& given, DrawSettings& settings);
};

// All options of some shaders, in the order of the help. A new one is a row here, and a field of PlanRequest
// or SetupOptions.
const std::vector<Option>& options_of_some_shaders() {
  static const std::vector<Option> c_options = {
      {"--highlight-test",
       {{Shader::quadratic}},
       false,
       "quadratic: test for splitting a triangle in four: none, centroid (as published),\n"
       "conservative, or proved (default: conservative in preset exact, centroid in published)",
       [](const Given& given, DrawSettings& s) {
         s.setup.quadratic.test = given.one_of({HighlightTest::none, HighlightTest::centroid,
                                                HighlightTest::conservative, HighlightTest::proved});
       }},
      {"--threshold",
       {{Shader::quadratic}, {Shader::spherical, Preset::exact}},
       false,
       fmt::format("error above which a triangle is split (quadratic) or cut into strips (spherical, preset\n"
                   "exact), in colour steps of 1/255 (default: {})",
                   QuadraticSetupOptions{}.threshold),
       [](const Given& given, DrawSettings& s) {
         s.setup.quadratic.threshold = s.setup.spherical.threshold = given.above_zero();
       }},
      {"--max-level",
       {{Shader::quadratic}},
       false,
       fmt::format("quadratic: levels of splitting, 0 to {0} (default: {0})", c_most_levels),
       [](const Given& given, DrawSettings& s) {
         s.setup.quadratic.max_level = given.whole_number(0, c_most_levels);
       }},
      {"--cosine",
       {{Shader::spherical}},
       true,
       fmt::format("spherical: {},\na size that `make tables` has made (default: the preset's)",
                   tables::c_cosine_values),
       [](const Given& given, DrawSettings& s) {
         s.plan.tables = tables::parse_cosine_size(given.text);
         if (!s.plan.tables) given.fail(fmt::format("'{}' is not {}", given.text, tables::c_cosine_values));
       }},
      {"--lights",
       {{Shader::spherical}, {Shader::processors}},
       true,
       fmt::format("spherical and processors, with --all-effects: number of lights, up to {} (default: that\n"
                   "of the scene, at least one)",
                   c_most_lights),
       [](const Given& given, DrawSettings& s) {
         if (!s.plan.all_effects) throw_bad_input("--lights goes with --all-effects; give both");
         s.plan.lights = static_cast<unsigned>(given.whole_number(1, c_most_lights));
       }},
      {"--degree",
       {{Shader::quadratic}},
       true,
       "quadratic: 2, or 1: planes through the colours at the vertices, as in Gouraud's shading,\n"
       "by hardware without second differences (default: 2)",
       [](const Given& given, DrawSettings& s) { s.plan.degree = given.whole_number(1, 2); }},
      {"--form",
       {{Shader::processors}},
       true,
       "processors: unrolled, one object per clock, or folded, as published: one datapath\n"
       "per processor, several clocks per object (default: unrolled)",
       [](const Given& given, DrawSettings& s) {
         s.plan.form = given.one_of({ProcessorForm::unrolled, ProcessorForm::folded});
       }},
      {"--object-processors",
       {{Shader::processors}},
       true,
       fmt::format(
           "processors: a chain of this many object processors, up to {}, instead of the rasterizer: only\n"
           "visible objects are shaded (default: the rasterizer; {} for a scene with shadows)",
           c_most_object_processors, c_object_processors),
       [](const Given& given, DrawSettings& s) {
         s.plan.objects = static_cast<unsigned>(given.whole_number(1, c_most_object_processors));
       }},
      {"--subpixels",
       {{Shader::processors}},
       true,
       "processors, with --object-processors: 1, or 4 or 16 subpixels of a pixel, which is then filtered\n"
       "(default: 1)",
       [](const Given& given, DrawSettings& s) {
         const int subpixels = given.whole_number(1, 16);
         if (subpixels != 1 && subpixels != 4 && subpixels != 16)
           given.fail(fmt::format("{} is not 1, 4 or 16", subpixels));
         if (s.plan.objects == 0) throw_bad_input("--subpixels goes with --object-processors; give both");
         s.plan.subpixels = static_cast<unsigned>(subpixels);
       }},
      {"--span-ends",
       {{Shader::spherical, Preset::exact}},
       false,
       "spherical, preset exact: surface or slerp: vectors at a span's ends from the surface, or by\n"
       "slerp along the edges, as published: never cut into strips, so errors are large close to a\n"
       "light (default: surface)",
       [](const Given& given, DrawSettings& s) {
         s.setup.spherical.ends = given.one_of({SpanEnds::on_surface, SpanEnds::slerped_along_edges});
       }},
  };
  return c_options;
}

std::optional<std::string> text_of(const DrawOptions& options, const char* flag) {
  const auto found = options.of_some_shaders.find(flag);
  return found == options.of_some_shaders.end() ? std::nullopt : found->second;
}

// An option for other hardware would be ignored, so refuse it.
void check_hardware(const Option& option, Shader shader, Preset preset) {
  if (std::ranges::any_of(option.belongs_to, [&](const Hardware& hardware) {
        return hardware.shader == shader && hardware.preset.value_or(preset) == preset;
      }))
    return;
  std::vector<std::string> names;
  std::ranges::transform(option.belongs_to, std::back_inserter(names), name_of);
  throw_bad_input("{} belongs to {}, and does not apply to the {} shader in preset {}", option.flag,
                  fmt::join(names, " and "), to_string(shader), to_string(preset));
}

// The options of some shaders that are given, in the order of the table.
void apply_options(const DrawOptions& o, DrawSettings& s) {
  for (const Option& option : options_of_some_shaders())
    if (text_of(o, option.flag)) check_hardware(option, s.plan.shader, s.plan.preset);
  for (const Option& option : options_of_some_shaders())
    if (const auto text = text_of(o, option.flag)) option.apply({option.flag, *text}, s);
  if (text_of(o, "--threshold") && s.plan.shader == Shader::spherical &&
      s.setup.spherical.ends == SpanEnds::slerped_along_edges)
    throw_bad_input("--threshold goes with --span-ends surface: with slerp no triangle is cut");
}

}  // namespace

void DrawOptions::add_to(CLI::App& command) {
  command.add_option("--shader", shader, c_shader_names)->capture_default_str();
  command.add_option("--preset", preset, "exact, or published: the paper's word lengths and edges")
      ->capture_default_str();
  command.add_option("--size", size, "WIDTHxHEIGHT in pixels, each 1 to 4096")->capture_default_str();
  command.add_option("--out", out, "folder for results")->capture_default_str();
  command.add_flag(
      "--all-effects", all_effects,
      "elaborate every effect of the shader, not only those that the scene needs; unused effects\n"
      "have coefficients of zero, and the frame stays the same");
  for (const Option& option : options_of_some_shaders())
    command.add_option(option.flag, of_some_shaders[option.flag], option.help);
  command.add_option("--threads", threads, "threads for setup and golden model (0: all cores)")
      ->capture_default_str();
}

Shader checked_shader(const std::string& name) {
  for (const Shader shader : c_shaders)
    if (name == to_string(shader)) return shader;
  throw_bad_input("--shader: '{}' is not a shader of this program; take {}", name, c_shader_names);
}

FrameSize checked_size(const std::string& text, const char* option) {
  const std::optional<FrameSize> size = parse_frame_size(text);
  if (!size) throw_bad_input("{}: '{}' is not WIDTHxHEIGHT in pixels, such as 640x480", option, text);
  if (size->width < 1 || size->height < 1 || size->width > c_max_frame_side ||
      size->height > c_max_frame_side)
    throw_bad_input("{}: {} is out of range; width and height are 1 to {} pixels", option, text,
                    c_max_frame_side);
  return *size;
}

DrawSettings checked(const DrawOptions& o) {
  DrawSettings s;
  s.plan.shader = checked_shader(o.shader);
  if (o.preset != "exact" && o.preset != "published")
    throw_bad_input("--preset: '{}' is not a preset; take exact or published", o.preset);
  s.plan.preset = o.preset == "exact" ? Preset::exact : Preset::published;
  s.plan.all_effects = o.all_effects;
  s.size = checked_size(o.size);
  s.setup.quadratic.test =
      s.plan.preset == Preset::exact ? HighlightTest::conservative : HighlightTest::centroid;
  apply_options(o, s);
  if (o.threads > 1024) throw_bad_input("--threads: {} is more than 1024", o.threads);
  s.threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  if (o.out.empty()) throw_bad_input("--out: the folder has no name");
  if (std::ranges::any_of(o.out, [](unsigned char c) { return std::iscntrl(c); }))
    throw_bad_input("--out: the folder's name holds a control character");
  s.out = o.out;
  return s;
}

void CoreOptions::add_to(CLI::App& command, CLI::Option* needed) {
  for (CLI::Option* option :
       {command.add_option("--format", format,
                           "rgb565, with 16 bits of depth, or xrgb8888, with 32 bits of depth"),
        command.add_option("--bus", bus_bits, "width of the bus to the memory: 32 or 64")}) {
    option->capture_default_str();
    if (needed != nullptr) option->needs(needed);
  }
}

CoreSettings checked(const CoreOptions& options) {
  const bool true_colour = options.format == "xrgb8888";
  if (!true_colour && options.format != "rgb565")
    throw_bad_input("--format: '{}' is not a format; take rgb565 or xrgb8888", options.format);
  if (options.bus_bits != 32 && options.bus_bits != 64)
    throw_bad_input("--bus: {} is not 32 or 64", options.bus_bits);
  return {true_colour, options.bus_bits};
}

std::string hardware_options(const DrawOptions& o) {
  std::string line = fmt::format("--shader {} --preset {}", o.shader, o.preset);
  for (const Option& option : options_of_some_shaders())
    if (const auto text = text_of(o, option.flag); text && option.selects_hardware)
      line += fmt::format(" {} {}", option.flag, *text);
  return line + (o.all_effects ? " --all-effects" : "");
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
      throw_bad_input("--simulator: '{}' is not a simulator; take {} or {}", name,
                      fmt::join(known_names.begin(), known_names.end() - 1, ", "), known_names.back());
  return chosen;
}

void add_device(CLI::App& command, const synth::Family*& family) {
  command
      .add_option_function<std::string>(
          "--device",
          [&family](const std::string& name) {
            family = synth::family_of(name);
            if (family == nullptr)
              throw_bad_input("--device: '{}' is not a device; take {}", name,
                              fmt::join(synth::device_options(), " or "));
          },
          "the FPGA whose clocks and cells count: hx8k (iCE40 HX8K) or ecp5 (ECP5 LFE5U-85F)")
      ->default_str(std::string(family->device->option));
}

std::vector<std::string> builtin_scenes(const Folders& folders) {
  std::vector<std::string> names = scene_names(folders.scenes());
  if (names.empty())
    throw_bad_input("{}: no built-in scenes here; is the checkout whole?", folders.scenes().string());
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
