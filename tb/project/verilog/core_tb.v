// SPDX-License-Identifier: Apache-2.0
// Draws the packets of `FILE by halfway_core, on a memory of 64-bit words that answers at once, and prints each pixel that
// is not the clear colour as a line: y x red green blue. Pixels are RGB565, printed as the core has cut them.
`timescale 1ns / 1ns

module core_tb;
  localparam limit = 200000;  // clocks
  localparam words = 1 << 14;  // of 64 bits
  localparam [31:0] ring = 'h100, packets = 'h1000, colours = 'h10000, depths = 'h18000, stride = 128;

  reg clk = 0, resetn = 0;
  reg [31:0] file[0:`COUNT-1];
  reg [63:0] memory[0:words-1];
  wire irq;
  wire [31:0] picture;
  integer clocks = 0, i, x, y;

  // The register port.
  reg awvalid = 0, wvalid = 0;
  reg [7:0] awaddr;
  reg [31:0] wdata;
  wire awready, wready, bvalid, arready_lite, rvalid_lite;
  wire [1:0] bresp, rresp_lite;
  reg [1:0] taken;
  wire [31:0] rdata_lite;

  // The memory port.
  wire arvalid, rready, awvalid_m, wvalid_m, wlast, bready;
  wire [31:0] araddr, awaddr_m;
  wire [7:0] arlen, awlen, wstrb;
  wire [2:0] arsize, awsize, arprot, awprot;
  wire [1:0] arburst, awburst;
  wire [3:0] arcache, awcache;
  wire [63:0] wdata_m;
  reg rvalid = 0, rlast = 0, bvalid_m = 0, reading = 0, writing = 0;
  reg [63:0] rdata;
  reg [31:0] read_at, write_at;
  reg [7:0] left;

  halfway_core core (
      .aclk(clk), .aresetn(resetn), .irq(irq), .picture(picture),
      .s_axi_awvalid(awvalid), .s_axi_awready(awready), .s_axi_awaddr(awaddr), .s_axi_awprot(3'b0),
      .s_axi_wvalid(wvalid), .s_axi_wready(wready), .s_axi_wdata(wdata), .s_axi_wstrb(4'hF),
      .s_axi_bvalid(bvalid), .s_axi_bready(1'b1), .s_axi_bresp(bresp),
      .s_axi_arvalid(1'b0), .s_axi_arready(arready_lite), .s_axi_araddr(8'b0), .s_axi_arprot(3'b0),
      .s_axi_rvalid(rvalid_lite), .s_axi_rready(1'b1), .s_axi_rdata(rdata_lite), .s_axi_rresp(rresp_lite),
      .m_axi_arvalid(arvalid), .m_axi_arready(!reading), .m_axi_araddr(araddr), .m_axi_arlen(arlen),
      .m_axi_arsize(arsize), .m_axi_arburst(arburst), .m_axi_arcache(arcache), .m_axi_arprot(arprot),
      .m_axi_rvalid(rvalid), .m_axi_rready(rready), .m_axi_rdata(rdata), .m_axi_rresp(2'b0), .m_axi_rlast(rlast),
      .m_axi_awvalid(awvalid_m), .m_axi_awready(!writing), .m_axi_awaddr(awaddr_m), .m_axi_awlen(awlen),
      .m_axi_awsize(awsize), .m_axi_awburst(awburst), .m_axi_awcache(awcache), .m_axi_awprot(awprot),
      .m_axi_wvalid(wvalid_m), .m_axi_wready(writing && !bvalid_m), .m_axi_wdata(wdata_m), .m_axi_wstrb(wstrb),
      .m_axi_wlast(wlast), .m_axi_bvalid(bvalid_m), .m_axi_bready(bready), .m_axi_bresp(2'b0)
  );

  always #5 clk = !clk;

  // AXI4's rules: what waits does not change, and no burst crosses 4 KiB.
  wire [40:0] ar = {arvalid, araddr, arlen}, aw = {awvalid_m, awaddr_m, awlen};
  wire [73:0] w = {wvalid_m, wlast, wstrb, wdata_m};
  reg [40:0] ar_waiting = 0, aw_waiting = 0;
  reg [73:0] w_waiting = 0;
  always @(posedge clk) begin
    if (ar_waiting[40] && ar !== ar_waiting || aw_waiting[40] && aw !== aw_waiting || w_waiting[73] && w !== w_waiting
        || arvalid && araddr[11:0] + 8 * arlen + 8 > 4096 || awvalid_m && awaddr_m[11:0] + 8 * awlen + 8 > 4096) begin
      $display("a transfer changes while it waits, or a burst crosses 4 KiB");
      $finish;
    end
    ar_waiting <= reading ? ar : 0;
    aw_waiting <= writing ? aw : 0;
    w_waiting <= writing && !bvalid_m ? 0 : w;
  end

  // One burst of reads and one of writes at a time.
  always @(posedge clk) begin
    clocks <= clocks + 1;
    if (clocks > limit) begin
      $display("hangs");
      $finish;
    end
    if (arvalid && !reading) begin
      reading <= 1;
      read_at <= araddr / 8;
      left <= arlen;
    end
    if (rvalid && rready) begin
      rvalid <= 0;
      if (rlast) reading <= 0;
    end
    if (reading && !rvalid) begin
      rvalid <= 1;
      rdata <= memory[read_at];
      rlast <= left == 0;
      read_at <= read_at + 1;
      left <= left - 1;
    end
    if (awvalid_m && !writing) begin
      writing <= 1;
      write_at <= awaddr_m / 8;
    end
    if (writing && !bvalid_m && wvalid_m) begin
      for (i = 0; i < 8; i = i + 1) if (wstrb[i]) memory[write_at][8*i+:8] <= wdata_m[8*i+:8];
      write_at <= write_at + 1;
      bvalid_m <= wlast;
    end
    if (bvalid_m && bready) begin
      bvalid_m <= 0;
      writing <= 0;
    end
  end

  task write(input [7:0] address, input [31:0] value);
    begin
      @(negedge clk);
      awvalid = 1;
      wvalid = 1;
      awaddr = address;
      wdata = value;
      // A transfer is at the rising edge after this one, if it is ready now.
      while (awvalid || wvalid) begin
        taken = {awready, wready};
        @(negedge clk);
        awvalid = awvalid && !taken[1];
        wvalid = wvalid && !taken[0];
      end
      while (!bvalid) @(negedge clk);
      if (bresp !== 0) $display("response of register %h is %b", address, bresp);
    end
  endtask

  initial begin
    $readmemh(`FILE, file);
    for (i = 0; i < words; i = i + 1) memory[i] = 0;
    for (i = 0; i < `COUNT; i = i + 2) memory[packets/8+i/2] = {file[i+1], file[i]};
    // A command: docs/rtl/core.md.
    memory[ring/8] = {32'd`COUNT, packets};
    memory[ring/8+1] = {depths, colours};
    memory[ring/8+2] = {16'd`HEIGHT, 16'd`WIDTH, 16'd128, 16'd128};
    memory[ring/8+3] = {16'd`HEIGHT, 16'd0, 16'd`WIDTH, 16'd0};
    memory[ring/8+4] = 64'h0000000013000000;  // draw, swap, clear: black
    repeat (4) @(negedge clk);
    resetn = 1;
    write('h24, 1);
    write('h2C, ring);
    write('h34, 1);
    write('h18, 1);
    while (irq !== 1) @(posedge clk);
    if (picture !== colours) $display("picture is %h", picture);
    for (y = 0; y < `HEIGHT; y = y + 1)
      for (x = 0; x < `WIDTH; x = x + 1) begin
        rdata = memory[(colours+y*stride+2*x)/8] >> (16 * (x % 4));
        if (rdata[15:0] !== 0) $display("%0d %0d %0d %0d %0d", y, x, rdata[15:11], rdata[10:5], rdata[4:0]);
      end
    $finish;
  end
endmodule
