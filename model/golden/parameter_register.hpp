// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/stream/parameter_register.vhd.
#pragma once

namespace halfway::golden {

template <class T>
class ParameterRegister {
 public:
  void load(const T& start) { value_ = start; }
  const T& value() const { return value_; }

 private:
  T value_{};
};

}  // namespace halfway::golden
