// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/lane_simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <numeric>
#include <utility>

#include "golden_run/golden_run.hpp"
#include "sim/driver/limits.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/extras/lanes/lane_api.h"
#include "sim/os/threads.hpp"
#include "sim/run/open_engine.hpp"

namespace halfway {
namespace {

/// In vectors and fragments. A part ends with some clocks without output, and a run ends with lanes that wait
/// for the last part, so parts must not be too short.
constexpr std::size_t c_shortest_part = 100;
/// Fragments per thread drawn before they are output: they stay in the processor's second-level cache.
constexpr std::size_t c_batch = 64 * 1024;

/// A triangle, a line of triangles, or a load.
struct Unit {
  std::size_t vectors, pixels;
  bool load = false;
  std::size_t work() const { return vectors + pixels; }
};

}  // namespace

struct LaneSimulator::Hardware {
  HardwareKey key;
  LaneOptions options;
  SharedLibrary library;
  unsigned init_bits = 0;
  decltype(&halfway_lanes_create) create = nullptr;
};

struct LaneSimulator::State : Hardware {
  explicit State(Hardware hardware)
      : Hardware(std::move(hardware)),
        golden(make_golden_model(key)),
        knows_pixels(golden->init_bits() == init_bits) {
    create_lanes();
  }

  void create_lanes() {
    loads = 0;
    for (unsigned i = 0; i < std::max(options.threads, 1U); ++i)
      threads.emplace_back(create(i, std::max<std::uint64_t>(options.idle_limit, 1), options.stall_seed));
  }
  void replace_lanes() {
    cycles_before = cycles_of_all();
    threads.clear();
    create_lanes();
  }

  std::uint64_t cycles_of_all() const {
    std::uint64_t sum = cycles_before;
    for (const auto& thread : threads) sum += thread->cycles();
    return sum;
  }

  /// The unit at the start of the words.
  Unit unit(std::span<const std::uint32_t> words) const {
    const std::size_t vectors =
        std::clamp<std::size_t>(golden->group(words), 1, words.size() / vector_words());
    if (!knows_pixels) return {vectors, c_shortest_part};
    return {vectors, static_cast<std::size_t>(golden->all_pixels(words.first(vectors * vector_words()))),
            golden->is_load(words)};
  }
  std::size_t vector_words() const { return (init_bits + 31) / 32; }

  std::unique_ptr<GoldenModel>
      golden;            ///< finds loads, the vectors of a unit and the number of pixels covered by it
  bool knows_pixels;     ///< false for hardware that is not one of the shaders
  bool drawing = false;  ///< true after an interruption: lanes are within triangles
  std::uint64_t cycles_before = 0;  ///< of lanes that were replaced
  std::size_t loads = 0;            ///< number of loads that all lanes have taken
  std::vector<std::unique_ptr<HalfwayLanes>> threads;
};

// The progress of a call's vectors: units ahead are grouped into parts, lanes draw the parts, and the
// complete parts at the front are output. Every lane takes every load.
class LaneSimulator::Passage {
 public:
  Passage(State& state, std::span<const std::uint32_t> init_words, std::uint64_t most)
      : s_(state), words_(init_words), first_load_(state.loads), left_(most) {}

  /// Adds enough parts for a run, unless too many fragments wait. Returns false if nothing is left.
  bool add_parts();
  Status draw();
  Status pass_on(const OnDrawn& on_drawn);

 private:
  std::size_t threads() const { return s_.threads.size(); }
  std::size_t lanes() const { return s_.threads[0]->lanes() * threads(); }
  void look_ahead();
  Error too_many(std::uint64_t limit) const {
    return {ExitCode::differs, fmt::format("{} in lanes: more than {} fragments", s_.key.name(), limit)};
  }

