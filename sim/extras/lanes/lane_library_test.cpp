// SPDX-License-Identifier: Apache-2.0
// Tests of the generator on small netlists: every operation gives Verilator's result, and unsupported
// constructs are refused.
#include "sim/extras/lanes/lane_library.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/test/is_error.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

constexpr unsigned c_stimulus_words = 5, c_response_words = 100;
constexpr std::size_t c_vectors = 500;  // per lane

// Same as tb/mutants/netlist_harness.cpp, with different vectors in each lane.
const char* const c_harness = R"(
#include "sim/extras/lanes/lane_operations.hpp"
namespace halfway::lanes { namespace {
#include "lanes.hpp"
} }
extern "C" __attribute__((visibility("default"))) unsigned lanes_count() { return halfway::lanes::c_lanes; }
extern "C" __attribute__((visibility("default"))) void lanes_run(const std::uint32_t* stimuli,
                                                                 std::size_t count, std::uint32_t* responses) {
  using namespace halfway::lanes;
  State state;
  Inputs in;
  Outputs out;
  for (int i = 0; i < 4; ++i) reset_step(state, in, out);
  for (std::size_t i = 0; i < count; ++i) {
    for (unsigned lane = 0; lane < c_lanes; ++lane) set_stimulus(in, lane, stimuli + (lane * count + i) * 5);
    step(state, in, out);
    for (unsigned lane = 0; lane < c_lanes; ++lane)
      for (unsigned word = 0; word < 100; ++word)
        responses[(lane * count + i) * 100 + word] = out.response[word][lane];
  }
}
)";

// Ports as in tb/mutants/netlist_harness.cpp.
std::string module_of(const std::string& body) {
  return "module m\n  (input  clk,\n   input  reset,\n   input  [159:0] stimulus,\n   output [3199:0] "
         "response);\n" +
         body + "endmodule\n";
}

// All constructs of the shaders' netlists, and registers that read one another at the same edge.
const char* const c_everything = R"(
  wire [39:0] a, b;
  wire [11:0] c, d;
  wire [5:0] n;
  wire e, f, g, h;
  wire [71:0] k, l;
  assign a = stimulus[39:0];
  assign b = stimulus[79:40];
  assign c = stimulus[91:80];
  assign d = stimulus[103:92];
  assign n = stimulus[109:104];
  assign e = stimulus[110];
  assign f = stimulus[111];
  assign g = stimulus[112];
  assign h = stimulus[113];
  assign k = stimulus[71:0];
  assign l = stimulus[151:80];
  reg [7:0] rom[63:0];
  reg [39:0] wide_rom[3:0];

  initial begin
