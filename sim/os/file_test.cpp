// SPDX-License-Identifier: Apache-2.0
#include "sim/os/file.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "common/test/is_error.hpp"
#include "sim/os/must.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

class File : public FolderTest {
 protected:
  std::size_t files() const {
    const std::filesystem::directory_iterator all(here());
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }
};

TEST_F(File, WritesAndReadsWhole) {
  std::string content(3'000'001, 'x');
  content[17] = '\0';
  ASSERT_TRUE(write_file(at("a/b/c"), content));
  EXPECT_TRUE(must(read_file(at("a/b/c"))) == content);
  EXPECT_EQ(read_file(at("none")).error().code, ExitCode::bad_input);
}

TEST_F(File, AreListedByName) {
  for (const char* name : {"c.vhd", "b/d.vhd", "b/a.txt", "a.vhd"}) write(name, "");
  using Files = std::vector<std::filesystem::path>;
  EXPECT_EQ(must(files_below(here())), (Files{"a.vhd", "b/a.txt", "b/d.vhd", "c.vhd"}));
  EXPECT_EQ(must(files_below(here(), ".vhd")), (Files{"a.vhd", "b/d.vhd", "c.vhd"}));
  EXPECT_TRUE(is_error(files_below(at("none")), "none: No such file or directory"));
}

TEST_F(File, ReadsLinesAcrossBuffers) {
  std::string content;
  for (int i = 0; i < 400'000; ++i) content += std::to_string(i) + '\n';
  write("a", content);
  auto reader = must(LineReader::open(at("a")));
  std::string_view line;
  for (int i = 0; i < 400'000; ++i) {
    ASSERT_TRUE(must(reader.next(line)));
    ASSERT_EQ(line, std::to_string(i));
  }
  EXPECT_FALSE(must(reader.next(line)));
}

TEST_F(File, ErrorsNameTheFileAndLeaveNothing) {
  EXPECT_TRUE(is_error(LineWriter::open("/proc/halfway/file"), ExitCode::bad_input, "/proc/halfway"));
  // A folder has the name of the file, so the rename fails after everything was written.
  ASSERT_TRUE(make_folders(at("taken")));
  EXPECT_FALSE(write_file(at("taken"), "content"));
  EXPECT_EQ(files(), 1U);
}

TEST_F(File, WithoutCommitThereIsNoFile) {
  {
    auto writer = must(LineWriter::open(at("a")));
    writer.append("text");
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(File, ReadsLines) {
  const std::string longest(100, 'l');
  write("a", "one\n\nthree\n" + longest + "\nlast");
  auto reader = must(LineReader::open(at("a"), 100));
  std::string_view line;
  for (const std::string& expected :
       {std::string("one"), std::string(), std::string("three"), longest, std::string("last")}) {
    ASSERT_TRUE(must(reader.next(line)));
    EXPECT_EQ(line, expected);
  }
  EXPECT_FALSE(must(reader.next(line)));
}

TEST_F(File, RefusesLinesThatAreTooLong) {
  for (const std::size_t length : {101U, 5'000'000U}) {
    write("a", "short\n" + std::string(length, 'x') + "\n");
    auto reader = must(LineReader::open(at("a"), 100));
    std::string_view line;
    ASSERT_TRUE(must(reader.next(line)));
    EXPECT_TRUE(is_error(reader.next(line), "/a:2: "));
  }
}

TEST(ContentHash, SeparatesFields) {
  EXPECT_NE(ContentHash().add("ab").add("c").hex(), ContentHash().add("a").add("bc").hex());
  EXPECT_NE(ContentHash().add("").hex(), ContentHash().hex());
  EXPECT_EQ(ContentHash().add("a").hex(), ContentHash().add("a").hex());
  EXPECT_EQ(ContentHash().hex(), "6c62272e07bb014262b821756295c58d");  // FNV-1a's offset basis
}

TEST_F(File, TemporaryFolderIsRemovedUnlessMoved) {
  std::filesystem::path gone;
  {
    auto made = must(TemporaryFolder::make(at("x")));
    gone = made.path();
    ASSERT_TRUE(write_file(gone / "f", "1"));
  }
  EXPECT_FALSE(std::filesystem::exists(gone));
  auto first = TemporaryFolder::make(at("x")), second = TemporaryFolder::make(at("x"));
  ASSERT_TRUE(write_file(first->path() / "f", "1"));
  ASSERT_TRUE(write_file(second->path() / "f", "2"));
  ASSERT_TRUE(first->move_to(at("kept")));
  ASSERT_TRUE(second->move_to(at("kept")));
  EXPECT_EQ(text_of("kept/f"), "1");
}

// Make the file so old that it counts as abandoned unless it is locked.
void age(const std::filesystem::path& path) {
  std::filesystem::last_write_time(path,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::minutes(5));
}

TEST_F(File, LeftoversAreRemovedAndFilesInUseStay) {
  for (const char* name : {"x/.halfway-old", "x/.halfway-new", "x/other"})
    ASSERT_TRUE(make_folders(at(name)));
  write("x/.halfway-old/f", "1");
  std::filesystem::create_directory_symlink(at("x/other"), at("x/.halfway-link"));
  for (const char* name : {"f.part-old", "f.part-new", "g.part-old", "f"}) std::ofstream(at(name)) << "x";
  for (const char* name : {"x/.halfway-old", "x/other", "f.part-old", "g.part-old", "f"}) age(at(name));
  const auto used = must(TemporaryFolder::make(at("x")));
  EXPECT_FALSE(std::filesystem::exists(at("x/.halfway-old")));
  for (const char* name : {"x/.halfway-new", "x/other", "x/.halfway-link"})
    EXPECT_TRUE(std::filesystem::exists(at(name))) << name;
  age(used.path());
  const auto next = TemporaryFolder::make(at("x"));
  EXPECT_TRUE(std::filesystem::exists(used.path()));

  auto writer = must(LineWriter::open(at("f")));
  EXPECT_FALSE(std::filesystem::exists(at("f.part-old")));
  for (const char* name : {"f.part-new", "g.part-old", "f"})
    EXPECT_TRUE(std::filesystem::exists(at(name))) << name;
  for (const auto& entry : std::filesystem::directory_iterator(here()))
    if (entry.path().filename().string().starts_with("f.part-")) age(entry.path());
  writer.append("whole");
  write("f", "another");
  ASSERT_TRUE(writer.commit());
  EXPECT_EQ(text_of("f"), "whole");
  EXPECT_FALSE(std::filesystem::exists(at("f.part-new")));
}

TEST_F(File, TheSecondToLockAFolderWaitsForTheFirst) {
  std::optional<Descriptor> held = must(lock_folder(here(), [] { FAIL() << "it is not locked"; }));
  std::atomic<bool> waited = false, taken = false;
  std::jthread second([&] {
    const auto lock = lock_folder(here(), [&] { waited = true; });
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

}  // namespace
}  // namespace halfway
