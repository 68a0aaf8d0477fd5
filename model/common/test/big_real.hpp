// SPDX-License-Identifier: Apache-2.0
// For tests: real numbers of 400 bits, by MPFR. Sums of nearly opposite terms, and quotients by them, stay
// accurate.
#pragma once

#include <mpfr.h>

namespace halfway {

class BigReal {
 public:
  BigReal(double v = 0.0) {
    mpfr_init2(v_, 400);
    mpfr_set_d(v_, v, MPFR_RNDN);
  }
  BigReal(const BigReal& other) : BigReal() { mpfr_set(v_, other.v_, MPFR_RNDN); }
  BigReal& operator=(const BigReal& other) {
    mpfr_set(v_, other.v_, MPFR_RNDN);
    return *this;
  }
  ~BigReal() { mpfr_clear(v_); }
  explicit operator double() const { return mpfr_get_d(v_, MPFR_RNDN); }

  static BigReal pi() {
    BigReal r;
    mpfr_const_pi(r.v_, MPFR_RNDN);
    return r;
  }
  friend BigReal operator+(const BigReal& a, const BigReal& b) { return of(mpfr_add, a, b); }
  friend BigReal operator-(const BigReal& a, const BigReal& b) { return of(mpfr_sub, a, b); }
  friend BigReal operator*(const BigReal& a, const BigReal& b) { return of(mpfr_mul, a, b); }
  friend BigReal operator/(const BigReal& a, const BigReal& b) { return of(mpfr_div, a, b); }
  friend BigReal pow(const BigReal& a, const BigReal& b) { return of(mpfr_pow, a, b); }
  friend BigReal min(const BigReal& a, const BigReal& b) { return of(mpfr_min, a, b); }
  friend BigReal sqrt(const BigReal& a) { return of(mpfr_sqrt, a); }
  friend BigReal exp(const BigReal& a) { return of(mpfr_exp, a); }
  friend BigReal exp2(const BigReal& a) { return of(mpfr_exp2, a); }
  friend BigReal log2(const BigReal& a) { return of(mpfr_log2, a); }
  friend BigReal sin(const BigReal& a) { return of(mpfr_sin, a); }
  friend BigReal cos(const BigReal& a) { return of(mpfr_cos, a); }
  friend BigReal abs(const BigReal& a) { return of(mpfr_abs, a); }
  /// The part after the point.
  friend BigReal fraction(const BigReal& a) { return of(mpfr_frac, a); }
  friend bool operator<(const BigReal& a, const BigReal& b) { return mpfr_less_p(a.v_, b.v_) != 0; }

 private:
  template <class Function, class... Arguments>
  static BigReal of(Function function, const Arguments&... arguments) {
    BigReal r;
    function(r.v_, arguments.v_..., MPFR_RNDN);
    return r;
  }
  mpfr_t v_;
};

}  // namespace halfway
