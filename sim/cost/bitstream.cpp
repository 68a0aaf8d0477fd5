// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/bitstream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "sim/cost/placement.hpp"
#include "sim/cost/yosys.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

using nlohmann::json;

constexpr const char* c_top = "board_top";
constexpr const char* c_constraints = "rtl/board/board.pcf";
// The placement of this seed meets the clock.
constexpr const char* c_seed = "1";

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

BoardFigures read_figures(const std::filesystem::path& folder) {
  BoardFigures figures;
  try {
    const json report = json::parse(must(read_file(folder / "report.json")));
    std::vector<CellKind> kinds(c_ice40.kinds.begin(), c_ice40.kinds.end());
    kinds.push_back({"SB_", nullptr});  // cells of pins, clocks and the PLL
    figures.cells = count_cells(folder, kinds);
    figures.logic_cells = report.at("utilization").at(c_hx8k.names.logic_cell).at("used");
    for (const auto& [clock, speed] : report.at("fmax").items()) figures.mhz = speed.at("achieved");
    figures.strobe_ns = strobe_delay(report);
  } catch (const json::exception& error) {
    throw_tool_failed("not what Yosys 0.23 and nextpnr 0.4 report: {}", error.what());
  }
  if (figures.strobe_ns <= 0 || figures.strobe_ns > c_strobe_ns)
    throw_tool_failed("{}: the strobes of the SRAM take {:.1f} ns to the late clock; {} ns are the limit",
                      c_top, figures.strobe_ns, c_strobe_ns);
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

std::string board_netlist(const SimulatorFolders& folders) {
  const GhdlTool ghdl = must(GhdlTool::find());
  std::vector<VhdlSource> sources = must(read_rtl_sources(folders.source));
  for (VhdlSource& source : must(read_rtl_sources(folders.source, "rtl/board")))
    sources.push_back(std::move(source));
  const GhdlLibrary library = must(GhdlLibrary::for_synthesis(ghdl, sources, folders.cache, true));
  return must(mend_cells(must(library.synthesize(c_top, {}))));
}

BoardFigures make_bitstream(const SimulatorFolders& folders, const std::filesystem::path& output) {
  const std::string netlist = board_netlist(folders);
  const TemporaryFolder scratch = must(TemporaryFolder::make(folders.cache));
  const std::filesystem::path& folder = scratch.path();
  must(write_file(folder / "netlist.v", netlist));
  const std::vector<std::vector<std::string>> commands = {
      {"yosys", "-q", "-p",
       fmt::format("read_verilog netlist.v; {} -top {} -json board.json; {}", c_ice40.pass, c_top,
                   c_statistics)},
      placer_command(c_hx8k, c_board_mhz,
                     {"--pcf", (folders.source / c_constraints).string(), "--json", "board.json", "--asc",
                      "board.asc", "--seed", c_seed, "--report", "report.json", "--quiet"}),
      {"icepack", "board.asc", "board.bin"}};
  for (const std::vector<std::string>& command : commands) run_tool(command, folder, c_top);
  const BoardFigures figures = read_figures(folder);
  must(make_folders(output.parent_path()));
  must(write_file(output, must(read_file(folder / "board.bin"))));
  return figures;
}

}  // namespace halfway::synth
