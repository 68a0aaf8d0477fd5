// SPDX-License-Identifier: Apache-2.0
// What the commands share: what to draw, how to say how far it is.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "sim/engine/engine.hpp"
#include "sim/program/program.hpp"

namespace halfway::cli {

/// Options of every command that draws. What is not given is setup's or the plan's to choose.
struct DrawOptions {
  std::string shader = "quadratic";
  std::optional<int> address_bits, data_bits;  ///< of the spherical shader's tables
  bool all_effects = false;
  std::optional<unsigned> lights;  ///< with all effects
  std::optional<std::string> span_ends;
  std::string preset = "exact";
  std::optional<std::string> form;  ///< of the shading processors; none: unrolled
  std::string size = "640x480";
  std::string out = "build/out";
  std::optional<std::string> highlight_test;
  std::optional<double> threshold;
  std::optional<int> max_level;
  unsigned threads = 0;

  void add_to(CLI::App& command);
};

/// The same, checked.
struct DrawSettings {
  PlanRequest plan;
  FrameSize size;
  SetupOptions setup;
  unsigned threads;
  std::filesystem::path out;
};

Result<DrawSettings> checked(const DrawOptions& options);

/// WIDTHxHEIGHT, as the option has it.
Result<FrameSize> checked_size(const std::string& text, const char* option = "--size");

/// For help texts.
inline constexpr const char* c_shader_names = "quadratic, spherical or processors";
/// By its name.
Result<Shader> checked_shader(const std::string& name);
/// Why an option is refused that is another shader's; `owners`: such as "the quadratic shader".
std::string of_other_hardware(std::string_view option, std::string_view owners, Shader shader);

/// By their names, which must be of `known`, in its order; none given: GHDL and Verilator.
Result<std::vector<EngineKind>> checked_simulators(const std::vector<std::string>& names,
                                                   std::span<const EngineKind> known = c_engine_kinds);

/// The built-in scenes' names, in alphabetical order.
Result<std::vector<std::string>> builtin_scenes(const Folders& folders);

/// The folder's name under which the results of a scene lie, however it was named: without folder and ending.
std::string result_name(const std::string& scene);

/// Says on stderr, terminal or not, that another run holds a folder of results.
void say_waiting(const std::filesystem::path& folder);

/// A line on a terminal that is written over; silent elsewhere.
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

// One function a command: adds itself to `app` and sets `exit_code` when it has run.
void add_sim(CLI::App& app, const Folders& folders, int& exit_code);
void add_plan(CLI::App& app, const Folders& folders, int& exit_code);
void add_render(CLI::App& app, const Folders& folders, int& exit_code);
void add_init(CLI::App& app, const Folders& folders, int& exit_code);
void add_compare(CLI::App& app, const Folders& folders, int& exit_code);
void add_figures(CLI::App& app, const Folders& folders, int& exit_code);
void add_view(CLI::App& app, const Folders& folders, int& exit_code);
void add_savings(CLI::App& app, const Folders& folders, int& exit_code);
void add_study(CLI::App& app, const Folders& folders, int& exit_code);
void add_report(CLI::App& app, const Folders& folders, int& exit_code);
void add_why(CLI::App& app, const Folders& folders, int& exit_code);

}  // namespace halfway::cli
