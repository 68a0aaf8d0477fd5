// SPDX-License-Identifier: Apache-2.0
// Work shared by threads. Exceptions of the threads are rethrown in the calling thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "common/host.hpp"
#include "sim/os/must.hpp"

namespace halfway {

/// Run `work` on `threads` threads, including the calling thread, and wait for all. If the system starts
/// fewer threads, use those. Rethrow the first exception of any thread here; otherwise running out of memory
/// in a thread would end the process.
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

/// At most `threads` threads; 0: one per processor of the machine.
inline Workers on_threads(unsigned threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  return {threads, [threads](unsigned most, const std::function<void()>& work) {
            work_on_threads(std::min(threads, most), work);
          }};
}

/// Call `each` once with every number below `count`, in order, on at most `threads` threads. After an
/// exception no further call starts. Throws the Failure of the smallest failing number, independent of the
/// number of threads, or another exception.
template <class Each>
void must_for_each(unsigned threads, std::size_t count, const Each& each) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::size_t failed = count;
  std::optional<Failure> first;
  work_on_threads(static_cast<unsigned>(std::min<std::size_t>(threads, count)), [&] {
    for (std::size_t at; (at = next++) < count;) {
      try {
        each(at);
      } catch (const Failure& failure) {
        next = count;
        const std::scoped_lock lock(mutex);
        if (at < failed) first.emplace(failure);
        failed = std::min(failed, at);
      } catch (...) {
        next = count;
        throw;
      }
    }
  });
  if (first) throw Failure(*first);
}

}  // namespace halfway
