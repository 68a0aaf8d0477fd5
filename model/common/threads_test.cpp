// SPDX-License-Identifier: Apache-2.0
#include "common/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>

namespace halfway {
namespace {

TEST(WorkOnThreads, RunsOnAsManyAndWaitsForAll) {
  std::atomic<int> ran = 0;
  work_on_threads(7, [&] { ++ran; });
  EXPECT_EQ(ran, 7);
  work_on_threads(0, [&] { ++ran; });
  EXPECT_EQ(ran, 8);
}

TEST(WorkOnThreads, AnExceptionOfAnyThreadComesOut) {
  std::atomic<int> ran = 0;
  const auto third_fails = [&] {
    if (++ran == 3) throw std::bad_alloc();
  };
  EXPECT_THROW(work_on_threads(5, third_fails), std::bad_alloc);
  EXPECT_EQ(ran, 5);
  EXPECT_THROW(work_on_threads(1, [] { throw std::runtime_error("x"); }), std::runtime_error);
}

}  // namespace
}  // namespace halfway
