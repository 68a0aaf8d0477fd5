// SPDX-License-Identifier: Apache-2.0
#include "formal_verilog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "text.hpp"

namespace halfway::proofs {
namespace {

constexpr std::string_view c_dut = "dut_";

std::string_view without_leading_spaces(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string_view::npos ? std::string_view() : line.substr(begin);
}

// Connects a signal `dut_x` that the unit leaves free, of as many bits as `value` says, to the signal `x`
// inside the instance `dut`: Yosys does so by the name when it flattens.
std::string connected_to_dut(std::string_view name, std::string_view value) {
  const int bits = std::stoi(std::string(value));
  const std::string inside = fmt::format("\\dut.{} ", name.substr(c_dut.size()));
  return fmt::format("  (* hierconn *) wire [{}:0] {};\n  assign {} = {};\n", bits - 1, inside, name, inside);
}

// In a netlist with a reset, properties are checked from the second clock on, and the first one is a reset,
// unless the unit has an assumption `starts` of its own.
std::string statements_of(const std::vector<std::string>& asserts, const std::vector<std::string>& assumes,
                          bool has_reset, bool is_top) {
  std::string text;
  if (has_reset) text += "  reg proof_started = 0;\n  always @(posedge clk) proof_started <= 1;\n";
  const bool has_start =
      std::ranges::any_of(assumes, [](const std::string& line) { return contains(line, "_starts: "); });
  if (has_reset && is_top && !has_start) text += "  always @* assume (proof_started || reset);\n";
  for (const std::string& line : assumes) text += line;
  for (const std::string& line : asserts) text += line;
  return text;
}

// An assertion of the RTL itself has no label, so GHDL gives it a number: n34. It checks what the unit
// assumes of the inputs.
bool is_of_unit(std::string_view label) {
  return !label.starts_with('n') || label.find_first_not_of("0123456789", 1) != std::string_view::npos;
}

// GHDL writes an assertion as $fatal and an assumption as VHDL. Yosys reads assert and assume:
//   always @*                                    always @* x: assert (n1_o);
//     if (!n1_o)
//       $fatal(1, "assertion failure x");
//   x: assert n1_o = '1' severity warning; --  assume       always @* x: assume (n1_o);
FormalVerilog with_properties(std::string_view netlist, std::string_view top) {
  const std::vector<std::string_view> lines = lines_of(netlist);
  const bool has_reset = contains(netlist, "input  reset");
  const std::string top_line = fmt::format("module {}", top);
  bool is_top = false;
  std::vector<std::string> asserts, assumes;  // of the module
  FormalVerilog result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = lines[i];
    if (i + 2 < lines.size() && contains(lines[i + 2], "$fatal(") &&
        without_leading_spaces(line) == "always @*") {
      if (const auto label = between(lines[i + 2], "failure ", "\""); is_of_unit(label)) {
        asserts.push_back(fmt::format("  always @* {}: assert ({}{});\n", label,
                                      has_reset ? "!proof_started || " : "",
                                      between(lines[i + 1], "if (!", ")")));
        ++result.counts.asserts;
      }
      i += 2;
    } else if (line.ends_with("--  assume")) {
      assumes.push_back(fmt::format("  always @* {}: assume ({});\n", between(line, "  ", ":"),
                                    between(line, "assert ", " =")));
      ++result.counts.assumes;
    } else if (contains(line, "'bX; // (signal)")) {
      // Drop the driver of a signal that the unit leaves free: Yosys makes it an arbitrary value.
      if (const auto name = between(line, "assign ", " "); name.starts_with(c_dut))
        result.text += connected_to_dut(name, between(line, "= ", "'"));
    } else {
      if (line.starts_with("module ")) is_top = line == top_line;
      if (line == "endmodule" && !(asserts.empty() && assumes.empty())) {
        result.text += statements_of(asserts, assumes, has_reset, is_top);
        asserts.clear();
        assumes.clear();
      }
      result.text.append(line).push_back('\n');
    }
  }
  return result;
}

// GHDL writes a constant of more than 32 bits as a string of digits: "01" for 2'b01. It writes zeros for the
// sign bits of a negative one.
Result<std::string> with_numbers(std::string_view verilog) {
  std::string result;
  while (!verilog.empty()) {
    const std::size_t open = verilog.find('"');
    const std::size_t close = open == std::string_view::npos ? open : verilog.find('"', open + 1);
    if (close == std::string_view::npos) break;
    const std::string_view digits = verilog.substr(open + 1, close - open - 1);
    const bool is_binary = !digits.empty() && digits.find_first_not_of("01") == std::string_view::npos;
    if (is_binary && digits.size() > 32 && digits.find('1') == digits.size() - 32)
      return tool_failed(
          fmt::format("{}: GHDL lost the sign of this constant; write it as a positive one", digits));
    result.append(verilog.substr(0, open));
    result += is_binary ? fmt::format("{}'b{}", digits.size(), digits) : fmt::format("\"{}\"", digits);
    verilog.remove_prefix(close + 1);
  }
  return result.append(verilog);
}

int count_statements(std::string_view unit, std::string_view keyword) {
  int count = 0;
  for (std::string_view line : lines_of(unit)) {
    line = line.substr(0, line.find("--"));
    if (contains(line, fmt::format(" : {} ", keyword))) ++count;
  }
  return count;
}

}  // namespace

Result<FormalVerilog> formal_verilog(std::string_view netlist, std::string_view top) {
  FormalVerilog formal = with_properties(netlist, top);
  if (contains(formal.text, "$fatal"))
    return tool_failed("GHDL wrote an assertion in a form that is not known; rewrite the assertion");
  auto text = with_numbers(formal.text);
  if (!text) return text.error();
  formal.text = std::move(*text);
  return formal;
}

PropertyCounts count_properties(std::string_view unit) {
  return {count_statements(unit, "assert"), count_statements(unit, "assume")};
}

}  // namespace halfway::proofs
