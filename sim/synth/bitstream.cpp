// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/bitstream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "sim/synth/ice40_cells.hpp"
#include "sim/synth/nameless_netlist.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway::synth {
namespace {

using nlohmann::json;

constexpr const char* c_top = "board_top";
constexpr const char* c_constraints = "rtl/board/board.pcf";
constexpr std::chrono::minutes c_bitstream_timeout{60};
// The placement of this seed meets the clock.
constexpr const char* c_seed = "1";

Result<std::string> run(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  const Command command{
      .arguments = std::move(arguments), .working_folder = folder, .timeout = c_bitstream_timeout};
  const auto end = run_process(command, c_install_board_tools);
  if (!end) return end.error();
  if (end->succeeded()) return end->output;
  return tool_failed(fmt::format("{}: {} failed ({}):\n{}\n  while running: {}", c_top,
                                 command.arguments.front(), end->how(), end->output, to_string(command)));
}

// The text that the bits of a GHDL constant spell, 8 bits per character.
std::string text_of_bits(std::string_view bits) {
  std::string text;
  for (std::size_t at = 0; at + 8 <= bits.size(); at += 8) {
    int character = 0;
    for (const char bit : bits.substr(at, 8)) character = 2 * character + (bit == '1' ? 1 : 0);
    text += static_cast<char>(character);
  }
  return text;
}

Result<json> read_json(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tool_failed(text.error().message);
  json whole = json::parse(*text, nullptr, false);
  if (!whole.is_discarded()) return whole;
  return tool_failed(fmt::format("{}: not JSON", path.string()));
}

Ice40Cells count_cells(const json& statistics) {
  Ice40Cells cells;
  for (const auto& [type, count] : statistics.at("design").at("num_cells_by_type").items()) {
    const auto n = count.get<std::uint64_t>();
    if (type == "SB_LUT4") cells.luts += n;
    if (type == "SB_CARRY") cells.carries += n;
    if (is_register_type(type)) cells.flip_flops += n;
    if (type.starts_with("SB_RAM40_4K")) cells.rams += n;
  }
  return cells;
}

// The longest path from the falling edge of the clock to the rising edge of the late clock.
double strobe_delay(const json& report) {
  double longest = 0;
  for (const json& path : report.at("critical_paths")) {
    if (!path.value("from", "").starts_with("negedge") || !path.value("to", "").starts_with("posedge late"))
      continue;
    double delay = 0;
    for (const json& part : path.at("path")) delay += part.value("delay", 0.0);
    longest = std::max(longest, delay);
  }
  return longest;
}

Result<BoardFigures> read_figures(const std::filesystem::path& folder) {
  const auto statistics = read_json(folder / "cells.json");
  if (!statistics) return statistics.error();
  const auto report = read_json(folder / "report.json");
  if (!report) return report.error();
  const auto bytes = read_file(folder / "board.bin");
  if (!bytes) return tool_failed(bytes.error().message);
  BoardFigures figures;
  try {
    figures.cells = count_cells(*statistics);
    figures.logic_cells = report->at("utilization").at("ICESTORM_LC").at("used");
    for (const auto& [clock, speed] : report->at("fmax").items()) figures.mhz = speed.at("achieved");
    figures.strobe_ns = strobe_delay(*report);
  } catch (const json::exception& error) {
    return tool_failed(fmt::format("not what Yosys 0.23 and nextpnr 0.4 report: {}", error.what()));
  }
  if (figures.strobe_ns <= 0 || figures.strobe_ns > c_strobe_ns)
    return tool_failed(
        fmt::format("{}: the strobes of the SRAM take {:.1f} ns to the late clock; {} ns are the limit",
                    c_top, figures.strobe_ns, c_strobe_ns));
  figures.bitstream = ContentHash().add(*bytes).hex();
  return figures;
}

}  // namespace

Result<std::string> mend_cells(std::string_view netlist) {
  static const std::regex c_empty_module(R"((^|\n)module SB_[^;]*;\nendmodule\n)");
  static const std::regex c_text(R"(\.(FEEDBACK_PATH|PLLOUT_SELECT_PORT[AB])\(\d+'b([01]+)\))");
  const auto mended = mend_netlist(std::regex_replace(std::string(netlist), c_empty_module, "$1"));
  if (!mended) return mended;
  std::string result;
  auto from = mended->cbegin();
  for (std::sregex_iterator at(mended->cbegin(), mended->cend(), c_text), last; at != last; ++at) {
    result.append(from, (*at)[0].first);
    result += fmt::format(".{}(\"{}\")", (*at)[1].str(), text_of_bits((*at)[2].str()));
    from = (*at)[0].second;
  }
  return result.append(from, mended->cend());
}

Result<std::string> board_netlist(const SimulatorFolders& folders) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  const auto board = read_rtl_sources(folders.source, "rtl/board");
  if (!board) return board.error();
  sources->insert(sources->end(), board->begin(), board->end());
  const auto library = GhdlLibrary::for_synthesis(*tool, *sources, folders.cache, true);
  if (!library) return library.error();
  const auto text = library->synthesize(c_top, {});
  if (!text) return text.error();
  return mend_cells(*text);
}

Result<std::string> board_hash(const SimulatorFolders& folders) {
  const auto netlist = board_netlist(folders);
  if (!netlist) return netlist.error();
  const auto constraints = read_file(folders.source / c_constraints);
  if (!constraints) return constraints.error();
  return ContentHash().add("board 1").add(c_seed).add(nameless(*netlist)).add(*constraints).hex();
}

Result<BoardFigures> make_bitstream(const SimulatorFolders& folders, const std::filesystem::path& output) {
  const auto netlist = board_netlist(folders);
  if (!netlist) return netlist.error();
  const auto scratch = TemporaryFolder::make(folders.cache);
  if (!scratch) return scratch.error();
  const std::filesystem::path& folder = scratch->path();
  if (Status written = write_file(folder / "netlist.v", *netlist); !written) return written.error();
  const std::vector<std::vector<std::string>> commands = {
      {"yosys", "-q", "-p",
       fmt::format("read_verilog netlist.v; synth_ice40 -device hx -top {} -json board.json; tee -q -o "
                   "cells.json stat -json",
                   c_top)},
      {"nextpnr-ice40", "--hx8k", "--package", "ct256", "--freq", std::to_string(c_board_mhz), "--pcf",
       (folders.source / c_constraints).string(), "--json", "board.json", "--asc", "board.asc", "--seed",
       c_seed, "--report", "report.json", "--quiet"},
      {"icepack", "board.asc", "board.bin"}};
  for (const std::vector<std::string>& command : commands)
    if (const auto done = run(folder, command); !done) return done.error();
  const auto figures = read_figures(folder);
  if (!figures) return figures;
  const auto bytes = read_file(folder / "board.bin");
  if (!bytes) return bytes.error();
  if (Status made = make_folders(output.parent_path()); !made) return made.error();
  if (Status written = write_file(output, *bytes); !written) return written.error();
  return figures;
}

Result<std::string> board_tools() {
  const auto ghdl = GhdlTool::find();
  if (!ghdl) return ghdl.error();
  const auto yosys = run({}, {"yosys", "-V"});
  if (!yosys) return yosys.error();
  const auto nextpnr = run({}, {"nextpnr-ice40", "--version"});
  if (!nextpnr) return nextpnr.error();
  const auto line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  return fmt::format("{}; {}; {}", line(ghdl->version), line(*yosys), line(*nextpnr));
}

}  // namespace halfway::synth
