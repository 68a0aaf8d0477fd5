// SPDX-License-Identifier: Apache-2.0
#include "plan/cells.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "common/file.hpp"
#include "common/subprocess.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway {
namespace {

constexpr std::chrono::minutes kSynthesisTimeout{60};
constexpr const char* kFigures = "cells.json";
constexpr const char* kMultipliers = "multipliers.json";

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
    multipliers =
        fmt::format("; chtype -set $mul t:{}; tee -q -o {} stat -json -width", kMultiplier, kMultipliers);
  }
  return fmt::format(
      "read_verilog netlist.v; {}; opt -fast -full; memory_map -rom-only; opt -full; techmap; opt -fast; "
      "abc -fast -lut 4; opt -fast; memory_unpack; tee -q -o {} stat -json{}",
      coarse, kFigures, multipliers);
}

}  // namespace

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
  hash.add("cells 3").add(version_).add(script).add(kMultiplierModel).add(*mended);
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
    if (const auto cells = read_cells(fresh->path()); !cells) return cells.error();
    if (Status moved = fresh->move_to(folder); !moved) return moved.error();
  }
  return read_cells(folder);
}

}  // namespace halfway
