// SPDX-License-Identifier: Apache-2.0
// The functions of a hardware module, compiled for WebAssembly with the generated lanes of a shader.
// JavaScript calls _initialize, writes the init vectors of a call into the module's memory, calls
// hardware_draw and reads the fragments. Each call may enlarge the memory: take memory.buffer again after it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "sim/extras/lanes/lane_runner.hpp"

namespace {

using halfway::lanes::c_lanes, halfway::lanes::c_registers, halfway::lanes::Lanes, halfway::lanes::StuckBit;

constexpr std::uint64_t c_idle_limit = 100'000;  // as LaneOptions
// In vectors. A part ends with some clocks without fragments, so parts must not be too short; shorter parts
// let all lanes end at about the same time.
constexpr std::size_t c_shortest_part = 8, c_longest_part = 256;

/// Independent vectors of a call, in order.
struct Unit {
  std::uint32_t vector, vectors;
};

/// Draws a stream in one lane and records the observed parts of signals before each edge of the clock.
class Observer {
 public:
  int run(const std::vector<std::uint32_t>& init_words, std::size_t most,
          const std::vector<StuckBit>& stuck) {
    using namespace halfway::lanes;
    trace_.clear();
    const auto state = std::make_unique<State>();  // larger than the stack
    Inputs in;
    Outputs out;
    for (int i = 0; i < c_reset_clocks; ++i) reset_step(*state, in, out);
    const std::size_t vectors = init_words.size() / c_init_words;
    std::size_t vector = 0, fragments = 0;
    std::uint64_t still = 0;
    while (true) {
      // Clock the hardware. Only the first lane gets vectors.
      const bool offered = vector < vectors;
      if (offered) set_init_data(in, 0, &init_words[vector * c_init_words]);
      in.init_valid = to_mask(offered ? 1 : 0);
      trace_.resize(trace_.size() + c_observed_words);
      observe(*state, in, &trace_[trace_.size() - c_observed_words]);
      step(*state, in, out);
      for (const StuckBit& bit : stuck) bit.set(*state);

      const bool taken = offered && (to_bits(out.init_ready) & 1) != 0;
      const bool drawn = (to_bits(out.fragment_valid) & 1) != 0;
      vector += taken ? 1 : 0;
      fragments += drawn ? 1 : 0;
      still = taken || drawn ? 0 : still + 1;
      if ((to_bits(out.fault) & 1) != 0) return halfway_fault;
      if (fragments > most || trace_.size() > c_most_words) return halfway_buffer_full;
      if (still > c_idle_limit) return halfway_hang;
      if (!offered && !drawn && (to_bits(out.busy) & 1) == 0) return halfway_done;
    }
  }
  const std::vector<std::uint32_t>& trace() const { return trace_; }

 private:
  static constexpr std::size_t c_most_words = std::size_t{64} << 20;

  std::vector<std::uint32_t> trace_;
};

class Hardware {
 public:
  std::uint32_t* words(std::size_t count) { return room(words_, count); }
  Unit* units(std::size_t count) { return room(units_, count); }
  std::uint32_t* loads(std::size_t count) { return room(loads_, count); }
  const std::vector<HalfwayFragment>& fragments() const { return fragments_; }

  int draw(std::size_t most) {
    fragments_.clear();
    std::vector<HalfwayPart> parts = make_parts();
    const std::vector<std::size_t> loads(loads_.begin(), loads_.end());
    std::size_t next = 0;
    const HalfwayBatch batch{.words = words_.data(),
                             .loads = loads.data(),
                             .first_load = loads_taken_,
                             .end_load = loads_taken_ + loads.size(),
                             .parts = parts.data(),
                             .first = 0,
                             .end = parts.size(),
                             .next = &next,
                             .max_fragments = most,
                             .enough = SIZE_MAX,
                             .more = 0};
    int status = lanes_->run(batch);
    std::size_t count = 0;
    for (const HalfwayPart& part : parts) count += part.fragments;
    if (status == halfway_done && count > most) status = halfway_buffer_full;
    if (status != halfway_done) {
      reset();
      return status;
    }
    loads_taken_ = batch.end_load;

    // Put the fragments into the order of a single stream.
    fragments_.reserve(count);
    for (const HalfwayPart& part : parts) {
      const HalfwayFragment* first = lanes_->take(part.lane, part.fragments);
      fragments_.insert(fragments_.end(), first, first + part.fragments);
    }
    return halfway_done;
  }

  int observe(std::size_t most) { return observer_.run(words_, most, stuck_); }
  const std::vector<std::uint32_t>& trace() const { return observer_.trace(); }

  void reset() {
    lanes_ = std::make_unique<Lanes>(0, c_idle_limit, 0);
    lanes_->stick(stuck_);
    loads_taken_ = 0;
  }

