// SPDX-License-Identifier: Apache-2.0
// A number with more precision than needed: the least distance of any entry of a table from a tie is 2^-22.
#pragma once

#include <mpfr.h>

namespace halfway::tables {

class Real {
 public:
  Real() { mpfr_init2(value_, 256); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

}  // namespace halfway::tables
