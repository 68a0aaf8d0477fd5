// SPDX-License-Identifier: Apache-2.0
#include "sim/os/file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "common/test/is_error.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

class File : public testing::Test {
 protected:
  std::filesystem::path operator/(const char* name) const { return folder_.path() / name; }
  std::size_t files() const {
    const std::filesystem::directory_iterator all(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }
  const TemporaryFolder folder_ = must(TemporaryFolder::make(testing::TempDir()));
};

TEST_F(File, WritesAndReadsWhole) {
  std::string content(3'000'001, 'x');
  content[17] = '\0';
  ASSERT_TRUE(write_file(*this / "a/b/c", content));
  const auto read = must(read_file(*this / "a/b/c"));
  EXPECT_TRUE(read == content);
  EXPECT_EQ(read_file(*this / "none").error().code, ExitCode::bad_input);
}

TEST_F(File, ErrorsNameTheFileAndLeaveNothing) {
  const auto full = LineWriter::open("/proc/halfway/file");
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().message.find("/proc/halfway"), std::string::npos);
  EXPECT_EQ(full.error().code, ExitCode::bad_input);
  // A folder has the name of the file, so the rename fails after everything was written.
  ASSERT_TRUE(make_folders(*this / "taken"));
  EXPECT_FALSE(write_file(*this / "taken", "content"));
  EXPECT_EQ(files(), 1U);
}

TEST_F(File, WithoutCommitThereIsNoFile) {
  {
    auto writer = must(LineWriter::open(*this / "a"));
    writer.append("text");
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(File, AreListedByName) {
  const auto& folder = folder_.path();
  ASSERT_TRUE(make_folders(folder / "b"));
  for (const char* name : {"c.vhd", "b/d.vhd", "b/a.txt", "a.vhd"})
    ASSERT_TRUE(write_file(folder / name, ""));
  const auto all = files_below(folder), some = files_below(folder, ".vhd");
  ASSERT_TRUE(all && some);
  using Files = std::vector<std::filesystem::path>;
  EXPECT_EQ(*all, (Files{"a.vhd", "b/a.txt", "b/d.vhd", "c.vhd"}));
  EXPECT_EQ(*some, (Files{"a.vhd", "b/d.vhd", "c.vhd"}));
  EXPECT_TRUE(is_error(files_below(folder / "none"), "none: No such file or directory"));
}

TEST_F(File, ReadsLines) {
  const std::string longest(100, 'l');
  ASSERT_TRUE(write_file(*this / "a", "one\n\nthree\n" + longest + "\nlast"));
  auto reader = must(LineReader::open(*this / "a", 100));
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
    ASSERT_TRUE(write_file(*this / "a", "short\n" + std::string(length, 'x') + "\n"));
    auto reader = must(LineReader::open(*this / "a", 100));
    std::string_view line;
    ASSERT_TRUE(must(reader.next(line)));
    EXPECT_TRUE(is_error(reader.next(line), "/a:2: "));
  }
}

TEST_F(File, ReadsLinesAcrossBuffers) {
  std::string content;
  for (int i = 0; i < 400'000; ++i) content += std::to_string(i) + '\n';
  ASSERT_TRUE(write_file(*this / "a", content));
  auto reader = must(LineReader::open(*this / "a"));
  std::string_view line;
  for (int i = 0; i < 400'000; ++i) {
    ASSERT_TRUE(must(reader.next(line)));
    ASSERT_EQ(line, std::to_string(i));
  }
  EXPECT_FALSE(must(reader.next(line)));
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
    auto made = must(TemporaryFolder::make(*this / "x"));
    gone = made.path();
    ASSERT_TRUE(write_file(gone / "f", "1"));
  }
  EXPECT_FALSE(std::filesystem::exists(gone));
  auto first = TemporaryFolder::make(*this / "x"), second = TemporaryFolder::make(*this / "x");
  ASSERT_TRUE(write_file(first->path() / "f", "1"));
  ASSERT_TRUE(write_file(second->path() / "f", "2"));
  ASSERT_TRUE(first->move_to(*this / "kept"));
  ASSERT_TRUE(second->move_to(*this / "kept"));
  EXPECT_EQ(*read_file(*this / "kept/f"), "1");
}

// Make the file so old that it counts as abandoned unless it is locked.
void age(const std::filesystem::path& path) {
  std::filesystem::last_write_time(path,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::minutes(5));
}

TEST_F(File, LeftoversAreRemovedAndFilesInUseStay) {
  for (const char* name : {"x/.halfway-old", "x/.halfway-new", "x/other"})
    ASSERT_TRUE(make_folders(*this / name));
  ASSERT_TRUE(write_file(*this / "x/.halfway-old/f", "1"));
  std::filesystem::create_directory_symlink(*this / "x/other", *this / "x/.halfway-link");
  for (const char* name : {"f.part-old", "f.part-new", "g.part-old", "f"}) std::ofstream(*this / name) << "x";
  for (const char* name : {"x/.halfway-old", "x/other", "f.part-old", "g.part-old", "f"}) age(*this / name);
  const auto used = must(TemporaryFolder::make(*this / "x"));
  EXPECT_FALSE(std::filesystem::exists(*this / "x/.halfway-old"));
  for (const char* name : {"x/.halfway-new", "x/other", "x/.halfway-link"})
    EXPECT_TRUE(std::filesystem::exists(*this / name)) << name;
  age(used.path());
  const auto next = TemporaryFolder::make(*this / "x");
  EXPECT_TRUE(std::filesystem::exists(used.path()));

  auto writer = must(LineWriter::open(*this / "f"));
  EXPECT_FALSE(std::filesystem::exists(*this / "f.part-old"));
  for (const char* name : {"f.part-new", "g.part-old", "f"})
    EXPECT_TRUE(std::filesystem::exists(*this / name)) << name;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    if (entry.path().filename().string().starts_with("f.part-")) age(entry.path());
  writer.append("whole");
  ASSERT_TRUE(write_file(*this / "f", "another"));
  ASSERT_TRUE(writer.commit());
  EXPECT_EQ(*read_file(*this / "f"), "whole");
  EXPECT_FALSE(std::filesystem::exists(*this / "f.part-new"));
}

}  // namespace
}  // namespace halfway
