// SPDX-License-Identifier: Apache-2.0
// Frames as text for a colour terminal.
#pragma once

#include <string>

#include "frame/frame.hpp"
#include "frame/frame_size.hpp"

namespace halfway {

enum class TerminalColours {
  full,     ///< 24 bits
  palette,  ///< xterm's 256 colours: a cube with 6 levels per channel, and 24 greys
};

/// The largest size with the frame's proportions that fits into the given columns and lines of text. A line
/// shows two pixels. The size is at least one pixel and at most the frame's size.
FrameSize fitting_size(FrameSize frame, std::uint32_t columns, std::uint32_t lines);

/// The frame scaled to that size, drawn with half blocks. Each pixel is the mean of the source pixels that it
/// covers. Every line ends with a colour reset and a line feed.
std::string terminal_picture(const Frame& frame, FrameSize size, TerminalColours colours);

}  // namespace halfway
