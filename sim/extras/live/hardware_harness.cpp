// SPDX-License-Identifier: Apache-2.0
// The functions of a hardware module, compiled for WebAssembly with the generated lanes of a shader.
// JavaScript calls _initialize, writes the init vectors of a call into the module's memory, calls
// hardware_draw and reads the fragments. Each call may enlarge the memory: take memory.buffer again after it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numeric>
#include <vector>

#include "sim/extras/lanes/lane_runner.hpp"

namespace {

using halfway::lanes::c_lanes, halfway::lanes::c_registers, halfway::lanes::Lanes, halfway::lanes::StuckBit;

constexpr std::uint64_t c_idle_limit = 100'000;  // as LaneOptions
// In vectors. A part ends with some clocks without fragments, so parts must not be too short; shorter parts
// let all lanes end at about the same time.
constexpr std::size_t c_shortest_part = 8, c_longest_part = 256;

class Hardware {
 public:
  std::vector<std::uint32_t> words;
  /// In order: the number of vectors of each unit (GoldenModel::group), 0 for a load (GoldenModel::is_load).
  std::vector<std::uint32_t> units;
  std::vector<HalfwayFragment> fragments;
  std::vector<std::uint32_t> trace;  ///< of observe()

  int draw(std::size_t most) {
    fragments.clear();
    std::vector<HalfwayPart> parts;
    std::vector<std::size_t> loads;
    find_parts(parts, loads);
    std::size_t next = 0;
    const HalfwayBatch batch{.words = words.data(),
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
    fragments.reserve(count);
    for (const HalfwayPart& part : parts) {
      const HalfwayFragment* first = lanes_->take(part.lane, part.fragments);
      fragments.insert(fragments.end(), first, first + part.fragments);
    }
    return halfway_done;
  }

  /// Draws all words as one part, in lanes of which one has something to draw.
  int observe(std::size_t most) {
    trace.clear();
    const auto lanes = std::make_unique<Lanes>(0, c_idle_limit, 0);  // larger than the stack
    lanes->stick(stuck_);
    lanes->trace = &trace;
    HalfwayPart part{.vectors = words.size() / halfway::lanes::c_init_words};
    std::size_t next = 0;
    const int status = lanes->run({.words = words.data(),
                                   .parts = &part,
                                   .end = 1,
                                   .next = &next,
                                   .max_fragments = most,
                                   .enough = SIZE_MAX});
    return status == halfway_done && part.fragments > most ? halfway_buffer_full : status;
  }

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
  /// Joins units without a load between them, fewer towards the end.
  void find_parts(std::vector<HalfwayPart>& parts, std::vector<std::size_t>& loads) const {
    std::size_t ahead = std::accumulate(units.begin(), units.end(), std::size_t{0}), vector = 0, wanted = 0;
    for (const std::uint32_t vectors : units) {
      if (vectors == 0) {
        loads.push_back(vector++);
        wanted = 0;
        continue;
      }
      if (parts.empty() || parts.back().vectors >= wanted) {
        parts.push_back({.vector = vector});
        wanted = std::clamp(ahead / (4 * c_lanes), c_shortest_part, c_longest_part);
      }
      parts.back().vectors += vectors;
      vector += vectors;
      ahead -= vectors;
    }
  }

  std::unique_ptr<Lanes> lanes_ = std::make_unique<Lanes>(0, c_idle_limit, 0);
  std::size_t loads_taken_ = 0;
  std::vector<StuckBit> stuck_;
};

/// The module's only hardware.
Hardware& hardware() {
  static Hardware hardware;
  return hardware;
}

std::uint32_t* room(std::vector<std::uint32_t>& words, std::size_t count) {
  words.resize(count);
  return words.data();
}

}  // namespace

#define HARDWARE_EXPORT(name) extern "C" __attribute__((export_name(#name)))

/// Room for the words of a call's init vectors, valid until the next call of the same function.
HARDWARE_EXPORT(hardware_words) std::uint32_t* hardware_words(std::uint32_t count) {
  return room(hardware().words, count);
}
/// Room for Hardware::units.
HARDWARE_EXPORT(hardware_units) std::uint32_t* hardware_units(std::uint32_t count) {
  return room(hardware().units, count);
}
/// Draw all units. 0, or a HalfwayStatus: more than `most` fragments, a hang or a fault; the lanes are then
/// reset.
HARDWARE_EXPORT(hardware_draw) int hardware_draw(std::uint32_t most) {
  return hardware().draw(most);
}
/// The fragments of the last call, HalfwayFragment, in the order of a single stream.
HARDWARE_EXPORT(hardware_fragment_count) std::uint32_t hardware_fragment_count() {
  return static_cast<std::uint32_t>(hardware().fragments.size());
}
HARDWARE_EXPORT(hardware_fragments) const void* hardware_fragments() {
  return hardware().fragments.data();
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
  return static_cast<std::uint32_t>(hardware().trace.size());
}
HARDWARE_EXPORT(hardware_trace) const std::uint32_t* hardware_trace() {
  return hardware().trace.data();
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
