// SPDX-License-Identifier: Apache-2.0
// Runs a verilated netlist with a stimulus and a response like tb/mutants/netlist_known_bad_tb.vhd.
#include <cstdint>
#include <cstring>

#include "Vshader.h"
#include "verilated.h"

extern "C" __attribute__((visibility("default"))) void netlist_run(const std::uint32_t* stimuli,
                                                                   std::size_t count,
                                                                   std::uint32_t* responses) {
  VerilatedContext context;
  Vshader model(&context);
  const auto tick = [&] {
    model.clk = 1;
    model.eval();
    model.clk = 0;
    model.eval();
  };
  model.clk = 0;
  model.reset = 1;
  std::memset(&model.stimulus[0], 0, sizeof model.stimulus);
  model.eval();
  for (int i = 0; i < 4; ++i) tick();
  model.reset = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&model.stimulus[0], stimuli, sizeof model.stimulus);
    model.eval();
    std::memcpy(responses, &model.response[0], sizeof model.response);
    stimuli += sizeof model.stimulus / 4;
    responses += sizeof model.response / 4;
    tick();
  }
}
