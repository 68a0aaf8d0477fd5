// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_sources.hpp"

#include "sim/os/must.hpp"

namespace halfway::board {

HardwareKey board_key() {
  return {.shader = Shader::quadratic, .preset = Preset::exact, .channels = 3, .degree = 1};
}

std::vector<VhdlSource> board_sources(const SimulatorFolders& folders) {
  std::vector<VhdlSource> sources = must(read_rtl_sources(folders.source));
  for (VhdlSource& source : must(read_rtl_sources(folders.source, "rtl/board")))
    if (source.name != c_board_top_file) sources.push_back(std::move(source));
  return sources;
}

}  // namespace halfway::board
