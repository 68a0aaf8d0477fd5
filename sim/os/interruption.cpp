// SPDX-License-Identifier: Apache-2.0
#include "sim/os/interruption.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <utility>

namespace halfway {
namespace {

// A file system or the reader of a pipe may block for ever.
constexpr std::chrono::seconds c_patience{2};

// Global, because a signal handler has no other access to its object. Blocking the signals and waiting for
// them in a thread would avoid that, but libraries start threads before main, and those would receive the
// signals.
std::atomic<int> writer = -1;
static_assert(std::atomic<int>::is_always_lock_free);

void tell(int signal) {
  const int error = errno;
  const auto byte = static_cast<unsigned char>(signal);
  [[maybe_unused]] const ssize_t written = ::write(writer, &byte, 1);
  errno = error;
}

}  // namespace

Interruption::Interruption(std::function<void()> tidy)
    : tidy_(std::move(tidy)), before_{{{SIGINT, {}}, {SIGTERM, {}}, {SIGHUP, {}}}} {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return;  // without a pipe, signals keep their default action
  reader_ = ends[0];
  writer = ends[1];
  watcher_ = std::jthread([this] { watch(); });
  struct sigaction action{};
  action.sa_handler = tell;
  action.sa_flags = SA_RESTART;
  for (auto& [signal, before] : before_)
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(signal, &action, nullptr);
}

Interruption::~Interruption() {
  if (reader_ < 0) return;
  restore();
  tell(0);
  watcher_.join();
  ::close(writer.exchange(-1));
  ::close(reader_);
}

void Interruption::restore() const {
  for (const auto& [signal, before] : before_) ::sigaction(signal, &before, nullptr);
}

void Interruption::watch() {
  unsigned char signal = 0;
  while (::read(reader_, &signal, 1) < 0 && errno == EINTR) {
  }
  if (signal == 0) return;
  [[maybe_unused]] const bool alone = gate_.try_lock_for(c_patience);
  tidy_();
  restore();
  ::raise(signal);
  if (alone) gate_.unlock();  // an earlier handler took the signal, and the process continues
}

}  // namespace halfway