  State& s_;
  std::span<const std::uint32_t> words_;
  std::deque<Unit> ahead_;  ///< after the last part
  std::vector<HalfwayPart> parts_;
  std::vector<std::size_t> loads_;   ///< the vectors before vector_ that are loads
  std::vector<std::size_t> pixels_;  ///< covered by each part
  std::size_t first_load_;           ///< number of the call's first load
  std::uint64_t left_;               ///< fragments that may still be output
  std::size_t seen_ = 0;             ///< vectors in parts or ahead
  std::size_t vector_ = 0;           ///< first vector after the last part
  std::size_t work_ahead_ = 0;       ///< of the units ahead
  std::size_t first_ = 0;            ///< number of the first part
  std::size_t next_ = 0;             ///< number of the first part not yet started
  bool more_ = false;                ///< more parts must be added when all are started
};

void LaneSimulator::Passage::look_ahead() {
  const std::size_t words_per_vector = s_.vector_words();
  while (work_ahead_ < c_batch * threads() && seen_ * words_per_vector < words_.size()) {
    const Unit unit = s_.unit(words_.subspan(seen_ * words_per_vector));
    ahead_.push_back(unit);
    seen_ += unit.vectors;
    work_ahead_ += unit.work();
  }
}

bool LaneSimulator::Passage::add_parts() {
  std::size_t waiting = 0, work = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::size_t own = Unit{parts_[i].vectors, pixels_[i]}.work();
    waiting += own;
    if (first_ + i >= next_) work += own;
  }
  const auto full = [&] { return waiting != 0 && waiting >= s_.options.most_waiting * threads(); };
  const auto enough = [&] { return work >= c_batch * threads(); };
  for (look_ahead(); !ahead_.empty() && !full() && !enough(); look_ahead()) {
    if (ahead_.front().load) {
      loads_.push_back(vector_++);
      work_ahead_ -= ahead_.front().work();
      ahead_.pop_front();
      continue;
    }
    // Make shorter parts towards the end, so that all lanes end at about the same time.
    const std::size_t wanted = std::max(c_shortest_part, work_ahead_ / (4 * lanes()));
    Unit sum{0, 0};
    for (; !ahead_.empty() && !ahead_.front().load && sum.work() < wanted; ahead_.pop_front()) {
      sum.vectors += ahead_.front().vectors;
      sum.pixels += ahead_.front().pixels;
    }
    parts_.push_back({.vector = vector_, .vectors = sum.vectors});
    pixels_.push_back(sum.pixels);
    vector_ += sum.vectors;
    work_ahead_ -= sum.work();
    waiting += sum.work();
    work += sum.work();
  }
  more_ = !ahead_.empty() && !full();
  return !parts_.empty() || s_.loads < first_load_ + loads_.size();
}

Status LaneSimulator::Passage::draw() {
  std::uint64_t limit = left_;
  if (s_.knows_pixels)
    limit = std::min(limit, std::accumulate(pixels_.begin(), pixels_.end(), c_most_surplus));
  const HalfwayBatch batch{.words = words_.data(),
                           .loads = loads_.data(),
                           .first_load = first_load_,
                           .end_load = first_load_ + loads_.size(),
                           .parts = parts_.data(),
                           .first = first_,
                           .end = first_ + parts_.size(),
                           .next = &next_,
                           .max_fragments = limit,
                           .enough = c_batch,
                           .more = more_};
  std::atomic<int> worst = halfway_done;
  std::atomic<std::size_t> next_thread = 0;
  work_on_threads(static_cast<unsigned>(std::min(threads(), std::max<std::size_t>(parts_.size(), 1))), [&] {
    for (std::size_t i; (i = next_thread++) < threads();) {
      const int status = s_.threads[i]->run(batch);
      for (int seen = worst; status > seen && !worst.compare_exchange_weak(seen, status);) {
      }
    }
  });
  next_ = std::min(next_, batch.end);  // lanes that found no part have incremented it too
  // A run without parts ends when each lane has taken all loads.
  if (parts_.empty()) s_.loads = batch.end_load;
  switch (worst) {
    case halfway_done:
      return Ok{};
    case halfway_buffer_full:
      return too_many(limit);
    case halfway_hang:
      return Error{ExitCode::differs,
                   fmt::format("{} in lanes: hang: no progress in a lane within the idle limit, after {} "
                               "cycles of all lanes",
                               s_.key.name(), s_.cycles_of_all())};
    case halfway_fault:
      return Error{ExitCode::differs,
                   fmt::format("{} in lanes: the hardware reports a fault", s_.key.name())};
    default:
      return tool_failed(fmt::format("{} in lanes: unknown status {}", s_.key.name(), worst.load()));
  }
}

