// SPDX-License-Identifier: Apache-2.0
// Timing of the triangle walker at full speed, from the contract in the header of
// rtl/raster/triangle_walker.vhd: the edge stage is one line ahead of the line stage, which is one line ahead
// of the span stage.
#pragma once

#include <algorithm>
#include <cstdint>

namespace halfway::golden {

/// Clocks are counted from the start of the first triangle.
class WalkerClock {
 public:
  /// `records`: the input buffer holds one record per line, so the next header comes only after the last
  /// line. `held`: number of additional clocks for which an init vector stays in the input buffer after it
  /// was read.
  explicit WalkerClock(bool records = false, std::int64_t held = 0)
      : records_(records), held_(held), read_(-2 - held) {}

  /// The clock in which the first line of the next init vector enters the line stage.
  std::int64_t take_init() {
    const std::int64_t there = (records_ ? line_free_ : read_ + held_) + 1;
    read_ = std::max(there, handed_on_ + (lines_ == 1 ? 1 : 0));
    handed_on_ = std::max(read_ + 1, line_free_);
    lines_ = 0;
    return handed_on_;
  }
  /// The clock in which the edge stage read that vector: as soon as it is available and the previous line
  /// leaves the edge stage, but one clock later after the first line of a triangle.
  std::int64_t read() const { return read_; }

  /// The clock in which the line and its record are accepted. Its first pixel is output in the next clock,
  /// followed by the others.
  std::int64_t take_line(std::int64_t pixels) {
    if (lines_++ != 0) handed_on_ = line_free_;
    line_free_ = pixels == 0 ? handed_on_ + 1 : std::max(handed_on_ + 1, span_free_);
    if (pixels != 0) span_free_ = line_free_ + pixels;
    return line_free_;
  }
  /// The clock in which the last pixel so far is output.
  std::int64_t last_pixel() const { return span_free_; }

 private:
  bool records_;
  std::int64_t held_, read_, lines_ = 0, handed_on_ = -1, line_free_ = -2, span_free_ = 0;
};

}  // namespace halfway::golden
