// SPDX-License-Identifier: Apache-2.0
#include "sim/costs/cells.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway {
namespace {

using Json = nlohmann::json;

constexpr std::chrono::minutes c_synthesis_timeout{60};
constexpr const char* c_figures = "cells.json";
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

Result<std::string> run_yosys(Command command, const std::string& doing) {
  command.timeout = c_synthesis_timeout;
  const auto end = run_process(command, c_install_yosys);
  if (!end) return end.error();
  if (end->succeeded()) return end->output;
  return tool_failed(fmt::format("{}: yosys failed ({}):\n{}\n  while running: {}", doing, end->how(),
                                 end->output, to_string(command)));
}

// Read the statistics of the whole design from the output of Yosys's stat.
Result<Json> read_design(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tool_failed(text.error().message);
  const auto json = Json::parse(*text, nullptr, false);
  auto design = json.is_object() ? json.value("design", Json()) : Json();
  if (design.is_object() && design.value("num_cells_by_type", Json()).is_object()) return design;
  return tool_failed(
      fmt::format("{}: not the output of Yosys's stat; delete it and try again", path.string()));
}

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
std::string yosys_script(const HardwareKey& key) {
  const std::string top = key.entity();
  std::string coarse = fmt::format("synth -flatten -lut 4 -top {} -run begin:fine", top), multipliers;
  // Otherwise abc would spend most of its time on the many wide multipliers.
  if (key.shader == Shader::processors) {
    coarse = fmt::format(
        "read_verilog -lib {0}.v; hierarchy -top {1}; proc; flatten; opt_expr; opt_clean; opt -nodffe "
        "-nosdff; "
        "wreduce; opt_clean; chtype -set {0} t:$mul; synth -lut 4 -top {1} -run coarse:fine",
        c_multiplier, top);
    multipliers = fmt::format("; json -o {} t:{}", c_multipliers, c_multiplier);
  }
  return fmt::format(
      "read_verilog netlist.v; {}; opt -fast -full; memory_map -rom-only; opt -full; techmap; opt -fast; "
      "abc -fast -lut 4; opt -fast; memory_unpack; tee -q -o {} stat -json{}",
      coarse, c_figures, multipliers);
}

}  // namespace

