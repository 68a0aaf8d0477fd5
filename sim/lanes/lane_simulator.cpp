// SPDX-License-Identifier: Apache-2.0
#include "sim/lanes/lane_simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "common/threads.hpp"
#include "run/golden_run.hpp"
#include "run/limits.hpp"
#include "sim/lanes/lane_api.h"
#include "sim/lanes/lane_library.hpp"
#include "sim/verilator/netlist.hpp"
#include "sim/verilator/shader_netlist.hpp"

namespace halfway {
namespace {

/// In vectors and fragments: a part ends with some clocks in which nothing comes, a batch with lanes that
/// wait for the last part.
constexpr std::size_t kShortestPart = 100;
/// Of a thread, drawn before they are handed on: they stay in the processor's second cache.
constexpr std::size_t kBatch = 64 * 1024;
/// Large triangles: a lane has nothing to do while others end theirs, so there are to be a few for each, in
/// memory if need be.
constexpr std::size_t kTrianglesALane = 8;
constexpr std::size_t kLargestBatch = 16 * kBatch;

struct Triangle {
  std::size_t vectors, pixels;
  std::size_t work() const { return vectors + pixels; }
};

}  // namespace

struct LaneSimulator::Hardware {
  HardwareKey key;
  LaneOptions options;
  SharedLibrary library;
  unsigned init_bits = 0;
  std::size_t lanes = 0;
  decltype(&halfway_lanes_run) run = nullptr;
  decltype(&halfway_lanes_fragments) fragments = nullptr;
  decltype(&halfway_lanes_cycles) cycles = nullptr;
  decltype(&halfway_lanes_create) create = nullptr;
  decltype(&halfway_lanes_destroy) destroy = nullptr;
};

struct LaneSimulator::State : Hardware {
  explicit State(Hardware hardware)
      : Hardware(std::move(hardware)),
        golden(make_golden_model(key)),
        knows_pixels(golden->init_bits() == init_bits) {
    create_lanes();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { destroy_lanes(); }

  void create_lanes() {
    for (unsigned i = 0; i < std::max(options.threads, 1U); ++i)
      threads.push_back(create(i, std::max<std::uint64_t>(options.idle_limit, 1)));
  }
  void destroy_lanes() {
    for (void* thread : threads) {
      cycles_before += cycles(thread);
      destroy(thread);
    }
    threads.clear();
  }
  void replace_lanes() {
    destroy_lanes();
    create_lanes();
  }

  /// The one that the words begin with.
  Triangle triangle(std::span<const std::uint32_t> words) const {
    const std::size_t vectors =
        std::clamp<std::size_t>(golden->group(words), 1, words.size() / vector_words());
    return {vectors, knows_pixels ? static_cast<std::size_t>(golden->pixels(words)) : kShortestPart};
  }
  std::size_t vector_words() const { return (init_bits + 31) / 32; }

  std::unique_ptr<GoldenModel>
      golden;                       ///< knows which vectors belong together, and how many pixels they cover
  bool knows_pixels;                ///< not of other hardware than the shaders
  bool drawing = false;             ///< or they broke off, and stand in the middle of triangles
  std::uint64_t cycles_before = 0;  ///< of lanes that were replaced
  std::vector<void*> threads;
  std::vector<Triangle> triangles;  ///< of a batch
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
  return LaneSimulator(std::make_shared<State>(std::move(hardware)));
}

LaneSimulator LaneSimulator::another() const {
  return with_lanes(*state_);
}

unsigned LaneSimulator::init_bits() const {
  return state_->init_bits;
}

std::uint64_t LaneSimulator::cycles() const {
  std::uint64_t sum = state_->cycles_before;
  for (const void* thread : state_->threads) sum += state_->cycles(thread);
  return sum;
}

Status LaneSimulator::run(std::span<const std::uint32_t> init_words, std::size_t max_fragments,
                          const OnDrawn& on_drawn) {
  State& s = *state_;
  const std::size_t words_per_vector = s.vector_words(), threads = s.threads.size();
  if (init_words.size() % words_per_vector != 0)
    return bad_input(fmt::format("{}: {} words are no whole vectors of {} bits", s.key.name(),
                                 init_words.size(), s.init_bits));
  if (s.drawing) s.replace_lanes();
  while (!init_words.empty()) {
    std::size_t words = 0, work = 0;
    s.triangles.clear();
    while (words < init_words.size() &&
           (work < kBatch * threads || s.triangles.size() < kTrianglesALane * s.lanes * threads)) {
      const Triangle triangle = s.triangle(init_words.subspan(words));
      if (work != 0 && work + triangle.work() > kLargestBatch * threads) break;
      s.triangles.push_back(triangle);
      words += triangle.vectors * words_per_vector;
      work += triangle.work();
    }
    s.drawing = true;
    const auto drawn = draw(init_words.first(words), max_fragments, on_drawn);
    if (!drawn) return drawn.error();
    s.drawing = false;
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
  // Long parts first, then shorter ones, so that all lanes end together.
  const std::size_t words_per_vector = s.vector_words(), all = s.lanes * s.threads.size();
  std::size_t left = 0, pixels = 0;
  for (const Triangle& triangle : s.triangles) {
    left += triangle.work();
    pixels += triangle.pixels;
  }
  if (s.knows_pixels) max_fragments = std::min<std::size_t>(max_fragments, pixels + c_most_surplus);
  const auto too_many = [&] {
    return Error{ExitCode::differs,
                 fmt::format("{} in lanes: more than {} fragments", s.key.name(), max_fragments)};
  };
  s.parts.clear();
  std::size_t vector = 0;
  for (auto next = s.triangles.begin(); next != s.triangles.end();) {
    const std::size_t wanted = std::max(kShortestPart, left / (4 * all));
    HalfwayPart part{.vector = vector};
    for (std::size_t work = 0; next != s.triangles.end() && work < wanted; ++next) {
      part.vectors += next->vectors;
      work += next->work();
      left -= next->work();
    }
    vector += part.vectors;
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
  for (const HalfwayPart& part : s.parts) {
    const auto* first = reinterpret_cast<const Fragment*>(s.fragments(s.threads[part.owner], part.lane));
    on_drawn(init_words.subspan(part.vector * words_per_vector, part.vectors * words_per_vector),
             {first + part.fragment, part.fragments});
  }
  return total;
}

}  // namespace halfway
