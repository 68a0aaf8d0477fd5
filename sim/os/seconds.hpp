// SPDX-License-Identifier: Apache-2.0
// Elapsed time and processor time. Processor time does not grow when threads share a core.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <ctime>

#include "common/host.hpp"

namespace halfway {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double seconds_of(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
/// Processor seconds of the calling thread since its start.
inline double thread_seconds() {
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}
/// Processor seconds of all threads of this process.
inline double process_seconds() {
  return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

/// The clocks of this machine.
inline Clocks host_clocks() {
  const auto start = std::chrono::steady_clock::now();
  return {[start] { return seconds_since(start); }, thread_seconds};
}

/// Processor seconds of all child processes that have ended.
inline double children_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

}  // namespace halfway
