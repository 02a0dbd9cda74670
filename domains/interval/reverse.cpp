// SPDX-License-Identifier: Apache-2.0
// The reverses of algebraic functions, of cosh and of the power.
#include "domains/interval/reverse.h"

#include <algorithm>
#include <cmath>

#include "domains/interval/functions.h"
#include "domains/interval/guarded.h"
#include "domains/interval/kernel.h"
#include "domains/interval/point_functions.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

const Interval kPositive = Interval::raw(0.0, kInfinity);

}  // namespace

Interval sqr_rev(const Interval& c, const Interval& x) { return upward(up::sqr_rev, c, x); }
Interval abs_rev(const Interval& c, const Interval& x) { return upward(up::abs_rev, c, x); }
Interval cosh_rev(const Interval& c, const Interval& x) { return abs_rev(acosh(c), x); }

Interval mul_rev(const Interval& b, const Interval& c, const Interval& x) {
  return upward(up::mul_rev, b, c, x);
}

std::array<Interval, 2> mul_rev_to_pair(const Interval& b, const Interval& c) {
  RoundUpward guard;
  const Interval factor = opaque_bounds(b), product = opaque_bounds(c), none = Interval::empty();
  if (factor.is_empty() || product.is_empty()) return {none, none};
  if (factor.contains(0.0) && product.contains(0.0)) return {Interval::entire(), none};
  if (factor.lo() >= 0 || factor.hi() <= 0) return {opaque_bounds(up::div(product, factor)), none};
  const Interval left = up::div_by_signed(product, Interval::raw(factor.lo(), 0.0));
  const Interval right = up::div_by_signed(product, Interval::raw(0.0, factor.hi()));
  const bool ordered = product.lo() > 0;  // a positive product over the negative factors comes first
  return {opaque_bounds(ordered ? left : right), opaque_bounds(ordered ? right : left)};
}

Interval pown_rev(const Interval& c, const Interval& x, int n) {
  if (n == 0) return c.contains(1.0) ? x : Interval::empty();
  if (n == 1)
    return upward([](const Interval& power, const Interval& base) { return meet(power, base); }, c, x);
  if (n > 0 && leq(pown(x, n), c)) return x;  // a power costs less than a root
  if (n % 2 == 0) return abs_rev(rootn(c, n), x);
  return upward(
      [n](const Interval& power, const Interval& base) {
        const Interval above = rootn(meet(power, kPositive), n), below = rootn(meet(-power, kPositive), n);
        return join(meet(above, base), meet(-below, base));
      },
      c, x);
}

Interval atan2_rev1(const Interval& x, const Interval& c, const Interval& y) {
  Interval ordinate = y, abscissa = x;
  return atan2_rev(c, ordinate, abscissa) ? ordinate : Interval::empty();
}

Interval atan2_rev2(const Interval& y, const Interval& c, const Interval& x) {
  Interval ordinate = y, abscissa = x;
  return atan2_rev(c, ordinate, abscissa) ? abscissa : Interval::empty();
}

// ---- Powers: x^b = c is b log x = log c, a quotient of log c either way. In what follows a numerator is log
// c for a bound c, and a denominator d stands for itself (powRev1) or for its logarithm (powRev2).

