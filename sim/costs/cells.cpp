// SPDX-License-Identifier: Apache-2.0
#include "sim/costs/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway {
namespace {

constexpr std::chrono::minutes kSynthesisTimeout{60};
constexpr const char* kFigures = "cells.json";
constexpr const char* kMultipliers = "multipliers.json";
constexpr const char* kShapes = "multipliers.il";

// Stands for $mul, and is left alone by what makes LUTs.
constexpr const char* kMultiplier = "multiplier_cell";
constexpr const char* kMultiplierModel = R"(module multiplier_cell (A, B, Y);
  parameter A_SIGNED = 0, B_SIGNED = 0, A_WIDTH = 1, B_WIDTH = 1, Y_WIDTH = 1;
  input [A_WIDTH-1:0] A;
  input [B_WIDTH-1:0] B;
  output [Y_WIDTH-1:0] Y;
endmodule
)";

Result<std::string> run_yosys(Command command, const std::string& doing) {
  command.timeout = kSynthesisTimeout;
  const auto end = run_process(command, kInstallYosys);
  if (!end) return end.error();
  if (end->succeeded()) return end->output;
  return tool_failed(fmt::format("{}: yosys failed ({}):\n{}\n  while running: {}", doing, end->how(),
                                 end->output, to_string(command)));
}

// A figure of the whole design in what Yosys's stat wrote.
Result<nlohmann::json> read_design(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tool_failed(text.error().message);
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  auto design = json.is_object() ? json.value("design", nlohmann::json()) : nlohmann::json();
  if (design.is_object() && design.value("num_cells_by_type", nlohmann::json()).is_object()) return design;
  return tool_failed(fmt::format("{}: not what Yosys's stat writes; delete it and try again", path.string()));
}

// With the widths of what they give: $mul_48.
Status read_multipliers(const std::filesystem::path& path, Cells& cells) {
  const auto design = read_design(path);
  if (!design) return design.error();
  constexpr std::string_view c_prefix = "$mul_";
  for (const auto& [type, count] : (*design)["num_cells_by_type"].items()) {
    if (!type.starts_with(c_prefix)) continue;
    const auto n = count.get<std::uint64_t>();
    cells.multipliers += n;
    cells.product_bits += n * std::stoul(type.substr(c_prefix.size()));
  }
  return Ok{};
}

// A signal as `dump` writes it, in its parts, the highest first.
std::vector<std::string> parts_of(std::string_view signal) {
  std::vector<std::string> parts;
  std::istringstream words{std::string(signal)};
  for (std::string word; words >> word;) {
    if (word == "{" || word == "}") continue;
    if (word.starts_with('[') && !parts.empty())
      parts.back() += ' ' + word;
    else
      parts.push_back(word);
  }
  return parts;
}

// How many of the highest bits repeat the one below them; as many as are zeros where it is not signed.
struct Extension {
  unsigned bits = 0;
  bool is_sign = false;
};
Extension extension_of(const std::vector<std::string>& parts) {
  Extension found;
  const std::string& first = parts.front();
  if (const std::size_t quote = first.find('\''); quote != std::string::npos) {
    const std::string_view digits = std::string_view(first).substr(quote + 1);
    if (digits.find_first_not_of('0') == std::string_view::npos)
      found.bits = static_cast<unsigned>(digits.size());
    return found;
  }
  std::size_t same = 1;
  while (same < parts.size() && parts[same] == first) ++same;
  // `x [5] x [5] x [5:0]`: bit 5 is there three times.
  const std::size_t close = first.rfind(']');
  const bool goes_on = same < parts.size() && close != std::string::npos &&
                       parts[same].starts_with(first.substr(0, close) + ':');
  found.bits = static_cast<unsigned>(goes_on ? same : same - 1);
  found.is_sign = found.bits > 0;
  return found;
}

