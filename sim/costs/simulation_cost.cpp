// SPDX-License-Identifier: Apache-2.0
#include "sim/costs/simulation_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "frame/assemble.hpp"
#include "sim/compare/limits.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/rtl_frame.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/system/file.hpp"
#include "sim/system/seconds.hpp"

namespace halfway {
namespace {

constexpr int c_most_passes = 3;
// A pass of this many seconds is measured well enough.
constexpr double c_long_pass = 1.0;

// The least of up to three passes.
Status least_of(std::optional<double>& least, const std::function<Result<double>()>& pass) {
  for (int i = 0; i < c_most_passes && !(least > c_long_pass); ++i) {
    const auto seconds = pass();
    if (!seconds) return seconds.error();
    least = std::min(*seconds, least.value_or(*seconds));
  }
  return Ok{};
}

class Measurement {
 public:
  Measurement(const Scene& scene, const HardwareKey& key, const CostSettings& settings)
      : scene_(scene), key_(key), s_(settings), setup_(make_setup(scene, s_.size, key_, s_.setup)) {}

  Result<SimulationCost> run() {
    auto scratch = TemporaryFolder::make(s_.folders.cache);
    if (!scratch) return scratch.error();
    const std::filesystem::path init = scratch->path() / "init.txt";
    if (s_.ghdl)
      if (Status status = write_init(init); !status) return status.error();
    if (s_.verilator)
      if (Status status = least_of(cost_.verilator_seconds, [&] { return verilator_pass(); }); !status)
        return status.error();
    if (s_.ghdl)
      if (Status status = least_of(cost_.ghdl_seconds, [&] { return ghdl_pass(init); }); !status)
        return status.error();
    return cost_;
  }

 private:
  // Also the golden frame.
  Status write_init(const std::filesystem::path& path) {
    s_.on_progress(fmt::format("setup for {}", key_.name()));
    auto file = InitFileWriter::open(path, key_.name(), setup_->init_bits());
    if (!file) return file.error();
    FrameAssembler assembler(s_.size, scene_.background);
    SceneStream stream(*setup_, key_, s_.threads);
    for (Batch batch; stream.next(batch);) {
      file->write(batch.init_words);
      if (Status status = assembler.add(batch.golden); !status) return status;
    }
    cost_.frame = assembler.frame();
    return file->commit();
  }

  Result<double> ghdl_pass(const std::filesystem::path& init) {
    s_.on_progress(fmt::format("GHDL simulates {}", key_.name()));
    const auto runner = GhdlRunner::open(key_, s_.folders);
    if (!runner) return runner.error();
    const double begin = children_seconds();
    const auto ran = runner->run(init, init.parent_path() / "trace", {.idle_limit = c_idle_limit});
    if (!ran) return ran.error();
    cost_.cycles = ran->cycles;
    cost_.fragments = ran->fragments;
    return children_seconds() - begin;
  }

  Result<double> verilator_pass() {
    s_.on_progress(fmt::format("Verilator simulates {}", key_.name()));
    auto engine = open_engine(EngineKind::verilator, key_, s_.folders);
    if (!engine) return engine.error();
    RtlFrame rtl(std::move(*engine), s_.size, scene_.background);
    SceneStream stream(*setup_, key_, s_.threads);
    if (Status status = rtl.draw(scene_, stream); !status) return status.error();
    const SimulatorRun run = rtl.result();
    if (!run.fault.empty()) return Error{ExitCode::differs, fmt::format("{}: {}", key_.name(), run.fault)};
    cost_.fragments = run.fragments;
    cost_.cycles = *run.cycles;
    cost_.frame = rtl.assembler().frame();
    return rtl.seconds().rtl;
  }

  const Scene& scene_;
  const HardwareKey& key_;
  const CostSettings& s_;
  std::unique_ptr<Setup> setup_;
  SimulationCost cost_;
};

}  // namespace

Result<SimulationCost> simulation_cost(const Scene& scene, const HardwareKey& key,
                                       const CostSettings& settings) {
  return Measurement(scene, key, settings).run();
}

}  // namespace halfway
