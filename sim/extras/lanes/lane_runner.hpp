// SPDX-License-Identifier: Apache-2.0
// Draws parts of a stream in the generated lanes of a shader, with which it is compiled.
// A cycle is the same as in sim/engines/verilator/verilator_harness.cpp at full speed: outputs are sampled
// just before the rising edge, inputs change after it. A lane that has drawn its part gets the next one when
// its hardware is idle. A lane without a next part runs empty until the others have finished theirs.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "sim/extras/lanes/lane_api.h"
#include "sim/extras/lanes/lane_operations.hpp"

namespace halfway::lanes {
namespace {
#include "lanes.hpp"

constexpr std::size_t c_init_words = (HALFWAY_INIT_BITS + 31) / 32;
constexpr std::size_t c_block = 256;  // clocks between two checks of the room for fragments
// Room for fragments that is kept between runs. Larger room is released when its fragments are taken.
constexpr std::size_t c_kept_room = std::size_t{1} << 21;
constexpr std::size_t c_no_part = SIZE_MAX;
constexpr std::size_t c_most_traced = std::size_t{64} << 20;  // words
constexpr int c_reset_clocks = 4, c_late_clocks = 8;  // as in sim/engines/verilator/verilator_harness.cpp

#ifdef HALFWAY_STALLS
// Random stalls of both streams, independent per lane. A vector is offered late and then stays offered; a
// fragment waits. A waiting fragment must not change.
class Stalls {
 public:
  explicit Stalls(std::uint32_t seed) : random_(seed * 2654435761u | 1u) {}

  /// Before the edge: set what this clock offers and accepts.
  void drive(Inputs& in, std::uint32_t waiting) {
    offered_ = (offered_ | (next_random() >> 16)) & waiting;
    ready_ = next_random() >> 16;
    in.init_valid = to_mask(offered_);
    in.fragment_ready = to_mask(ready_);
  }
  std::uint32_t offered() const { return offered_; }
  std::uint32_t ready() const { return ready_; }
  void taken(std::uint32_t lanes) { offered_ &= ~lanes; }

  /// After the edge: the lanes whose waiting fragment changed.
  std::uint32_t changed(const Outputs& out) {
    const std::uint32_t valid = to_bits(out.fragment_valid);
    const M same = equal(out.fragment_triangle, held_.fragment_triangle) &
                   equal(out.fragment_z, held_.fragment_z) & equal(out.fragment_y, held_.fragment_y) &
                   equal(out.fragment_x, held_.fragment_x) & equal(out.fragment_red, held_.fragment_red) &
                   equal(out.fragment_green, held_.fragment_green) &
                   equal(out.fragment_blue, held_.fragment_blue);
    const std::uint32_t changed = holding_ & ~(valid & to_bits(same));
    held_ = out;
    holding_ = valid & ~ready_;
    return changed;
  }

 private:
  std::uint32_t next_random() {
    random_ ^= random_ << 13;
    random_ ^= random_ >> 17;
    random_ ^= random_ << 5;
    return random_;
  }

  std::uint32_t random_, offered_ = 0, ready_ = 0, holding_ = 0;
  Outputs held_{};
};
#else
// Full speed: `fragment_ready` is constant in the generated text.
class Stalls {
 public:
  explicit Stalls(std::uint32_t) {}
  void drive(Inputs& in, std::uint32_t waiting) { in.init_valid = to_mask(offered_ = waiting); }
  std::uint32_t offered() const { return offered_; }
  static std::uint32_t ready() { return ~0u; }
  static void taken(std::uint32_t) {}
  static std::uint32_t changed(const Outputs&) { return 0; }

 private:
  std::uint32_t offered_ = 0;
};
#endif

/// A bit of a register that does not change, in all lanes.
struct StuckBit {
  std::size_t number;  ///< of the register
  unsigned bit;
  bool value;

  void set(State& state) const {
    const Register& place = c_registers[number];
    char* const variable = reinterpret_cast<char*>(&state) + place.offset;
    if (place.mask) {
      *reinterpret_cast<M*>(variable) = value ? c_all : c_none;
    } else {
      V& vector = *reinterpret_cast<V*>(variable);
      const V one = splat(1u << bit);
      vector = value ? vector | one : vector & ~one;
    }
  }
};

class Lanes final : public HalfwayLanes {
 public:
  Lanes(std::uint32_t owner, std::uint64_t idle_limit, std::uint32_t stall_seed)
      : owner_(owner), idle_limit_(idle_limit), stalls_(stall_seed + owner) {
    Outputs out;
    for (int i = 0; i < c_reset_clocks; ++i) reset_step(state_, in_, out);
  }

