// SPDX-License-Identifier: Apache-2.0
// halfway_board: makes the board's bitstream and compares its figures with those in tb/board/pinned.txt. With
// the same tools the bytes are the same; with others only the clock must be met.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "sim/program/program.hpp"
#include "sim/synth/bitstream.hpp"
#include "sim/system/file.hpp"
#include "sim/system/page_part.hpp"

namespace halfway::synth {
namespace {

// Relative to the project's root.
constexpr const char* c_board_pins = "tb/board/pinned.txt";
constexpr const char* c_page = "docs/board.md";
constexpr const char* c_figures_part = "bitstream";
constexpr const char* c_sram_part = "sram";

// Times at the pins of the FPGA, in ns: tb/board/ice40_cells.vhd.
constexpr double c_clock_to_pin = 2.5, c_setup = 2.5;

struct Options {
  bool check = false, pin = false;
  SimulatorFolders folders{};
  std::filesystem::path output{};
};

// A figure by name, as text.
using Figures = std::map<std::string, std::string>;

Result<Figures> read_pins(const std::filesystem::path& path) {
  auto reader = LineReader::open(path);
  if (!reader) return reader.error();
  Figures figures;
  std::string_view line;
  for (auto next = reader->next(line); next != LineReader::Next::end_of_file; next = reader->next(line)) {
    if (next == LineReader::Next::failed) return reader->error();
    if (line.empty() || line.front() == '#') continue;
    const std::size_t space = line.find(' ');
    if (space == std::string_view::npos)
      return reader->at("not a name and a value; write the file again with make board PIN=1");
    figures[std::string(line.substr(0, space))] = line.substr(space + 1);
  }
  return figures;
}

Status write_pins(const std::filesystem::path& path, const Figures& figures) {
  std::string text =
      "# The board's bitstream: its design (hash of netlist and constraints), the tools, and what they "
      "report.\n"
      "# Written by `make board PIN=1`.\n";
  for (const auto& [name, value] : figures) text += fmt::format("{} {}\n", name, value);
  return write_file(path, text);
}

Figures figures_of(const BoardFigures& board, const std::string& tools, const std::string& design) {
  return {{"bitstream", board.bitstream},
          {"carries", std::to_string(board.cells.carries)},
          {"clock_mhz", fmt::format("{:.1f}", board.mhz)},
          {"design", design},
          {"flip_flops", std::to_string(board.cells.flip_flops)},
          {"logic_cells", std::to_string(board.logic_cells)},
          {"luts", std::to_string(board.cells.luts)},
          {"rams", std::to_string(board.cells.rams)},
          {"strobe_ns", fmt::format("{:.1f}", board.strobe_ns)},
          {"tools", tools}};
}

// Print each figure that is not as pinned.
ExitCode compare(const Figures& figures, const Figures& pins) {
  ExitCode end = ExitCode::equal;
  for (const auto& [name, value] : figures) {
    const auto pinned = pins.find(name);
    if (pinned != pins.end() && pinned->second == value) continue;
    cli::say(fmt::format("{}: {} is {}, {} is pinned; make board PIN=1 stores it", c_board_pins, name, value,
                         pinned == pins.end() ? "nothing" : pinned->second));
    end = ExitCode::differs;
  }
  return end;
}

std::string figures_table(const BoardFigures& board) {
  return fmt::format(
      "| LUTs | flip-flops | RAMs | logic cells of {} | clock, MHz, of {} needed | strobes to the late "
      "clock, ns, "
      "of at most {} |\n| --- | --- | --- | --- | --- | --- |\n| {} | {} | {} | {} | {:.1f} | {:.1f} |",
      c_device_cells, c_board_mhz, c_strobe_ns, board.cells.luts, board.cells.flip_flops, board.cells.rams,
      board.logic_cells, board.mhz, board.strobe_ns);
}

// Times of the SRAM, needed by its data sheet (tb/board/sram_model.vhd) and given by the clocks of board_top.
std::string sram_table() {
  constexpr double c_period = 1000.0 / c_board_mhz, c_quarter = c_period / 4;
  struct Row {
    const char* requirement;
    double needs, has;
  };
  constexpr Row c_rows[] = {
      {"read: from the address to the data, before the set-up of the pin's register", 10,
       c_period - c_clock_to_pin - c_setup},
      {"read: from sram_oe_n to the data, before the same", 5,
       c_period - c_quarter - c_clock_to_pin - c_setup},
      {"write: pulse", 7, 2 * c_quarter},
      {"write: address before the end of the pulse", 7, 3 * c_quarter},
      {"write: data before the end of the pulse", 5, 3 * c_quarter},
      {"write: address before the start of the pulse, address and data after its end", 0, c_quarter},
      {"write after a read and a clock without access: from sram_oe_n until the pins drive", 5,
       c_period - c_quarter},
      {"read after a write: from the end of the pins' drive to sram_oe_n", 0, c_quarter}};
  std::string table = "| requirement, ns | needs | has | margin |\n| --- | --- | --- | --- |";
  for (const Row& row : c_rows)
    table += fmt::format("\n| {} | {} | {} | {} |", row.requirement, row.needs, row.has, row.has - row.needs);
  return table;
}

Status write_page(const std::filesystem::path& source, const BoardFigures& board) {
  return rewrite_page(source / c_page, [&](const std::string& page) -> Result<std::string> {
    const auto figures = with_page_part(page, c_figures_part, figures_table(board));
    if (!figures) return figures;
    return with_page_part(*figures, c_sram_part, sram_table());
  });
}

// Only the hash of the design: seconds.
Result<ExitCode> check_design(const Options& options) {
  const auto pins = read_pins(options.folders.source / c_board_pins);
  if (!pins) return pins.error();
  const auto design = board_hash(options.folders);
  if (!design) return design.error();
  const auto pinned = pins->find("design");
  if (pinned != pins->end() && pinned->second == *design) return ExitCode::equal;
  cli::say(fmt::format("{}: the figures are of another design; make board PIN=1 stores those of this one",
                       c_board_pins));
  return ExitCode::differs;
}

Result<ExitCode> run(const Options& options) {
  if (options.check) return check_design(options);
  const auto tools = board_tools();
  if (!tools) return tools.error();
  const auto design = board_hash(options.folders);
  if (!design) return design.error();
  const auto board = make_bitstream(options.folders, options.output);
  if (!board) return board.error();
  const Figures figures = figures_of(*board, *tools, *design);
  fmt::print("{}: {} of {} logic cells, {} RAMs, {:.1f} MHz of {} needed, strobes {:.1f} ns of {}\n",
             options.output.string(), board->logic_cells, c_device_cells, board->cells.rams, board->mhz,
             c_board_mhz, board->strobe_ns, c_strobe_ns);
  const std::filesystem::path path = options.folders.source / c_board_pins;
  if (options.pin) {
    if (Status written = write_pins(path, figures); !written) return written.error();
    if (Status written = write_page(options.folders.source, *board); !written) return written.error();
    return ExitCode::equal;
  }
  const auto pins = read_pins(path);
  if (!pins) return pins.error();
  return compare(figures, *pins);
}

}  // namespace
}  // namespace halfway::synth

int main(int argc, char** argv) {
  using namespace halfway;
  synth::Options options;
  CLI::App app{"The board's bitstream, against what is pinned", "halfway_board"};
  auto* pin =
      app.add_flag("--pin", options.pin, "write the figures into the pinned file instead of comparing");
  app.add_flag("--check", options.check, "make nothing: only compare the design with the pinned one")
      ->excludes(pin);
  app.add_option("SOURCE", options.folders.source, "the project's root")->required();
  app.add_option("CACHE", options.folders.cache, "folder of what was made before")->required();
  app.add_option("OUTPUT", options.output, "the bitstream")->required();
  int exit_code = 0;
  app.callback([&] {
    options.folders.source = std::filesystem::absolute(options.folders.source);
    options.folders.cache = std::filesystem::absolute(options.folders.cache);
    const auto end = synth::run(options);
    exit_code = end ? static_cast<int>(*end) : cli::report(end.error());
  });
  return cli::run_program(app, argc, argv, exit_code);
}
