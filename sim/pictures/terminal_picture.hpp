// SPDX-License-Identifier: Apache-2.0
// Frames as text, for a terminal that knows colours.
#pragma once

#include <string>

#include "frame/frame.hpp"
#include "frame/frame_size.hpp"

namespace halfway {

enum class TerminalColours {
  full,     ///< 24 bits
  palette,  ///< the 256 of xterm: a cube of 6 levels a channel, and 24 greys
};

/// The largest size of the frame's proportions, and at least a pixel, that fits into so many columns and
/// lines of text, of two pixels each; never larger than the frame.
FrameSize fitting_size(FrameSize frame, std::uint32_t columns, std::uint32_t lines);

/// The frame in that size, each pixel the mean of those that it stands for, as half blocks; every line ends
/// with the terminal's own colours and a line feed.
std::string terminal_picture(const Frame& frame, FrameSize size, TerminalColours colours);

}  // namespace halfway