namespace {

constexpr mpfr_prec_t kWorking = 200;

mpfr_rnd_t away_if(bool up) { return up ? MPFR_RNDU : MPFR_RNDD; }

/// log x, rounded.
void set_log(Number& result, double x, mpfr_rnd_t direction) {
  Number argument(x);
  mpfr_log(result.get(), argument.get(), direction);
}

/// exp(log c / d), rounded; in the limit where a bound is 0 or infinite.
struct Root {
  bool above_zero;  // the denominators' side; 0 is the limit from there
  double operator()(double c, double d, mpfr_rnd_t direction) const {
    if (c == 1) return 1.0;
    const bool positive = (c > 1) == above_zero;
    if (c == 0 || c == kInfinity || d == 0) return positive ? kInfinity : 0.0;
    if (std::isinf(d)) return 1.0;
    // The quotient rises with the numerator where d > 0.
    Number t(kWorking), result(mpfr_prec_t{53});
    set_log(t, c, away_if((direction == MPFR_RNDU) == above_zero));
    mpfr_div_d(t.get(), t.get(), d, direction);
    mpfr_exp(result.get(), t.get(), direction);
    return mpfr_get_d(result.get(), direction);
  }
};

/// log c / log d, rounded, for d on one side of 1; d == 1 is the limit from that side.
struct Logarithm {
  bool above_one;
  double operator()(double c, double d, mpfr_rnd_t direction) const {
    if (c == 1) return 0.0;
    const bool positive = (c > 1) == above_one;
    if (c == 0 || c == kInfinity || d == 1) return positive ? kInfinity : -kInfinity;
    if (d == 0 || d == kInfinity) return 0.0;
    const bool up = direction == MPFR_RNDU;
    Number t(kWorking), by(kWorking), result(mpfr_prec_t{53});
    set_log(t, c, away_if(up == above_one));
    // The quotient's size falls with the denominator's.
    set_log(by, d, away_if((up == positive) != above_one));
    mpfr_div(result.get(), t.get(), by.get(), direction);
    return mpfr_get_d(result.get(), direction);
  }
};

/// The quotients of log c by denominators of one sign, from the one next to zero to the farthest.
template <class Quotient>
Interval quotients(const Interval& c, double near, double far, bool positive, Quotient quotient) {
  const double of_low = c.lo() >= 1 ? far : near, of_high = c.hi() >= 1 ? near : far;
  return positive ? Interval::raw(quotient(c.lo(), of_low, MPFR_RNDD), quotient(c.hi(), of_high, MPFR_RNDU))
                  : Interval::raw(quotient(c.hi(), of_high, MPFR_RNDD), quotient(c.lo(), of_low, MPFR_RNDU));
}

/// The part of x in quotients by denominators of one sign. Where c is without 1 none is `pole`, the base 1 or
/// the exponent 0: that is the limit for an infinite exponent or for a base of 0 or oo.
Interval part_of(const Interval& quotients, const Interval& c, const Interval& x, double pole) {
  const Interval part = meet(quotients, x);
  const bool is_limit = part.lo() == pole && part.hi() == pole && !c.contains(1.0);
  return is_limit ? Interval::empty() : part;
}

/// The positive bases in x with x^b in c.
Interval positive_bases(const Interval& b, const Interval& c, const Interval& x) {
  if (c.hi() == 0) return Interval::empty();
  if (b.contains(0.0) && c.contains(1.0)) return x;
  Interval bases = Interval::empty();
  if (b.hi() > 0) bases = part_of(quotients(c, std::max(b.lo(), 0.0), b.hi(), true, Root{true}), c, x, 1.0);
  if (b.lo() < 0)
    bases = join(bases, part_of(quotients(c, std::min(b.hi(), 0.0), b.lo(), false, Root{false}), c, x, 1.0));
  return bases;
}

}  // namespace

Interval pow_rev1(const Interval& b, const Interval& c, const Interval& x) {
  RoundNearest guard;
  MpfrScope scope;
  const Interval exponent = opaque_bounds(b), power = meet(opaque_bounds(c), kPositive);
  const Interval base = meet(opaque_bounds(x), kPositive);
  if (exponent.is_empty() || power.is_empty() || base.is_empty()) return Interval::empty();
  Interval bases = positive_bases(exponent, power, base);
  if (bases.hi() == 0) bases = Interval::empty();  // what is left of the open half-line's closure
  const bool zero = base.lo() == 0 && power.lo() == 0 && exponent.hi() > 0;
  return opaque_bounds(zero ? join(bases, Interval::raw(0.0, 0.0)) : bases);
}

Interval pow_rev2(const Interval& a, const Interval& c, const Interval& x) {
  RoundNearest guard;
  MpfrScope scope;
  const Interval base = meet(opaque_bounds(a), kPositive), power = meet(opaque_bounds(c), kPositive);
  const Interval exponent = opaque_bounds(x);
  if (base.is_empty() || power.is_empty() || exponent.is_empty()) return Interval::empty();
  if (base.hi() == 0 || power.hi() == 0) {  // 0^y is 0 for y > 0, and nothing else ever is
    const bool possible = base.lo() == 0 && power.lo() == 0 && exponent.hi() > 0;
    return possible ? opaque_bounds(meet(exponent, kPositive)) : Interval::empty();
  }
  if (base.contains(1.0) && power.contains(1.0)) return exponent;
  Interval exponents = Interval::empty();
  if (base.hi() > 1) {
    const Interval above = quotients(power, std::max(base.lo(), 1.0), base.hi(), true, Logarithm{true});
    exponents = part_of(above, power, exponent, 0.0);
  }
  if (base.lo() < 1) {
    const Interval below = quotients(power, std::min(base.hi(), 1.0), base.lo(), false, Logarithm{false});
    exponents = join(exponents, part_of(below, power, exponent, 0.0));
  }
  return opaque_bounds(exponents);
}

}  // namespace hcsp
