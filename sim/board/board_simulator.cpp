// SPDX-License-Identifier: Apache-2.0
#include "sim/board/board_simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "sim/board/board_api.h"
#include "sim/board/board_picture.hpp"
#include "sim/board/sram_model.hpp"
#include "sim/system/file.hpp"
#include "sim/verilator/netlist.hpp"
#include "sim/verilator/verilated_library.hpp"

namespace halfway::board {
namespace {

constexpr const char* c_top = "board_core";
constexpr const char* c_top_file = "rtl/board/board_top.vhd";
constexpr const char* c_testbench = "board_sim_tb";
constexpr int c_reset_clocks = 4;

struct BoardLibrary {
  SharedLibrary library;
  decltype(&board_version) version = nullptr;
  decltype(&board_create) create = nullptr;
  decltype(&board_clock) clock = nullptr;
  decltype(&board_destroy) destroy = nullptr;
};

/// The sources of the RTL and of the board without its pins.
Result<std::vector<VhdlSource>> board_sources(const SimulatorFolders& folders) {
  auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  auto board = read_rtl_sources(folders.source, "rtl/board");
  if (!board) return board.error();
  std::ranges::copy_if(*board, std::back_inserter(*sources),
                       [](const VhdlSource& source) { return source.name != c_top_file; });
  return sources;
}

Result<BoardLibrary> open_board(const SimulatorFolders& folders) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  const auto sources = board_sources(folders);
  if (!sources) return sources.error();
  const auto library = GhdlLibrary::for_synthesis(*tool, *sources, folders.cache);
  if (!library) return library.error();
  const auto netlist = library->synthesize(c_top, board_key().generics());
  if (!netlist) return netlist.error();
  auto mended = mend_netlist(*netlist);
  if (!mended) return mended.error();
  const std::filesystem::path folder = folders.source / "sim/board";
  auto built = open_verilated({.name = c_top,
                               .netlist = std::move(*mended),
                               .top = c_top,
                               .harness = folder / "board_harness.cpp",
                               .include_folder = folders.source,
                               .harness_headers = {folder / "board_api.h"}},
                              folders.cache);
  if (!built) return built.error();
  BoardLibrary board{.library = std::move(*built)};
  if (Status bound = board.library.bind(board.version, "board_version", board.create, "board_create",
                                        board.clock, "board_clock", board.destroy, "board_destroy");
      !bound)
    return bound.error();
  if (board.version() != HALFWAY_BOARD_VERSION)
    return tool_failed(
        fmt::format("{}: of another version; delete it and try again", board.library.file().string()));
  return board;
}

VideoPins video_pins(const BoardOutputs& pins) {
  return {pins.hsync != 0, pins.vsync != 0, pins.red, pins.green, pins.blue};
}

/// A line of the log of tb/board/board_sim_tb.vhd: numbers separated by blanks.
template <class... Numbers>
bool read_numbers(std::string_view line, Numbers&... numbers) {
  const auto take = [&](auto& number) {
    while (line.starts_with(' ')) line.remove_prefix(1);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return error == std::errc();
  };
  return (take(numbers) && ...);
}

}  // namespace

HardwareKey board_key() {
  return {.shader = Shader::quadratic, .preset = Preset::exact, .channels = 3, .degree = 1};
}

