// SPDX-License-Identifier: Apache-2.0
// The generated lanes as a shared library: exported by lane_harness.cpp, called by lane_simulator.cpp.
#pragma once

#include "sim/engines/verilator/harness_api.h"

// Whole triangles. One lane draws them; it is idle before and after.
struct HalfwayPart {
  size_t vector, vectors;  // index of the first vector, number of vectors
  uint32_t owner, lane;    // thread and lane that draw the part
  size_t fragments;        // number drawn
  int ended;
};

/* Parts are numbered in their order. Numbering starts at a run in which no lane has a part.
   Loads are vectors that change the state of the hardware. They belong to no part: each lane takes all loads
   before the vectors of its part, in order. They are numbered from the creation of the lanes on. */
struct HalfwayBatch {
  const uint32_t* words;
  const size_t* loads;  // indices of vectors
  size_t first_load, end_load;
  HalfwayPart* parts;
  size_t first, end;     // number of the first part, and one past the last
  size_t* next;          // number of the first part not started; shared by all threads
  size_t max_fragments;  // limit of fragments drawn and not taken
  size_t enough;         // a run also ends after drawing this number of fragments
  int more; /* more parts follow: a run also ends when a lane has no part to start; otherwise each such lane
               takes the remaining loads */
};

/* The lanes of one thread. */
class HalfwayLanes {
 public:
  virtual ~HalfwayLanes() = default;
  /* Draw parts, each by the first free lane, until all are started. The next run continues unfinished parts.
     halfway_buffer_full: more than `max_fragments`. */
  virtual int run(const HalfwayBatch& batch) = 0;
  // Take the next `count` fragments of a lane. They are valid until the next run.
  virtual const HalfwayFragment* take(uint32_t lane, size_t count) = 0;
  // Clocks from start to end of a part, summed over all lanes.
  virtual uint64_t cycles() const = 0;
  virtual uint32_t lanes() const = 0;
};

// `stall_seed`: seed of the random stalls if the library was built with HALFWAY_STALLS; otherwise unused.
extern "C" HalfwayLanes* halfway_lanes_create(uint32_t owner, uint64_t idle_limit, uint32_t stall_seed);
