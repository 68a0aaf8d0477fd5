// SPDX-License-Identifier: Apache-2.0
// When the walker does things at full speed, from what the header of rtl/raster/triangle_walker.vhd promises:
// the edge stage stands a line ahead of the line stage, and that a line ahead of the span stage.
#pragma once

#include <algorithm>
#include <cstdint>

namespace halfway::golden {

/// Clocks count from that in which the first triangle begins.
class WalkerClock {
 public:
  /// `records`: the buffer in front holds a record a line, so the next header comes only after the last line.
  /// `held`: for so many clocks more an init vector stays in the buffer in front, when it was read.
  explicit WalkerClock(bool records = false, std::int64_t held = 0)
      : records_(records), held_(held), read_(-2 - held) {}

  /// The clock in which the next init vector's first line goes to the line stage.
  std::int64_t take_init() {
    const std::int64_t there = (records_ ? line_free_ : read_ + held_) + 1;
    read_ = std::max(there, handed_on_ + (lines_ == 1 ? 1 : 0));
    handed_on_ = std::max(read_ + 1, line_free_);
    lines_ = 0;
    return handed_on_;
  }
  /// The clock in which the edge stage read that vector: when it was there, in that in which the line before
  /// left the edge stage, but a clock later behind a triangle's first line.
  std::int64_t read() const { return read_; }

  /// The clock in which the line, and its record, is taken. Its first pixel stands at the output a clock
  /// later and leaves in that clock, the others follow.
  std::int64_t take_line(std::int64_t pixels) {
    if (lines_++ != 0) handed_on_ = line_free_;
    line_free_ = pixels == 0 ? handed_on_ + 1 : std::max(handed_on_ + 1, span_free_);
    if (pixels != 0) span_free_ = line_free_ + pixels;
    return line_free_;
  }
  /// The clock in which the last pixel so far leaves.
  std::int64_t last_pixel() const { return span_free_; }

 private:
  bool records_;
  std::int64_t held_, read_, lines_ = 0, handed_on_ = -1, line_free_ = -2, span_free_ = 0;
};

}  // namespace halfway::golden
