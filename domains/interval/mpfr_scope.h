// SPDX-License-Identifier: Apache-2.0
// RAII for MPFR, which decides what double-double arithmetic cannot. For source files only: no public header
// includes this one. Conversions to and from double are under round to nearest with gradual underflow
// (rounding.h).
#pragma once

#include <mpfr.h>

namespace hcsp {

/// MPFR's exponent range is a setting of the thread: widen it, and leave it and the flags as found.
class MpfrScope {
 public:
  MpfrScope() : emin_(mpfr_get_emin()), emax_(mpfr_get_emax()), flags_(mpfr_flags_save()) {
    static thread_local const CacheOwner owner;
    static_cast<void>(owner);
    mpfr_set_emin(mpfr_get_emin_min());
    mpfr_set_emax(mpfr_get_emax_max());
  }
  ~MpfrScope() {
    mpfr_set_emin(emin_);
    mpfr_set_emax(emax_);
    mpfr_flags_restore(flags_, MPFR_FLAGS_ALL);
  }
  MpfrScope(const MpfrScope&) = delete;
  MpfrScope& operator=(const MpfrScope&) = delete;

 private:
  /// Gives MPFR's constants back when the thread ends.
  struct CacheOwner {
    ~CacheOwner() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
  };
  mpfr_exp_t emin_, emax_;
  mpfr_flags_t flags_;
};

/// A number of MPFR; not a number until it is set.
class Number {
 public:
  explicit Number(mpfr_prec_t precision) { mpfr_init2(value_, precision); }
  explicit Number(double x) : Number(mpfr_prec_t{53}) { mpfr_set_d(value_, x, MPFR_RNDN); }
  ~Number() { mpfr_clear(value_); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

}  // namespace hcsp
