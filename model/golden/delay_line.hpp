// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/stream/delay_line.vhd.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace halfway::golden {

template <class T>
class DelayLine {
 public:
  explicit DelayLine(int depth) : words_(static_cast<std::size_t>(depth)) {}

  /// One clock with enable.
  void step(T word) {
    words_[next_] = std::move(word);
    next_ = (next_ + 1) % words_.size();
    ++taken_;
  }
  /// The word stored `depth` clocks before the next one.
  const T& delayed() const { return words_[next_]; }
  /// True if at least `depth` words were stored: delayed() is then one of them.
  bool full() const { return taken_ >= words_.size(); }

 private:
  std::vector<T> words_;
  std::size_t next_ = 0, taken_ = 0;
};

}  // namespace halfway::golden
