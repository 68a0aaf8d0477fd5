// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/core/core_simulator.hpp"

#include <fmt/format.h>

#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/os/must.hpp"

namespace halfway::core {
namespace {

constexpr std::uint64_t c_reset_clocks = 4;
/// Of an access to a register.
constexpr std::uint64_t c_most_access_clocks = 64;

/// Warnings: comparisons whose result depends on generics only.
const std::vector<std::string> c_allowed = {"-Wno-CMPCONST", "-Wno-UNSIGNED"};

[[noreturn]] void hangs(const std::string& what, std::uint64_t clocks) {
  throw Failure{{ExitCode::differs, fmt::format("core in Verilator: {} in {} clocks", what, clocks)}};
}

struct CoreLibrary {
  SharedLibrary library;
  decltype(&halfway_core_create) create = nullptr;
  decltype(&halfway_core_clock) clock = nullptr;
  decltype(&halfway_core_destroy) destroy = nullptr;
};

CoreLibrary open_library(const CoreKey& key, const SimulatorFolders& folders) {
  const std::filesystem::path folder = folders.source / "sim/extras/core";
  CoreLibrary core{
      .library = must(open_verilated(
          {.name = key.name(),
           .netlist = must(mend_netlist(must(rtl_library(folders).synthesize(c_core_top, key.generics())))),
           .top = c_core_top,
           .harness = folder / "core_harness.cpp",
           .include_folder = folders.source,
           .harness_headers = {folder / "core_api.h"},
           .verilator_flags = c_allowed},
          folders.cache))};
  must(core.library.bind(core.create, "halfway_core_create", core.clock, "halfway_core_clock", core.destroy,
                         "halfway_core_destroy"));
  return core;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> CoreKey::generics() const {
  auto list = shader.core_generics(format == PixelFormat::xrgb8888, bus_bits);
  if (limit_bits != 0) list.emplace_back("g_limit_bits", std::to_string(limit_bits));
  return list;
}

std::string CoreKey::name() const {
  return fmt::format("{}-core-{}-{}", shader.name(), to_string(format), bus_bits);
}

struct CoreSimulator::State {
  State(CoreLibrary opened, AxiMemory at_port)
      : library(std::move(opened)), core(library.create()), memory(std::move(at_port)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { library.destroy(core); }

  CoreLibrary library;
  void* core;
  AxiMemory memory;
  CoreInputs inputs{};
  CoreOutputs outputs{};
  std::uint64_t clocks = 0;
};

CoreSimulator::CoreSimulator(const CoreKey& key, MemoryTiming timing, const SimulatorFolders& folders)
    : state_(std::make_unique<State>(open_library(key, folders), AxiMemory(key.bus_bits / 8, timing))) {
  State& s = *state_;
  for (; s.clocks < c_reset_clocks; ++s.clocks) s.library.clock(s.core, &s.inputs, &s.outputs);
  s.inputs.aresetn = 1;
}

CoreSimulator::~CoreSimulator() = default;

void CoreSimulator::clock() {
  State& s = *state_;
  ++s.clocks;
  s.library.clock(s.core, &s.inputs, &s.outputs);
  s.memory.clock(s.inputs, s.outputs);
}

CoreSimulator::Answer CoreSimulator::read(std::uint32_t address) {
  State& s = *state_;
  s.inputs.s_axi_araddr = static_cast<std::uint8_t>(address);
  s.inputs.s_axi_arvalid = s.inputs.s_axi_rready = 1;
  for (std::uint64_t i = 0; i < c_most_access_clocks; ++i) {
    clock();
    if (s.outputs.s_axi_arready != 0) s.inputs.s_axi_arvalid = 0;
    if (s.outputs.s_axi_rvalid == 0) continue;
    s.inputs.s_axi_rready = 0;
    return {s.outputs.s_axi_rdata, s.outputs.s_axi_rresp};
  }
  hangs(fmt::format("no answer to a read of register {:02x}", address), c_most_access_clocks);
}

std::uint8_t CoreSimulator::write(std::uint32_t address, std::uint32_t value, unsigned strobes) {
  State& s = *state_;
  s.inputs.s_axi_awaddr = static_cast<std::uint8_t>(address);
  s.inputs.s_axi_wdata = value;
  s.inputs.s_axi_wstrb = static_cast<std::uint8_t>(strobes);
  s.inputs.s_axi_awvalid = s.inputs.s_axi_wvalid = s.inputs.s_axi_bready = 1;
  for (std::uint64_t i = 0; i < c_most_access_clocks; ++i) {
    clock();
    if (s.outputs.s_axi_awready != 0) s.inputs.s_axi_awvalid = 0;
    if (s.outputs.s_axi_wready != 0) s.inputs.s_axi_wvalid = 0;
    if (s.outputs.s_axi_bvalid == 0) continue;
    s.inputs.s_axi_bready = 0;
    return s.outputs.s_axi_bresp;
  }
  hangs(fmt::format("no answer to a write of register {:02x}", address), c_most_access_clocks);
}

void CoreSimulator::wait(std::uint64_t most) {
  for (std::uint64_t i = 0; !interrupt(); ++i) {
    if (i == most) hangs("no interrupt", most);
    clock();
  }
}

bool CoreSimulator::interrupt() const {
  return state_->outputs.interrupt != 0;
}
std::uint32_t CoreSimulator::picture() const {
  return state_->outputs.picture;
}
std::uint64_t CoreSimulator::clocks() const {
  return state_->clocks;
}
AxiMemory& CoreSimulator::memory() {
  return state_->memory;
}

}  // namespace halfway::core