Result<Cells> read_cells(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kFigures;
  const auto design = read_design(path);
  if (!design) return design.error();
  Cells cells;
  cells.memory_bits = design->value("num_memory_bits", std::uint64_t{0});
  std::uint64_t multipliers = 0;
  for (const auto& [type, count] : (*design)["num_cells_by_type"].items()) {
    if (type == "$lut")
      cells.luts += count.get<std::uint64_t>();
    else if (type == kMultiplier)
      multipliers += count.get<std::uint64_t>();
    else if (type.find("DFF") != std::string::npos)
      cells.flip_flops += count.get<std::uint64_t>();
    else if (type.starts_with("$memrd") || type.starts_with("$memwr"))
      continue;  // ports of what memory_bits counts
    else         // a latch, say: never in a right netlist, and not to be passed over
      return tool_failed(fmt::format("{}: cells of type {}, neither LUT nor flip-flop", path.string(), type));
  }
  if (multipliers > 0)
    if (Status status = read_multipliers(folder / kMultipliers, cells); !status) return status.error();
  if (multipliers != cells.multipliers)
    return tool_failed(fmt::format("{}: {} multipliers, {} with a width: delete it and try again",
                                   path.string(), multipliers, cells.multipliers));
  return cells;
}

// As `synth` has it, but for memory that is written: that stays memory.
std::string yosys_script(const HardwareKey& key) {
  const std::string top = key.entity();
  std::string coarse = fmt::format("synth -flatten -lut 4 -top {} -run begin:fine", top), multipliers;
  // Wide multipliers, and many of them, would take nearly all of abc's time.
  if (key.shader == Shader::processors) {
    coarse = fmt::format(
        "read_verilog -lib {0}.v; hierarchy -top {1}; proc; flatten; opt_expr; opt_clean; opt -nodffe "
        "-nosdff; "
        "wreduce; opt_clean; chtype -set {0} t:$mul; synth -lut 4 -top {1} -run coarse:fine",
        kMultiplier, top);
    multipliers = fmt::format("; dump -o {} t:{}; chtype -set $mul t:{}; tee -q -o {} stat -json -width",
                              kShapes, kMultiplier, kMultiplier, kMultipliers);
  }
  return fmt::format(
      "read_verilog netlist.v; {}; opt -fast -full; memory_map -rom-only; opt -full; techmap; opt -fast; "
      "abc -fast -lut 4; opt -fast; memory_unpack; tee -q -o {} stat -json{}",
      coarse, kFigures, multipliers);
}

}  // namespace