Result<BoardRun> run_in_verilator(const std::vector<HostAction>& script, const RunOptions& options,
                                  const SimulatorFolders& folders, const OnPicture& on_picture) {
  const auto library = open_board(folders);
  if (!library) return library.error();
  const std::unique_ptr<void, decltype(&board_destroy)> board(library->create(), library->destroy);
  SpiHost host(script, options.pause_seed);
  SramModel sram(c_words_in_use);
  bool ended = false;
  BoardRun run;
  Monitor monitor([&](const DotPicture& dots) { ended = !on_picture(dots); });

  // The cells of the pins: registers of the outputs and of the inputs.
  BoardOutputs pins{}, outputs{};
  pins.hsync = pins.vsync = 1;
  SpiPins spi;
  BoardInputs inputs{.reset = 1, .spi_select_n = 1, .spi_clock = 0, .spi_data_in = 0, .sram_data_in = 0};
  for (int i = 0; i < c_reset_clocks; ++i) library->clock(board.get(), &inputs, &outputs);
  inputs.reset = 0;
  std::uint64_t clock = 0;
  for (; !ended; ++clock) {
    if (clock == options.most_clocks)
      return Error{ExitCode::differs, fmt::format("board: not done after {} clocks", clock)};
    library->clock(board.get(), &inputs, &outputs);
    inputs.sram_data_in = sram.clock(pins);
    monitor.clock(video_pins(pins));
    inputs.spi_select_n = spi.select_n;
    inputs.spi_clock = spi.clock;
    inputs.spi_data_in = spi.data;
    if (!host.done()) run.clocks = clock + 1;
    spi = host.clock(outputs.spi_data_out != 0);
    pins = outputs;
    for (const std::string& fault : {sram.fault(), monitor.fault()})
      if (!fault.empty()) return Error{ExitCode::differs, "board in Verilator: " + fault};
  }
  run.host_done = host.done();
  run.report = host.report();
  run.sram_accesses = sram.reads() + sram.writes();
  return run;
}

Result<BoardRun> run_in_ghdl(const std::vector<HostAction>& script, const SimulatorFolders& folders,
                             const OnPicture& on_picture) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  auto sources = board_sources(folders);
  if (!sources) return sources.error();
  for (const char* name :
       {"tb/board/board_sram.vhd", "tb/board/board_host.vhd", "tb/board/board_sim_tb.vhd"}) {
    auto source = read_vhdl_source(folders.source, name);
    if (!source) return source.error();
    sources->push_back(std::move(*source));
  }
  const auto library = GhdlLibrary::open(*tool, *sources, c_testbench, folders.cache);
  if (!library) return library.error();
  auto scratch = TemporaryFolder::make(folders.cache / "board");
  if (!scratch) return scratch.error();
  const std::filesystem::path place = std::filesystem::absolute(scratch->path());
  if (Status written = write_file(place / "script.txt", script_text(script)); !written)
    return written.error();

  Command command{.arguments = library->run_arguments(c_testbench), .working_folder = library->folder()};
  for (const auto& [name, value] : board_key().generics())
    command.arguments.push_back(fmt::format("-g{}={}", name, value));
  command.arguments.push_back("-gg_folder=" + place.string());
  command.arguments.insert(command.arguments.end(), {"--ieee-asserts=disable", "--assert-level=error"});
  const auto end = run_process(command, c_install_ghdl);
  if (!end) return end.error();
  if (!end->succeeded())
    return Error{ExitCode::differs, fmt::format("board in GHDL ({}): {}", end->how(), end->output)};

  // Show the log of the video pins to the monitor: the number of clocks, and the levels during them.
  auto log = LineReader::open(place / "video.txt");
  if (!log) return log.error();
  Monitor monitor([&](const DotPicture& dots) { on_picture(dots); });
  BoardRun run;
  std::string_view line;
  bool complete = false;
  for (auto next = log->next(line); next == LineReader::Next::line; next = log->next(line)) {
    if (line.starts_with("end ")) {
      complete = read_numbers(line.substr(4), run.clocks, run.report.packets, run.report.status_bytes,
                              run.report.errors, run.report.faults, run.report.frames);
      break;
    }
    std::uint64_t clocks = 0;
    unsigned hsync = 0, vsync = 0, red = 0, green = 0, blue = 0;
    if (!read_numbers(line, clocks, hsync, vsync, red, green, blue))
      return log->at("is not a line of levels");
    const VideoPins pins{hsync != 0, vsync != 0, static_cast<std::uint8_t>(red),
                         static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue)};
    for (std::uint64_t i = 0; i < clocks; ++i) monitor.clock(pins);
  }
  if (!complete) return log->at("the log has no last line");
  if (!monitor.fault().empty()) return Error{ExitCode::differs, "board in GHDL: " + monitor.fault()};
  return run;
}

}  // namespace halfway::board
