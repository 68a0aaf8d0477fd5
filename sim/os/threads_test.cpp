// SPDX-License-Identifier: Apache-2.0
#include "sim/os/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <thread>

#include "common/test/is_error.hpp"

namespace halfway {
namespace {

TEST(WorkOnThreads, AnExceptionOfAnyThreadIsRethrown) {
  std::atomic<int> ran = 0;
  const auto third_fails = [&] {
    if (++ran == 3) throw std::bad_alloc();
  };
  EXPECT_THROW(work_on_threads(5, third_fails), std::bad_alloc);
  EXPECT_EQ(ran, 5);
  EXPECT_THROW(work_on_threads(1, [] { throw std::runtime_error("x"); }), std::runtime_error);
}

TEST(MustForEach, ThrowsTheFailureOfTheSmallestNumberAndStartsNoMore) {
  std::atomic<int> ran = 0;
  const auto alone = caught([&] {
    must_for_each(1, 100, [&](std::size_t i) {
      ++ran;
      if (i >= 10) throw_bad_input("{}", i);
    });
  });
  EXPECT_TRUE(is_error(alone, "10"));
  EXPECT_EQ(ran, 11);
  // The second call fails at once; the first fails after it.
  std::atomic<bool> second_failed = false;
  const auto both = caught([&] {
    must_for_each(2, 2, [&](std::size_t i) {
      if (i == 0)
        while (!second_failed) std::this_thread::yield();
      second_failed = true;
      throw_bad_input("{}", i);
    });
  });
  EXPECT_TRUE(is_error(both, "0"));
}

}  // namespace
}  // namespace halfway
