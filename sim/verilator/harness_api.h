/* SPDX-License-Identifier: Apache-2.0 */
/* The verilated shader as a shared library: what harness.cpp exports and verilator_simulator.cpp calls. */
#ifndef HALFWAY_SIM_VERILATOR_HARNESS_API_H
#define HALFWAY_SIM_VERILATOR_HARNESS_API_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HALFWAY_HARNESS_VERSION 3

/* Laid out as halfway::Fragment. */
typedef struct {
  uint32_t triangle, z;
  uint16_t y, x;
  uint8_t red, green, blue, reserved;
} HalfwayFragment;

typedef enum {
  HALFWAY_DONE = 0,        /* run: every vector is taken; drain: nothing is held any more */
  HALFWAY_BUFFER_FULL = 1, /* call again with room */
  HALFWAY_HANG = 2,        /* nothing moved for idle_limit cycles */
  HALFWAY_CHANGED = 3,     /* a fragment changed or was withdrawn while it was not taken */
  HALFWAY_FAULT = 4        /* the hardware says itself that it went wrong: a shadow counter left its range */
} HalfwayStatus;

typedef struct {
  uint32_t init_bits;
  uint32_t stall_seed; /* 0: full speed */
  uint64_t idle_limit;
  /* Waveforms of the cycles [waves_from, waves_to), in libraries built for it; else null. */
  const char* waves_path;
  uint64_t waves_from, waves_to;
} HalfwayOptions;

typedef struct {
  const uint32_t* words; /* the vectors not yet taken */
  size_t vectors;        /* how many; counted down */
  HalfwayFragment* fragments;
  size_t capacity, count; /* room, and how much of it was used */
} HalfwayStreams;

/* Simulates cycles until every vector of `streams` is taken. Fragments of the last ones may be still to come.
 */
int halfway_run(void* model, HalfwayStreams* streams);
/* Goes on, without vectors, until nothing is held. */
int halfway_drain(void* model, HalfwayStreams* streams);
/* From the first vector taken to the last vector or fragment that moved, both counted. */
uint64_t halfway_cycles(const void* model);

uint32_t halfway_harness_version(void);
/* Null where the library was built for another width, or was not built for waveforms and these are asked for.
 */
void* halfway_create(const HalfwayOptions* options);
void halfway_destroy(void* model);

#ifdef __cplusplus
}
#endif
#endif
