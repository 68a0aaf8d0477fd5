// SPDX-License-Identifier: Apache-2.0
// Processor time, which does not grow where threads share a core.
#pragma once

#include <ctime>

namespace halfway {

/// Processor seconds that the calling thread has taken since it began.
inline double thread_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace halfway
