// SPDX-License-Identifier: Apache-2.0
#include "sim/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iterator>
#include <thread>
#include <utility>

#include "common/to_integer.hpp"
#include "frame/frame.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/run/draw_knobs.hpp"

namespace halfway::cli {
namespace {

std::optional<std::string> text_of(const DrawOptions& options, const DrawKnob& knob) {
  const auto found = options.knobs.find(knob.name);
  return found == options.knobs.end() ? std::nullopt : found->second;
}

// A knob of other hardware would be ignored, so refuse it.
void check_hardware(const DrawKnob& knob, Shader shader, Preset preset) {
  if (knob.belongs(shader, preset)) return;
  std::vector<std::string> names;
  for (const auto& [its, in] : knob.belongs_to)
    names.push_back(fmt::format("the {} shader{}", to_string(its),
                                in ? fmt::format(" in preset {}", to_string(*in)) : ""));
  throw_bad_input("{} belongs to {}, and does not apply to the {} shader in preset {}", knob.option(),
                  fmt::join(names, " and "), to_string(shader), to_string(preset));
}

// The knobs that are given, in the order of their table.
void apply_knobs(const DrawOptions& o, DrawSettings& s) {
  for (const DrawKnob& knob : draw_knobs())
    if (text_of(o, knob)) check_hardware(knob, s.plan.shader, s.plan.preset);
  for (const DrawKnob& knob : draw_knobs())
    if (const auto text = text_of(o, knob)) knob.set({knob.option(), *text}, s.plan, s.setup);
  for (const DrawKnob& knob : draw_knobs())
    if (text_of(o, knob) && knob.matters != nullptr && !knob.matters(s.plan, s.setup))
      throw_bad_input("{} goes with {}", knob.option(), knob.needs);
}

}  // namespace

void DrawOptions::add_to(CLI::App& command) {
  command.add_option("--shader", shader, c_shader_names)->capture_default_str();
  command.add_option("--preset", preset, "exact, or published: the paper's word lengths and edges")
      ->check(CLI::IsMember({"exact", "published"}))
      ->capture_default_str();
  command.add_option("--size", size, "WIDTHxHEIGHT in pixels, each 1 to 4096")->capture_default_str();
  command.add_option("--out", out, "folder for results")->capture_default_str();
  command.add_flag(
      "--all-effects", all_effects,
      "elaborate every effect of the shader, not only those that the scene needs; unused effects\n"
      "have coefficients of zero, and the frame stays the same");
  for (const DrawKnob& knob : draw_knobs()) command.add_option(knob.option(), knobs[knob.name], knob.help);
  command.add_option("--threads", threads, "threads for setup and golden model (0: all cores)")
      ->check(CLI::Range(0, 1024))
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
  s.plan.preset = o.preset == "exact" ? Preset::exact : Preset::published;
  s.plan.all_effects = o.all_effects;
  s.size = checked_size(o.size);
  s.setup.quadratic.test =
      s.plan.preset == Preset::exact ? HighlightTest::conservative : HighlightTest::centroid;
  apply_knobs(o, s);
  s.threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  if (o.out.empty()) throw_bad_input("--out: the folder has no name");
  if (std::ranges::any_of(o.out, [](unsigned char c) { return std::iscntrl(c); }))
    throw_bad_input("--out: the folder's name holds a control character");
  s.out = o.out;
  return s;
}

void CoreOptions::add_to(CLI::App& command, CLI::Option* needed) {
  for (CLI::Option* option :
       {command
            .add_option("--format", format,
                        "rgb565, with 16 bits of depth, or xrgb8888, with 32 bits of depth")
            ->check(CLI::IsMember({"rgb565", "xrgb8888"})),
        command.add_option("--bus", bus_bits, "width of the bus to the memory: 32 or 64")
            ->check(CLI::IsMember({32, 64}))}) {
    option->capture_default_str();
    if (needed != nullptr) option->needs(needed);
  }
}

std::string hardware_options(const DrawOptions& o) {
  std::string line = fmt::format("--shader {} --preset {}", o.shader, o.preset);
  for (const DrawKnob& knob : draw_knobs())
    if (const auto text = text_of(o, knob); text && knob.selects_hardware)
      line += fmt::format(" {} {}", knob.option(), *text);
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
