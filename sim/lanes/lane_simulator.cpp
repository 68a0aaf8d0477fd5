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

/// Fragments, about: a part ends with some clocks in which nothing comes, a batch with lanes that wait for
/// the last part.
constexpr double kShortestPart = 100;
/// Fragments a thread, about, that are drawn before they are handed on: they stay in the processor's second
/// cache.
constexpr double kBatch = 64 * 1024;
/// Large triangles: a lane has nothing to do while others end theirs, so there are to be a few for each, in
/// memory if need be.
constexpr std::size_t kTrianglesALane = 8;
constexpr double kLargestBatch = 16 * kBatch;

}  // namespace

struct LaneSimulator::Hardware {
  HardwareKey key;
  LaneOptions options;
  SharedLibrary library;
  unsigned init_bits = 0;
  std::size_t lanes = 0;
  double fragments_per_vector = kBatch;  ///< in the batch before; many, so that the first one is small
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

  std::unique_ptr<GoldenModel> golden;  ///< knows which vectors belong together
  std::vector<void*> threads;
  std::vector<HalfwayPart> parts;
};

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
  const std::size_t words_per_vector = (s.init_bits + 31) / 32;
  const std::size_t few_triangles = kTrianglesALane * s.lanes * s.threads.size();
  while (init_words.size() >= words_per_vector) {
    const auto words_of = [&](double fragments) {  // about so many a thread
      return (to_integer<std::size_t>(fragments * static_cast<double>(s.threads.size()) /
                                      (s.fragments_per_vector + 1)) +
              1) *
             words_per_vector;
    };
    const std::size_t wanted = words_of(kBatch), most = words_of(kLargestBatch);
    std::size_t words = 0;
    for (std::size_t triangles = 0;
         words < init_words.size() && (words < wanted || (triangles < few_triangles && words < most));
         ++triangles) {
      const std::size_t triangle = s.golden->group(init_words.subspan(words)) * words_per_vector;
      words = std::min(words + std::max(triangle, words_per_vector), init_words.size());
    }
    const auto drawn = draw(init_words.first(words), max_fragments, on_drawn);
    if (!drawn) return drawn.error();
    max_fragments -= *drawn;
    init_words = init_words.subspan(words);
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

Result<std::size_t> LaneSimulator::draw(std::span<const std::uint32_t> init_words, std::size_t max_fragments,
                                        const OnDrawn& on_drawn) {
  State& s = *state_;
  const auto too_many = [&] {
    return Error{ExitCode::differs,
                 fmt::format("{} in lanes: more than {} fragments", s.key.name(), max_fragments)};
  };
  // Long parts first, then shorter ones, so that all lanes end together.
  const std::size_t words_per_vector = (s.init_bits + 31) / 32, all = s.lanes * s.threads.size();
  const std::size_t vectors = init_words.size() / words_per_vector;
  const auto shortest = to_integer<std::size_t>(kShortestPart / (s.fragments_per_vector + 1)) + 1;
  s.parts.clear();
  for (std::size_t at = 0; at < vectors;) {
    const std::size_t wanted = std::max(shortest, (vectors - at) / (4 * all));
    HalfwayPart part{.vector = at};
    while (at < vectors && part.vectors < wanted) {
      const auto rest = init_words.subspan(at * words_per_vector, (vectors - at) * words_per_vector);
      const std::size_t triangle = std::clamp<std::size_t>(s.golden->group(rest), 1, vectors - at);
      part.vectors += triangle;
      at += triangle;
    }
    s.parts.push_back(part);
  }

  std::size_t next_part = 0;
  std::atomic<int> worst = HALFWAY_DONE;
  std::atomic<std::size_t> next_thread = 0;
  work_on_threads(static_cast<unsigned>(std::min(s.threads.size(), s.parts.size())), [&] {
    for (std::size_t i; (i = next_thread++) < s.threads.size();) {
      HalfwayBatch batch{init_words.data(), s.parts.data(), s.parts.size(), &next_part, max_fragments};
      const int status = s.run(s.threads[i], &batch);
      for (int seen = worst; status > seen && !worst.compare_exchange_weak(seen, status);) {
      }
    }
  });
  std::size_t total = 0;
  for (const HalfwayPart& part : s.parts) total += part.fragments;
  switch (worst) {
    case HALFWAY_DONE:
      if (total > max_fragments) return too_many();
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
  if (vectors > 0) s.fragments_per_vector = static_cast<double>(total) / static_cast<double>(vectors);
  for (const HalfwayPart& part : s.parts) {
    const auto* first = reinterpret_cast<const Fragment*>(s.fragments(s.threads[part.owner], part.lane));
    on_drawn(init_words.subspan(part.vector * words_per_vector, part.vectors * words_per_vector),
             {first + part.fragment, part.fragments});
  }
  return total;
}

}  // namespace halfway
