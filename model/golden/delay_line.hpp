// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/stream/delay_line.vhd.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace halfway::golden {

/// A shift register of `depth` words.
template <class T>
class DelayLine {
 public:
  explicit DelayLine(int depth) : words_(static_cast<std::size_t>(depth)) {}

  /// One clock with enable. There must be a word: `depth` > 0.
  void step(T word) {
    assert(!words_.empty());
    std::shift_right(words_.begin(), words_.end(), 1);
    words_.front() = std::move(word);
    ++taken_;
  }
  /// The word stored `depth` clocks before the next one.
  const T& delayed() const { return words_.back(); }
  /// True if at least `depth` words were stored: delayed() is then one of them.
  bool full() const { return taken_ >= words_.size(); }

 private:
  std::vector<T> words_;
  std::size_t taken_ = 0;
};

}  // namespace halfway::golden
