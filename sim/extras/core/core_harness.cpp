// SPDX-License-Identifier: Apache-2.0
// Compiled in one translation unit with the verilated halfway_core (prefix Vshader).
#include <memory>

#include "Vshader.h"
#include "sim/extras/core/core_api.h"
#include "verilated.h"

#define HALFWAY_EXPORT extern "C" __attribute__((visibility("default")))

namespace {

struct Core {
  VerilatedContext context;
  Vshader top{&context, "core"};
};

}  // namespace

HALFWAY_EXPORT void* halfway_core_create(void) {
  auto core = std::make_unique<Core>();
  core->top.aclk = 0;
  core->top.aresetn = 0;
  core->top.eval();
  return core.release();
}

HALFWAY_EXPORT void halfway_core_clock(void* core, const CoreInputs* inputs, CoreOutputs* outputs) {
  Vshader& top = static_cast<Core*>(core)->top;
  top.aresetn = inputs->aresetn;
  top.s_axi_awvalid = inputs->s_axi_awvalid;
  top.s_axi_awaddr = inputs->s_axi_awaddr;
  top.s_axi_awprot = 0;
  top.s_axi_wvalid = inputs->s_axi_wvalid;
  top.s_axi_wdata = inputs->s_axi_wdata;
  top.s_axi_wstrb = inputs->s_axi_wstrb;
  top.s_axi_bready = inputs->s_axi_bready;
  top.s_axi_arvalid = inputs->s_axi_arvalid;
  top.s_axi_araddr = inputs->s_axi_araddr;
  top.s_axi_arprot = 0;
  top.s_axi_rready = inputs->s_axi_rready;
  top.m_axi_arready = inputs->m_axi_arready;
  top.m_axi_rvalid = inputs->m_axi_rvalid;
  top.m_axi_rdata = inputs->m_axi_rdata;
  top.m_axi_rresp = inputs->m_axi_rresp;
  top.m_axi_rlast = inputs->m_axi_rlast;
  top.m_axi_awready = inputs->m_axi_awready;
  top.m_axi_wready = inputs->m_axi_wready;
  top.m_axi_bvalid = inputs->m_axi_bvalid;
  top.m_axi_bresp = inputs->m_axi_bresp;
  top.aclk = 0;
  top.eval();
  *outputs = {.interrupt = top.irq,
              .s_axi_awready = top.s_axi_awready,
              .s_axi_wready = top.s_axi_wready,
              .s_axi_bvalid = top.s_axi_bvalid,
              .s_axi_bresp = top.s_axi_bresp,
              .s_axi_arready = top.s_axi_arready,
              .s_axi_rvalid = top.s_axi_rvalid,
              .s_axi_rresp = top.s_axi_rresp,
              .m_axi_arvalid = top.m_axi_arvalid,
              .m_axi_arlen = top.m_axi_arlen,
              .m_axi_rready = top.m_axi_rready,
              .m_axi_awvalid = top.m_axi_awvalid,
              .m_axi_awlen = top.m_axi_awlen,
              .m_axi_wvalid = top.m_axi_wvalid,
              .m_axi_wstrb = top.m_axi_wstrb,
              .m_axi_wlast = top.m_axi_wlast,
              .m_axi_bready = top.m_axi_bready,
              .picture = top.picture,
              .s_axi_rdata = top.s_axi_rdata,
              .m_axi_araddr = top.m_axi_araddr,
              .m_axi_awaddr = top.m_axi_awaddr,
              .m_axi_wdata = top.m_axi_wdata};
  top.aclk = 1;
  top.eval();
}

HALFWAY_EXPORT void halfway_core_destroy(void* core) {
  static_cast<Core*>(core)->top.final();
  delete static_cast<Core*>(core);
}
