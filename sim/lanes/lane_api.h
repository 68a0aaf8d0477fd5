/* SPDX-License-Identifier: Apache-2.0 */
/* The generated lanes as a shared library: what lane_harness.cpp exports and lane_simulator.cpp calls. */
#ifndef HALFWAY_SIM_LANES_LANE_API_H
#define HALFWAY_SIM_LANES_LANE_API_H

#include "sim/verilator/harness_api.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HALFWAY_LANES_VERSION 1

/* Whole triangles, drawn by one lane from idle to idle. */
typedef struct {
  size_t vector, vectors;     /* where in the words, and how many */
  uint32_t owner, lane;       /* which drew it */
  size_t fragment, fragments; /* where in the lane's, and how many */
} HalfwayPart;

typedef struct {
  const uint32_t* words;
  HalfwayPart* parts;
  size_t count;
  size_t* next; /* the first part that nobody has begun; shared by all who draw the batch */
  size_t max_fragments;
} HalfwayBatch;

/* Draws parts, each by the first lane that is free, until there are no more. HALFWAY_BUFFER_FULL: more than
   `max_fragments`. */
int halfway_lanes_run(void* lanes, const HalfwayBatch* batch);
/* What a lane drew in the last run. */
const HalfwayFragment* halfway_lanes_fragments(const void* lanes, uint32_t lane);
/* The clocks of all lanes between taking a part and ending it. */
uint64_t halfway_lanes_cycles(const void* lanes);
uint32_t halfway_lanes_count(void);
uint32_t halfway_lanes_version(void);
void* halfway_lanes_create(uint32_t owner, uint64_t idle_limit);
void halfway_lanes_destroy(void* lanes);

#ifdef __cplusplus
}
#endif
#endif
