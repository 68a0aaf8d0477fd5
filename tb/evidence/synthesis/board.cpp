// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "measure.hpp"
#include "sim/cost/bitstream.hpp"
#include "sim/files/template.hpp"
#include "sim/os/must.hpp"
#include "sim/os/page_part.hpp"

namespace halfway::synth {
namespace {

constexpr const char* c_bitstream = "build/board/board.bin";

std::string figures_table(const BoardFigures& board) {
  const std::vector<std::string> columns = {
      "LUTs",
      "flip-flops",
      "RAMs",
      fmt::format("logic cells of {}", c_hx8k.cells),
      fmt::format("clock, MHz, of {} needed", c_board_mhz),
      fmt::format("strobes to the late clock, ns, of at most {}", c_strobe_ns)};
  const std::vector<std::string> row = {
      std::to_string(board.cells.luts), std::to_string(board.cells.flip_flops),
      std::to_string(board.cells.rams), std::to_string(board.logic_cells),
      fmt::format("{:.1f}", board.mhz), fmt::format("{:.1f}", board.strobe_ns)};
  return markdown_table(columns, {&row, 1});
}

}  // namespace

ExitCode board(const Options& options) {
  const BoardFigures figures = make_bitstream(options.folders, options.folders.source / c_bitstream);
  const std::string table = figures_table(figures);
  fmt::print("{}\n\n{}", c_bitstream, table);
  if (options.page)
    must(rewrite_page(options.folders.source / "docs/board.md",
                      [&](const std::string& page) { return with_page_part(page, "bitstream", table); }));
  const page::Value value{
      "board",
      "board_top",
      {static_cast<double>(figures.cells.luts), static_cast<double>(figures.cells.flip_flops),
       static_cast<double>(figures.cells.rams), figures.mhz}};
  return page::judged(options.folders.source, {&value, 1});
}

}  // namespace halfway::synth
