// SPDX-License-Identifier: Apache-2.0
// Compiled in one translation unit with the verilated board_core (prefix Vshader).
#include <memory>

#include "Vshader.h"
#include "sim/extras/board/board_api.h"
#include "verilated.h"

#define HALFWAY_EXPORT extern "C" __attribute__((visibility("default")))

namespace {

struct Board {
  VerilatedContext context;
  Vshader core{&context, "board"};
};

}  // namespace

HALFWAY_EXPORT uint32_t board_version(void) {
  return HALFWAY_BOARD_VERSION;
}

HALFWAY_EXPORT void* board_create(void) {
  auto board = std::make_unique<Board>();
  board->core.clk = 0;
  board->core.reset = 1;
  board->core.spi_select_n = 1;
  board->core.eval();
  return board.release();
}

HALFWAY_EXPORT void board_clock(void* board, const BoardInputs* inputs, BoardOutputs* outputs) {
  Vshader& core = static_cast<Board*>(board)->core;
  core.reset = inputs->reset;
  core.spi_select_n = inputs->spi_select_n;
  core.spi_clock = inputs->spi_clock;
  core.spi_data_in = inputs->spi_data_in;
  core.sram_data_in = inputs->sram_data_in;
  core.clk = 0;
  core.eval();
  *outputs = {core.sram_address, core.sram_data_out, core.sram_data_enable, core.sram_read,
              core.sram_write,   core.spi_data_out,  core.vga_hsync,        core.vga_vsync,
              core.vga_red,      core.vga_green,     core.vga_blue};
  core.clk = 1;
  core.eval();
}

HALFWAY_EXPORT void board_destroy(void* board) {
  static_cast<Board*>(board)->core.final();
  delete static_cast<Board*>(board);
}
