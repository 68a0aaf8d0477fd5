// SPDX-License-Identifier: Apache-2.0
#include "sim/os/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>

namespace halfway {

Result<FolderLock> FolderLock::take(const std::filesystem::path& folder,
                                    const std::function<void()>& on_wait) {
  const std::filesystem::path path = folder / ".lock";
  FolderLock lock(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644));
  const int descriptor = lock.descriptor_.get();
  const auto failed = [&] {
    return tool_failed(fmt::format("{}: cannot lock the folder: {}", path.string(), std::strerror(errno)));
  };
  if (descriptor < 0) return failed();
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return lock;
  on_wait();
  while (::flock(descriptor, LOCK_EX) != 0)
    if (errno != EINTR) return failed();
  return lock;
}

}  // namespace halfway
