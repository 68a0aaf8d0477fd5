// SPDX-License-Identifier: Apache-2.0
// Expected clock counts for tb/rtl/illumination/table4_tb.vhd, from model/plan/processor_clocks.hpp.
#pragma once

#include <cstdint>
#include <filesystem>

#include "common/result.hpp"
#include "plan/processor_clocks.hpp"
#include "sim/files/vector_file.hpp"

namespace halfway::vectors {

/// One row per line: a word of preset, kind of processor (3: none works), positional, spot, N normalized,
/// view vector; then the clocks.
inline void write_table4(const std::filesystem::path& folder) {
  VectorFile file;
  for (const ProcessorClocks& row : c_processor_clocks)
    for (const Preset preset : {Preset::published, Preset::exact}) {
      const auto clocks = row.clocks(preset);
      if (!clocks) continue;
      std::uint64_t work = preset == Preset::exact ? 1 : 0;
      work = work << 2 | (row.term ? static_cast<std::uint64_t>(*row.term) : 3);
      for (const bool flag :
           {row.light == LightKind::positional, row.light == LightKind::spot, row.normalize, row.view})
        work = work << 1 | (flag ? 1 : 0);
      file.word(work, 7).word(*clocks, 32).end_vector();
    }
  file.write(folder / "table4.txt");
}

}  // namespace halfway::vectors