Result<std::vector<MultiplierShape>> read_multiplier_shapes(const std::string& netlist,
                                                            const std::string& type) {
  std::vector<MultiplierShape> shapes;
  const auto wrong = [&](const std::string& what) {
    return tool_failed(fmt::format("multiplier {}: {}", shapes.size() + 1, what));
  };
  try {
    const Json design = Json::parse(netlist);
    for (const Json& module : design.at("modules"))
      for (const Json& cell : module.at("cells")) {
        if (cell.at("type") != type) continue;
        const Json &words = cell.at("connections"), &a = words.at("A"), &b = words.at("B");
        if (a.empty() || b.empty() || words.at("Y").empty())
          return wrong("an operand or the product is missing");
        Extension a_more = extension_of(a), b_more = extension_of(b);
        if (a_more.bits >= a.size() || b_more.bits >= b.size())
          return wrong("an operand is no wider than its sign");
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
    return wrong(bad.what());
  }
  return shapes;
}

Result<CellCounter> CellCounter::open(const SimulatorFolders& folders) {
  auto version = run_yosys({.arguments = {"yosys", "-V"}}, "looking for yosys");
  if (!version) return version.error();
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  const auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  auto library = GhdlLibrary::for_synthesis(*tool, *sources, folders.cache);
  if (!library) return library.error();
  return CellCounter(std::move(*version), std::move(*library),
                     std::filesystem::absolute(folders.cache) / "yosys");
}

Result<Cells> CellCounter::count(const HardwareKey& key) const {
  const auto netlist = library_.synthesize(key.entity(), key.generics());
  if (!netlist) return netlist.error();
  const auto mended = mend_netlist(*netlist);
  if (!mended) return mended.error();
  return figures<Cells>(key.name(), yosys_script(key),
                        {{"netlist.v", *mended}, {fmt::format("{}.v", c_multiplier), c_multiplier_model}},
                        [this](const std::filesystem::path& folder) { return read(folder); });
}

template <class Figures, class Read>
Result<Figures> CellCounter::figures(const std::string& name, const std::string& script, const Files& files,
                                     const Read& read) const {
  ContentHash hash;
  hash.add("cells 5").add(version_).add(script);
  for (const auto& [file, text] : files) hash.add(text);
  const std::filesystem::path folder = cache_ / fmt::format("{}-{}", name, hash.hex());
  if (std::filesystem::exists(folder)) return read(folder);
  auto fresh = TemporaryFolder::make(cache_);
  if (!fresh) return fresh.error();
  for (const auto& [file, text] : files)
    if (Status written = write_file(fresh->path() / file, text); !written) return written.error();
  const auto done =
      run_yosys({.arguments = {"yosys", "-q", "-p", script}, .working_folder = fresh->path()}, name);
  if (!done) return done.error();
  const auto found = read(fresh->path());
  if (!found) return found;
  if (Status moved = fresh->move_to(folder); !moved) return moved.error();
  return found;
}

Result<Cells> CellCounter::read(const std::filesystem::path& folder) const {
  const std::filesystem::path path = folder / c_figures;
  const auto design = read_design(path);
  if (!design) return design.error();
  Cells cells;
  cells.memory_bits = design->value("num_memory_bits", std::uint64_t{0});
  for (const auto& [type, count] : (*design)["num_cells_by_type"].items()) {
    if (type == "$lut")
      cells.luts += count.get<std::uint64_t>();
    else if (type == c_multiplier)
      cells.multipliers += count.get<std::uint64_t>();
    else if (type.find("DFF") != std::string::npos)
      cells.flip_flops += count.get<std::uint64_t>();
    else if (type.starts_with("$memrd") || type.starts_with("$memwr"))
      continue;  // ports of memories; memory_bits counts these
    else         // for example a latch: an error, because a correct netlist has none
      return tool_failed(fmt::format("{}: cells of type {}, neither LUT nor flip-flop", path.string(), type));
  }
  if (cells.multipliers == 0) return cells;
  const std::filesystem::path netlist = folder / c_multipliers;
  const auto text = read_file(netlist);
  if (!text) return tool_failed(text.error().message);
  const auto shapes = read_multiplier_shapes(*text, c_multiplier);
  if (!shapes) return tool_failed(fmt::format("{}: {}", netlist.string(), shapes.error().message));
  if (shapes->size() != cells.multipliers)
    return tool_failed(fmt::format("{}: {} multipliers, not {}: delete it and try again", netlist.string(),
                                   shapes->size(), cells.multipliers));
  for (const MultiplierShape& shape : *shapes) {
    cells.product_bits += shape.product_bits;
    const auto luts = luts_of(shape);
    if (!luts) return luts.error();
    cells.multiplier_luts += *luts;
  }
  return cells;
}

Result<std::uint64_t> CellCounter::luts_of(const MultiplierShape& shape) const {
  const std::string sign = shape.is_signed ? "signed " : "";
  const std::string model = fmt::format(
      "module multiplier (input {0}[{1}:0] a, input {0}[{2}:0] b, output {0}[{3}:0] y);\n  assign y = a * "
      "{4};\nendmodule\n",
      sign, shape.a_bits - 1, shape.b_bits - 1, shape.product_bits - 1, shape.square ? "a" : "b");
  const std::string script = fmt::format(
      "read_verilog multiplier.v; synth_ice40 -device hx -top multiplier; tee -q -o {} stat -json",
      c_figures);
  return figures<std::uint64_t>(fmt::format("multiplier-{}x{}", shape.a_bits, shape.b_bits), script,
                                {{"multiplier.v", model}},
                                [](const std::filesystem::path& folder) -> Result<std::uint64_t> {
                                  const auto design = read_design(folder / c_figures);
                                  if (!design) return design.error();
                                  return (*design)["num_cells_by_type"].value("SB_LUT4", std::uint64_t{0});
                                });
}

}  // namespace halfway
