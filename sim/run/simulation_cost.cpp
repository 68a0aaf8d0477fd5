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

class Measurement {
 public:
  Measurement(const Scene& scene, const HardwareKey& key, const CostSettings& settings)
      : scene_(scene), key_(key), s_(settings) {}

  SimulationCost run() {
    const TemporaryFolder scratch = must(TemporaryFolder::make(s_.folders.cache));
    const std::filesystem::path init = scratch.path() / "init.txt";
    if (s_.ghdl) write_init(init);
    if (s_.verilator) cost_.verilator_seconds = least_of([&] { return verilator_pass(); });
    if (s_.ghdl) cost_.ghdl_seconds = least_of([&] { return ghdl_pass(init); });
    return cost_;
  }

 private:
  FrameDriver driver_of(std::vector<std::shared_ptr<Engine>> engines) const {
    return {scene_,
            s_.size,
            key_,
            std::move(engines),
            {.setup = s_.setup,
             .golden_picture = true,
             .workers = on_threads(s_.threads),
             .clocks = host_clocks()}};
  }

  // Also the golden frame.
  void write_init(const std::filesystem::path& path) {
    s_.on_progress(fmt::format("setup for {}", key_.name()));
    FrameDriver driver = driver_of({});
    InitFileWriter file = must(InitFileWriter::open(path, key_.name(), driver.init_bits()));
    must(driver.draw([&](const Batch& batch) {
      file.write(batch.init_words);
      return Status(Ok{});
    }));
    cost_.frame = driver.golden_frame().frame();
    must(file.commit());
  }

  double ghdl_pass(const std::filesystem::path& init) {
    s_.on_progress(fmt::format("GHDL simulates {}", key_.name()));
    const GhdlRunner runner = must(GhdlRunner::open(key_, s_.folders));
    const double begin = children_seconds();
    const GhdlRun ran =
        must(runner.run(init, init.parent_path() / "trace", {.idle_limit = idle_limit(key_)}));
    cost_.cycles = ran.cycles;
    cost_.fragments = ran.fragments;
    return children_seconds() - begin;
  }

  double verilator_pass() {
    s_.on_progress(fmt::format("Verilator simulates {}", key_.name()));
    FrameDriver driver = driver_of({must(open_engine(EngineKind::verilator, key_, s_.folders))});
    must(driver.draw());
    const SimulatorRun run = driver.frame().result();
    if (!run.fault.empty()) throw Failure{{ExitCode::differs, fmt::format("{}: {}", key_.name(), run.fault)}};
    cost_.fragments = run.fragments;
    cost_.cycles = *run.cycles;
    cost_.frame = driver.frame().assembler().frame();
    return driver.frame().seconds().rtl;
  }

  const Scene& scene_;
  const HardwareKey& key_;
  const CostSettings& s_;
  SimulationCost cost_;
};

}  // namespace

SimulationCost simulation_cost(const Scene& scene, const HardwareKey& key, const CostSettings& settings) {
  return Measurement(scene, key, settings).run();
}

}  // namespace halfway
