// SPDX-License-Identifier: Apache-2.0
#include "plan/cells.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/file.hpp"
#include "common/subprocess.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway {
namespace {

constexpr std::chrono::minutes kSynthesisTimeout{60};
constexpr const char* kFigures = "cells.json";

Result<std::string> run_yosys(Command command, const std::string& doing) {
  command.timeout = kSynthesisTimeout;
  const auto end = run_process(command, kInstallYosys);
  if (!end) return end.error();
  if (end->succeeded()) return end->output;
  return tool_failed(fmt::format("{}: yosys failed ({}):\n{}\n  while running: {}", doing, end->how(),
                                 end->output, to_string(command)));
}

Result<Cells> read_cells(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tool_failed(text.error().message);
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  const auto design = json.is_object() ? json.value("design", nlohmann::json()) : nlohmann::json();
  const auto by_type =
      design.is_object() ? design.value("num_cells_by_type", nlohmann::json()) : nlohmann::json();
  if (!by_type.is_object())
    return tool_failed(
        fmt::format("{}: not what Yosys's stat writes; delete it and try again", path.string()));
  Cells cells;
  cells.memory_bits = design.value("num_memory_bits", std::uint64_t{0});
  for (const auto& [type, count] : by_type.items()) {
    if (type == "$lut")
      cells.luts += count.get<std::uint64_t>();
    else if (type.find("DFF") != std::string::npos)
      cells.flip_flops += count.get<std::uint64_t>();
    else if (type.starts_with("$memrd") || type.starts_with("$memwr"))
      continue;  // ports of what memory_bits counts
    else         // a latch, say: never in a right netlist, and not to be passed over
      return tool_failed(fmt::format("{}: cells of type {}, neither LUT nor flip-flop", path.string(), type));
  }
  return cells;
}

}  // namespace

Result<CellCounter> CellCounter::open(const SimulatorFolders& folders) {
  auto version = run_yosys({.arguments = {"yosys", "-V"}}, "looking for yosys");
  if (!version) return version.error();
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  const auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  auto library = GhdlLibrary::open(*tool, *sources, "", folders.cache);
  if (!library) return library.error();
  return CellCounter(std::move(*version), std::move(*library),
                     std::filesystem::absolute(folders.cache) / "yosys");
}

Result<Cells> CellCounter::count(const HardwareKey& key) const {
  const auto netlist = library_.synthesize(key.entity(), key.generics());
  if (!netlist) return netlist.error();
  const auto mended = mend_netlist(*netlist);
  if (!mended) return mended.error();
  // As `synth` has it, but for memory that is written: that stays memory.
  const std::string script = fmt::format(
      "read_verilog netlist.v; synth -flatten -lut 4 -top {} -run begin:fine; opt -fast -full; "
      "memory_map -rom-only; opt -full; techmap; opt -fast; abc -fast -lut 4; opt -fast; memory_unpack; "
      "tee -q -o {} stat -json",
      key.entity(), kFigures);

  ContentHash hash;
  hash.add("cells 2").add(version_).add(script).add(*mended);
  const std::filesystem::path folder = cache_ / fmt::format("{}-{}", key.name(), hash.hex());
  if (!std::filesystem::exists(folder)) {
    auto fresh = TemporaryFolder::make(cache_);
    if (!fresh) return fresh.error();
    if (Status written = write_file(fresh->path() / "netlist.v", *mended); !written) return written.error();
    const auto done =
        run_yosys({.arguments = {"yosys", "-q", "-p", script}, .working_folder = fresh->path()}, key.name());
    if (!done) return done.error();
    if (const auto cells = read_cells(fresh->path() / kFigures); !cells) return cells.error();
    if (Status moved = fresh->move_to(folder); !moved) return moved.error();
  }
  return read_cells(folder / kFigures);
}

}  // namespace halfway
