// SPDX-License-Identifier: Apache-2.0
#include "sim/files/trace.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

class TraceFile : public FolderTest {
 protected:
  void expect_refused(const std::string& content, const std::string& place, const std::string& what) {
    const auto refused = read_trace(write("trace.txt", content), "key");
    EXPECT_TRUE(is_error(refused, ExitCode::bad_input, path_.string() + place + ": ")) << content;
    EXPECT_TRUE(is_error(refused, what)) << content;
  }

  const std::filesystem::path path_ = at("trace.txt");
};

TEST_F(TraceFile, WritesTheFormat) {
  const Trace trace{
      {{.triangle = 4294967295, .z = 16777215, .y = 4095, .x = 0, .red = 255, .green = 0, .blue = 7}}, 9};
  ASSERT_TRUE(write_trace(path_, "key", trace));
  EXPECT_EQ(*read_file(path_), "halfway-trace 1 key\n4294967295 4095 0 16777215 255 0 7\ncycles 9\nend 1\n");
  ASSERT_TRUE(write_trace(path_, "key", {}));
  EXPECT_EQ(*read_file(path_), "halfway-trace 1 key\nend 0\n");
}

TEST_F(TraceFile, IsReadBack) {
  std::mt19937 random(1);
  Trace trace;
  for (int i = 0; i < 100'000; ++i) {
    trace.fragments.push_back({.triangle = static_cast<std::uint32_t>(random()),
                               .z = static_cast<std::uint32_t>(random() & 0xffffff),
                               .y = static_cast<std::uint16_t>(random() & 0xfff),
                               .x = static_cast<std::uint16_t>(random() & 0xfff),
                               .red = static_cast<std::uint8_t>(random() & 0xff),
                               .green = static_cast<std::uint8_t>(random() & 0xff),
                               .blue = static_cast<std::uint8_t>(random() & 0xff)});
  }
  for (const std::optional<std::uint64_t> cycles :
       {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1)}) {
    trace.cycles = cycles;
    ASSERT_TRUE(write_trace(path_, "key", trace));
    const auto read = must(read_trace(path_, ""));
    EXPECT_EQ(read.fragments, trace.fragments);
    EXPECT_EQ(read.cycles, cycles);
  }
}

TEST_F(TraceFile, StreamsInPieces) {
  Trace trace;
  for (std::uint32_t i = 0; i < 100; ++i)
    trace.fragments.push_back({.triangle = i, .z = 0, .y = 0, .x = 0, .red = 0, .green = 0, .blue = 0});
  ASSERT_TRUE(write_trace(path_, "key", trace));
  auto reader = must(TraceReader::open(path_, "key"));
  std::vector<Fragment> fragments;
  while (true) {
    const auto got = must(reader.read(fragments, 9));
    if (got == 0) break;
    EXPECT_LE(got, 9U);
  }
  EXPECT_EQ(fragments, trace.fragments);
}

TEST_F(TraceFile, RefusesIncompleteAndForeignFiles) {
  expect_refused("", ":1", "empty");
  expect_refused("GIF89a\n", ":1", "not a trace");
  expect_refused(std::string(1000, 'x'), ":1", "more than");
  expect_refused("halfway-trace 2 key\nend 0\n", ":1", "version");
  expect_refused("halfway-trace 1\nend 0\n", ":1", "broken header");
  expect_refused("halfway-trace 1 key \nend 0\n", ":1", "broken header");
  expect_refused("halfway-trace 1 other\nend 0\n", ":1", "other");
  const std::string header = "halfway-trace 1 key\n", fragment = "1 2 3 4 5 6 7\n";
  expect_refused(header, ":1", "without its last line");
  expect_refused(header + fragment, ":2", "without its last line");
  expect_refused(header + fragment + "cycles 3\n", ":3", "without its last line");
  expect_refused(header + fragment + "end 2\n", ":3", "end 1");
  expect_refused(header + fragment + "cycles x\nend 1\n", ":3", "cycles <n>");
  expect_refused(header + fragment + "end 1\n" + fragment, ":4", "follows");
  expect_refused(header + "4294967296 2 3 4 5 6 7\nend 1\n", ":2", "triangle must be");
  expect_refused(header + "1 4096 3 4 5 6 7\nend 1\n", ":2", "y must be");
  expect_refused(header + "1 2 4096 4 5 6 7\nend 1\n", ":2", "x must be");
  expect_refused(header + "1 2 3 16777216 5 6 7\nend 1\n", ":2", "z must be");
  expect_refused(header + "1 2 3 4 256 6 7\nend 1\n", ":2", "red must be");
  expect_refused(header + "1 2 3 4 5 6 -7\nend 1\n", ":2", "blue must be");
  expect_refused(header + "1 2 3 4 5 6\nend 1\n", ":2", "blue must be");
  expect_refused(header + "1 2 3 4 5 6 7 8\nend 1\n", ":2", "more than seven");
  expect_refused(header + "1 2 3 4 5 6 7 \nend 1\n", ":2", "space");
  expect_refused(header + "1  2 3 4 5 6 7\nend 1\n", ":2", "y must be");
  expect_refused(header + "01 2 3 4 5 6 7\nend 1\n", ":2", "triangle must be");
  expect_refused(header + "\nend 0\n", ":2", "triangle must be");
  expect_refused(header + "1 2 3 4 5 6 7\r\nend 1\n", ":2", "blue must be");
}

}  // namespace
}  // namespace halfway
