// SPDX-License-Identifier: Apache-2.0
// The functions of a shared library of lanes.
#include "sim/extras/lanes/lane_api.h"
#include "sim/extras/lanes/lane_runner.hpp"

#define HALFWAY_EXPORT extern "C" __attribute__((visibility("default")))
using halfway::lanes::Lanes;

HALFWAY_EXPORT int halfway_lanes_run(void* lanes, const HalfwayBatch* batch) {
  return static_cast<Lanes*>(lanes)->run(*batch);
}
HALFWAY_EXPORT const HalfwayFragment* halfway_lanes_take(void* lanes, uint32_t lane, size_t count) {
  return static_cast<Lanes*>(lanes)->take(lane, count);
}
HALFWAY_EXPORT uint64_t halfway_lanes_cycles(const void* lanes) {
  return static_cast<const Lanes*>(lanes)->cycles();
}
HALFWAY_EXPORT uint32_t halfway_lanes_count(void) {
  return halfway::lanes::c_lanes;
}
HALFWAY_EXPORT uint32_t halfway_lanes_version(void) {
  return HALFWAY_LANES_VERSION;
}
HALFWAY_EXPORT void* halfway_lanes_create(uint32_t owner, uint64_t idle_limit, uint32_t stall_seed) {
  return new Lanes(owner, idle_limit, stall_seed);
}
HALFWAY_EXPORT void halfway_lanes_destroy(void* lanes) {
  delete static_cast<Lanes*>(lanes);
}
