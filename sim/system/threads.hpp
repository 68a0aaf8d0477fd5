// SPDX-License-Identifier: Apache-2.0
// Work shared by threads, whose faults come out in the one that asked for it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "common/result.hpp"

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

/// Calls work on `threads` threads at most; 0: as many as the machine has.
inline auto on_threads(unsigned threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  return [threads](unsigned most, const std::function<void()>& work) {
    work_on_threads(std::min(threads, most), work);
  };
}

/// Calls `each`, which returns a Status, with every number below `count` once, in order, on `threads` threads
/// at most. Behind a failure or an exception none is begun; what is returned then is the failure of the
/// smallest number that fails, whatever the threads.
template <class Each>
Status for_each_on_threads(unsigned threads, std::size_t count, const Each& each) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::size_t failed = count;
  Status result = Ok{};
  work_on_threads(static_cast<unsigned>(std::min<std::size_t>(threads, count)), [&] {
    for (std::size_t at; (at = next++) < count;) {
      try {
        Status done = each(at);
        if (done) continue;
        next = count;
        const std::scoped_lock lock(mutex);
        if (at < failed) {
          failed = at;
          result = std::move(done);
        }
      } catch (...) {
        next = count;
        throw;
      }
    }
  });
  return result;
}

}  // namespace halfway
