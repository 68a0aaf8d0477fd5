// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/verilator/verilator_simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "sim/engines/verilator/harness_api.h"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/os/file.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_chunk = 1U << 11;  ///< fragments output at a time: they stay in the cache

static_assert(sizeof(Fragment) == sizeof(HalfwayFragment));
static_assert(offsetof(Fragment, triangle) == offsetof(HalfwayFragment, triangle));
static_assert(offsetof(Fragment, z) == offsetof(HalfwayFragment, z));
static_assert(offsetof(Fragment, y) == offsetof(HalfwayFragment, y));
static_assert(offsetof(Fragment, x) == offsetof(HalfwayFragment, x));
static_assert(offsetof(Fragment, red) == offsetof(HalfwayFragment, red));
static_assert(offsetof(Fragment, green) == offsetof(HalfwayFragment, green));
static_assert(offsetof(Fragment, blue) == offsetof(HalfwayFragment, blue));

}  // namespace

struct VerilatorSimulator::Hardware {
  SharedLibrary library;
  std::string name;
  HalfwayOptions options{};
  decltype(&halfway_create) create = nullptr;
  decltype(&halfway_run) run = nullptr;
  decltype(&halfway_drain) drain = nullptr;
  decltype(&halfway_cycles) cycles = nullptr;
  decltype(&halfway_destroy) destroy = nullptr;
};

struct VerilatorSimulator::State : Hardware {
  explicit State(Hardware hardware) : Hardware(std::move(hardware)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (model != nullptr) destroy(model);
  }

  std::string wave_path;
  std::vector<Fragment> chunk = std::vector<Fragment>(c_chunk);
  void* model = nullptr;
};

Result<VerilatorSimulator> VerilatorSimulator::open(const HardwareKey& key, const SimulatorFolders& folders,
                                                    const VerilatorOptions& options) try {
  // Builds with waveforms or another netlist simulate few cycles, so compile them without optimization.
  const bool fast = options.wave_file.empty() && options.netlist.empty();
  std::string netlist = netlist_of(key, folders);
  const unsigned init_bits = port_bits(netlist, key.entity(), "init_data");
  if (init_bits == 0)
    return tool_failed(fmt::format("{}: the netlist has no module with the port init_data", key.name()));
  if (!options.netlist.empty()) netlist = options.netlist;
  const std::filesystem::path folder = folders.source / "sim/engines/verilator";
  const VerilatedBuild build{.name = key.name() + (options.wave_file.empty() ? "" : "-waves") +
                                     (options.netlist.empty() ? "" : "-mapped"),
                             .netlist = std::move(netlist),
                             .top = key.entity(),
                             .harness = folder / "verilator_harness.cpp",
                             .include_folder = folders.source,
                             .harness_headers = {folder / "harness_api.h"},
                             .definitions = {fmt::format("HALFWAY_INIT_BITS={}", init_bits)},
                             .waves = !options.wave_file.empty(),
                             .fast = fast,
                             .compiler = options.compiler};
  Hardware hardware{.library = must(open_verilated(build, folders.cache)), .name = key.name()};
  decltype(&halfway_harness_version) version = nullptr;
  must(hardware.library.bind(version, "halfway_harness_version", hardware.create, "halfway_create",
                             hardware.destroy, "halfway_destroy", hardware.run, "halfway_run", hardware.drain,
                             "halfway_drain", hardware.cycles, "halfway_cycles"));
  if (version() != HALFWAY_HARNESS_VERSION) {
    return tool_failed(
        fmt::format("{}: of another version; delete it and try again", hardware.library.file().string()));
  }
  hardware.options.init_bits = init_bits;
  hardware.options.stall_seed = options.stall_seed;
  hardware.options.idle_limit = std::max<std::uint64_t>(options.idle_limit, 1);
  auto state = std::make_shared<State>(std::move(hardware));
  if (!options.wave_file.empty()) {
    const auto absolute = std::filesystem::absolute(options.wave_file);
    must(make_folders(absolute.parent_path()));
    state->wave_path = absolute.string();
    state->options.waves_path = state->wave_path.c_str();
    state->options.waves_from = options.waves_from;
    state->options.waves_to = options.waves_to;
  }
  return with_model(std::move(state));
} catch (const Failure& failure) {
  return failure.error;
}

Result<VerilatorSimulator> VerilatorSimulator::with_model(std::shared_ptr<State> state) {
  state->model = state->create(&state->options);
  if (state->model == nullptr) {
    return tool_failed(state->wave_path.empty()
                           ? fmt::format("{}: does not fit {}; delete it and try again",
                                         state->library.file().string(), state->name)
                           : fmt::format("{}: cannot write the waveforms", state->wave_path));
  }
  return VerilatorSimulator(std::move(state));
}

Result<std::shared_ptr<Engine>> VerilatorSimulator::another() const {
  auto state = std::make_shared<State>(static_cast<const Hardware&>(*state_));
  state->options.waves_path = nullptr;
  return shared_engine(with_model(std::move(state)));
}

std::optional<std::uint64_t> VerilatorSimulator::cycles() const {
  return state_->cycles(state_->model);
}

Status VerilatorSimulator::draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
                                const OnDrawn& on_drawn) {
  return advance(init_words, false, most, on_drawn);
}

Status VerilatorSimulator::drain(std::uint64_t most, const OnDrawn& on_drawn) {
  return advance({}, true, most, on_drawn);
}

Status VerilatorSimulator::advance(std::span<const std::uint32_t> init_words, bool drain, std::uint64_t most,
                                   const OnDrawn& on_drawn) {
  State& s = *state_;
  const std::size_t words_per_vector = (s.options.init_bits + 31) / 32;
  if (init_words.size() % words_per_vector != 0)
    return bad_input(fmt::format("{}: {} words are no whole vectors of {} bits", s.name, init_words.size(),
                                 s.options.init_bits));
  HalfwayStreams streams{init_words.data(), init_words.size() / words_per_vector, nullptr, 0, 0};
  for (std::uint64_t left = most;; left -= streams.count) {
    // Allow one more than the limit, to detect that it is exceeded.
    streams.fragments = reinterpret_cast<HalfwayFragment*>(s.chunk.data());
    streams.capacity = left < c_chunk ? left + 1 : c_chunk;
    streams.count = 0;
    const int status = drain ? s.drain(s.model, &streams) : s.run(s.model, &streams);
    if (streams.count != 0) on_drawn(std::span(s.chunk).first(streams.count));
    switch (status) {
      case halfway_done:
        if (streams.count <= left) return Ok{};
        break;
      case halfway_buffer_full:
        break;
      case halfway_hang:
        return Error{
            ExitCode::differs,
            fmt::format("{} in Verilator: hang: nothing moved for {} cycles after {} cycles, with {} vectors "
                        "still to be taken",
                        s.name, s.options.idle_limit, s.cycles(s.model), streams.vectors)};
      case halfway_changed:
        return Error{
            ExitCode::differs,
            fmt::format("{} in Verilator: a fragment changed or was withdrawn while it was not taken, after "
                        "{} cycles",
                        s.name, s.cycles(s.model))};
      case halfway_fault:
        return Error{ExitCode::differs,
                     fmt::format("{} in Verilator: the hardware refused a vector, by cycle {}", s.name,
                                 s.cycles(s.model))};
      default:
        return tool_failed(fmt::format("{} in Verilator: unknown status {}", s.name, status));
    }
    if (streams.count > left)
      return Error{ExitCode::differs, fmt::format("{} in Verilator: more than {} fragments", s.name, most)};
  }
}

}  // namespace halfway
