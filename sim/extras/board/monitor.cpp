// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/monitor.hpp"

#include <fmt/format.h>

#include <utility>

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

void Monitor::fail(std::string what) {
  if (fault_.empty()) fault_ = fmt::format("monitor: {} in clock {}", what, clock_);
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

}  // namespace halfway::board
