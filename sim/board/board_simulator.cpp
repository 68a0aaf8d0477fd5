// SPDX-License-Identifier: Apache-2.0
#include "sim/board/board_simulator.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <utility>

#include "sim/board/board_sources.hpp"
#include "sim/board/verilated_board.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::board {
namespace {

/// After the host is done, the last frame must be shown: four pictures of the monitor.
constexpr std::uint64_t c_late_clocks = 4 * 840'000;
constexpr const char* c_testbench = "board_sim_tb";

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

Result<BoardRun> run_in_verilator(const std::vector<HostAction>& script, const RunOptions& options,
                                  const SimulatorFolders& folders, const OnPicture& on_picture) {
  bool ended = false;
  auto board = VerilatedBoard::open(folders, [&](const DotPicture& dots) { ended = !on_picture(dots); });
  if (!board) return board.error();
  SpiHost host(script, options.pause_seed);
  BoardRun run;
  for (SpiPins pins; !ended;) {
    if (board->clocks() == options.most_clocks)
      return Error{ExitCode::differs, fmt::format("board: not done after {} clocks", options.most_clocks)};
    const Result<bool> data = board->clock(pins);
    if (!data) return data.error();
    if (!host.done()) run.clocks = board->clocks();
    if (board->clocks() > run.clocks + c_late_clocks) break;
    pins = host.clock(*data);
  }
  run.host_done = host.done();
  run.report = host.report();
  return run;
}

Result<BoardRun> run_in_ghdl(const std::vector<HostAction>& script, const SimulatorFolders& folders,
                             const OnPicture& on_picture) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  auto sources = board_sources(folders);
  if (!sources) return sources.error();
  for (const char* name :
       {"tb/tb_pkg.vhd", "tb/board/ice40_cells.vhd", c_board_top_file, "tb/board/sram_model.vhd",
        "tb/board/board_host.vhd", "tb/board/board_sim_tb.vhd"}) {
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
