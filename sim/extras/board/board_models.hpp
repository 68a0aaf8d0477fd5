// SPDX-License-Identifier: Apache-2.0
// The monitor and the SRAM at the board's pins, one system clock at a time. A fault of the board is a Failure
// with the code `differs`.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "frame/frame.hpp"
#include "sim/extras/board/board_api.h"

namespace halfway::board {

inline constexpr FrameSize c_monitor{640, 480};
inline constexpr int c_clocks_per_dot = 2;

/// The levels of one line's or one frame's parts, in dots or lines.
struct VideoTiming {
  int visible, front_porch, sync, back_porch;
  int total() const { return visible + front_porch + sync + back_porch; }
};
inline constexpr VideoTiming c_line{640, 16, 96, 48}, c_field{480, 10, 2, 33};

struct VideoPins {
  bool hsync = true, vsync = true;            ///< active low
  std::uint8_t red = 0, green = 0, blue = 0;  ///< 0 to 7
  friend bool operator==(const VideoPins&, const VideoPins&) = default;
};

/// A picture at the pins: three levels of 3 bits per dot, line by line from the top left.
using DotPicture = std::vector<std::array<std::uint8_t, 3>>;

/// The picture with 0 to 255 per channel: 7 is 255.
Frame frame_of_dots(const DotPicture& dots);

/// Decodes the levels of the video pins into pictures, and checks the timing of 640x480 at 60 Hz.
class Monitor {
 public:
  /// Calls on_picture for each complete picture from the first vertical sync on.
  explicit Monitor(std::function<void(const DotPicture&)> on_picture);

  /// One system clock.
  void clock(const VideoPins& pins);

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void start_line(bool vsync);
  void check_edges(const VideoPins& pins);
  void take_dot(const VideoPins& pins);

  std::function<void(const DotPicture&)> on_picture_;
  DotPicture dots_;
  VideoPins last_;
  std::uint64_t clock_ = 0;
  std::int64_t hsync_fall_ = -1;  ///< clock of the last falling edge; -1: none yet
  std::int64_t line_ = -1;        ///< falling edges of hsync since vsync was high again; -1: not known
  int sync_lines_ = 0;            ///< falling edges of hsync with vsync low
  bool seen_vsync_ = false;
};

/// An asynchronous SRAM of 256K words of 16 bits. It reads and writes within a clock, and checks the rules of
/// the bus:
/// - it is read or written, not both, and the FPGA drives the data exactly while it writes
/// - at least one clock with neither lies between a read and a write: the SRAM releases the bus in it
/// - only the words of buffers and depths are used
class SramModel {
 public:
  /// The first `words_in_use` words may be addressed.
  explicit SramModel(std::uint32_t words_in_use);

  /// One clock with these levels at the pins. Returns the data on the bus at its end; without a read, noise.
  std::uint16_t clock(const BoardOutputs& pins);

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::uint16_t noise();

  std::vector<std::uint16_t> words_;
  std::uint32_t words_in_use_;
  std::uint64_t clock_ = 0;
  std::uint32_t random_ = 1;
  bool was_read_ = false;
};

}  // namespace halfway::board
