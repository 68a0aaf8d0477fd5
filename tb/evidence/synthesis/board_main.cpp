// SPDX-License-Identifier: Apache-2.0
// halfway_board: makes the board's bitstream, prints its figures and compares them with the thresholds.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "evidence/thresholds.hpp"
#include "sim/cost/bitstream.hpp"
#include "sim/files/page_part.hpp"
#include "sim/files/template.hpp"
#include "sim/os/must.hpp"
#include "sim/os/program.hpp"

namespace halfway::synth {

constexpr const char* c_page = "docs/board.md";  // relative to the project's root

namespace {

struct Options {
  SimulatorFolders folders{};
  std::filesystem::path output{};
  bool page = false;
};

std::string figures_table(const BoardFigures& board) {
  const std::vector<std::string> columns = {
      "LUTs",
      "flip-flops",
      "RAMs",
      fmt::format("logic cells of {}", c_device_cells),
      fmt::format("clock, MHz, of {} needed", c_board_mhz),
      fmt::format("strobes to the late clock, ns, of at most {}", c_strobe_ns)};
  const std::vector<std::string> row = {
      std::to_string(board.cells.luts), std::to_string(board.cells.flip_flops),
      std::to_string(board.cells.rams), std::to_string(board.logic_cells),
      fmt::format("{:.1f}", board.mhz), fmt::format("{:.1f}", board.strobe_ns)};
  return markdown_table(columns, {&row, 1});
}

ExitCode run(const Options& options) {
  const BoardFigures board = make_bitstream(options.folders, options.output);
  const std::string table = figures_table(board);
  fmt::print("{}\n\n{}", options.output.string(), table);
  if (options.page)
    must(rewrite_page(options.folders.source / c_page,
                      [&](const std::string& page) { return with_page_part(page, "bitstream", table); }));
  const page::Value value{"board",
                          "board_top",
                          {static_cast<double>(board.cells.luts), static_cast<double>(board.cells.flip_flops),
                           static_cast<double>(board.cells.rams), board.mhz}};
  return must(page::judged(options.folders.source, {&value, 1}));
}

}  // namespace
}  // namespace halfway::synth

int main(int argc, char** argv) {
  using namespace halfway;
  synth::Options options;
  CLI::App app{"The board's bitstream, and its figures against the thresholds", "halfway_board"};
  app.add_flag("--page", options.page, fmt::format("write the figures into {}", synth::c_page));
  app.add_option("SOURCE", options.folders.source, "the project's root")->required();
  app.add_option("CACHE", options.folders.cache, "folder of what was made before")->required();
  app.add_option("OUTPUT", options.output, "the bitstream")->required();
  int exit_code = 0;
  app.callback([&] {
    options.folders.source = std::filesystem::absolute(options.folders.source);
    options.folders.cache = std::filesystem::absolute(options.folders.cache);
    exit_code = static_cast<int>(synth::run(options));
  });
  return cli::run_program(app, argc, argv, exit_code);
}
