// SPDX-License-Identifier: Apache-2.0
// What to draw of a scene: the part that all settings of jobs have in common.
#pragma once

#include "plan/plan.hpp"
#include "setup/setup.hpp"

namespace halfway {

struct DrawRequest {
  PlanRequest plan{};
  FrameSize size{};
  SetupOptions setup{};
  unsigned threads = 1;
};

}  // namespace halfway
