// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "common/test/is_error.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

TEST(FolderLock, MakesTheSecondWaitForTheFirst) {
  auto folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  auto held =
      std::make_unique<Descriptor>(must(lock_folder(folder.path(), [] { FAIL() << "it is not locked"; })));
  std::atomic<bool> waited = false, taken = false;
  std::jthread second([&] {
    const auto lock = lock_folder(folder.path(), [&] { waited = true; });
    EXPECT_TRUE(lock);
    taken = true;
  });
  for (int i = 0; i < 10'000 && !waited; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(waited) << "the second did not meet the first's lock";
  EXPECT_FALSE(taken);
  held.reset();
  second.join();
  EXPECT_TRUE(taken);
}

TEST(FolderLock, FailsWithoutFolder) {
  EXPECT_TRUE(is_error(lock_folder("/nonexistent/folder", [] {}), "/nonexistent/folder"));
}

}  // namespace
}  // namespace halfway
