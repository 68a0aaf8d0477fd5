// SPDX-License-Identifier: Apache-2.0
#include "sim/run/verilator_frame.hpp"

#include <utility>

#include "sim/os/must.hpp"
#include "sim/run/open_engine.hpp"

namespace halfway {

VerilatorFrame draw_in_verilator(const Scene& scene, FrameSize size, const HardwareKey& key,
                                 const SimulatorFolders& folders, FrameOptions options) {
  FrameDriver driver(scene, size, key, {must(open_engine(EngineKind::verilator, key, folders))},
                     std::move(options));
  must(driver.draw());
  must(driver.equal());
  const FrameAssembler& drawn = driver.frame().assembler();
  return {drawn.frame(), drawn.mask(), drawn.fragments_inside(), *driver.frame().engine().cycles(),
          driver.counts()};
}

}  // namespace halfway
