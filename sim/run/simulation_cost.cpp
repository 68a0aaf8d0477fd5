// SPDX-License-Identifier: Apache-2.0
#include "sim/run/simulation_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/driver/frame_driver.hpp"
#include "sim/driver/limits.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/files/init_file.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/open_engine.hpp"

namespace halfway {
namespace {

constexpr int c_most_passes = 3;
// A pass of this many seconds is measured well enough.
constexpr double c_long_pass = 1.0;

// The least of up to three passes.
template <class Pass>
double least_of(const Pass& pass) {
  double least = pass();
  for (int i = 1; i < c_most_passes && least <= c_long_pass; ++i) least = std::min(least, pass());
  return least;
}

FrameDriver driver_of(const Scene& scene, const HardwareKey& key, const CostSettings& s,
                      std::vector<std::shared_ptr<Engine>> engines) {
  return {
      scene,
      s.size,
      key,
      std::move(engines),
      {.setup = s.setup, .golden_picture = true, .workers = on_threads(s.threads), .clocks = host_clocks()}};
}

// Write the init vectors to the file. Return the golden model's frame.
Frame write_init(const Scene& scene, const HardwareKey& key, const CostSettings& s,
                 const std::filesystem::path& path) {
  s.on_progress(fmt::format("setup for {}", key.name()));
  FrameDriver driver = driver_of(scene, key, s, {});
  InitFileWriter file = must(InitFileWriter::open(path, key.name(), driver.init_bits()));
  must(driver.draw([&](const Batch& batch) {
    file.write(batch.init_words);
    return Status(Ok{});
  }));
  must(file.commit());
  return driver.golden_frame().frame();
}

// Return the seconds of one pass.
double verilator_pass(const Scene& scene, const HardwareKey& key, const CostSettings& s,
                      SimulationCost& cost) {
  s.on_progress(fmt::format("Verilator simulates {}", key.name()));
  FrameDriver driver = driver_of(scene, key, s, {must(open_engine(EngineKind::verilator, key, s.folders))});
  must(driver.draw());
  const SimulatorRun run = driver.frame().result();
  if (!run.fault.empty()) throw Failure{{ExitCode::differs, fmt::format("{}: {}", key.name(), run.fault)}};
  cost.fragments = run.fragments;
  cost.cycles = *run.cycles;
  cost.frame = driver.frame().assembler().frame();
  return driver.frame().seconds().rtl;
}

double ghdl_pass(const std::filesystem::path& init, const HardwareKey& key, const CostSettings& s,
                 SimulationCost& cost) {
  s.on_progress(fmt::format("GHDL simulates {}", key.name()));
  const GhdlRunner runner = must(GhdlRunner::open(key, s.folders));
  const double begin = children_seconds();
  const GhdlRun ran = must(runner.run(init, init.parent_path() / "trace", {.idle_limit = idle_limit(key)}));
  cost.cycles = ran.cycles;
  cost.fragments = ran.fragments;
  return children_seconds() - begin;
}

}  // namespace

SimulationCost simulation_cost(const Scene& scene, const HardwareKey& key, const CostSettings& s) {
  SimulationCost cost;
  const TemporaryFolder scratch = must(TemporaryFolder::make(s.folders.cache));
  const std::filesystem::path init = scratch.path() / "init.txt";
  if (s.ghdl) cost.frame = write_init(scene, key, s, init);
  if (s.verilator) cost.verilator_seconds = least_of([&] { return verilator_pass(scene, key, s, cost); });
  if (s.ghdl) cost.ghdl_seconds = least_of([&] { return ghdl_pass(init, key, s, cost); });
  return cost;
}

}  // namespace halfway
