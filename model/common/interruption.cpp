// SPDX-License-Identifier: Apache-2.0
#include "common/interruption.hpp"

#include <pthread.h>

#include <chrono>
#include <utility>

namespace halfway {
namespace {

constexpr timespec c_poll{0, 50'000'000};
// A file system may hang, or whoever reads a pipe.
constexpr std::chrono::seconds c_patience{2};

}  // namespace

Interruption::Interruption(std::function<void()> tidy) : tidy_(std::move(tidy)) {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
  ::pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

Interruption::~Interruption() {
  watcher_.request_stop();
  watcher_.join();
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interruption::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const int signal = ::sigtimedwait(&signals_, nullptr, &c_poll);
    if (signal < 0) continue;
    const bool alone = gate_.try_lock_for(c_patience);
    tidy_();
    sigset_t taken;
    sigemptyset(&taken);
    sigaddset(&taken, signal);
    ::pthread_sigmask(SIG_UNBLOCK, &taken, nullptr);
    ::raise(signal);
    if (alone) gate_.unlock();  // somebody's own handler took it
  }
}

}  // namespace halfway
