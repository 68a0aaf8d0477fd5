// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_simulator.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <utility>

#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::board {
namespace {

/// After the host is done, the last frame must be shown: four pictures of the monitor.
constexpr std::uint64_t c_late_clocks = 4 * 840'000, c_most_clocks = 500'000'000;
constexpr const char* c_top = "board_core";
constexpr const char* c_testbench = "board_sim_tb";
constexpr int c_reset_clocks = 4;

/// The board with its pins.
constexpr const char* c_board_top_file = "rtl/board/board_top.vhd";

/// The RTL in compile order, and that of the board without board_top, which needs the cells of the FPGA.
std::vector<VhdlSource> board_sources(const SimulatorFolders& folders) {
  std::vector<VhdlSource> sources = must(read_rtl_sources(folders.source));
  for (VhdlSource& source : must(read_rtl_sources(folders.source, "rtl/board")))
    if (source.name != c_board_top_file) sources.push_back(std::move(source));
  return sources;
}

SharedLibrary open_board(const SimulatorFolders& folders) {
  const GhdlLibrary library =
      must(GhdlLibrary::for_synthesis(must(GhdlTool::find()), board_sources(folders), folders.cache));
  const std::filesystem::path folder = folders.source / "sim/extras/board";
  return must(
      open_verilated({.name = c_top,
                      .netlist = must(mend_netlist(must(library.synthesize(c_top, board_key().generics())))),
                      .top = c_top,
                      .harness = folder / "board_harness.cpp",
                      .include_folder = folders.source,
                      .harness_headers = {folder / "board_api.h"}},
                     folders.cache));
}

/// A line of the log of tb/rtl/board/board_sim_tb.vhd: numbers separated by blanks.
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

VerilatedBoard::VerilatedBoard(const SimulatorFolders& folders,
                               std::function<void(const DotPicture&)> on_picture)
    : library_(open_board(folders)), monitor_(std::move(on_picture)) {
  decltype(&board_create) create = nullptr;
  must(library_.bind(create, "board_create"));
  core_.reset(create());
  pins_.hsync = pins_.vsync = 1;
  for (int i = 0; i < c_reset_clocks; ++i) core_->clock(inputs_, outputs_);
  inputs_.reset = 0;
}

bool VerilatedBoard::clock(const SpiPins& spi) {
  ++clocks_;
  core_->clock(inputs_, outputs_);
  // The registers of the inputs take what is at the pins, those of the outputs what the core gives.
  inputs_.sram_data_in = sram_.clock(pins_);
  inputs_.spi_select_n = spi.select_n;
  inputs_.spi_clock = spi.clock;
  inputs_.spi_data_in = spi.data;
  monitor_.clock({pins_.hsync != 0, pins_.vsync != 0, pins_.red, pins_.green, pins_.blue});
  pins_ = outputs_;
  return outputs_.spi_data_out != 0;
}

BoardRun run_in_verilator(const std::vector<HostAction>& script, std::uint32_t pause_seed,
                          const SimulatorFolders& folders, const OnPicture& on_picture) {
  bool ended = false;
  VerilatedBoard board(folders, [&](const DotPicture& dots) { ended = !on_picture(dots); });
  SpiHost host(script, pause_seed);
  BoardRun run;
  for (SpiPins pins; !ended;) {
    if (board.clocks() == c_most_clocks)
      throw Failure{{ExitCode::differs, fmt::format("board: not done after {} clocks", c_most_clocks)}};
    const bool data = board.clock(pins);
    if (!host.done()) run.clocks = board.clocks();
    if (board.clocks() > run.clocks + c_late_clocks) break;
    pins = host.clock(data);
  }
  run.host_done = host.done();
  run.report = host.report();
  return run;
}

BoardRun run_in_ghdl(const std::vector<HostAction>& script, const SimulatorFolders& folders,
                     const OnPicture& on_picture) {
  std::vector<VhdlSource> sources = board_sources(folders);
  for (const char* name :
       {"tb/rtl/tb_pkg.vhd", "tb/rtl/board/ice40_cells.vhd", c_board_top_file, "tb/rtl/board/sram_model.vhd",
        "tb/rtl/board/board_host.vhd", "tb/rtl/board/board_sim_tb.vhd"})
    sources.push_back(must(read_vhdl_source(folders.source, name)));
  const TemporaryFolder scratch = must(TemporaryFolder::make(folders.cache / "board"));
  const std::filesystem::path place = std::filesystem::absolute(scratch.path());
  must(write_file(place / "script.txt", script_text(script)));
  std::vector<std::string> generics = {"-gg_folder=" + place.string()};
  for (const auto& [name, value] : board_key().generics())
    generics.push_back(fmt::format("-g{}={}", name, value));
  must(run_testbench(c_testbench, sources, generics, folders.cache));

  // Show the log of the video pins to the monitor: the number of clocks, and the levels during them.
  LineReader log = must(LineReader::open(place / "video.txt"));
  Monitor monitor([&](const DotPicture& dots) { on_picture(dots); });
  BoardRun run;
  bool complete = false;
  for (std::string_view line; !complete && must(log.next(line));) {
    if (line.starts_with("end ")) {
      complete = read_numbers(line.substr(4), run.clocks, run.report.packets, run.report.status_bytes,
                              run.report.errors, run.report.faults, run.report.frames);
      break;
    }
    std::uint64_t clocks = 0;
    unsigned hsync = 0, vsync = 0, red = 0, green = 0, blue = 0;
    if (!read_numbers(line, clocks, hsync, vsync, red, green, blue))
      throw Failure{log.at("is not a line of levels")};
    const VideoPins pins{hsync != 0, vsync != 0, static_cast<std::uint8_t>(red),
                         static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue)};
    for (std::uint64_t i = 0; i < clocks; ++i) monitor.clock(pins);
  }
  if (!complete) throw Failure{log.at("the log has no last line")};
  return run;
}

}  // namespace halfway::board
