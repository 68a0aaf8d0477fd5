// SPDX-License-Identifier: Apache-2.0
// The functions of a compiled netlist: C, so that a shared library can be loaded at run time.
#pragma once

#include <cstdint>

/// A port of the netlist. Its value is at `data` in little-endian order, in the lowest `bits` bits.
struct ModelPort {
  const char* name;
  void* data;
  std::uint32_t bits;
  std::uint32_t is_input;
};

extern "C" {
void* mutant_create();
void mutant_destroy(void* model);
void mutant_eval(void* model);
/// Writes the model's ports to `ports`, which must have room for all of them. Returns their number.
std::uint32_t mutant_ports(void* model, ModelPort* ports);
}
