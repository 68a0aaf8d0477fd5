// SPDX-License-Identifier: Apache-2.0
#include "sim/lanes/lane_simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "common/threads.hpp"
#include "common/to_integer.hpp"
#include "run/golden_run.hpp"
#include "sim/lanes/lane_api.h"
#include "sim/lanes/lane_library.hpp"
#include "sim/verilator/netlist.hpp"
#include "sim/verilator/shader_netlist.hpp"

namespace halfway {
namespace {

/// Fragments, about: a part ends with some clocks in which nothing comes, and all with lanes that wait for
/// the last one.
constexpr double kShortestPart = 100;
/// Fragments a thread, about, that are drawn before they are handed on: they stay in the processor's second
/// cache.
constexpr double kBatch = 64 * 1024;
/// Those a lane, and their vectors, that tell how many a vector has.
constexpr double kToTell = 100;

}  // namespace

struct LaneSimulator::Hardware {
  HardwareKey key;
  LaneOptions options;
  SharedLibrary library;
  unsigned init_bits = 0;
  std::size_t lanes = 0;
  double fragments_per_vector = kBatch;              ///< of late; many, so that the first batch is small
  std::size_t told_fragments = 0, told_vectors = 0;  ///< since then
  decltype(&halfway_lanes_run) run = nullptr;
  decltype(&halfway_lanes_fragments) fragments = nullptr;
  decltype(&halfway_lanes_cycles) cycles = nullptr;
  decltype(&halfway_lanes_create) create = nullptr;
  decltype(&halfway_lanes_destroy) destroy = nullptr;
};

struct LaneSimulator::State : Hardware {
  explicit State(Hardware hardware) : Hardware(std::move(hardware)), golden(make_golden_model(key)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    for (void* thread : threads) destroy(thread);
  }

  /// Whole triangles of `rest`, vector `at` and those behind it, `batch` vectors or a few more; the first
  /// vector behind them.
  std::size_t add_parts(std::span<const std::uint32_t> rest, std::size_t at, std::size_t batch);

