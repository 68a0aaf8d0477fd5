// SPDX-License-Identifier: Apache-2.0
// The function of a shared library of lanes.
#include "sim/extras/lanes/lane_api.h"
#include "sim/extras/lanes/lane_runner.hpp"

extern "C" __attribute__((visibility("default"))) HalfwayLanes* halfway_lanes_create(uint32_t owner,
                                                                                     uint64_t idle_limit,
                                                                                     uint32_t stall_seed) {
  return new halfway::lanes::Lanes(owner, idle_limit, stall_seed);
}
