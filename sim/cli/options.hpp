// SPDX-License-Identifier: Apache-2.0
// Shared by the commands: options of what to draw, and progress messages.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/cost/families.hpp"
#include "sim/driver/engine.hpp"
#include "sim/os/command_line.hpp"
#include "sim/run/draw_knobs.hpp"

namespace halfway::cli {

/// Options of every command that draws.
struct DrawOptions {
  std::string shader = "quadratic";
  std::string preset = "exact";
  std::string size = "640x480";
  std::string out = "build/out";
  bool all_effects = false;
  unsigned threads = 0;
  /// As given, by their names. Setup or the plan chooses the values of the others.
  std::map<std::string, std::optional<std::string>> knobs;

  void add_to(CLI::App& command);
};

/// The checked options.
struct DrawSettings : DrawRequest {
  std::filesystem::path out{};
};

DrawSettings checked(const DrawOptions& options);

/// Options of halfway_core: what its memory has.
struct CoreOptions {
  std::string format = "rgb565";  ///< of pixels
  unsigned bus_bits = 64;

  bool true_colour() const { return format == "xrgb8888"; }
  /// With `needed`, they are refused without this option.
  void add_to(CLI::App& command, CLI::Option* needed = nullptr);
};

/// The given options that select the hardware of a scene, as on the command line.
std::string hardware_options(const DrawOptions& options);

/// Parses WIDTHxHEIGHT, the form of the option.
FrameSize checked_size(const std::string& text, const char* option = "--size");

/// For help texts.
inline constexpr const char* c_shader_names = "quadratic, spherical or processors";
/// Finds a shader by its name.
Shader checked_shader(const std::string& name);

/// Adds --device. Its value is the family of the device; before, that of the default.
void add_device(CLI::App& command, const synth::Family*& family);

/// Finds simulators by name. All must be in `known`; the result has its order. Default: GHDL and Verilator.
std::vector<EngineKind> checked_simulators(const std::vector<std::string>& names,
                                           std::span<const EngineKind> known = c_engine_kinds);

/// The built-in scenes' names, in alphabetical order.
std::vector<std::string> builtin_scenes(const Folders& folders);

/// Name of the folder with a scene's results: the scene's name or file without folder and extension.
std::string result_name(const std::string& scene);

/// Prints on stderr, also without a terminal, that another run has locked a folder of results.
void say_waiting(const std::filesystem::path& folder);

/// A line on a terminal that is updated in place. Prints nothing if stderr is no terminal.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(double done);  ///< 0 to 1
  void show(const std::string& text);
  void clear();

 private:
  std::string what_;
  bool terminal_;
  bool shown_ = false;
  int last_percent_ = -1;
};

/// A function per command. It adds the command to `app`; the command's callback sets `exit_code`.
using AddCommand = void(CLI::App& app, const Folders& folders, int& exit_code);
AddCommand add_sim, add_view, add_live, add_compare, add_why, add_board_sim, add_core_sim, add_plan,
    add_savings, add_study, add_report, add_render, add_init, add_verilog, add_figures;

}  // namespace halfway::cli
