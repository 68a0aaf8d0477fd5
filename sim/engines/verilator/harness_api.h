// SPDX-License-Identifier: Apache-2.0
// The verilated shader as a shared library: exported by verilator_harness.cpp, called by
// verilator_simulator.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

#define HALFWAY_HARNESS_VERSION 3

// Same layout as halfway::Fragment.
struct HalfwayFragment {
  uint32_t triangle, z;
  uint16_t y, x;
  uint8_t red, green, blue, reserved;
};

enum HalfwayStatus {
  halfway_done = 0,         // run: every vector is accepted; drain: the hardware is empty
  halfway_buffer_full = 1,  // call again with free space
  halfway_hang = 2,         // no progress for idle_limit cycles
  halfway_changed = 3,      // a fragment changed or was withdrawn while it waited
  halfway_fault = 4         // the hardware refused a vector
};

struct HalfwayOptions {
  uint32_t init_bits;
  uint32_t stall_seed;  // 0: full speed
  uint64_t idle_limit;
  // File for waveforms of the cycles [waves_from, waves_to), in libraries built for it; otherwise null.
  const char* waves_path;
  uint64_t waves_from, waves_to;
};

struct HalfwayStreams {
  const uint32_t* words;  // the remaining vectors
  size_t vectors;         // number of remaining vectors, counted down
  HalfwayFragment* fragments;
  size_t capacity, count;  // size of `fragments`, and number of fragments written
};

// Simulate until every vector of `streams` is accepted. Fragments of the last ones may still follow.
int halfway_run(void* model, HalfwayStreams* streams);
// Continue without vectors until the hardware is empty.
int halfway_drain(void* model, HalfwayStreams* streams);
// Cycles from the first vector accepted to the last vector or fragment moved, both included.
uint64_t halfway_cycles(const void* model);

uint32_t halfway_harness_version(void);
// Null if the library was built for another width, or if waveforms are requested and it was built without.
void* halfway_create(const HalfwayOptions* options);
void halfway_destroy(void* model);
}