  std::unique_ptr<GoldenModel> golden;  ///< knows which vectors belong together
  std::vector<void*> threads;
  std::vector<HalfwayPart> parts;
};

std::size_t LaneSimulator::State::add_parts(std::span<const std::uint32_t> rest, std::size_t at,
                                            std::size_t batch) {
  const std::size_t words_per_vector = (init_bits + 31) / 32, all = lanes * threads.size();
  const std::size_t first = at, behind = at + rest.size() / words_per_vector;
  const auto shortest = to_integer<std::size_t>(kShortestPart / (fragments_per_vector + 1)) + 1;
  while (at < behind && at - first < batch) {
    // Shorter ones at the end, so that all lanes end together.
    const std::size_t wanted = std::max(shortest, std::min(batch, behind - at) / (4 * all));
    HalfwayPart part{.vector = at};
    while (at < behind && part.vectors < wanted) {
      const std::size_t triangle = std::clamp<std::size_t>(
          golden->group(rest.subspan((at - first) * words_per_vector)), 1, behind - at);
      part.vectors += triangle;
      at += triangle;
    }
    parts.push_back(part);
  }
  return at;
}

std::string LaneSimulator::refused(const HardwareKey& key) {
  if (key.shader == Shader::processors) return "its lights and counters outlive a triangle";
  return key.probe ? "they have no probes" : "";
}

Result<LaneSimulator> LaneSimulator::open(const HardwareKey& key, const SimulatorFolders& folders,
                                          const LaneOptions& options) {
  if (const std::string why = refused(key); !why.empty()) return bad_input(key.name() + ": no lanes: " + why);
  auto netlist = netlist_of(key, folders);
  if (!netlist) return netlist.error();
  const unsigned init_bits = port_bits(*netlist, key.entity(), "init_data");
  if (init_bits == 0)
    return tool_failed(fmt::format("{}: the netlist has no module with the port init_data", key.name()));
  const LaneBuild build{.name = key.name(),
                        .netlist = std::move(*netlist),
                        .top = key.entity(),
                        .ports = {.fixed = {{"fragment_ready", true}},
                                  .outputs = {"init_ready", "fragment_valid", "fragment_triangle",
                                              "fragment_y", "fragment_x", "fragment_z", "fragment_red",
                                              "fragment_green", "fragment_blue", "busy", "fault"}},
                        .harness = folders.source / "sim/lanes/lane_harness.cpp",
                        .source = folders.source,
                        .definitions = {fmt::format("HALFWAY_INIT_BITS={}", init_bits)},
                        .fast = options.fast,
                        .compiler = options.compiler};
  auto library = open_lanes(build, folders.cache);
  if (!library) return library.error();

  Hardware hardware{.key = key, .options = options, .library = std::move(*library), .init_bits = init_bits};
  decltype(&halfway_lanes_version) version = nullptr;
  decltype(&halfway_lanes_count) count = nullptr;
  if (Status bound = hardware.library.bind(
          version, "halfway_lanes_version", count, "halfway_lanes_count", hardware.run, "halfway_lanes_run",
          hardware.fragments, "halfway_lanes_fragments", hardware.cycles, "halfway_lanes_cycles",
          hardware.create, "halfway_lanes_create", hardware.destroy, "halfway_lanes_destroy");
      !bound)
    return bound.error();
  if (version() != HALFWAY_LANES_VERSION) {
    return tool_failed(
        fmt::format("{}: of another version; delete it and try again", hardware.library.file().string()));
  }
  hardware.lanes = count();
  return with_lanes(std::move(hardware));
}

LaneSimulator LaneSimulator::with_lanes(Hardware hardware) {
  auto state = std::make_shared<State>(std::move(hardware));
  for (unsigned i = 0; i < std::max(state->options.threads, 1U); ++i)
    state->threads.push_back(state->create(i, std::max<std::uint64_t>(state->options.idle_limit, 1)));
  return LaneSimulator(std::move(state));
}

LaneSimulator LaneSimulator::another() const {
  return with_lanes(*state_);
}

unsigned LaneSimulator::init_bits() const {
  return state_->init_bits;
}

std::uint64_t LaneSimulator::cycles() const {
  std::uint64_t sum = 0;
  for (const void* thread : state_->threads) sum += state_->cycles(thread);
  return sum;
}

Status LaneSimulator::run(std::span<const std::uint32_t> init_words, std::size_t max_fragments,
                          const OnDrawn& on_drawn) {
  State& s = *state_;
  const std::size_t words_per_vector = (s.init_bits + 31) / 32, threads = s.threads.size();
  const std::size_t vectors = init_words.size() / words_per_vector;
  const auto words_of = [&](std::size_t vector, std::size_t count) {
    return init_words.subspan(vector * words_per_vector, count * words_per_vector);
  };
  const auto too_many = [&] {
    return Error{ExitCode::differs,
                 fmt::format("{} in lanes: more than {} fragments", s.key.name(), max_fragments)};
  };
  s.parts.clear();
  std::size_t next_part = 0, taken = 0, left = max_fragments;
  for (std::size_t at = 0; at < vectors || taken < s.parts.size();) {
    const bool begins = at == 0;
    if (next_part == s.parts.size() && at < vectors) {
      const auto batch =
          to_integer<std::size_t>(kBatch * static_cast<double>(threads) / (s.fragments_per_vector + 1)) + 1;
      at = s.add_parts(words_of(at, vectors - at), at, batch);
    }
    std::size_t waiting = 0;
    for (std::size_t part = taken; part < next_part; ++part) waiting += s.parts[part].fragments;
    const bool ends = waiting > s.options.most_waiting * threads;  // what is begun, and nothing else
    const std::size_t count = ends ? next_part : s.parts.size();

    std::atomic<int> worst = HALFWAY_DONE;
    std::atomic<std::size_t> next_thread = 0;
    work_on_threads(static_cast<unsigned>(std::min(threads, s.parts.size())), [&] {
      for (std::size_t i; (i = next_thread++) < threads;) {
        const HalfwayBatch now{.words = init_words.data(),
                               .parts = s.parts.data(),
                               .count = count,
                               .next = &next_part,
                               .taken = taken,
                               .max_fragments = left,
                               .enough = ends ? SIZE_MAX : static_cast<std::size_t>(kBatch),
                               .begins = begins,
                               .more = !ends && at < vectors};
        const int status = s.run(s.threads[i], &now);
        for (int seen = worst; status > seen && !worst.compare_exchange_weak(seen, status);) {
        }
      }
    });
    switch (worst) {
      case HALFWAY_DONE:
        break;
      case HALFWAY_BUFFER_FULL:
        return too_many();
      case HALFWAY_HANG:
        return Error{
            ExitCode::differs,
            fmt::format("{} in lanes: hang: nothing moved in a lane for as long as is allowed, after {} "
                        "cycles of all lanes",
                        s.key.name(), cycles())};
      case HALFWAY_FAULT:
        return Error{ExitCode::differs, fmt::format("{} in lanes: the hardware tells a fault", s.key.name())};
      default:
        return tool_failed(fmt::format("{} in lanes: unknown status {}", s.key.name(), worst.load()));
    }
    // Who found none to begin has counted, too.
    next_part = std::min(next_part, count);

    for (; taken < s.parts.size() && s.parts[taken].ended != 0; ++taken) {
      const HalfwayPart& part = s.parts[taken];
      if (part.fragments > left) return too_many();
      left -= part.fragments;
      s.told_fragments += part.fragments;
      s.told_vectors += part.vectors;
      const auto* first = reinterpret_cast<const Fragment*>(s.fragments(s.threads[part.owner], part.lane));
      on_drawn(words_of(part.vector, part.vectors), {first + part.fragment, part.fragments});
    }
    // A few may be of another size than most.
    if (static_cast<double>(s.told_fragments + s.told_vectors) < kToTell * static_cast<double>(s.lanes))
      continue;
    s.fragments_per_vector = static_cast<double>(s.told_fragments) / static_cast<double>(s.told_vectors);
    s.told_fragments = s.told_vectors = 0;
  }
  return Ok{};
}

Status LaneSimulator::run(std::span<const std::uint32_t> init_words, std::size_t vectors,
                          std::vector<Fragment>& out, std::size_t max_fragments) {
  const std::size_t words_per_vector = (state_->init_bits + 31) / 32;
  if (init_words.size() != words_per_vector * vectors)
    return bad_input(fmt::format("{}: {} words are not {} vectors of {} bits", state_->key.name(),
                                 init_words.size(), vectors, state_->init_bits));
  return run(init_words, max_fragments - std::min(max_fragments, out.size()),
             [&](auto, std::span<const Fragment> fragments) {
               out.insert(out.end(), fragments.begin(), fragments.end());
             });
}

}  // namespace halfway