  void stick(const StuckBit& bit) {
    stuck_.push_back(bit);
    lanes_->stick(stuck_);
  }
  void heal() {
    stuck_.clear();
    lanes_->stick(stuck_);
  }

 private:
  template <class Item>
  static Item* room(std::vector<Item>& items, std::size_t count) {
    items.resize(count);
    return items.data();
  }

  /// Joins units without a load between them, fewer towards the end.
  std::vector<HalfwayPart> make_parts() const {
    std::size_t ahead = 0;
    for (const Unit& unit : units_) ahead += unit.vectors;
    std::vector<HalfwayPart> parts;
    std::size_t wanted = 0;
    for (const Unit& unit : units_) {
      const bool follows = !parts.empty() && parts.back().vector + parts.back().vectors == unit.vector;
      if (!follows || parts.back().vectors >= wanted) {
        parts.push_back({.vector = unit.vector});
        wanted = std::clamp(ahead / (4 * c_lanes), c_shortest_part, c_longest_part);
      }
      parts.back().vectors += unit.vectors;
      ahead -= unit.vectors;
    }
    return parts;
  }

  std::vector<std::uint32_t> words_, loads_;
  std::vector<Unit> units_;
  std::vector<HalfwayFragment> fragments_;
  std::unique_ptr<Lanes> lanes_ = std::make_unique<Lanes>(0, c_idle_limit, 0);
  std::size_t loads_taken_ = 0;
  std::vector<StuckBit> stuck_;
  Observer observer_;
};

/// The module's only hardware.
Hardware& hardware() {
  static Hardware hardware;
  return hardware;
}

}  // namespace

#define HARDWARE_EXPORT(name) extern "C" __attribute__((export_name(#name)))

/// Room for the words of a call's init vectors, valid until the next call of the same function.
HARDWARE_EXPORT(hardware_words) std::uint32_t* hardware_words(std::uint32_t count) {
  return hardware().words(count);
}
/// Room for pairs: first vector and number of vectors of each unit (GoldenModel::unit), in order.
HARDWARE_EXPORT(hardware_parts) void* hardware_parts(std::uint32_t count) {
  return hardware().units(count);
}
/// Room for the indices of the vectors that are loads (GoldenModel::is_load), in order.
HARDWARE_EXPORT(hardware_loads) std::uint32_t* hardware_loads(std::uint32_t count) {
  return hardware().loads(count);
}
/// Draw all units. 0, or a HalfwayStatus: more than `most` fragments, a hang or a fault; the lanes are then
/// reset.
HARDWARE_EXPORT(hardware_draw) int hardware_draw(std::uint32_t most) {
  return hardware().draw(most);
}
/// The fragments of the last call, HalfwayFragment, in the order of a single stream.
HARDWARE_EXPORT(hardware_fragment_count) std::uint32_t hardware_fragment_count() {
  return static_cast<std::uint32_t>(hardware().fragments().size());
}
HARDWARE_EXPORT(hardware_fragments) const void* hardware_fragments() {
  return hardware().fragments().data();
}
/// Reset all lanes, which forget their loads.
HARDWARE_EXPORT(hardware_reset) void hardware_reset() {
  hardware().reset();
}

/// Draw the words in another copy of the hardware, as a single stream, and record parts of signals. 0, or
/// a HalfwayStatus: more than `most` fragments or too many clocks, a hang or a fault.
HARDWARE_EXPORT(hardware_observe) int hardware_observe(std::uint32_t most) {
  return hardware().observe(most);
}
/// Clock by clock, the words of each part of ShaderStages::parts in its order, the least significant first.
HARDWARE_EXPORT(hardware_trace_words) std::uint32_t hardware_trace_words() {
  return static_cast<std::uint32_t>(hardware().trace().size());
}
HARDWARE_EXPORT(hardware_trace) const std::uint32_t* hardware_trace() {
  return hardware().trace().data();
}

/// The registers that can stick: the variables of the generated State, without those that only delay others.
HARDWARE_EXPORT(hardware_register_count) std::uint32_t hardware_register_count() {
  return std::size(c_registers);
}
/// Path of instances, signal and field in the RTL.
HARDWARE_EXPORT(hardware_register_name) const char* hardware_register_name(std::uint32_t index) {
  return c_registers[index].name;
}
HARDWARE_EXPORT(hardware_register_bits) std::uint32_t hardware_register_bits(std::uint32_t index) {
  return c_registers[index].bits;
}
/// From now on this bit of this register has this value in all lanes.
HARDWARE_EXPORT(hardware_stick) void hardware_stick(std::uint32_t index, std::uint32_t bit, int value) {
  hardware().stick({index, bit, value != 0});
}
/// No bit sticks any more.
HARDWARE_EXPORT(hardware_heal) void hardware_heal() {
  hardware().heal();
}
