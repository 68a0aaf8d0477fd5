// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/stream/stream_register.vhd: one register of a valid/ready stream, clock by clock.
#pragma once

#include "golden/parameter_register.hpp"

namespace halfway::golden {

template <class T>
class StreamRegister {
 public:
  bool in_ready(bool out_ready) const { return out_ready || !valid_; }
  bool out_valid() const { return valid_; }
  const T& out_data() const { return payload_.value(); }

  void clock(bool reset, bool in_valid, const T& in_data, bool out_ready) {
    if (in_ready(out_ready)) {
      if (in_valid) payload_.load(in_data);
      valid_ = in_valid;
    }
    if (reset) valid_ = false;
  }

 private:
  bool valid_ = false;
  ParameterRegister<T> payload_;
};

}  // namespace halfway::golden
