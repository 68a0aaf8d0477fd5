// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/generic_cells.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

using Json = nlohmann::json;

constexpr const char* c_multipliers = "multipliers.json";

// Replaces $mul. The passes that make LUTs leave it unchanged.
constexpr const char* c_multiplier = "multiplier_cell";
constexpr const char* c_multiplier_model = R"(module multiplier_cell (A, B, Y);
  parameter A_SIGNED = 0, B_SIGNED = 0, A_WIDTH = 1, B_WIDTH = 1, Y_WIDTH = 1;
  input [A_WIDTH-1:0] A;
  input [B_WIDTH-1:0] B;
  output [Y_WIDTH-1:0] Y;
endmodule
)";

// Number of highest bits that are redundant: copies of the sign, or zeros if unsigned.
struct Extension {
  unsigned bits = 0;
  bool is_sign = false;
};
// `word`: wire numbers, and constants as texts; lowest bit first.
Extension extension_of(const Json& word) {
  const Json& top = word.back();
  unsigned same = 1;
  while (same < word.size() && word[word.size() - 1 - same] == top) ++same;
  if (top == "0") return {same, false};
  if (top.is_string()) return {};
  return {same - 1, same > 1};
}

// Same steps as Yosys's `synth`, except that writable memory stays memory.
std::string yosys_script(const Design& design) {
  const std::string& top = design.entity;
  std::string coarse = fmt::format("synth -flatten -lut 4 -top {} -run begin:fine", top), multipliers;
  // Otherwise abc would spend most of its time on the many wide multipliers.
  if (design.has_products) {
    coarse = fmt::format(
        "read_verilog -lib {0}.v; hierarchy -top {1}; proc; flatten; opt_expr; opt_clean; opt -nodffe "
        "-nosdff; "
        "wreduce; opt_clean; chtype -set {0} t:$mul; synth -lut 4 -top {1} -run coarse:fine",
        c_multiplier, top);
    multipliers = fmt::format("; json -o {} t:{}", c_multipliers, c_multiplier);
  }
  return fmt::format(
      "read_verilog netlist.v; {}; opt -fast -full; memory_map -rom-only; opt -full; techmap; opt -fast; "
      "abc -fast -lut 4; opt -fast; memory_unpack; {}{}",
      coarse, c_statistics, multipliers);
}

constexpr CellKind c_kinds[] = {{"$lut", &Cells::luts},
                                {c_multiplier, &Cells::multipliers},
                                {"$_DFF", &Cells::flip_flops},
                                {"$_SDFF", &Cells::flip_flops},
                                // Ports of memories; memory_bits counts these.
                                {"$memrd", nullptr},
                                {"$memwr", nullptr}};

std::uint64_t luts_of(const Yosys& yosys, const MultiplierShape& shape) {
  const std::string sign = shape.is_signed ? "signed " : "";
  const std::string model = fmt::format(
      "module multiplier (input {0}[{1}:0] a, input {0}[{2}:0] b, output {0}[{3}:0] y);\n  assign y = a * "
      "{4};\nendmodule\n",
      sign, shape.a_bits - 1, shape.b_bits - 1, shape.product_bits - 1, shape.square ? "a" : "b");
  const std::string script =
      fmt::format("read_verilog multiplier.v; {} -top multiplier; {}", c_ice40.pass, c_statistics);
  const std::filesystem::path folder = yosys.run(fmt::format("multiplier-{}x{}", shape.a_bits, shape.b_bits),
                                                 script, {{"multiplier.v", model}}, read_statistics);
  return count_cells(folder, c_ice40.kinds).luts;
}

Cells read_cells(const Yosys& yosys, const std::filesystem::path& folder) {
  Cells cells = count_cells(folder, c_kinds);
  cells.memory_bits = read_statistics(folder).value("num_memory_bits", std::uint64_t{0});
  if (cells.multipliers == 0) return cells;
  const std::string text = read_own_file(folder / c_multipliers);
  const std::vector<MultiplierShape> shapes = read_multiplier_shapes(text, c_multiplier);
  if (shapes.size() != cells.multipliers)
    throw_tool_failed("{}: {} multipliers, not {}: delete it and try again",
                      (folder / c_multipliers).string(), shapes.size(), cells.multipliers);
  for (const MultiplierShape& shape : shapes) {
    cells.product_bits += shape.product_bits;
    cells.multiplier_luts += luts_of(yosys, shape);
  }
  return cells;
}

}  // namespace

std::vector<MultiplierShape> read_multiplier_shapes(const std::string& netlist, const std::string& type) {
  std::vector<MultiplierShape> shapes;
  const auto wrong = [&](const std::string& what) {
    return Failure{tool_failed(fmt::format("multiplier {}: {}", shapes.size() + 1, what))};
  };
  try {
    const Json design = Json::parse(netlist);
    for (const Json& module : design.at("modules"))
      for (const Json& cell : module.at("cells")) {
        if (cell.at("type") != type) continue;
        const Json &words = cell.at("connections"), &a = words.at("A"), &b = words.at("B");
        if (a.empty() || b.empty() || words.at("Y").empty())
          throw wrong("an operand or the product is missing");
        Extension a_more = extension_of(a), b_more = extension_of(b);
        if (a_more.bits >= a.size() || b_more.bits >= b.size())
          throw wrong("an operand is no wider than its sign");
        const auto is_signed = [&](const char* name) {
          return cell.at("parameters").at(name).get<std::string>().ends_with('1');
        };
        MultiplierShape shape{.square = a == b, .product_bits = static_cast<unsigned>(words.at("Y").size())};
        shape.is_signed = is_signed("A_SIGNED") || is_signed("B_SIGNED") || a_more.is_sign || b_more.is_sign;
        // In a signed product, an unsigned operand keeps one of its leading zeros as its sign.
        for (Extension* more : {&a_more, &b_more})
          if (shape.is_signed && !more->is_sign && more->bits > 0) --more->bits;
        shape.a_bits = static_cast<unsigned>(a.size()) - a_more.bits;
        shape.b_bits = static_cast<unsigned>(b.size()) - b_more.bits;
        shapes.push_back(shape);
      }
  } catch (const Json::exception& bad) {
    throw wrong(bad.what());
  }
  return shapes;
}

Cells generic_cells(const Yosys& yosys, const Design& design, const std::string& netlist) {
  const auto read = [&](const std::filesystem::path& folder) { return read_cells(yosys, folder); };
  return read(yosys.run(design.name, yosys_script(design),
                        {{"netlist.v", netlist}, {fmt::format("{}.v", c_multiplier), c_multiplier_model}},
                        read));
}

}  // namespace halfway::synth
