// SPDX-License-Identifier: Apache-2.0
#include "sim/files/image.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "common/test/is_error.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

class Image : public testing::Test {
 protected:
  static Frame noise(FrameSize size, unsigned seed) {
    Frame frame(size);
    std::mt19937 random(seed);
    for (std::uint8_t& byte : frame.rgb) byte = static_cast<std::uint8_t>(random());
    return frame;
  }
  static std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  const TemporaryFolder made_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path folder_ = made_.path();
};

TEST_F(Image, IsReadBackAsWritten) {
  unsigned seed = 0;
  for (const FrameSize size : {FrameSize{1, 1}, FrameSize{3, 2}, FrameSize{640, 7}, FrameSize{1, 4096}}) {
    const Frame frame = noise(size, ++seed);
    const fs::path path = folder_ / "a b %04d #.png";
    const Status written = write_png(path, frame);
    ASSERT_TRUE(written) << written.error().message;
    const auto back = must(read_png(path));
    EXPECT_EQ(back.size.width, size.width);
    EXPECT_EQ(back.size.height, size.height);
    EXPECT_EQ(back.rgb, frame.rgb);
    EXPECT_EQ(files(), 1u);  // no temporary file is left
    ASSERT_TRUE(write_png(path, frame, Compression::quick));
    const auto quick = must(read_png(path));
    EXPECT_EQ(quick.rgb, frame.rgb);
  }
}

TEST_F(Image, APpmIsItsPixelsAfterAHeader) {
  const Frame frame = noise({3, 2}, 7);
  const fs::path path = folder_ / "a.ppm";
  ASSERT_TRUE(write_ppm(path, frame));
  EXPECT_EQ(bytes_of(path), "P6\n3 2\n255\n" + std::string(frame.rgb.begin(), frame.rgb.end()));
  EXPECT_EQ(files(), 1u);
  EXPECT_FALSE(write_ppm(path, Frame{}));
}

TEST_F(Image, SameFrameGivesTheSameBytes) {
  ASSERT_TRUE(write_png(folder_ / "a.png", noise({50, 40}, 1)));
  ASSERT_TRUE(write_png(folder_ / "b.png", noise({50, 40}, 1)));
  EXPECT_EQ(bytes_of(folder_ / "a.png"), bytes_of(folder_ / "b.png"));
}

TEST_F(Image, AnUnwritableFolderIsBadInput) {
  const Frame frame({2, 2});
  const auto expect_refused = [&](const fs::path& path) {
    const Status status = write_png(path, frame);
    ASSERT_FALSE(status) << path;
    EXPECT_EQ(status.error().code, ExitCode::bad_input);
    EXPECT_EQ(status.error().message.find(path.string() + ": "), 0u) << status.error().message;
  };
  expect_refused(folder_ / "missing" / "a.png");
  std::ofstream(folder_ / "file") << "x";
  expect_refused(folder_ / "file" / "a.png");
  expect_refused(folder_);  // the path is a folder
  if (::geteuid() != 0) {   // root may read every file
    fs::create_directory(folder_ / "closed");
    fs::permissions(folder_ / "closed", fs::perms::owner_read | fs::perms::owner_exec);
    expect_refused(folder_ / "closed" / "a.png");
    fs::permissions(folder_ / "closed", fs::perms::owner_all);
  }
}

TEST_F(Image, AFullDeviceIsToolFailed) {
  EXPECT_TRUE(is_error(write_png("/dev/full", Frame({2, 2})), ExitCode::tool_failed));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// A file size limit stops the writing half way, like a disk that fills up.
TEST_F(Image, AWriteCutShortLeavesTheOldFile) {
  const fs::path path = folder_ / "a.png";
  ASSERT_TRUE(write_png(path, noise({8, 8}, 1)));
  const std::string before = bytes_of(path);
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
  EXPECT_EQ(bytes_of(path), before);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Image, RefusesInvalidFrames) {
  Frame torn({4, 4});
  torn.rgb.pop_back();
  for (const Frame& frame : {Frame(), Frame({0, 5}), Frame({5, 0}), Frame({4097, 1}), torn}) {
    EXPECT_TRUE(is_error(write_png(folder_ / "a.png", frame), ExitCode::bad_input));
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(Image, RefusesToReadIncompletePictures) {
  const fs::path path = folder_ / "a.png";
  const auto expect_refused = [&] {
    const auto frame = read_png(path);
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ExitCode::bad_input);
    EXPECT_EQ(frame.error().message.find(path.string() + ": "), 0u) << frame.error().message;
  };
  expect_refused();  // missing
  ASSERT_TRUE(write_png(path, noise({64, 48}, 3)));
  const std::string whole = bytes_of(path);
  for (const std::size_t length : {std::size_t{0}, std::size_t{7}, std::size_t{40}, whole.size() / 2}) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, length);
    expect_refused();
  }
  std::ofstream(path, std::ios::binary | std::ios::trunc) << "P6 1 1 255 abc";
  expect_refused();
  std::string damaged = whole;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x10);
  std::ofstream(path, std::ios::binary | std::ios::trunc) << damaged;
  expect_refused();
}

}  // namespace
}  // namespace halfway
