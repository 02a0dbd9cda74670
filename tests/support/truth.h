// SPDX-License-Identifier: Apache-2.0
// Independent truth for the tests of intervals: MPFR with directed rounding, and seeded random doubles and
// intervals of every size with the corner cases among them.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <random>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp {

/// How GoogleTest shows an interval: every bit.
inline void PrintTo(const Interval& a, std::ostream* out) {
  *out << std::hexfloat << '[' << a.lo() << ", " << a.hi() << ']' << std::defaultfloat;
}

}  // namespace hcsp

namespace hcsp::oracle {

class Real {
 public:
  explicit Real(double x = 0.0, mpfr_prec_t precision = 53) {
    mpfr_init2(value_, precision);
    mpfr_set_d(value_, x, MPFR_RNDN);
  }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// The tightest enclosure of f(x), f(x, y). Rounding twice in one direction, to 53 bits and to the subnormal
/// grid, is rounding once.
inline Interval truth(Unary f, double x) {
  Real argument(x), lo, hi;
  f(lo.get(), argument.get(), MPFR_RNDD);
  f(hi.get(), argument.get(), MPFR_RNDU);
  return Interval::raw(mpfr_get_d(lo.get(), MPFR_RNDD), mpfr_get_d(hi.get(), MPFR_RNDU));
}

inline Interval truth(Binary f, double x, double y) {
  Real left(x), right(y), lo, hi;
  f(lo.get(), left.get(), right.get(), MPFR_RNDD);
  f(hi.get(), left.get(), right.get(), MPFR_RNDU);
  return Interval::raw(mpfr_get_d(lo.get(), MPFR_RNDD), mpfr_get_d(hi.get(), MPFR_RNDU));
}

/// Random numbers for tests; the seed is fixed, and printed where a test fails.
class Dice {
 public:
  static constexpr std::uint64_t kSeed = 20240611;
  explicit Dice(std::uint64_t seed = kSeed) : engine_(seed) {}

  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }

  /// Any finite double: of moderate size, a corner case, a small integer, or any bits.
  double any() {
    static const std::vector<double> corners = {0.0,
                                                1.0,
                                                2.0,
                                                0.5,
                                                0x1p-26,
                                                0x1p-27,
                                                0x1p-1074,
                                                0x1p-1022,
                                                0x1.fffffffffffffp-1023,
                                                0x1p-537,
                                                0x1p511,
                                                0x1.fffffffffffffp1023,
                                                0x1.921fb54442d18p+0,
                                                0x1.921fb54442d18p+1,
                                                0x1.921fb54442d19p+1,
                                                0x1p20,
                                                0x1p300};
    const double sign = below(2) == 0 ? 1.0 : -1.0;
    switch (below(5)) {
      case 0:
        return sign * corners[static_cast<std::size_t>(below(static_cast<int>(corners.size())))];
      case 1:
        return below(21) - 10;
      case 2: {
        const double x = std::bit_cast<double>(engine_());
        return std::isfinite(x) ? x : 1.0;
      }
      default:
        return sign * std::exp2(uniform(-12, 8));
    }
  }

  /// Any nonempty interval: points and half lines included.
  Interval interval() {
    const double a = any(), b = below(6) == 0 ? a : any();
    const double lo = below(16) == 0 ? -kInfinity : std::min(a, b);
    return Interval::raw(lo, below(16) == 0 ? kInfinity : std::max(a, b));
  }

  /// A finite point of a.
  double in(const Interval& a) {
    const double lo = std::max(a.lo(), -0x1.fffffffffffffp1023),
                 hi = std::min(a.hi(), 0x1.fffffffffffffp1023);
    switch (below(6)) {
      case 0:
        return lo;
      case 1:
        return hi;
      case 2:
        return std::clamp(any(), lo, hi);
      default: {
        const double part = uniform(0, 1);
        return std::clamp(lo * (1 - part) + hi * part, lo, hi);
      }
    }
  }

  /// An interval within a.
  Interval within(const Interval& a) {
    if (below(4) == 0) return a;
    const double x = in(a), y = in(a);
    return Interval::raw(std::min(x, y), std::max(x, y));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hcsp::oracle
