// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/stream/stream_queue.vhd, clock by clock.
#pragma once

#include <deque>
#include <optional>

namespace halfway::golden {

template <class T>
class StreamQueue {
 public:
  /// At most `most` words may be claimed at the same time.
  explicit StreamQueue(int most) : most_(most) {}

  bool room() const { return claimed_ < most_; }
  bool pending() const { return claimed_ > 0; }
  bool out_valid() const { return out_.has_value(); }
  const T& out_data() const { return *out_; }

  /// `in`: the input word, if there is one.
  void clock(bool reset, bool claim, const std::optional<T>& in, bool out_ready) {
    if (claim) ++claimed_;
    if (out_ready && out_) {
      out_.reset();
      --claimed_;
    }
    if (!out_ && !words_.empty()) {
      out_ = words_.front();
      words_.pop_front();
    }
    if (in) words_.push_back(*in);
    if (reset) {
      claimed_ = 0;
      out_.reset();
      words_.clear();
    }
  }

 private:
  int most_, claimed_ = 0;
  std::optional<T> out_;
  std::deque<T> words_;  ///< available at the output from the next clock on
};

}  // namespace halfway::golden
