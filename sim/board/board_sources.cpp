// SPDX-License-Identifier: Apache-2.0
#include "sim/board/board_sources.hpp"

#include <algorithm>
#include <iterator>

namespace halfway::board {

HardwareKey board_key() {
  return {.shader = Shader::quadratic, .preset = Preset::exact, .channels = 3, .degree = 1};
}

Result<std::vector<VhdlSource>> board_sources(const SimulatorFolders& folders) {
  auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  auto board = read_rtl_sources(folders.source, "rtl/board");
  if (!board) return board.error();
  std::ranges::copy_if(*board, std::back_inserter(*sources),
                       [](const VhdlSource& source) { return source.name != c_board_top_file; });
  return sources;
}

}  // namespace halfway::board
