// SPDX-License-Identifier: Apache-2.0
#include "sim/os/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

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

TEST(WorkOnThreads, RunsOnAllThreadsAndWaits) {
  std::atomic<int> ran = 0;
  work_on_threads(7, [&] { ++ran; });
  EXPECT_EQ(ran, 7);
  work_on_threads(0, [&] { ++ran; });
  EXPECT_EQ(ran, 8);
}

TEST(MustForEach, EachNumberOnceOnAnyNumberOfThreads) {
  for (const unsigned threads : {0U, 1U, 4U, 300U}) {
    std::vector<std::atomic<int>> calls(100);
    must_for_each(threads, calls.size(), [&](std::size_t i) { ++calls[i]; });
    for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
  }
  EXPECT_NO_THROW(must_for_each(4, 0, [](std::size_t) { throw_bad_input("called"); }));
}

TEST(MustForEach, AnExceptionEndsAllAndIsRethrown) {
  std::atomic<int> ran = 0;
  EXPECT_THROW(must_for_each(1, 100,
                             [&](std::size_t) {
                               if (++ran == 3) throw std::bad_alloc();
                             }),
               std::bad_alloc);
  EXPECT_EQ(ran, 3);
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