ROM
    wide_rom[0] = 40'h0000000001;
    wide_rom[1] = 40'h89abcdef01;
    wide_rom[2] = 40'hff00000000;
    wide_rom[3] = 40'h7fffffffff;
  end
  // A delay that moves under a condition, longer than a ring.
  reg [31:0] slow0, slow1, slow2, slow3, slow4, slow5, slow6, slow7, slow8, slow9;
  always @(posedge clk)
    if (e) begin
      slow0 <= stimulus[31:0]; slow1 <= slow0; slow2 <= slow1; slow3 <= slow2; slow4 <= slow3;
      slow5 <= slow4; slow6 <= slow5; slow7 <= slow6; slow8 <= slow7; slow9 <= slow8;
    end
  // A number shifted step by step, and products of signed and unsigned numbers.
  wire [39:0] shifted8, shifted4;
  wire [47:0] long_a, long_b, short_a, short_b;
  assign shifted8 = g ? {a[31:0], 8'b0} : a;
  assign shifted4 = h ? shifted8 : {shifted8[35:0], 4'b0};
  assign long_a = {{24{a[23]}}, a[23:0]};
  assign long_b = {{16{b[31]}}, b[31:0]};
  assign short_a = {24'b0, a[23:0]};
  assign short_b = {16'b0, b[31:0]};
  reg [39:0] p, q, sum;
  reg [99:0] wide;
  reg [18:0] mixed;
  reg [7:0] read;
  reg [69:0] places[7:0];
  reg [69:0] place;
  reg [31:0] product;
  reg one, two;
  reg [31:0] late0, late1, late2, late3, late4, late5, late6, late7, late8, late9, taken;
  reg [11:0] left, right;
  reg stored, held, paired;
  reg [11:0] counted, caught;
  reg [3:0] unset;
  // Registers as GHDL prints them: loaded in every clock, often with their own value.
  reg [16:0] record;
  reg [11:0] walked, deep;
  reg walked_carry, top, masked_top;
  wire [11:0] addend, stepped;
  wire [13:0] digit;
  assign addend = f ? d : c;
  assign stepped = walked + addend;
  assign digit = {2'b0, c} * {12'b0, n[1] & g, n[0] & g};
  always @(posedge clk)
    record <= reset ? 17'h155 : e ? {f, c, n[3:0]} : g ? {record[16], record[15:4] + 12'd3, record[3:0]} : record;
  always @(posedge clk)
    walked <= (e | f) ? (e ? addend : stepped) : walked;
  always @(posedge clk)
    walked_carry <= (e | f) ? stepped[11] & ~e : walked_carry;
  always @(posedge clk)
    deep <= n[0] ? (n[1] ? deep : n[2] ? (n[3] ? (n[4] ? (n[5] ? (e ? (f ? deep : c) : d) : deep) : c) : deep) : d) : deep;
  always @(posedge clk) top <= digit[13] & (n[1] & g);
  always @(posedge clk) masked_top <= digit[13] & n[0];
  wire [39:0] next;
  assign next = e ? sum + a : sum - b;
  always @(posedge clk)
    if (reset) begin sum <= 40'b0; end else begin if (f) begin sum <= next; end end
  always @(posedge clk)
    if (e & f) begin p <= q; end else begin if (g) begin p <= a; end end
  always @(posedge clk)
    if (f) begin q <= p; end else begin if (h) begin q <= b; end end
  always @(posedge clk)
    if (g) begin wide <= stimulus[150:51]; end else begin if (h) begin wide <= {wide[59:0], p}; end end
  always @(posedge clk)
    if (!h) begin mixed <= c < d ? {1'b1, sum[17:0]} : {1'b0, mixed[18:1]}; end
  always @(posedge clk)
    if (f | g) begin read <= rom[n]; end
  always @(posedge clk)
    if (g) begin places[n[2:0]] <= {mixed, b, d[10:0]}; end
  always @(posedge clk)
    if (h) begin place <= places[n[5:3]]; end
  always @(posedge clk)
    product <= {20'b0, c} * {20'b0, d};
  always @(posedge clk)
    if (reset) begin one <= 1'b0; end else begin one <= two ^ e; end
  always @(posedge clk)
    if (reset) begin two <= 1'b1; end else begin if (e) begin two <= one | ~f; end end
  always @(posedge clk) begin
    late0 <= e ? stimulus[31:0] : late9;
    late1 <= late0; late2 <= late1; late3 <= late2; late4 <= late3; late5 <= late4;
    late6 <= late5; late7 <= late6; late8 <= late7; late9 <= late8;
    if (reset) begin left <= 12'd5; right <= 12'd9; end else begin left <= right; right <= left; end
  end
  always @(posedge clk)
    if (g) begin taken <= late7; end
  // Masks of what is written with them.
  always @(posedge clk) begin stored <= e ^ f; counted <= stored ? counted + 12'b1 : counted; end
  always @(posedge clk)
    if (held) begin held <= e; paired <= h; caught <= g ? c : caught; end else begin held <= f; end
  assign response = {
    418'b0, slow3, slow6, slow9, slow9 ^ slow1, wide_rom[n[1:0]], shifted4, |b[12:0], |{e, f}, |{n, a}, 1'b0,
    long_a * long_b, short_a * long_b, short_a * short_b, record, walked, deep, walked_carry, top, masked_top, 1'b0, unset, {2'b0, unset} + n, stored, held, paired, counted, caught, left, right, k + l, k - l, k * l, -k, k << n, k >> n, $signed(k) >>> n, {k[70:0], 1'b1} + {l[70:0], e},
    k == l, k < l, k >= l, $signed(k) < $signed(l), {a[38:0], 1'b1} + {b[38:0], e}, {b[38:0], f} + {a[38:0], 1'b1}, places[n[4:2]], place, {f, place[68:0]}, c != d ? a : b,
    {40{two}}, {24'b0, c, mixed[18], n, d[3:0]}, one, two, product, read, mixed, wide, q, p, sum,
    a << 5, a >> 7, a << n, a >> n, {52'b0, c} << n, $signed(c) >>> 3, $signed(d) >>> n[3:0],
    ~a, -a, a & b, a | b, a ^ b, a * b, $signed(c) * $signed(d), {16'b0, a[39:16]},
    c == d, c != d, c < d, c <= d, c > d, c >= d, e == f, e != f,
    $signed(c) < $signed(d), $signed(c) <= $signed(d), $signed(c) > $signed(d), $signed(c) >= $signed(d),
    $signed({{8{c[11]}}, c}) == $signed(b[19:0]), {3{c}},
    e ? {c, 1'b0, d} : {13'b1, n, n}, f ? a : {b[38:0], e}, g ? wide : {wide[98:0], f},
    late0, late1, late4, late6, late7, late8, late9, late9 ^ late2, taken};
)";

class Lanes : public FolderTest {
 protected:
  void SetUp() override { write("harness.cpp", c_harness); }

  LaneBuild build_of(const std::string& body, LaneVectors vectors = LaneVectors::avx512) const {
    return {.name = "test",
            .netlist = module_of(body),
            .top = "m",
            .ports = {.fixed = {}, .outputs = {"response"}},
            .harness = at("harness.cpp"),
            .source = c_source_folder,
            .definitions = {},
            .fast = false,
            .vectors = vectors};
  }
  Result<SharedLibrary> open(const std::string& body, LaneVectors vectors = LaneVectors::avx512) {
    return caught(
        [&] { return must(SharedLibrary::load(build_lanes(build_of(body, vectors), c_checkout.cache))); });
  }
  std::string lanes_of(const std::string& body) const {
    return text_of(build_lanes(build_of(body), c_checkout.cache).parent_path() / "lanes.hpp");
  }

  void expect_refused(const std::string& body, const std::string& with) {
    EXPECT_TRUE(is_error(open(body), ExitCode::tool_failed, with)) << body;
  }
};

/// The number of lanes in the widest vectors of this machine.
unsigned most_lanes() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512dq") != 0 ? 16 : __builtin_cpu_supports("avx2") != 0 ? 8 : 4;
#else
  return 4;
#endif
}

struct Vectors {
  LaneVectors vectors;
  unsigned lanes;
};
class LanesOfVectors : public Lanes, public testing::WithParamInterface<Vectors> {};
INSTANTIATE_TEST_SUITE_P(All, LanesOfVectors,
                         testing::Values(Vectors{LaneVectors::avx512, 16}, Vectors{LaneVectors::avx2, 8},
                                         Vectors{LaneVectors::sse, 4}, Vectors{LaneVectors::none, 4}));

TEST_P(LanesOfVectors, EveryOperationGivesVerilatorsResult) {
  std::string body = c_everything, rom;
  for (unsigned i = 0; i < 64; ++i) rom += fmt::format("    rom[{}] = 8'd{};\n", i, (i * i * 7 + 13) % 256);
  body.replace(body.find("ROM\n"), 4, rom);
  std::mt19937 random(20240229);
  const auto lanes = must(open(body, GetParam().vectors));
  const auto count = must(lanes.function<unsigned()>("lanes_count"));
  const unsigned lane_count = std::min(most_lanes(), GetParam().lanes);
  ASSERT_EQ(count(), lane_count);
  std::vector<std::uint32_t> stimuli(lane_count * c_vectors * c_stimulus_words);
  for (std::uint32_t& word : stimuli) {
    word = static_cast<std::uint32_t>(random());
    if (random() % 8 == 0) word = random() % 2 == 0 ? 0 : ~0U;
  }
  const auto run = must(lanes.function<void(const std::uint32_t*, std::size_t, std::uint32_t*)>("lanes_run"));
  std::vector<std::uint32_t> found(lane_count * c_vectors * c_response_words), expected(found.size());
  run(stimuli.data(), c_vectors, found.data());

  std::string verilog = module_of(body);
  const auto verilated = must(open_verilated({.name = "lanes_test",
                                              .netlist = verilog,
                                              .top = "m",
                                              .harness = c_source_folder / "tb/mutants/netlist_harness.cpp",
                                              .include_folder = c_source_folder,
                                              .harness_headers = {},
                                              .definitions = {},
                                              .fast = false,
                                              .compiler = {}},
                                             c_checkout.cache));
  const auto verilate =
      verilated.function<void(const std::uint32_t*, std::size_t, std::uint32_t*)>("netlist_run");
  ASSERT_TRUE(verilate) << verilate.error().message;
  for (unsigned lane = 0; lane < lane_count; ++lane) {
    (*verilate)(&stimuli[lane * c_vectors * c_stimulus_words], c_vectors,
                &expected[lane * c_vectors * c_response_words]);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i], expected[i]) << "lane " << i / c_response_words / c_vectors << ", vector "
                                     << i / c_response_words % c_vectors << ", word " << i % c_response_words;
  }
}

TEST_F(Lanes, KeepingAValueBecomesACondition) {
  // A record of two fields with separate conditions.
  const std::string record = lanes_of(
      "  reg [15:0] q;\n"
      "  always @(posedge clk)\n"
      "    q <= stimulus[0] ? {q[15:8], stimulus[15:8]} : stimulus[1] ? {stimulus[31:24], q[7:0]} : q;\n"
      "  assign response = {3184'b0, q};\n");
  ASSERT_NE(record.find("LANE_STEP void step("), std::string::npos) << record;
  EXPECT_EQ(record.find("select("), std::string::npos) << record;
  EXPECT_EQ(record.find("  {\n"), std::string::npos) << record;

  // A sum that is loaded or stepped. Only the step adds.
  const std::string text = lanes_of(
      "  reg [15:0] q;\n"
      "  wire [15:0] addend;\n"
      "  assign addend = stimulus[1] ? stimulus[31:16] : stimulus[63:48];\n"
      "  always @(posedge clk)\n"
      "    q <= (stimulus[0] | stimulus[1]) ? (stimulus[0] ? addend : q + addend) : q;\n"
      "  assign response = {3184'b0, q};\n");
  const std::size_t step = text.find("LANE_STEP void step("), reset = text.find("LANE_STEP void reset_step(");
  ASSERT_NE(step, std::string::npos);
  const std::string body = text.substr(step, reset - step);
  std::size_t groups = 0;
  for (std::size_t at = 0; (at = body.find("  if (any(", at)) != std::string::npos; ++at) ++groups;
  EXPECT_EQ(groups, 2U) << body;
}

TEST_F(Lanes, UnsupportedConstructsAreRefused) {
  const auto respond = [](const std::string& expression) {
    return "  assign response = " + expression + ";\n";
  };
  expect_refused(respond("{3192'b0, stimulus[7:0] / stimulus[15:8]}"), "do not support 'div'");
  expect_refused(respond("{3199'b0, ^stimulus[7:0]}"), "do not support 'redxor'");
  expect_refused("  reg [3:0] m[8191:0];\n  always @(posedge clk) m[stimulus[12:0]] <= stimulus[18:15];\n" +
                     respond("{3196'b0, m[stimulus[32:20]]}"),
                 "m.m: a memory of 8192 places");
  expect_refused(
      "  reg [3:0] m[1:0], n[1:0];\n"
      "  always @(posedge clk) if (stimulus[6]) m[stimulus[0]] <= n[stimulus[1]];\n"
      "  always @(posedge clk) if (stimulus[7]) n[stimulus[2]] <= m[stimulus[3]];\n" +
          respond("{3192'b0, m[stimulus[4]], n[stimulus[5]]}"),
      "read from one another");
  expect_refused("  reg [3:0] m[11:0];\n  always @(posedge clk) m[stimulus[3:0]] <= stimulus[7:4];\n" +
                     respond("{3196'b0, m[stimulus[11:8]]}"),
                 "m.m: an address that may be out of range");
  expect_refused("  reg q;\n  always @(negedge clk) q <= stimulus[0];\n" + respond("{3199'b0, q}"),
                 "rising edge");
  expect_refused(
      "  reg q;\n  always @(posedge clk) begin q <= stimulus[0]; if (stimulus[1]) q <= stimulus[2]; end\n" +
          respond("{3199'b0, q}"),
      "assigned twice");
  expect_refused(
      "  wire [7:0] loop;\n  assign loop = {loop[3:0] + 4'd1, loop[7:4]};\n" + respond("{3192'b0, loop}"),
      "depends on itself");
  LaneBuild build = build_of(respond("{3192'b0, stimulus[7:0]}"));
  build.ports.top = "m";
  build.ports.observed = {{"part/missing", 0, 1}};
  EXPECT_TRUE(is_error(caught([&] { build_lanes(build, c_checkout.cache); }), "part/missing: "));
}

TEST_F(Lanes, BrokenXmlIsRefused) {
  EXPECT_FALSE(generate_lanes("<verilator_xml>", {}));
  EXPECT_FALSE(generate_lanes("<verilator_xml></verilator_xml>", {}));
}

}  // namespace
}  // namespace halfway
