// SPDX-License-Identifier: Apache-2.0
// The verilated halfway_core as a shared library: exported by core_harness.cpp, called by core_simulator.cpp.
#pragma once

#include <cstdint>

// Ports of rtl/core/halfway_core.vhd, by their names.
struct CoreInputs {
  uint8_t aresetn;
  uint8_t s_axi_awvalid, s_axi_awaddr, s_axi_wvalid, s_axi_wstrb, s_axi_bready;
  uint8_t s_axi_arvalid, s_axi_araddr, s_axi_rready;
  uint8_t m_axi_arready, m_axi_rvalid, m_axi_rresp, m_axi_rlast;
  uint8_t m_axi_awready, m_axi_wready, m_axi_bvalid, m_axi_bresp;
  uint32_t s_axi_wdata;
  uint64_t m_axi_rdata;
};

struct CoreOutputs {
  uint8_t interrupt;
  uint8_t s_axi_awready, s_axi_wready, s_axi_bvalid, s_axi_bresp;
  uint8_t s_axi_arready, s_axi_rvalid, s_axi_rresp;
  uint8_t m_axi_arvalid, m_axi_arlen, m_axi_rready;
  uint8_t m_axi_awvalid, m_axi_awlen, m_axi_wvalid, m_axi_wstrb, m_axi_wlast, m_axi_bready;
  uint32_t picture, s_axi_rdata, m_axi_araddr, m_axi_awaddr;
  uint64_t m_axi_wdata;
};

class CoreModel {
 public:
  virtual ~CoreModel() = default;
  // The outputs in a clock with these inputs; then the rising edge that ends the clock.
  virtual void clock(const CoreInputs& inputs, CoreOutputs& outputs) = 0;
};

extern "C" CoreModel* halfway_core_create();
