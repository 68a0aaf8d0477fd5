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

SharedLibrary open_core(const CoreKey& key, const SimulatorFolders& folders) {
  const std::filesystem::path folder = folders.source / "sim/extras/core";
  return must(open_verilated(
      {.name = key.name(),
       .netlist = must(mend_netlist(must(rtl_library(folders).synthesize(c_core_top, key.generics())))),
       .top = c_core_top,
       .harness = folder / "core_harness.cpp",
       .include_folder = folders.source,
       .harness_headers = {folder / "core_api.h"},
       .verilator_flags = c_allowed},
      folders.cache));
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

CoreSimulator::CoreSimulator(const CoreKey& key, MemoryTiming timing, const SimulatorFolders& folders)
    : library_(open_core(key, folders)), memory_(key.bus_bits / 8, timing) {
  decltype(&halfway_core_create) create = nullptr;
  must(library_.bind(create, "halfway_core_create"));
  core_.reset(create());
  for (; clocks_ < c_reset_clocks; ++clocks_) core_->clock(inputs_, outputs_);
  inputs_.aresetn = 1;
}

void CoreSimulator::clock() {
  ++clocks_;
  core_->clock(inputs_, outputs_);
  memory_.clock(inputs_, outputs_);
}

CoreSimulator::Answer CoreSimulator::read(std::uint32_t address) {
  inputs_.s_axi_araddr = static_cast<std::uint8_t>(address);
  inputs_.s_axi_arvalid = inputs_.s_axi_rready = 1;
  for (std::uint64_t i = 0; i < c_most_access_clocks; ++i) {
    clock();
    if (outputs_.s_axi_arready != 0) inputs_.s_axi_arvalid = 0;
    if (outputs_.s_axi_rvalid == 0) continue;
    inputs_.s_axi_rready = 0;
    return {outputs_.s_axi_rdata, outputs_.s_axi_rresp};
  }
  hangs(fmt::format("no answer to a read of register {:02x}", address), c_most_access_clocks);
}

std::uint8_t CoreSimulator::write(std::uint32_t address, std::uint32_t value, unsigned strobes) {
  inputs_.s_axi_awaddr = static_cast<std::uint8_t>(address);
  inputs_.s_axi_wdata = value;
  inputs_.s_axi_wstrb = static_cast<std::uint8_t>(strobes);
  inputs_.s_axi_awvalid = inputs_.s_axi_wvalid = inputs_.s_axi_bready = 1;
  for (std::uint64_t i = 0; i < c_most_access_clocks; ++i) {
    clock();
    if (outputs_.s_axi_awready != 0) inputs_.s_axi_awvalid = 0;
    if (outputs_.s_axi_wready != 0) inputs_.s_axi_wvalid = 0;
    if (outputs_.s_axi_bvalid == 0) continue;
    inputs_.s_axi_bready = 0;
    return outputs_.s_axi_bresp;
  }
  hangs(fmt::format("no answer to a write of register {:02x}", address), c_most_access_clocks);
}

void CoreSimulator::wait(std::uint64_t most) {
  for (std::uint64_t i = 0; !interrupt(); ++i) {
    if (i == most) hangs("no interrupt", most);
    clock();
  }
}

}  // namespace halfway::core
