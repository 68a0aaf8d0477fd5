// SPDX-License-Identifier: Apache-2.0
// A lock that admits one run at a time to a folder.
#pragma once

#include <filesystem>
#include <functional>

#include "common/result.hpp"
#include "sim/os/descriptor.hpp"

namespace halfway {

/// The lock is released when the object is destroyed or the process ends in any way.
class FolderLock {
 public:
  /// Wait while another run has the lock. `on_wait` is called once if waiting is necessary.
  static Result<FolderLock> take(const std::filesystem::path& folder, const std::function<void()>& on_wait);

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  Descriptor descriptor_;
};

}  // namespace halfway
