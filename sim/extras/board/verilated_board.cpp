// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/verilated_board.hpp"

#include <utility>

#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/extras/board/board_api.h"
#include "sim/extras/board/board_picture.hpp"
#include "sim/extras/board/board_sources.hpp"
#include "sim/extras/board/sram_model.hpp"
#include "sim/os/must.hpp"

namespace halfway::board {
namespace {

constexpr const char* c_top = "board_core";
constexpr int c_reset_clocks = 4;

struct BoardLibrary {
  SharedLibrary library;
  decltype(&board_version) version = nullptr;
  decltype(&board_create) create = nullptr;
  decltype(&board_clock) clock = nullptr;
  decltype(&board_destroy) destroy = nullptr;
};

BoardLibrary open_library(const SimulatorFolders& folders) {
  const GhdlLibrary library =
      must(GhdlLibrary::for_synthesis(must(GhdlTool::find()), board_sources(folders), folders.cache));
  const std::filesystem::path folder = folders.source / "sim/extras/board";
  BoardLibrary board{
      .library = must(open_verilated(
          {.name = c_top,
           .netlist = must(mend_netlist(must(library.synthesize(c_top, board_key().generics())))),
           .top = c_top,
           .harness = folder / "board_harness.cpp",
           .include_folder = folders.source,
           .harness_headers = {folder / "board_api.h"}},
          folders.cache))};
  must(board.library.bind(board.version, "board_version", board.create, "board_create", board.clock,
                          "board_clock", board.destroy, "board_destroy"));
  if (board.version() != HALFWAY_BOARD_VERSION)
    throw_tool_failed("{}: of another version; delete it and try again", board.library.file().string());
  return board;
}

}  // namespace

struct VerilatedBoard::State {
  State(BoardLibrary opened, std::function<void(const DotPicture&)> on_picture)
      : library(std::move(opened)), core(library.create()), monitor(std::move(on_picture)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { library.destroy(core); }

  BoardLibrary library;
  void* core;
  SramModel sram{c_words_in_use};
  Monitor monitor;
  BoardInputs inputs{.reset = 1, .spi_select_n = 1, .spi_clock = 0, .spi_data_in = 0, .sram_data_in = 0};
  BoardOutputs outputs{}, pins{};  ///< of the core; of the cells, one clock later
  std::uint64_t clocks = 0;
};

VerilatedBoard::VerilatedBoard(const SimulatorFolders& folders,
                               std::function<void(const DotPicture&)> on_picture)
    : state_(std::make_unique<State>(open_library(folders), std::move(on_picture))) {
  State& s = *state_;
  s.pins.hsync = s.pins.vsync = 1;
  for (int i = 0; i < c_reset_clocks; ++i) s.library.clock(s.core, &s.inputs, &s.outputs);
  s.inputs.reset = 0;
}

VerilatedBoard::~VerilatedBoard() = default;

std::uint64_t VerilatedBoard::clocks() const {
  return state_->clocks;
}

bool VerilatedBoard::clock(const SpiPins& spi) {
  State& s = *state_;
  ++s.clocks;
  s.library.clock(s.core, &s.inputs, &s.outputs);
  // The registers of the inputs take what is at the pins, those of the outputs what the core gives.
  s.inputs.sram_data_in = s.sram.clock(s.pins);
  s.inputs.spi_select_n = spi.select_n;
  s.inputs.spi_clock = spi.clock;
  s.inputs.spi_data_in = spi.data;
  s.monitor.clock({s.pins.hsync != 0, s.pins.vsync != 0, s.pins.red, s.pins.green, s.pins.blue});
  s.pins = s.outputs;
  for (const std::string* fault : {&s.sram.fault(), &s.monitor.fault()})
    if (!fault->empty()) throw Failure{{ExitCode::differs, "board in Verilator: " + *fault}};
  return s.outputs.spi_data_out != 0;
}

}  // namespace halfway::board
