// SPDX-License-Identifier: Apache-2.0
// Compiled in one translation unit with the verilated board_core (prefix Vshader).
#include "Vshader.h"
#include "sim/extras/board/board_api.h"
#include "verilated.h"

namespace {

class Board final : public BoardModel {
 public:
  Board() {
    core_.clk = 0;
    core_.reset = 1;
    core_.spi_select_n = 1;
    core_.eval();
  }
  ~Board() override { core_.final(); }

  void clock(const BoardInputs& inputs, BoardOutputs& outputs) override {
    core_.reset = inputs.reset;
    core_.spi_select_n = inputs.spi_select_n;
    core_.spi_clock = inputs.spi_clock;
    core_.spi_data_in = inputs.spi_data_in;
    core_.sram_data_in = inputs.sram_data_in;
    core_.clk = 0;
    core_.eval();
    outputs = {core_.sram_address, core_.sram_data_out, core_.sram_data_enable, core_.sram_read,
               core_.sram_write,   core_.spi_data_out,  core_.vga_hsync,        core_.vga_vsync,
               core_.vga_red,      core_.vga_green,     core_.vga_blue};
    core_.clk = 1;
    core_.eval();
  }

 private:
  VerilatedContext context_;
  Vshader core_{&context_, "board"};
};

}  // namespace

extern "C" __attribute__((visibility("default"))) BoardModel* board_create() {
  return new Board;
}
