// SPDX-License-Identifier: Apache-2.0
// Draws the vectors of `FILE by the module `TOP, with random pauses at both ends, and prints each fragment as a line of
// a trace. With AXI the top has AXI4-Stream ports, and the file has the words of one frame's packets.
`timescale 1ns / 1ns

module shader_tb;
  localparam limit = 100000;  // clocks

  reg clk = 0, reset = 1;
  reg [`BITS-1:0] vectors[0:`COUNT-1];
  reg [31:0] index = 0;
  reg init_valid = 0, fragment_ready = 0;
  wire init_ready, fragment_valid;
  wire [2:0] fault;
  wire [31:0] triangle;
  wire [11:0] y, x;
  wire [23:0] z;
  wire [7:0] red, green, blue;
  wire last;
  integer seed = 1, clocks = 0;

`ifdef AXI
  wire [15:0] keep;
  wire [7:0] zero;
  wire [3:0] zero_y, zero_x;
  wire [7:0] zero_z;
  wire tlast, takes_triangle;
  `TOP top (
      .aclk(clk), .aresetn(!reset),
      .s_axis_tvalid(init_valid), .s_axis_tready(init_ready), .s_axis_tdata(vectors[index]), .s_axis_tlast(1'b0), .triangle(takes_triangle),
      .m_axis_tvalid(fragment_valid), .m_axis_tready(fragment_ready),
      .m_axis_tdata({zero, blue, green, red, triangle, zero_z, z, zero_y, y, zero_x, x}),
      .m_axis_tkeep(keep), .m_axis_tlast(tlast), .m_axis_tuser(fault)
  );
  assign last = fragment_valid && fragment_ready && tlast;
`else
  wire busy;
  assign fault[2:1] = 0;
  `TOP top (
      .clk(clk), .reset(reset),
      .init_valid(init_valid), .init_ready(init_ready), .init_data(vectors[index]),
      .fragment_valid(fragment_valid), .fragment_ready(fragment_ready), .fragment_triangle(triangle),
      .fragment_y(y), .fragment_x(x), .fragment_z(z), .fragment_red(red), .fragment_green(green), .fragment_blue(blue),
      .busy(busy), .fault(fault[0])
  );
  assign last = index == `COUNT && !busy;
`endif

  always #5 clk = !clk;

  initial $readmemh(`FILE, vectors);

  // Change the inputs between two rising edges. A vector that waits stays.
  always @(negedge clk) begin
    if (clocks > 3) begin
      init_valid = index < `COUNT && (init_valid || ($random(seed) & 1));
      fragment_ready = $random(seed) & 1;
    end
    reset = clocks < 3;
  end

  always @(posedge clk) begin
    clocks <= clocks + 1;
    if (!reset && fragment_valid && fragment_ready)
      $display("%0d %0d %0d %0d %0d %0d %0d", triangle, y, x, z, red, green, blue);
    if (!reset && fault !== 3'b0) begin
      $display("fault is %b", fault);
      $finish;
    end
    if (!reset && init_valid && init_ready) begin
      index <= index + 1;
      init_valid <= 0;
    end
    if (clocks > 8 && last) $finish;
    if (clocks > limit) begin
      $display("hangs with %0d vectors taken", index);
      $finish;
    end
  end
endmodule
