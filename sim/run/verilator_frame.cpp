// SPDX-License-Identifier: Apache-2.0
#include "sim/run/verilator_frame.hpp"

#include <fmt/format.h>

#include <memory>

#include "sim/compare/limits.hpp"
#include "sim/formats/made_formats.hpp"
#include "sim/run/rtl_stream.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/run/tile_setup.hpp"

namespace halfway {

Result<VerilatorFrame> draw_in_verilator(const Scene& scene, FrameSize size, const HardwareKey& key,
                                         const SetupOptions& options, const SimulatorFolders& folders,
                                         unsigned threads, const std::optional<Tile>& tile,
                                         const MadeFormats* formats) {
  auto simulator = VerilatorSimulator::open(key, folders, {.idle_limit = c_idle_limit});
  if (!simulator) return simulator.error();
  const std::unique_ptr<Setup> frame = make_setup(scene, size, key, options, formats);
  std::optional<TileSetup> part;
  if (tile) part.emplace(*frame, make_golden_model(key, formats), *tile);
  SceneStream stream(part ? static_cast<const Setup&>(*part) : *frame, key, threads,
                     {.ahead = threads > 1, .formats = formats});
  RtlStream rtl(size, tile.value_or(whole_frame(size)), scene.background);
  VerilatorFeed feed(*simulator, rtl);
  for (Batch batch; stream.next(batch);) {
    if (Status status = check_shadow_counts(scene, stream); !status) return status.error();
    rtl.add_golden(batch.golden);
    if (Status status = feed.add(batch.init_words); !status) return status.error();
  }
  if (Status status = feed.finish(); !status) return status.error();
  if (Status status = check_projection(scene, stream); !status) return status.error();
  VerilatorFrame drawn{rtl.assembler().frame(), rtl.assembler().mask(), rtl.assembler().fragments_inside(),
                       simulator->cycles(), stream.counts()};
  const SimulatorRun run = rtl.finish("verilator");
  if (run.equal()) return drawn;
  return Error{ExitCode::differs,
               fmt::format("{}: the RTL differs from the golden model: {} mismatches {}\n{}", key.name(),
                           run.mismatches, run.fault, run.description)};
}

}  // namespace halfway