Status LaneSimulator::Passage::pass_on(const OnDrawn& on_drawn) {
  std::size_t whole = 0;
  for (; whole < parts_.size() && parts_[whole].ended != 0; ++whole) {
    const HalfwayPart& part = parts_[whole];
    const std::uint64_t limit = s_.knows_pixels ? std::min(left_, pixels_[whole] + c_most_surplus) : left_;
    if (part.fragments > limit) return too_many(limit);
    left_ -= part.fragments;
    const auto* first =
        reinterpret_cast<const Fragment*>(s_.threads[part.owner]->take(part.lane, part.fragments));
    on_drawn({first, part.fragments});
  }
  first_ += whole;
  parts_.erase(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(whole));
  pixels_.erase(pixels_.begin(), pixels_.begin() + static_cast<std::ptrdiff_t>(whole));
  return Ok{};
}

LaneBuild lane_build_of(const HardwareKey& key, const SimulatorFolders& folders, const LaneOptions& options) {
  if (key.processors.objects > 0)
    throw_bad_input(
        "{}: lanes do not simulate object processors, which shadows need: their netlist is too large; use "
        "another simulator",
        key.name());
  std::string netlist = netlist_of(key, folders);
  const unsigned init_bits = port_bits(netlist, key.entity(), "init_data");
  if (init_bits == 0) throw_tool_failed("{}: the netlist has no module with the port init_data", key.name());
  const bool stalls = options.stall_seed != 0;
  std::map<std::string, bool> fixed;
  std::vector<std::string> definitions = {fmt::format("HALFWAY_INIT_BITS={}", init_bits)};
  if (stalls)
    definitions.emplace_back("HALFWAY_STALLS=1");
  else
    fixed["fragment_ready"] = true;
  return {.name = key.name() + (stalls ? "-stalls" : ""),
          .netlist = std::move(netlist),
          .top = key.entity(),
          .ports = {.fixed = fixed,
                    .outputs = {"init_ready", "fragment_valid", "fragment_triangle", "fragment_y",
                                "fragment_x", "fragment_z", "fragment_red", "fragment_green", "fragment_blue",
                                "busy", "fault"}},
          .harness = folders.source / "sim/extras/lanes/lane_harness.cpp",
          .source = folders.source,
          .definitions = definitions,
          .fast = options.fast,
          .vectors = options.vectors};
}

Result<LaneSimulator> LaneSimulator::open(const HardwareKey& key, const SimulatorFolders& folders,
                                          const LaneOptions& options) try {
  const LaneBuild build = lane_build_of(key, folders, options);
  Hardware hardware{.key = key,
                    .options = options,
                    .library = must(SharedLibrary::load(build_lanes(build, folders.cache))),
                    .init_bits = port_bits(build.netlist, key.entity(), "init_data")};
  must(hardware.library.bind(hardware.create, "halfway_lanes_create"));
  return LaneSimulator(std::make_shared<State>(std::move(hardware)));
} catch (const Failure& failure) {
  return failure.error;
}

Result<std::shared_ptr<Engine>> LaneSimulator::another() const {
  const auto state = std::make_shared<State>(static_cast<const Hardware&>(*state_));
  return shared_engine(Result<LaneSimulator>(LaneSimulator(state)));
}

std::uint64_t LaneSimulator::lane_cycles() const {
  return state_->cycles_of_all();
}

Status LaneSimulator::draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
                           const OnDrawn& on_drawn) {
  State& s = *state_;
  if (init_words.size() % s.vector_words() != 0)
    return bad_input(fmt::format("{}: {} words are no whole vectors of {} bits", s.key.name(),
                                 init_words.size(), s.init_bits));
  if (s.drawing) s.replace_lanes();
  s.drawing = true;
  Passage passage(s, init_words, most);
  while (passage.add_parts()) {
    if (Status drawn = passage.draw(); !drawn) return drawn;
    if (Status taken = passage.pass_on(on_drawn); !taken) return taken;
  }
  s.drawing = false;
  return Ok{};
}

Result<std::shared_ptr<Engine>> open_lanes(const HardwareKey& key, const SimulatorFolders& folders,
                                           const EngineOptions& options) {
  return shared_engine(LaneSimulator::open(
      key, folders,
      {.threads = options.threads, .idle_limit = c_idle_limit, .stall_seed = options.stall_seed}));
}

}  // namespace halfway
