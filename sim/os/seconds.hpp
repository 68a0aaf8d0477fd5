// SPDX-License-Identifier: Apache-2.0
// Elapsed time and processor time. Processor time does not grow when threads share a core.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <ctime>

namespace halfway {

inline double seconds_between(std::chrono::steady_clock::time_point start,
                              std::chrono::steady_clock::time_point end) {
  return std::chrono::duration<double>(end - start).count();
}
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return seconds_between(start, std::chrono::steady_clock::now());
}

/// Processor seconds of the calling thread since its start.
inline double thread_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A measured interval: processor seconds and elapsed seconds. Reading the processor clock takes almost a
/// microsecond. To divide an interval into short pieces, measure each piece in elapsed time and assign it the
/// same share of the processor time.
class Stretch {
 public:
  using Clock = std::chrono::steady_clock;
  static Clock::time_point now() { return Clock::now(); }

  template <class Work>
  auto add(const Work& work) {
    const Clock::time_point start = now();
    const double processor_start = thread_seconds();
    struct End {
      Stretch& stretch;
      Clock::time_point start;
      double processor_start;
      ~End() {
        stretch.processor_ += thread_seconds() - processor_start;
        stretch.clock_ += seconds_since(start);
      }
    } const end{*this, start, processor_start};
    return work();
  }
  double processor() const { return processor_; }
  double clock() const { return clock_; }
  /// Processor seconds of a piece that took `clock_seconds` of elapsed time.
  double share(double clock_seconds) const {
    return clock_ > 0.0 ? processor_ * clock_seconds / clock_ : 0.0;
  }

 private:
  double processor_ = 0.0, clock_ = 0.0;
};

/// Processor seconds of all threads of this process.
inline double process_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor seconds of all child processes that have ended.
inline double children_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

}  // namespace halfway
