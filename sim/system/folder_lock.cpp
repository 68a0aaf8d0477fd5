// SPDX-License-Identifier: Apache-2.0
#include "sim/system/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace halfway {

Result<FolderLock> FolderLock::take(const std::filesystem::path& folder,
                                    const std::function<void()>& on_wait) {
  const std::filesystem::path path = folder / ".lock";
  const int descriptor = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (descriptor < 0)
    return tool_failed(fmt::format("{}: cannot lock the folder: {}", path.string(), std::strerror(errno)));
  FolderLock lock(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return lock;
  on_wait();
  while (::flock(descriptor, LOCK_EX) != 0)
    if (errno != EINTR)
      return tool_failed(fmt::format("{}: cannot lock the folder: {}", path.string(), std::strerror(errno)));
  return lock;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace halfway
