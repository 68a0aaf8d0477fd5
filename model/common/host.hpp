// SPDX-License-Identifier: Apache-2.0
// What a host has and a browser lacks: threads and clocks. Code that runs in both gets them from its caller.
#pragma once

#include <functional>

namespace halfway {

/// Threads that share work. By default there is only the calling one.
struct Workers {
  using Share = std::function<void(unsigned most, const std::function<void()>& work)>;
  unsigned count = 1;
  Share share{};  ///< see run()

  /// Calls `work` at most `most` times, possibly on several threads at the same time, and returns after the
  /// last call.
  void run(unsigned most, const std::function<void()>& work) const {
    if (share)
      share(most, work);
    else
      work();
  }
};

/// Clocks in seconds. By default they stand still.
struct Clocks {
  std::function<double()> elapsed = [] { return 0.0; };
  std::function<double()> processor = [] { return 0.0; };  ///< of the calling thread
};

}  // namespace halfway
