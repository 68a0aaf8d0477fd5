// SPDX-License-Identifier: Apache-2.0
#include "sim/files/image.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <random>
#include <string>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

class Image : public FolderTest {
 protected:
  static Frame noise(FrameSize size, unsigned seed) {
    Frame frame(size);
    std::mt19937 random(seed);
    for (std::uint8_t& byte : frame.rgb) byte = static_cast<std::uint8_t>(random());
    return frame;
  }
  std::size_t files() const { return must(files_below(here())).size(); }
};

TEST_F(Image, IsReadBackAsWritten) {
  unsigned seed = 0;
  for (const FrameSize size : {FrameSize{1, 1}, FrameSize{3, 2}, FrameSize{640, 7}, FrameSize{1, 4096}}) {
    const Frame frame = noise(size, ++seed);
    const fs::path path = at("a b %04d #.png");
    for (const Compression compression : {Compression::usual, Compression::quick}) {
      must(write_png(path, frame, compression));
      const auto back = must(read_png(path));
      EXPECT_TRUE(back.size == size);
      EXPECT_EQ(back.rgb, frame.rgb);
      EXPECT_EQ(files(), 1u);  // no temporary file is left
    }
  }
}

TEST_F(Image, APpmIsItsPixelsAfterAHeader) {
  const Frame frame = noise({3, 2}, 7);
  const fs::path path = at("a.ppm");
  ASSERT_TRUE(write_ppm(path, frame));
  EXPECT_EQ(text_of(path), "P6\n3 2\n255\n" + std::string(frame.rgb.begin(), frame.rgb.end()));
  EXPECT_EQ(files(), 1u);
  EXPECT_FALSE(write_ppm(path, Frame{}));
}

TEST_F(Image, SameFrameGivesTheSameBytes) {
  ASSERT_TRUE(write_png(at("a.png"), noise({50, 40}, 1)));
  ASSERT_TRUE(write_png(at("b.png"), noise({50, 40}, 1)));
  EXPECT_EQ(text_of("a.png"), text_of("b.png"));
}

TEST_F(Image, AnUnwritableFolderIsBadInput) {
  const auto expect_refused = [&](const fs::path& path) {
    EXPECT_TRUE(is_error(write_png(path, Frame({2, 2})), ExitCode::bad_input, path.string() + ": "));
  };
  expect_refused(at("missing/a.png"));
  write("file", "x");
  expect_refused(at("file/a.png"));
  expect_refused(here());  // the path is a folder
  if (::geteuid() != 0) {  // root may read every file
    fs::create_directory(at("closed"));
    fs::permissions(at("closed"), fs::perms::owner_read | fs::perms::owner_exec);
    expect_refused(at("closed/a.png"));
    fs::permissions(at("closed"), fs::perms::owner_all);
  }
}

TEST_F(Image, AFullDeviceIsToolFailed) {
  EXPECT_TRUE(is_error(write_png("/dev/full", Frame({2, 2})), ExitCode::tool_failed));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// A file size limit stops the writing half way, like a disk that fills up.
TEST_F(Image, AWriteCutShortLeavesTheOldFile) {
  const fs::path path = at("a.png");
  ASSERT_TRUE(write_png(path, noise({8, 8}, 1)));
  const std::string before = text_of(path);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  rlimit limit = old_limit;
  limit.rlim_cur = 5000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  const Status status = write_png(path, noise({200, 200}, 2));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ExitCode::tool_failed);
  EXPECT_EQ(text_of(path), before);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Image, RefusesInvalidFrames) {
  Frame torn({4, 4});
  torn.rgb.pop_back();
  for (const Frame& frame : {Frame(), Frame({0, 5}), Frame({5, 0}), Frame({4097, 1}), torn}) {
    EXPECT_TRUE(is_error(write_png(at("a.png"), frame), ExitCode::bad_input));
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(Image, RefusesToReadIncompletePictures) {
  const fs::path path = at("a.png");
  const auto expect_refused = [&] {
    EXPECT_TRUE(is_error(read_png(path), ExitCode::bad_input, path.string() + ": "));
  };
  expect_refused();  // missing
  ASSERT_TRUE(write_png(path, noise({64, 48}, 3)));
  const std::string whole = text_of(path);
  std::string damaged = whole;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x10);
  for (const std::string& bytes :
       {std::string(), whole.substr(0, 7), whole.substr(0, 40), whole.substr(0, whole.size() / 2),
        std::string("P6 1 1 255 abc"), damaged}) {
    write(path, bytes);
    expect_refused();
  }
}

}  // namespace
}  // namespace halfway
