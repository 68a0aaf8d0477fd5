// SPDX-License-Identifier: Apache-2.0
#include "sim/run/verilator_frame.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "sim/formats/made_formats.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/rtl_frame.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/run/tile_setup.hpp"

namespace halfway {

Result<VerilatorFrame> draw_in_verilator(const Scene& scene, FrameSize size, const HardwareKey& key,
                                         const SetupOptions& options, const SimulatorFolders& folders,
                                         unsigned threads, const std::optional<Tile>& tile,
                                         const MadeFormats* formats) {
  auto engine = open_engine(EngineKind::verilator, key, folders);
  if (!engine) return engine.error();
  const std::unique_ptr<Setup> frame = make_setup(scene, size, key, options, formats);
  std::optional<TileSetup> part;
  if (tile) part.emplace(*frame, make_golden_model(key, formats), *tile);
  SceneStream stream(part ? static_cast<const Setup&>(*part) : *frame, key, threads,
                     {.ahead = threads > 1, .formats = formats});
  RtlFrame rtl(std::move(*engine), size, scene.background, {.tile = tile});
  if (Status status = rtl.draw(scene, stream); !status) return status.error();
  const SimulatorRun run = rtl.result();
  if (run.equal())
    return VerilatorFrame{rtl.assembler().frame(), rtl.assembler().mask(), rtl.assembler().fragments_inside(),
                          *run.cycles, stream.counts()};
  return Error{ExitCode::differs,
               fmt::format("{}: the RTL differs from the golden model: {} mismatches {}\n{}", key.name(),
                           run.mismatches, run.fault, run.description)};
}

}  // namespace halfway
