// SPDX-License-Identifier: Apache-2.0
// Delays Ctrl-C until the current output file is complete.
#pragma once

#include <array>
#include <csignal>
#include <functional>
#include <shared_mutex>
#include <thread>

namespace halfway {

/// During the object's life, SIGINT, SIGTERM and SIGHUP wait until the gate is free (with a time limit), call
/// `tidy`, and then end the process with their usual status. Ignored signals stay ignored. At most one object
/// per process.
class Interruption {
 public:
  explicit Interruption(std::function<void()> tidy);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Hold the gate while writing output that must be complete.
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
