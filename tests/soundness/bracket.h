// SPDX-License-Identifier: Apache-2.0
// The two doubles around a real number, which say exactly which intervals of doubles hold it: a number v is
// in [lo, hi] if and only if its bracket is.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "domains/interval/interval.h"

namespace hcsp::campaign {

/// v rounded down and up. Both NaN where there is no value, both infinite of one sign for a limit.
struct Bracket {
  double lo = std::numeric_limits<double>::quiet_NaN();
  double hi = std::numeric_limits<double>::quiet_NaN();

  /// Whether there is a limit, possibly infinite.
  [[nodiscard]] bool exists() const { return lo <= hi; }
  /// Whether it is of a real number.
  [[nodiscard]] bool is_finite() const { return lo < kInfinity && hi > -kInfinity; }
  [[nodiscard]] bool is_within(const Interval& a) const { return a.lo() <= lo && hi <= a.hi(); }
};

/// The tightest interval around numbers and limits.
class Hull {
 public:
  void add(const Bracket& b) {
    if (!b.exists()) return;
    lo_ = std::min(lo_, b.lo);
    hi_ = std::max(hi_, b.hi);
  }
  [[nodiscard]] Interval interval() const { return Interval::raw(lo_, hi_); }

 private:
  double lo_ = kInfinity, hi_ = -kInfinity;
};

/// Numbers of 53 bits for MPFR to work on, one set a thread.
class Registers {
 public:
  static Registers& of_thread() {
    static thread_local Registers registers;
    return registers;
  }
  Registers(const Registers&) = delete;
  Registers& operator=(const Registers&) = delete;

  mpfr_ptr set(int k, double x) {
    mpfr_set_d(value_[k], x, MPFR_RNDN);
    return value_[k];
  }
  mpfr_ptr result() { return value_[3]; }

  /// The bracket of what was rounded down into the result. One evaluation tells both bounds: the ternary
  /// value says whether it is the number itself, and where it is not the number lies before the next of 53
  /// bits. Rounding twice in one direction, to 53 bits and to the subnormal grid, is rounding once.
  Bracket bracket(int ternary) {
    mpfr_ptr r = result();
    if (mpfr_nan_p(r) != 0) return {};
    const double lo = mpfr_get_d(r, MPFR_RNDD);
    if (ternary != 0) mpfr_nextabove(r);
    return {lo, mpfr_get_d(r, MPFR_RNDU)};
  }

 private:
  Registers() {
    for (mpfr_t& v : value_) mpfr_init2(v, 53);
  }
  ~Registers() {
    for (mpfr_t& v : value_) mpfr_clear(v);
    mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE);
  }
  mpfr_t value_[4];
};

using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

inline Bracket bracket_of(Unary f, double x) {
  Registers& r = Registers::of_thread();
  return r.bracket(f(r.result(), r.set(0, x), MPFR_RNDD));
}

inline Bracket bracket_of(Binary f, double x, double y) {
  Registers& r = Registers::of_thread();
  return r.bracket(f(r.result(), r.set(0, x), r.set(1, y), MPFR_RNDD));
}

inline Bracket bracket_of_fma(double x, double y, double z) {
  Registers& r = Registers::of_thread();
  return r.bracket(mpfr_fma(r.result(), r.set(0, x), r.set(1, y), r.set(2, z), MPFR_RNDD));
}

}  // namespace hcsp::campaign