  int run(const HalfwayBatch& batch) override {
    batch_ = &batch;
    faults_ = 0;
    stops_ = false;
    make_room();
    const std::size_t before = waiting();
    for (unsigned i = 0; i < c_lanes; ++i)
      if ((active_ >> i & 1) == 0) begin_part(i);
    while (goes()) {
      const std::size_t now = waiting();
      if (now > batch.max_fragments) return halfway_buffer_full;
      if (trace && trace->size() > c_most_traced) return halfway_buffer_full;
      if (now - before >= batch.enough) return halfway_done;
      for (Lane& lane : lanes_) {
        if (lane.room < lane.count + c_block + 1) move(lane, 2 * lane.waiting() + 4 * c_block);
        lane.next = lane.fragments.get() + lane.count;
      }
      const std::uint32_t moved = block();
      for (unsigned i = 0; i < c_lanes; ++i) {
        Lane& lane = lanes_[i];
        lane.still = (moved >> i & 1) != 0 ? 0 : lane.still + c_block;
        if ((active_ >> i & 1) != 0 && lane.still >= idle_limit_ + c_block) return halfway_hang;
      }
      if (faults_ != 0) return halfway_fault;
    }
    Outputs out;
    for (int i = 0; active_ == 0 && i < c_late_clocks; ++i) {
      advance(out);
      faults_ |= to_bits(out.fault);
    }
    return faults_ != 0 ? halfway_fault : halfway_done;
  }

  /// From now on these bits stick, and no others. Not in a run.
  void stick(const std::vector<StuckBit>& bits) {
    stuck_ = bits;
    set_stuck_bits();
  }

  const HalfwayFragment* take(std::uint32_t number, std::size_t count) override {
    Lane& lane = lanes_[number];
    const HalfwayFragment* first = lane.fragments.get() + lane.taken;
    lane.taken += count;
    return first;
  }
  std::uint64_t cycles() const override { return cycles_; }
  std::uint32_t lanes() const override { return c_lanes; }

  /// Unless null: gets the words of the observed parts in the first lane, before each edge of the clock while
  /// a lane has a part.
  std::vector<std::uint32_t>* trace = nullptr;

 private:
  struct Lane {
    std::unique_ptr<HalfwayFragment[]> fragments;
    // fragments of room, taken fragments, index of the part's first fragment, all fragments
    std::size_t room = 0, taken = 0, begun = 0, count = 0;
    HalfwayFragment* next = nullptr;  // address of the lane's next fragment, minus the clocks of this block
    std::size_t part = 0;             // number of the part; c_no_part: only loads
    std::size_t vector = 0, end = 0;  // indices of the next vector, and of the first one after the part
    std::size_t loads = 0;            // number of loads taken
    std::uint64_t still = 0;          // clocks without progress
    std::size_t waiting() const { return count - taken; }
  };

  void advance(Outputs& out) {
    if (trace && active_ != 0) {
      trace->resize(trace->size() + c_observed_words);
      observe(state_, in_, trace->data() + trace->size() - c_observed_words);
    }
    step(state_, in_, out);
    set_stuck_bits();
  }
  void set_stuck_bits() {
    for (const StuckBit& bit : stuck_) bit.set(state_);
  }

  bool goes() const { return active_ != 0 && !stops_; }
  std::size_t waiting() const {
    std::size_t sum = 0;
    for (const Lane& lane : lanes_) sum += lane.waiting();
    return sum;
  }

  // Each time a lane's room is full, each of its fragments is moved at most once.
  void make_room() {
    std::size_t room = 0;
    for (const Lane& lane : lanes_) room += lane.room;
    for (Lane& lane : lanes_) {
      const std::size_t waiting = lane.waiting();
      if (lane.taken < waiting) continue;
      const std::size_t fitting = waiting == 0 ? 0 : 2 * waiting + 4 * c_block;
      move(lane, room > c_kept_room ? fitting : lane.room);
    }
  }

  // Unwritten pages take no memory.
  static void move(Lane& lane, std::size_t room) {
    const HalfwayFragment* const from = lane.fragments.get() + lane.taken;
    const std::size_t waiting = lane.waiting();
    if (room == lane.room) {
      std::copy(from, from + waiting, lane.fragments.get());
    } else {
      std::unique_ptr<HalfwayFragment[]> other(room == 0 ? nullptr : new HalfwayFragment[room]);
      std::copy(from, from + waiting, other.get());
      lane.fragments = std::move(other);
      lane.room = room;
    }
    lane.begun -= lane.taken;
    lane.count = waiting;
    lane.taken = 0;
  }

