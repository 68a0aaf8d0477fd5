// SPDX-License-Identifier: Apache-2.0
// Compiled in one translation unit with the verilated halfway_core (prefix Vshader).
#include "Vshader.h"
#include "sim/extras/core/core_api.h"
#include "verilated.h"

namespace {

class Core final : public CoreModel {
 public:
  Core() {
    top_.aclk = 0;
    top_.aresetn = 0;
    top_.eval();
  }
  ~Core() override { top_.final(); }

  void clock(const CoreInputs& inputs, CoreOutputs& outputs) override {
    top_.aresetn = inputs.aresetn;
    top_.s_axi_awvalid = inputs.s_axi_awvalid;
    top_.s_axi_awaddr = inputs.s_axi_awaddr;
    top_.s_axi_awprot = 0;
    top_.s_axi_wvalid = inputs.s_axi_wvalid;
    top_.s_axi_wdata = inputs.s_axi_wdata;
    top_.s_axi_wstrb = inputs.s_axi_wstrb;
    top_.s_axi_bready = inputs.s_axi_bready;
    top_.s_axi_arvalid = inputs.s_axi_arvalid;
    top_.s_axi_araddr = inputs.s_axi_araddr;
    top_.s_axi_arprot = 0;
    top_.s_axi_rready = inputs.s_axi_rready;
    top_.m_axi_arready = inputs.m_axi_arready;
    top_.m_axi_rvalid = inputs.m_axi_rvalid;
    top_.m_axi_rdata = inputs.m_axi_rdata;
    top_.m_axi_rresp = inputs.m_axi_rresp;
    top_.m_axi_rlast = inputs.m_axi_rlast;
    top_.m_axi_awready = inputs.m_axi_awready;
    top_.m_axi_wready = inputs.m_axi_wready;
    top_.m_axi_bvalid = inputs.m_axi_bvalid;
    top_.m_axi_bresp = inputs.m_axi_bresp;
    top_.aclk = 0;
    top_.eval();
    outputs = {.interrupt = top_.irq,
               .s_axi_awready = top_.s_axi_awready,
               .s_axi_wready = top_.s_axi_wready,
               .s_axi_bvalid = top_.s_axi_bvalid,
               .s_axi_bresp = top_.s_axi_bresp,
               .s_axi_arready = top_.s_axi_arready,
               .s_axi_rvalid = top_.s_axi_rvalid,
               .s_axi_rresp = top_.s_axi_rresp,
               .m_axi_arvalid = top_.m_axi_arvalid,
               .m_axi_arlen = top_.m_axi_arlen,
               .m_axi_rready = top_.m_axi_rready,
               .m_axi_awvalid = top_.m_axi_awvalid,
               .m_axi_awlen = top_.m_axi_awlen,
               .m_axi_wvalid = top_.m_axi_wvalid,
               .m_axi_wstrb = top_.m_axi_wstrb,
               .m_axi_wlast = top_.m_axi_wlast,
               .m_axi_bready = top_.m_axi_bready,
               .picture = top_.picture,
               .s_axi_rdata = top_.s_axi_rdata,
               .m_axi_araddr = top_.m_axi_araddr,
               .m_axi_awaddr = top_.m_axi_awaddr,
               .m_axi_wdata = top_.m_axi_wdata};
    top_.aclk = 1;
    top_.eval();
  }

 private:
  VerilatedContext context_;
  Vshader top_{&context_, "core"};
};

}  // namespace

extern "C" __attribute__((visibility("default"))) CoreModel* halfway_core_create() {
  return new Core;
}
