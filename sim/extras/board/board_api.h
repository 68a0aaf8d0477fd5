// SPDX-License-Identifier: Apache-2.0
// The verilated board as a shared library: exported by board_harness.cpp, called by board_simulator.cpp.
#pragma once

#include <cstdint>

// Ports of rtl/board/board_core.vhd.
struct BoardInputs {
  uint8_t reset, spi_select_n, spi_clock, spi_data_in;
  uint16_t sram_data_in;
};

struct BoardOutputs {
  uint32_t sram_address;
  uint16_t sram_data_out;
  uint8_t sram_data_enable, sram_read, sram_write, spi_data_out;
  uint8_t hsync, vsync, red, green, blue;
};

class BoardModel {
 public:
  virtual ~BoardModel() = default;
  // The outputs in a clock with these inputs; then the rising edge that ends the clock.
  virtual void clock(const BoardInputs& inputs, BoardOutputs& outputs) = 0;
};

extern "C" BoardModel* board_create();
