// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/stream/stream_queue.vhd, clock by clock.
#pragma once

#include <deque>
#include <optional>

namespace halfway::golden {

template <class T>
class StreamQueue {
 public:
  /// `most` words may be claimed at once.
  explicit StreamQueue(int most) : most_(most) {}

  bool room() const { return claimed_ < most_; }
  bool holds() const { return claimed_ > 0; }
  bool out_valid() const { return out_.has_value(); }
  const T& out_data() const { return *out_; }

  /// `in`: the word that comes, if any.
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
  std::deque<T> words_;  ///< that the output can take from the next clock on
};

}  // namespace halfway::golden
