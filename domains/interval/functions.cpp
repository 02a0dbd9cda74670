// SPDX-License-Identifier: Apache-2.0
// The functions that are monotone between known points: their images are bounded at the ends, by MPFR, which
// rounds correctly.
#include "domains/interval/functions.h"

#include <algorithm>
#include <cmath>

#include "domains/check.h"
#include "domains/interval/arcs.h"
#include "domains/interval/atan2.h"
#include "domains/interval/exp_log.h"
#include "domains/interval/guarded.h"
#include "domains/interval/kernel.h"
#include "domains/interval/point_functions.h"
#include "domains/interval/pown.h"

namespace hcsp {

namespace {

const Interval kPositive = Interval::raw(0.0, kInfinity);

/// The image of a non-decreasing function of MPFR on the part of a in its domain.
Interval rising(Function f, const Interval& a, const Interval& domain = {}) {
  return exactly(
      [&](const Interval& whole) {
        const Interval x = meet(whole, domain);
        if (x.is_empty()) return x;
        return Interval::raw(rounded(f, x.lo(), MPFR_RNDD), rounded(f, x.hi(), MPFR_RNDU));
      },
      a);
}

/// On a domain that is open, with infinite limits at its finite ends.
Interval rising_inside(Function f, const Interval& a, const Interval& domain) {
  return exactly(
      [&](const Interval& x) {
        if (x.hi() <= domain.lo() || x.lo() >= domain.hi()) return Interval::empty();
        return rising(f, x, domain);
      },
      a);
}

template <class Step>
Interval steps(const Interval& a, Step step) {
  return exactly(
      [&](const Interval& x) { return x.is_empty() ? x : Interval::raw(step(x.lo()), step(x.hi())); }, a);
}

double sign_of(double x) { return x > 0 ? 1.0 : (x < 0 ? -1.0 : 0.0); }

double nearest_even(double x) {
  const double away = std::round(x);
  const bool tie = std::abs(x - std::trunc(x)) == 0.5;
  return tie ? 2 * std::round(x / 2) : away;
}

}  // namespace

Interval exp(const Interval& a) { return upward(up::exp, a); }
Interval log(const Interval& a) { return upward(up::log, a); }
Interval exp2(const Interval& a) { return rising(mpfr_exp2, a); }
Interval exp10(const Interval& a) { return rising(mpfr_exp10, a); }
Interval expm1(const Interval& a) { return rising(mpfr_expm1, a); }
Interval log2(const Interval& a) { return rising_inside(mpfr_log2, a, kPositive); }
Interval log10(const Interval& a) { return rising_inside(mpfr_log10, a, kPositive); }
Interval log1p(const Interval& a) { return rising_inside(mpfr_log1p, a, Interval::raw(-1.0, kInfinity)); }
Interval asin(const Interval& a) { return rising(mpfr_asin, a, kUnit); }
Interval acos(const Interval& a) {
  return exactly(
      [](const Interval& whole) {
        const Interval x = meet(whole, kUnit);
        if (x.is_empty()) return x;
        return Interval::raw(rounded(mpfr_acos, x.hi(), MPFR_RNDD), rounded(mpfr_acos, x.lo(), MPFR_RNDU));
      },
      a);
}
Interval atan(const Interval& a) { return upward(up::atan, a); }
Interval sinh(const Interval& a) { return rising(mpfr_sinh, a); }
Interval cosh(const Interval& a) { return rising(mpfr_cosh, abs(a)); }
Interval tanh(const Interval& a) { return rising(mpfr_tanh, a); }
Interval asinh(const Interval& a) { return rising(mpfr_asinh, a); }
Interval acosh(const Interval& a) { return rising(mpfr_acosh, a, Interval::raw(1.0, kInfinity)); }
Interval atanh(const Interval& a) { return rising_inside(mpfr_atanh, a, kUnit); }

Interval sign(const Interval& a) { return steps(a, sign_of); }
Interval ceil(const Interval& a) {
  return steps(a, [](double x) { return std::ceil(x); });
}
Interval floor(const Interval& a) {
  return steps(a, [](double x) { return std::floor(x); });
}
Interval trunc(const Interval& a) {
  return steps(a, [](double x) { return std::trunc(x); });
}
Interval round_ties_to_even(const Interval& a) { return steps(a, nearest_even); }
Interval round_ties_to_away(const Interval& a) {
  return steps(a, [](double x) { return std::round(x); });
}

namespace {

/// The number of the branch (k - 1/2) pi < x < (k + 1/2) pi of the tangent around x; exact, since no double
/// but 0 is a multiple of pi/2: with 64 bits more than x has before the point, pi decides.
void branch_of(double x, Number& k) {
  const int exponent = x == 0 ? 0 : std::max(std::ilogb(x), 0);
  const mpfr_prec_t precision = 2 * exponent + 192;
  Number turns(precision), pi(precision);
  mpfr_const_pi(pi.get(), MPFR_RNDN);
  mpfr_set_d(turns.get(), x, MPFR_RNDN);
  mpfr_div(turns.get(), turns.get(), pi.get(), MPFR_RNDN);
  mpfr_set_prec(k.get(), precision);
  mpfr_rint_round(k.get(), turns.get(), MPFR_RNDN);
}

bool on_one_branch(const Interval& a) {
  if (!a.is_bounded()) return false;
  if (-1.5 < a.lo() && a.hi() < 1.5) return true;
  Number first(mpfr_prec_t{64}), last(mpfr_prec_t{64});
  branch_of(a.lo(), first);
  branch_of(a.hi(), last);
  return mpfr_equal_p(first.get(), last.get()) != 0;
}

}  // namespace

Interval tan(const Interval& a) {
  return exactly(
      [](const Interval& x) {
        if (x.is_empty()) return x;
        if (!on_one_branch(x)) return Interval::entire();
        return Interval::raw(rounded(mpfr_tan, x.lo(), MPFR_RNDD), rounded(mpfr_tan, x.hi(), MPFR_RNDU));
      },
      a);
}

Interval recip(const Interval& a) { return Interval::raw(1.0, 1.0) / a; }

// ---- fma.

namespace {

// An upper bound of a b + c for one corner, rounded once; the caller sees to an infinite c.
double corner(double a, double b, double c) {
  return a == 0 || b == 0 ? c : opaque(std::fma(opaque(a), opaque(b), opaque(c)));
}

double greatest_fma(const Interval& a, const Interval& b, double c) {
  if (c == kInfinity) return c;
  return std::max(std::max(corner(a.lo(), b.lo(), c), corner(a.lo(), b.hi(), c)),
                  std::max(corner(a.hi(), b.lo(), c), corner(a.hi(), b.hi(), c)));
}

}  // namespace

Interval intersection(const Interval& a, const Interval& b) {
  return upward([](const Interval& x, const Interval& y) { return meet(x, y); }, a, b);
}

Interval convex_hull(const Interval& a, const Interval& b) {
  return upward([](const Interval& x, const Interval& y) { return join(x, y); }, a, b);
}

Interval fma(const Interval& a, const Interval& b, const Interval& c) {
  return upward(
      [](const Interval& x, const Interval& y, const Interval& z) {
        if (x.is_empty() || y.is_empty() || z.is_empty()) return Interval::empty();
        return Interval::raw(-greatest_fma(-x, y, -z.lo()), greatest_fma(x, y, z.hi()));
      },
      a, b, c);
}

// ---- Powers and roots.

Interval pown(const Interval& a, int n) {
  return upward([n](const Interval& x) { return up::pown(x, n); }, a);
}

Interval rootn(const Interval& a, int n) {
  require(n != 0, "rootn: there is no root of order 0");
  return upward([n](const Interval& x) { return up::rootn(x, n); }, a);
}

namespace {

/// exp(y log x) at a corner, as the limit from within the box where x is 0 or infinite, or y infinite.
double power_at(double x, double y, mpfr_rnd_t direction) {
  if (y == 0 || x == 1) return 1.0;
  const bool limit = x == 0 || x == kInfinity || std::isinf(y);
  if (!limit) return rounded(mpfr_pow, x, y, direction);
  return (x > 1) == (y > 0) ? kInfinity : 0.0;
}

}  // namespace

// y log x is a product, so its extremes are at the corners of the box.
Interval pow(const Interval& a, const Interval& b) {
  return exactly(
      [](const Interval& whole, const Interval& y) {
        const Interval x = meet(whole, kPositive);
        if (x.is_empty() || y.is_empty()) return Interval::empty();
        if (x.hi() == 0) return y.hi() > 0 ? Interval::raw(0.0, 0.0) : Interval::empty();
        double lo = kInfinity, hi = 0.0;
        for (const double base : {x.lo(), x.hi()}) {
          for (const double exponent : {y.lo(), y.hi()}) {
            lo = std::min(lo, power_at(base, exponent, MPFR_RNDD));
            hi = std::max(hi, power_at(base, exponent, MPFR_RNDU));
          }
        }
        return Interval::raw(lo, hi);
      },
      a, b);
}

// ---- Cancellation.

namespace {

/// Whether a is at least as wide as b, exactly.
bool is_as_wide(const Interval& a, const Interval& b) {
  constexpr mpfr_prec_t kExact = 2200;  // any difference of doubles
  Number of_a(kExact), of_b(kExact);
  mpfr_set_d(of_a.get(), a.hi(), MPFR_RNDN);
  mpfr_sub_d(of_a.get(), of_a.get(), a.lo(), MPFR_RNDN);
  mpfr_set_d(of_b.get(), b.hi(), MPFR_RNDN);
  mpfr_sub_d(of_b.get(), of_b.get(), b.lo(), MPFR_RNDN);
  return mpfr_cmp(of_a.get(), of_b.get()) >= 0;
}

bool is_unbounded(const Interval& a) { return !a.is_empty() && !a.is_bounded(); }

}  // namespace

Interval cancel_minus(const Interval& a, const Interval& b) {
  return exactly(
      [](const Interval& x, const Interval& y) {
        if (is_unbounded(x) || is_unbounded(y)) return Interval::entire();
        if (x.is_empty()) return x;
        if (y.is_empty() || !is_as_wide(x, y)) return Interval::entire();
        RoundUpward upward;
        const Interval whole = opaque_bounds(x), part = opaque_bounds(y);
        return opaque_bounds(Interval::raw(up::sub_down(whole.lo(), part.lo()), whole.hi() - part.hi()));
      },
      a, b);
}

Interval cancel_plus(const Interval& a, const Interval& b) { return cancel_minus(a, -b); }

}  // namespace hcsp
