// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/ghdl_runner.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "sim/os/file.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway {
namespace {

constexpr const char* c_testbench = "frame_tb";
constexpr const char* c_testbench_file = "tb/rtl/frame_tb.vhd";
constexpr std::string_view c_testbench_shader = "entity work.quadratic_shader";
constexpr std::string_view c_testbench_generics = "g_exact => g_exact, g_channels => g_channels";
constexpr std::string_view c_testbench_init_bits = "work.formats_pkg.init_bits(g_exact, g_channels)";

/// A file that does not exist any more at the end.
struct ScratchFile {
  explicit ScratchFile(std::filesystem::path name) : path(std::move(name)) {}
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  const std::filesystem::path path;
};

/// The numbers of the last two lines, `cycles <n>` and `end <count>`; std::nullopt if they are missing.
std::optional<GhdlRun> read_trailer(const std::filesystem::path& trace_file) {
  std::ifstream file(trace_file, std::ios::binary | std::ios::ate);
  if (!file) return std::nullopt;
  const std::streamoff size = file.tellg();
  const std::streamoff length = std::min<std::streamoff>(size, 128);
  std::string tail(static_cast<std::size_t>(length), '\0');
  file.seekg(size - length);
  if (!file.read(tail.data(), length) || tail.empty() || tail.back() != '\n') return std::nullopt;
  const std::size_t cycles_at = tail.rfind("\ncycles ");
  if (cycles_at == std::string::npos) return std::nullopt;
  GhdlRun run;
  const char* const numbers = tail.c_str() + cycles_at;
  if (std::sscanf(numbers, "\ncycles %" SCNu64 "\nend %" SCNu64, &run.cycles, &run.fragments) != 2)
    return std::nullopt;
  return run;
}

/// GHDL's file of signals to write. It has no indices: a scope's name selects all scopes of a loop.
std::string wave_options(const std::vector<std::string>& signals) {
  std::string text = "$ version 1.1\n";
  for (const std::string& signal : signals) {
    bool index = false;
    text += '/';
    for (const char c : signal) {
      index = index || c == '(';
      if (!index) text += c;
      if (c == ')') index = false;
    }
    text += '\n';
  }
  return text;
}

/// The testbench's message, without the lines that GHDL adds. Empty if there is no message.
std::string reported_failure(const std::string& output) {
  constexpr std::string_view c_mark = "(report failure): ";
  const std::size_t at = output.find(c_mark);
  if (at == std::string::npos) return {};
  const std::size_t from = at + c_mark.size();
  return output.substr(from, output.find('\n', from) - from);
}

// tb/rtl/frame_tb.vhd with the key's shader inserted. All shaders have the same ports, so one testbench
// serves all: insert the entity, its generics and the width of init_data.
VhdlSource testbench(const HardwareKey& key, const std::filesystem::path& source_folder) {
  VhdlSource testbench = must(read_vhdl_source(source_folder, c_testbench_file));
  std::string generics;
  for (const auto& [name, value] : key.generics())
    generics += fmt::format("{0}{1} => {1}", generics.empty() ? "" : ", ", name);
  for (const auto& [what, with] : {std::pair(c_testbench_shader, "entity work." + key.entity()),
                                   {c_testbench_generics, generics},
                                   {c_testbench_init_bits, key.vhdl_init_bits()}}) {
    const std::size_t at = testbench.content.find(what);
    if (at == std::string::npos) throw_tool_failed("{}: does not say \"{}\"", c_testbench_file, what);
    testbench.content.replace(at, what.size(), with);
  }
  return testbench;
}

}  // namespace

Result<GhdlRunner> GhdlRunner::open(const HardwareKey& key, const SimulatorFolders& folders) try {
  std::vector<VhdlSource> sources = must(read_rtl_sources(folders.source));
  sources.push_back(testbench(key, folders.source));
  return GhdlRunner(key,
                    must(GhdlLibrary::open(must(GhdlTool::find()), sources, c_testbench, folders.cache)));
} catch (const Failure& failure) {
  return failure.error;
}

Result<GhdlRun> GhdlRunner::run(const std::filesystem::path& init_file,
                                const std::filesystem::path& trace_file, const GhdlRunOptions& options) const
    try {
  const auto absolute_trace = std::filesystem::absolute(trace_file);
  must(make_folders(absolute_trace.parent_path()));
  const ScratchFile trace(fmt::format("{}.part-{}", absolute_trace.string(), ::getpid()));

  Command command{.arguments = library_.run_arguments(c_testbench), .working_folder = library_.folder()};
  const auto generic = [&](std::string_view name, const std::string& value) {
    command.arguments.push_back(fmt::format("-g{}={}", name, value));
  };
  for (const auto& [name, value] : key_.generics()) generic(name, value);
  generic("g_init_file", std::filesystem::absolute(init_file).string());
  generic("g_trace_file", trace.path.string());
  generic("g_max_fragments", std::to_string(std::min(options.max_fragments, 0x7fffffffU)));
  generic("g_idle_limit", std::to_string(std::clamp(options.idle_limit, 1U, 0x7fffffffU)));
  generic("g_stall_seed", std::to_string(options.stall_seed & 0x7fffffffU));
  // The registers of the data path have no value until the first triangle loads them. The testbench checks
  // the outputs for metavalues.
  command.arguments.emplace_back("--ieee-asserts=disable");
  command.arguments.emplace_back("--assert-level=error");
  if (!options.wave_file.empty()) {
    const char* const kind = options.wave_file.extension() == ".fst" ? "--fst=" : "--vcd=";
    command.arguments.push_back(kind + std::filesystem::absolute(options.wave_file).string());
  }
  const ScratchFile wave_signals(absolute_trace.string() + ".signals");
  if (!options.wave_signals.empty()) {
    must(write_file(wave_signals.path, wave_options(options.wave_signals)));
    command.arguments.push_back("--read-wave-opt=" + wave_signals.path.string());
  }
  if (options.on_progress) {
    command.on_poll = [&] {
      std::error_code error;
      const auto bytes = std::filesystem::file_size(trace.path, error);
      if (!error) options.on_progress(bytes);
    };
  }

  const ProcessEnd end = must(run_process(command, c_install_ghdl));
  if (!end.succeeded()) {
    const std::string failure = reported_failure(end.output);
    const std::string file = std::filesystem::absolute(init_file).string() + ": ";
    if (failure.compare(0, file.size(), file) == 0) return bad_input(failure);
    if (!failure.empty() && failure.find(": cannot write") == std::string::npos) {
      return Error{ExitCode::differs, fmt::format("{} in GHDL: {}", key_.name(), failure)};
    }
    std::error_code error;
    const auto space = std::filesystem::space(absolute_trace.parent_path(), error);
    const bool full = !error && space.available < (1U << 16);
    return tool_failed(fmt::format("{}: the GHDL simulation failed ({}){}:\n{}\n  while running: {}",
                                   init_file.string(), end.how(), full ? ", the disk is full" : "",
                                   end.output, to_string(command)));
  }
  const auto run = read_trailer(trace.path);
  if (!run)
    return tool_failed(
        fmt::format("{}: GHDL ended without an error, but the trace is not whole; is the disk full?",
                    absolute_trace.string()));
  std::error_code error;
  std::filesystem::rename(trace.path, absolute_trace, error);
  if (error)
    return tool_failed(fmt::format("{}: cannot write: {}", absolute_trace.string(), error.message()));
  return *run;
} catch (const Failure& failure) {
  return failure.error;
}

}  // namespace halfway
