// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_models.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/os/must.hpp"

namespace halfway::board {

Frame frame_of_dots(const DotPicture& dots) {
  Frame frame(c_monitor);
  for (std::size_t i = 0; i < dots.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      frame.rgb[3 * i + c] = static_cast<std::uint8_t>((dots[i][c] * 255 + 3) / 7);
  return frame;
}

Monitor::Monitor(std::function<void(const DotPicture&)> on_picture)
    : on_picture_(std::move(on_picture)), dots_(Frame::pixels(c_monitor)) {}

void Monitor::fail(const std::string& what) const {
  throw Failure{{ExitCode::differs, fmt::format("monitor: {} in clock {}", what, clock_)}};
}

void Monitor::clock(const VideoPins& pins) {
  check_edges(pins);
  take_dot(pins);
  last_ = pins;
  ++clock_;
}

void Monitor::check_edges(const VideoPins& pins) {
  const auto now = static_cast<std::int64_t>(clock_);
  if (last_.hsync && !pins.hsync) {
    const std::int64_t period = now - hsync_fall_;
    if (hsync_fall_ >= 0 && period != c_line.total() * c_clocks_per_dot)
      fail(fmt::format("a line of {} clocks instead of {}", period, c_line.total() * c_clocks_per_dot));
    hsync_fall_ = now;
    start_line(pins.vsync);
  }
  if (!last_.hsync && pins.hsync && hsync_fall_ >= 0 && now - hsync_fall_ != c_line.sync * c_clocks_per_dot)
    fail(fmt::format("a horizontal sync of {} clocks instead of {}", now - hsync_fall_,
                     c_line.sync * c_clocks_per_dot));
}

/// Count lines from the first horizontal sync after the vertical one. The visible lines follow the back
/// porch.
void Monitor::start_line(bool vsync) {
  if (!vsync) {
    if (sync_lines_++ == 0 && seen_vsync_ && line_ + 1 != c_field.total() - c_field.sync)
      fail(fmt::format("a vertical sync after {} lines instead of {}", line_ + 1,
                       c_field.total() - c_field.sync));
    return;
  }
  if (sync_lines_ > 0) {
    if (sync_lines_ != c_field.sync && seen_vsync_)
      fail(fmt::format("a vertical sync of {} lines instead of {}", sync_lines_, c_field.sync));
    if (seen_vsync_) on_picture_(dots_);
    seen_vsync_ = true;
    sync_lines_ = 0;
    line_ = 0;
  } else if (line_ >= 0) {
    ++line_;
  }
}

void Monitor::take_dot(const VideoPins& pins) {
  if (line_ < 0 || hsync_fall_ < 0) return;
  const std::int64_t since = static_cast<std::int64_t>(clock_) - hsync_fall_;
  const std::int64_t x = since / c_clocks_per_dot - (c_line.sync + c_line.back_porch);
  const std::int64_t y = line_ - (c_field.back_porch - 1);
  const std::array<std::uint8_t, 3> dot = {pins.red, pins.green, pins.blue};
  const bool visible = x >= 0 && x < c_line.visible && y >= 0 && y < c_field.visible && sync_lines_ == 0;
  if (!visible) {
    if (dot != std::array<std::uint8_t, 3>{}) fail("a colour outside of the visible part");
    return;
  }
  auto& kept = dots_[static_cast<std::size_t>(y * c_line.visible + x)];
  if (since % c_clocks_per_dot == 0)
    kept = dot;
  else if (kept != dot)
    fail(fmt::format("the colour changes within dot {},{}", x, y));
}

constexpr std::size_t c_words = std::size_t{1} << 18;

SramModel::SramModel(std::uint32_t words_in_use) : words_(c_words), words_in_use_(words_in_use) {
  for (std::uint16_t& word : words_) word = noise();
}

std::uint16_t SramModel::noise() {  // xorshift32 (Marsaglia 2003)
  random_ ^= random_ << 13;
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  return static_cast<std::uint16_t>(random_);
}

void SramModel::fail(const std::string& what) const {
  throw Failure{{ExitCode::differs, fmt::format("SRAM: {} in clock {}", what, clock_)}};
}

std::uint16_t SramModel::clock(const BoardOutputs& pins) {
  ++clock_;
  const bool read = pins.sram_read != 0, write = pins.sram_write != 0;
  if (read && write) fail("read and write");
  if (write != (pins.sram_data_enable != 0))
    fail("the FPGA drives the data, but does not write, or the reverse");
  if (write && was_read_) fail("write in the clock after a read: the bus is not released");
  if ((read || write) && pins.sram_address >= words_in_use_)
    fail(fmt::format("address {} of {} words", pins.sram_address, words_in_use_));
  was_read_ = read;
  std::uint16_t& word = words_[pins.sram_address % c_words];
  if (write) word = pins.sram_data_out;
  return read ? word : noise();
}

}  // namespace halfway::board
