// SPDX-License-Identifier: Apache-2.0
// Time that work takes: by the clock, and of the processor, which does not grow where threads share a core.
#pragma once

#include <chrono>
#include <ctime>

namespace halfway {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor seconds that the calling thread has taken since it began.
inline double thread_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace halfway
