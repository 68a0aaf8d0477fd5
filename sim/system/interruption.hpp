// SPDX-License-Identifier: Apache-2.0
// Ctrl-C between two outputs, never in one.
#pragma once

#include <array>
#include <csignal>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <thread>

namespace halfway {

/// While it lives, SIGINT, SIGTERM and SIGHUP wait until nobody holds the gate (though not for ever), call
/// `tidy`, and then end the process as they would have; those that are ignored stay so. One at a time in a
/// process.
class Interruption {
 public:
  explicit Interruption(std::function<void()> tidy);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Held by whoever writes what must be whole.
  std::shared_lock<std::shared_timed_mutex> writing() { return std::shared_lock(gate_); }

 private:
  struct Before {
    int signal;
    struct sigaction action;
  };
  void watch();
  void restore() const;

  std::function<void()> tidy_;
  std::shared_timed_mutex gate_;
  int reader_ = -1;
  std::array<Before, 3> before_;
  std::jthread watcher_;
};

}  // namespace halfway
