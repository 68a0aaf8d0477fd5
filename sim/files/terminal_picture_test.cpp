// SPDX-License-Identifier: Apache-2.0
#include "sim/files/terminal_picture.hpp"

#include <gtest/gtest.h>

namespace halfway {
namespace {

TEST(TerminalPicture, FitsAndNeverGrows) {
  EXPECT_TRUE((fitting_size({1000, 1000}, 80, 24) == FrameSize{48, 48}));
  EXPECT_TRUE((fitting_size({1000, 500}, 80, 24) == FrameSize{80, 40}));
  EXPECT_TRUE((fitting_size({20, 10}, 80, 24) == FrameSize{20, 10}));
  EXPECT_TRUE((fitting_size({4096, 1}, 80, 24) == FrameSize{80, 1}));
  EXPECT_TRUE((fitting_size({1, 4096}, 80, 24) == FrameSize{1, 48}));
  EXPECT_TRUE((fitting_size({4096, 4096}, 1, 4096) == FrameSize{1, 1}));
}

TEST(TerminalPicture, HasTwoPixelsPerBlockAndAnOddLastLine) {
  Frame frame({2, 3});
  frame.rgb = {1,   2, 3, 1, 2,   3,  //
               4,   5, 6, 7, 8,   9,  //
               250, 0, 0, 0, 250, 0};
  EXPECT_EQ(terminal_picture(frame, frame.size, TerminalColours::full),
            "\033[38;2;1;2;3m\033[48;2;4;5;6m\u2580\033[48;2;7;8;9m\u2580\033[0m\n"
            "\033[38;2;250;0;0m\u2580\033[38;2;0;250;0m\u2580\033[0m\n");
}

TEST(TerminalPicture, AveragesTheCoveredPixels) {
  Frame frame({3, 2});
  frame.rgb = {10, 0, 0, 20, 0, 255, 33, 9, 9,  //
               30, 0, 0, 41, 0, 255, 34, 9, 9};
  // Three columns reduced to two: pixel 0, and the mean of pixels 1 and 2.
  EXPECT_EQ(terminal_picture(frame, {2, 1}, TerminalColours::full),
            "\033[38;2;20;0;0m\u2580\033[38;2;32;5;132m\u2580\033[0m\n");
}

TEST(TerminalPicture, UsesTheNearestOf256Colours) {
  const auto index = [](std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    Frame frame({1, 1});
    frame.rgb = {red, green, blue};
    const std::string text = terminal_picture(frame, {1, 1}, TerminalColours::palette);
    const std::string begin = "\033[38;5;", end = "m\u2580\033[0m\n";
    EXPECT_TRUE(text.starts_with(begin) && text.ends_with(end)) << text;
    return std::stoi(text.substr(begin.size()));
  };
  EXPECT_EQ(index(0, 0, 0), 16);
  EXPECT_EQ(index(255, 255, 255), 231);
  EXPECT_EQ(index(255, 0, 0), 196);
  EXPECT_EQ(index(90, 140, 250), 16 + 36 * 1 + 6 * 2 + 5);
  EXPECT_EQ(index(8, 8, 8), 232);
  EXPECT_EQ(index(3, 3, 3), 16);
  EXPECT_EQ(index(128, 128, 128), 244);
  EXPECT_EQ(index(238, 238, 238), 255);
  EXPECT_EQ(index(246, 246, 246), 255);
}

}  // namespace
}  // namespace halfway
