/* SPDX-License-Identifier: Apache-2.0 */
/* The generated lanes as a shared library: what lane_harness.cpp exports and lane_simulator.cpp calls. */
#ifndef HALFWAY_SIM_LANES_LANE_API_H
#define HALFWAY_SIM_LANES_LANE_API_H

#include "sim/verilator/harness_api.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HALFWAY_LANES_VERSION 3

/* Whole triangles, drawn by one lane from idle to idle. */
typedef struct {
  size_t vector, vectors; /* where in the words, and how many */
  uint32_t owner, lane;   /* which draws it */
  size_t fragments;       /* how many it drew */
  int ended;
} HalfwayPart;

/* Parts are numbered in their order from the first run on in which no lane has one. */
typedef struct {
  const uint32_t* words;
  HalfwayPart* parts;
  size_t first, end;    /* numbers of the first of the parts, and behind the last */
  size_t* next;         /* number of the first part that nobody has begun; shared by all who draw them */
  size_t max_fragments; /* drawn and not taken */
  size_t enough;        /* a run ends, too, when it has drawn so many */
  int more;             /* other parts follow: a run ends, too, when a lane has none to begin */
} HalfwayBatch;

/* Draws parts, each by the first lane that is free, until there are no more; what is begun then is drawn on
   in the next run. HALFWAY_BUFFER_FULL: more than `max_fragments`. */
int halfway_lanes_run(void* lanes, const HalfwayBatch* batch);
/* The first `count` fragments of what a lane drew and nobody has taken; there until the next run. */
const HalfwayFragment* halfway_lanes_take(void* lanes, uint32_t lane, size_t count);
/* The clocks of all lanes between taking a part and ending it. */
uint64_t halfway_lanes_cycles(const void* lanes);
uint32_t halfway_lanes_count(void);
uint32_t halfway_lanes_version(void);
/* `stall_seed`: of the random stalls of a library built with HALFWAY_STALLS; else unused. */
void* halfway_lanes_create(uint32_t owner, uint64_t idle_limit, uint32_t stall_seed);
void halfway_lanes_destroy(void* lanes);

#ifdef __cplusplus
}
#endif
#endif