  void begin_part(unsigned i) {
    const std::uint32_t bit = 1u << i;
    active_ &= ~bit;
    Lane& lane = lanes_[i];
    const std::size_t next = __atomic_fetch_add(batch_->next, 1, __ATOMIC_RELAXED);
    if (next < batch_->end) {
      HalfwayPart& part = batch_->parts[next - batch_->first];
      part.owner = owner_;
      part.lane = i;
      lane.part = next;
      lane.vector = part.vector;
      lane.end = part.vector + part.vectors;
    } else if (batch_->more != 0) {
      stops_ = true;
      return;
    } else if (lane.loads == batch_->end_load) {
      return;
    } else {
      lane.part = c_no_part;
      lane.vector = lane.end = SIZE_MAX;
    }
    lane.begun = lane.count;
    lane.still = 0;
    active_ |= bit;
    offer(i);
  }

  // The lane takes a load that precedes its next vector first.
  bool takes_load(const Lane& lane) const {
    return lane.loads < batch_->end_load && batch_->loads[lane.loads - batch_->first_load] < lane.vector;
  }

  void offer(unsigned i) {
    const Lane& lane = lanes_[i];
    const std::uint32_t bit = 1u << i;
    waiting_ &= ~bit;
    const bool load = takes_load(lane);
    if (!load && lane.vector == lane.end) return;
    waiting_ |= bit;
    const std::size_t vector = load ? batch_->loads[lane.loads - batch_->first_load] : lane.vector;
    set_init_data(in_, i, batch_->words + vector * c_init_words);
  }

  __attribute__((noinline)) void taken(std::uint32_t take) {
    for (; take != 0; take &= take - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(take));
      ++(takes_load(lanes_[i]) ? lanes_[i].loads : lanes_[i].vector);
      offer(i);
    }
  }

  __attribute__((noinline)) void ended(std::uint32_t idle, std::size_t clocks) {
    for (; idle != 0; idle &= idle - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(idle));
      Lane& lane = lanes_[i];
      count(lane, clocks);
      if (lane.part != c_no_part) {
        HalfwayPart& part = batch_->parts[lane.part - batch_->first];
        part.fragments = lane.count - lane.begun;
        part.ended = 1;
      }
      begin_part(i);
    }
  }

  static void count(Lane& lane, std::size_t clocks) {
    lane.count = static_cast<std::size_t>(lane.next + clocks - lane.fragments.get());
  }

  std::uint32_t block() {
    std::uint32_t moved = 0;
    std::size_t clock = 0;
    while (clock < c_block && goes()) {
      Outputs out;
      const std::uint32_t offered = waiting_;
      stalls_.drive(in_, waiting_);
      advance(out);
      const std::uint32_t take = stalls_.offered() & to_bits(out.init_ready);
      const std::uint32_t valid = to_bits(out.fragment_valid), drawn = valid & stalls_.ready();
      stalls_.taken(take);
      write(out, clock++);
      // In most clocks most lanes have a fragment, so advance all addresses and correct those of lanes
      // without one.
      for (std::uint32_t none = active_ & ~drawn; none != 0; none &= none - 1)
        --lanes_[std::countr_zero(none)].next;
      moved |= take | drawn;
      faults_ |= to_bits(out.fault) | stalls_.changed(out);
      cycles_ += static_cast<unsigned>(std::popcount(active_));
      if (take != 0) taken(take);
      const std::uint32_t idle = active_ & ~(offered | valid | to_bits(out.busy));
      if (idle != 0) ended(idle, clock);
    }
    for (std::uint32_t left = active_; left != 0; left &= left - 1)
      count(lanes_[std::countr_zero(left)], clock);
    return moved;
  }

  void write(const Outputs& out, std::size_t clock) {
    Row row = turn({out.fragment_triangle, out.fragment_z, out.fragment_y | out.fragment_x << 16,
                    out.fragment_red | out.fragment_green << 8 | out.fragment_blue << 16});
    for (unsigned i = 0; i < c_lanes; ++i) std::memcpy(lanes_[i].next + clock, of_lane(row, i), 16);
  }

  State state_;
  Inputs in_;
  Lane lanes_[c_lanes];
  std::uint32_t active_ = 0, faults_ = 0;  // a bit per lane
  bool stops_ = false;                     // a lane has no part to start, and the caller has more parts
  const HalfwayBatch* batch_ = nullptr;
  std::uint32_t owner_;
  std::uint64_t idle_limit_, cycles_ = 0;
  Stalls stalls_;
  std::vector<StuckBit> stuck_;
  std::uint32_t waiting_ = 0;  // lanes with a vector that is not accepted yet
};

}  // namespace
}  // namespace halfway::lanes
