// SPDX-License-Identifier: Apache-2.0
// Work shared by threads, whose faults come out in the one that asked for it.
#pragma once

#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace halfway {

/// Runs `work` on `threads` threads, this one among them, to the end of all. Where the system gives fewer, on
/// those. The first exception of any thread is thrown here; out of memory in a thread would else end the
/// process.
template <class Work>
void work_on_threads(unsigned threads, const Work& work) {
  std::mutex mutex;
  std::exception_ptr first;
  const auto guarded = [&]() noexcept {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!first) first = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    try {
      for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(guarded);
    } catch (const std::system_error&) {
    }
    guarded();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace halfway
