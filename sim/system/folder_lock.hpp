// SPDX-License-Identifier: Apache-2.0
// One run at a time in a folder.
#pragma once

#include <filesystem>
#include <functional>

#include "common/result.hpp"

namespace halfway {

/// Held until it goes, or its process does, however that ends.
class FolderLock {
 public:
  /// Waits while another run holds the folder; `on_wait` is called once if it must.
  static Result<FolderLock> take(const std::filesystem::path& folder, const std::function<void()>& on_wait);
  FolderLock(FolderLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace halfway
