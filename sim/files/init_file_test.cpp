// SPDX-License-Identifier: Apache-2.0
#include "sim/files/init_file.hpp"

#include <gtest/gtest.h>

#include <random>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

class InitFile : public FolderTest {
 protected:
  void expect_refused(const std::string& content, const std::string& place, const std::string& what) {
    const auto refused = read_init_file(write("init.txt", content), "key");
    EXPECT_TRUE(is_error(refused, ExitCode::bad_input, path_.string() + place + ": ")) << content;
    EXPECT_TRUE(is_error(refused, what)) << content;
  }

  const std::filesystem::path path_ = at("init.txt");
};

TEST_F(InitFile, WritesTheFormat) {
  ASSERT_TRUE(write_init_file(path_, "key", {.bits = 34, .words = {0x89abcdef, 0x2, 1, 0}}));
  EXPECT_EQ(*read_file(path_), "halfway-init 1 key 34\n289abcdef\n000000001\nend 2\n");
}

TEST_F(InitFile, IsReadBackForEveryWidth) {
  std::mt19937 random(1);
  for (const unsigned bits : {1U, 4U, 31U, 32U, 33U, 64U, 65U, 305U, 1680U}) {
    InitStream stream{bits, {}};
    for (int i = 0; i < 50; ++i) {
      for (std::size_t w = 0; w < stream.words_per_vector(); ++w) {
        stream.words.push_back(static_cast<std::uint32_t>(random()));
      }
      if (bits % 32 != 0) stream.words.back() &= (1U << bits % 32) - 1;
    }
    EXPECT_EQ(stream.size(), 50U);
    ASSERT_TRUE(write_init_file(path_, "key", stream));
    const auto read = must(read_init_file(path_, "key"));
    EXPECT_EQ(read.bits, bits);
    EXPECT_EQ(read.words, stream.words);
  }
}

TEST_F(InitFile, StreamsInPieces) {
  auto writer = must(InitFileWriter::open(path_, "key", 40));
  for (std::uint32_t i = 0; i < 100; ++i) writer.write(std::vector<std::uint32_t>{i, i % 256});
  ASSERT_TRUE(writer.commit());
  auto reader = must(InitFileReader::open(path_, ""));
  EXPECT_EQ(reader.key_name(), "key");
  std::vector<std::uint32_t> words;
  std::size_t total = 0;
  while (true) {
    const auto got = must(reader.read(words, 7));
    if (got == 0) break;
    EXPECT_LE(got, 7U);
    total += got;
  }
  EXPECT_EQ(total, 100U);
  EXPECT_EQ(words[198], 99U);
}

TEST_F(InitFile, RefusesIncompleteAndForeignFiles) {
  expect_refused("", ":1", "empty");
  expect_refused("P6\n1 1\n", ":1", "not an init file");
  expect_refused(std::string(100'000, 'x'), ":1", "more than");
  expect_refused("halfway-init 2 key 34\nend 0\n", ":1", "version");
  expect_refused("halfway-init 1 other 34\nend 0\n", ":1", "other");
  for (const char* header : {"halfway-init 1 key", "halfway-init 1 key 0", "halfway-init 1 key 34 5",
                             "halfway-init 1 key -34", "halfway-init 1  34", "halfway-init 1 key 34 ",
                             "halfway-init 1 key 99999999", "halfway-init 1 key 034"}) {
    expect_refused(std::string(header) + "\nend 0\n", ":1", "broken header");
  }
  const std::string header = "halfway-init 1 key 34\n";
  expect_refused(header, ":1", "without its last line");
  expect_refused(header + "000000001\n", ":2", "without its last line");
  expect_refused(header + "000000001\nend 2\n", ":3", "end 1");
  expect_refused(header + "000000001\nend \n", ":3", "end 1");
  expect_refused(header + "00000001\nend 1\n", ":2", "9 hexadecimal digits");
  expect_refused(header + "0000000001\nend 1\n", ":2", "9 hexadecimal digits");
  expect_refused(header + "00000000g\nend 1\n", ":2", "not a hexadecimal digit");
  expect_refused(header + "000000001\r\nend 1\n", ":2", "9 hexadecimal digits");
  expect_refused(header + "400000000\nend 1\n", ":2", "more than 34 bits");
  expect_refused(header + "end 0\nmore\n", ":3", "follows");
  expect_refused(header + "\nend 0\n", ":2", "9 hexadecimal digits");
}

TEST_F(InitFile, ReportsAMissingFile) {
  EXPECT_TRUE(is_error(read_init_file(path_.string() + ".none", "key"), ExitCode::bad_input));
}

}  // namespace
}  // namespace halfway