Result<std::vector<MultiplierShape>> read_multiplier_shapes(std::string_view dump, std::string_view type) {
  std::vector<MultiplierShape> shapes;
  const auto wrong = [&](const std::string& what) {
    return tool_failed(fmt::format("multiplier {}: {}", shapes.size() + 1, what));
  };
  const std::string begin = fmt::format("cell \\{} ", type);
  std::istringstream lines{std::string(dump)};
  MultiplierShape shape;
  std::map<std::string, std::string> connected;
  std::map<std::string, unsigned> parameters;
  bool within = false;
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
    if (line.starts_with(begin)) {
      within = true;
      connected.clear();
      parameters.clear();
    } else if (within && line.starts_with("parameter \\")) {
      std::istringstream words(line.substr(std::string_view("parameter \\").size()));
      std::string name;
      unsigned value = 0;
      if (!(words >> name >> value)) return wrong("'" + line + "' is no number");
      parameters[name] = value;
    } else if (within && line.starts_with("connect \\")) {
      const std::size_t name = std::string_view("connect \\").size(), space = line.find(' ', name);
      if (space == std::string::npos) return wrong("'" + line + "' connects nothing");
      connected[line.substr(name, space - name)] = line.substr(space + 1);
    } else if (within && line == "end") {
      within = false;
      const std::vector<std::string> a = parts_of(connected["A"]), b = parts_of(connected["B"]);
      shape = {.product_bits = parameters["Y_WIDTH"]};
      if (a.empty() || b.empty() || shape.product_bits == 0) return wrong("an operand or a width is missing");
      Extension a_more = extension_of(a), b_more = extension_of(b);
      if (a_more.bits >= parameters["A_WIDTH"] || b_more.bits >= parameters["B_WIDTH"])
        return wrong("an operand is no wider than its sign");
      shape.is_signed = parameters["A_SIGNED"] != 0 || a_more.is_sign || b_more.is_sign;
      // Zeros before a word beside a signed one: one of them is its sign.
      for (Extension* more : {&a_more, &b_more})
        if (shape.is_signed && !more->is_sign && more->bits > 0) --more->bits;
      shape.square = a == b;
      shape.a_bits = parameters["A_WIDTH"] - a_more.bits;
      shape.b_bits = parameters["B_WIDTH"] - b_more.bits;
      shapes.push_back(shape);
    }
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
  const std::string script = yosys_script(key);

  ContentHash hash;
  hash.add("cells 4").add(version_).add(script).add(kMultiplierModel).add(*mended);
  const std::filesystem::path folder = cache_ / fmt::format("{}-{}", key.name(), hash.hex());
  if (!std::filesystem::exists(folder)) {
    auto fresh = TemporaryFolder::make(cache_);
    if (!fresh) return fresh.error();
    if (Status written = write_file(fresh->path() / "netlist.v", *mended); !written) return written.error();
    if (Status written = write_file(fresh->path() / fmt::format("{}.v", kMultiplier), kMultiplierModel);
        !written)
      return written.error();
    const auto done =
        run_yosys({.arguments = {"yosys", "-q", "-p", script}, .working_folder = fresh->path()}, key.name());
    if (!done) return done.error();
    if (const auto cells = read(fresh->path()); !cells) return cells.error();
    if (Status moved = fresh->move_to(folder); !moved) return moved.error();
  }
  return read(folder);
}

Result<Cells> CellCounter::read(const std::filesystem::path& folder) const {
  auto cells = read_cells(folder);
  if (!cells || cells->multipliers == 0) return cells;
  const auto dump = read_file(folder / kShapes);
  if (!dump) return tool_failed(dump.error().message);
  const auto shapes = read_multiplier_shapes(*dump, kMultiplier);
  if (!shapes) return tool_failed(fmt::format("{}: {}", (folder / kShapes).string(), shapes.error().message));
  if (shapes->size() != cells->multipliers)
    return tool_failed(fmt::format("{}: {} multipliers, not {}: delete it and try again",
                                   (folder / kShapes).string(), shapes->size(), cells->multipliers));
  for (const MultiplierShape& shape : *shapes) {
    const auto luts = luts_of(shape);
    if (!luts) return luts.error();
    cells->multiplier_luts += *luts;
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
      "read_verilog multiplier.v; synth_ice40 -device hx -top multiplier; tee -q -o {} stat -json", kFigures);
  ContentHash hash;
  hash.add("multiplier 1").add(version_).add(script).add(model);
  const std::filesystem::path folder =
      cache_ / fmt::format("multiplier-{}x{}-{}", shape.a_bits, shape.b_bits, hash.hex());
  if (!std::filesystem::exists(folder)) {
    auto fresh = TemporaryFolder::make(cache_);
    if (!fresh) return fresh.error();
    if (Status written = write_file(fresh->path() / "multiplier.v", model); !written) return written.error();
    const auto done = run_yosys({.arguments = {"yosys", "-q", "-p", script}, .working_folder = fresh->path()},
                                "multiplier");
    if (!done) return done.error();
    if (const auto design = read_design(fresh->path() / kFigures); !design) return design.error();
    if (Status moved = fresh->move_to(folder); !moved) return moved.error();
  }
  const auto design = read_design(folder / kFigures);
  if (!design) return design.error();
  return (*design)["num_cells_by_type"].value("SB_LUT4", std::uint64_t{0});
}

}  // namespace halfway
