// SPDX-License-Identifier: Apache-2.0
#include "sim/os/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/test/is_error.hpp"

namespace halfway {
namespace {

TEST(WorkOnThreads, RunsOnAllThreadsAndWaits) {
  std::atomic<int> ran = 0;
  work_on_threads(7, [&] { ++ran; });
  EXPECT_EQ(ran, 7);
  work_on_threads(0, [&] { ++ran; });
  EXPECT_EQ(ran, 8);
}

TEST(WorkOnThreads, AnExceptionOfAnyThreadIsRethrown) {
  std::atomic<int> ran = 0;
  const auto third_fails = [&] {
    if (++ran == 3) throw std::bad_alloc();
  };
  EXPECT_THROW(work_on_threads(5, third_fails), std::bad_alloc);
  EXPECT_EQ(ran, 5);
  EXPECT_THROW(work_on_threads(1, [] { throw std::runtime_error("x"); }), std::runtime_error);
}

TEST(ForEachOnThreads, EachNumberOnceOnAnyNumberOfThreads) {
  for (const unsigned threads : {0U, 1U, 4U, 300U}) {
    std::vector<std::atomic<int>> calls(100);
    const Status done = for_each_on_threads(threads, calls.size(), [&](std::size_t i) -> Status {
      ++calls[i];
      return Ok{};
    });
    EXPECT_TRUE(done);
    for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
  }
  EXPECT_TRUE(for_each_on_threads(4, 0, [](std::size_t) -> Status { return bad_input("called"); }));
}

TEST(ForEachOnThreads, ReturnsTheFailureOfTheSmallestNumberAndStartsNoMore) {
  const auto number = [](std::size_t i) { return bad_input(std::to_string(i)); };
  std::atomic<int> ran = 0;
  const Status alone = for_each_on_threads(1, 100, [&](std::size_t i) -> Status {
    ++ran;
    return i < 10 ? Status(Ok{}) : Status(number(i));
  });
  EXPECT_TRUE(is_error(alone, "10"));
  EXPECT_EQ(ran, 11);
  // The second call fails at once; the first fails after it.
  std::atomic<bool> second_failed = false;
  const Status both = for_each_on_threads(2, 2, [&](std::size_t i) -> Status {
    if (i == 0)
      while (!second_failed) std::this_thread::yield();
    second_failed = true;
    return number(i);
  });
  EXPECT_TRUE(is_error(both, "0"));
}

TEST(ForEachOnThreads, AnExceptionEndsAllAndIsRethrown) {
  std::atomic<int> ran = 0;
  EXPECT_THROW((void)for_each_on_threads(1, 100,
                                         [&](std::size_t) -> Status {
                                           if (++ran == 3) throw std::bad_alloc();
                                           return Ok{};
                                         }),
               std::bad_alloc);
  EXPECT_EQ(ran, 3);
}

}  // namespace
}  // namespace halfway
