// SPDX-License-Identifier: Apache-2.0
#include "sim/run/verilator_frame.hpp"

#include <fmt/format.h>

#include <memory>

#include "sim/generator/word_lengths/made_formats.hpp"
#include "sim/os/must.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/rtl_frame.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/run/tile_setup.hpp"

namespace halfway {

VerilatorFrame draw_in_verilator(const Scene& scene, FrameSize size, const HardwareKey& key,
                                 const SetupOptions& options, const SimulatorFolders& folders,
                                 unsigned threads, const std::optional<Tile>& tile,
                                 const MadeFormats* formats) {
  RtlFrame rtl(must(open_engine(EngineKind::verilator, key, folders)), size, scene.background,
               {.tile = tile});
  const std::unique_ptr<Setup> frame = make_setup(scene, size, key, options, formats);
  std::optional<TileSetup> part;
  if (tile) part.emplace(*frame, make_golden_model(key, formats), *tile);
  SceneStream stream(part ? static_cast<const Setup&>(*part) : *frame, key, threads,
                     {.ahead = threads > 1, .formats = formats});
  must(rtl.draw(scene, stream));
  const SimulatorRun run = rtl.result();
  if (!run.equal())
    throw Failure{
        {ExitCode::differs, fmt::format("{}: the RTL differs from the golden model: {} mismatches {}\n{}",
                                        key.name(), run.mismatches, run.fault, run.description)}};
  return {rtl.assembler().frame(), rtl.assembler().mask(), rtl.assembler().fragments_inside(), *run.cycles,
          stream.counts()};
}

}  // namespace halfway
