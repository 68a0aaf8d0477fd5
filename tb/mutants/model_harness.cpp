// SPDX-License-Identifier: Apache-2.0
// Compiled with the Verilated model (prefix Vshader). MUTANT_PORTS lists the ports: PORT(name, bits,
// is_input).
#include "tb/mutants/model_harness.hpp"

#include "Vshader.h"
#include "verilated.h"

#define MUTANT_EXPORT extern "C" __attribute__((visibility("default")))

namespace {
struct Model {
  VerilatedContext context;
  Vshader netlist{&context, "netlist"};
};
}  // namespace

MUTANT_EXPORT void* mutant_create() {
  return new Model;
}

MUTANT_EXPORT void mutant_destroy(void* model) {
  delete static_cast<Model*>(model);
}

MUTANT_EXPORT void mutant_eval(void* model) {
  static_cast<Model*>(model)->netlist.eval();
}

MUTANT_EXPORT std::uint32_t mutant_ports(void* model, ModelPort* ports) {
  Vshader& netlist = static_cast<Model*>(model)->netlist;
  std::uint32_t count = 0;
#define PORT(name, bits, is_input) ports[count++] = {#name, &netlist.name, bits, is_input};
  MUTANT_PORTS
#undef PORT
  return count;
}
