// SPDX-License-Identifier: Apache-2.0
#include "domains/interval/numeric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "domains/check.h"
#include "domains/interval/mpfr_scope.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<double>::max();

// Strictly below, or both without bound.
bool is_inside(double below, double above) { return below < above || (std::isinf(below) && below == above); }

/// Keeps what was found within the guard, as opaque() keeps what is looked at.
double settled(double x) { return opaque(x); }
bool settled(bool x) {
  asm volatile("" : "+r"(x) : : "memory");
  return x;
}

Overlap settled(Overlap x) {
  asm volatile("" : "+r"(x) : : "memory");
  return x;
}

/// Runs under round to nearest with gradual underflow: where the caller takes subnormal numbers for 0, even a
/// comparison would be wrong.
template <class Body, class... Operands>
auto guarded(Body body, const Operands&... operands) {
  RoundNearest guard;
  return settled(body(Interval::raw(opaque(operands.lo()), opaque(operands.hi()))...));
}

}  // namespace

double inf(const Interval& a) {
  return guarded([](const Interval& x) { return x.lo() == 0 ? -0.0 : x.lo(); }, a);
}
double sup(const Interval& a) {
  return guarded([](const Interval& x) { return x.hi() == 0 ? 0.0 : x.hi(); }, a);
}

double mid(const Interval& a) {
  if (a.is_empty()) return kNaN;
  if (a.is_entire()) return 0.0;
  if (a.lo() == -kInfinity) return -kLargest;
  if (a.hi() == kInfinity) return kLargest;
  return a.mid();
}

double wid(const Interval& a) { return a.is_empty() ? kNaN : a.width(); }

double rad(const Interval& a) {
  if (a.is_empty()) return kNaN;
  const double m = mid(a);
  RoundUpward guard;
  const double middle = opaque(m), lo = opaque(a.lo()), hi = opaque(a.hi());
  return opaque(std::max(opaque(middle - lo), opaque(hi - middle)));
}

double mag(const Interval& a) {
  return guarded([](const Interval& x) { return x.is_empty() ? kNaN : x.mag(); }, a);
}

double mig(const Interval& a) {
  return guarded(
      [](const Interval& x) {
        if (x.is_empty()) return kNaN;
        return x.lo() > 0 ? x.lo() : (x.hi() < 0 ? -x.hi() : 0.0);
      },
      a);
}

bool equal(const Interval& a, const Interval& b) {
  return guarded([](const Interval& x, const Interval& y) { return x == y; }, a, b);
}

bool subset(const Interval& a, const Interval& b) {
  return guarded([](const Interval& x, const Interval& y) { return leq(x, y); }, a, b);
}

bool interior(const Interval& a, const Interval& b) {
  return guarded(
      [](const Interval& x, const Interval& y) {
        return x.is_empty() || (is_inside(y.lo(), x.lo()) && is_inside(x.hi(), y.hi()));
      },
      a, b);
}

bool less(const Interval& a, const Interval& b) {
  return guarded(
      [](const Interval& x, const Interval& y) {
        if (x.is_empty() || y.is_empty()) return x.is_empty() && y.is_empty();
        return x.lo() <= y.lo() && x.hi() <= y.hi();
      },
      a, b);
}

bool strict_less(const Interval& a, const Interval& b) {
  return guarded(
      [](const Interval& x, const Interval& y) {
        if (x.is_empty() || y.is_empty()) return x.is_empty() && y.is_empty();
        return is_inside(x.lo(), y.lo()) && is_inside(x.hi(), y.hi());
      },
      a, b);
}

bool precedes(const Interval& a, const Interval& b) {
  return guarded(
      [](const Interval& x, const Interval& y) { return x.is_empty() || y.is_empty() || x.hi() <= y.lo(); },
      a, b);
}

bool strict_precedes(const Interval& a, const Interval& b) {
  return guarded(
      [](const Interval& x, const Interval& y) { return x.is_empty() || y.is_empty() || x.hi() < y.lo(); }, a,
      b);
}

bool disjoint(const Interval& a, const Interval& b) {
  return guarded([](const Interval& x, const Interval& y) { return meet(x, y).is_empty(); }, a, b);
}

bool is_member(double x, const Interval& a) {
  if (!std::isfinite(x)) return false;
  return guarded([](const Interval& point, const Interval& y) { return y.contains(point.lo()); },
                 Interval::raw(x, x), a);
}

bool is_common(const Interval& a) { return !a.is_empty() && a.is_bounded(); }

namespace {

/// Of two that are not empty.
Overlap position(const Interval& a, const Interval& b) {
  if (a.hi() < b.lo()) return Overlap::before;
  if (b.hi() < a.lo()) return Overlap::after;
  if (a == b) return Overlap::equals;
  if (a.lo() == b.lo()) return a.hi() < b.hi() ? Overlap::starts : Overlap::started_by;
  if (a.hi() == b.hi()) return a.lo() > b.lo() ? Overlap::finishes : Overlap::finished_by;
  if (a.hi() == b.lo()) return Overlap::meets;
  if (b.hi() == a.lo()) return Overlap::met_by;
  if (a.lo() < b.lo()) return a.hi() < b.hi() ? Overlap::overlaps : Overlap::contains;
  return a.hi() < b.hi() ? Overlap::contained_by : Overlap::overlapped_by;
}

}  // namespace

Overlap overlap(const Interval& a, const Interval& b) {
  if (a.is_empty()) return b.is_empty() ? Overlap::both_empty : Overlap::first_empty;
  if (b.is_empty()) return Overlap::second_empty;
  return guarded(position, a, b);
}

// ---- Reductions: exactly, in a number of MPFR that holds any sum of products of doubles, then rounded.

namespace {

// Products reach from 2^-2148 to 2^2048; 64 bits more for the count.
constexpr mpfr_prec_t kExact = 2148 + 2048 + 64;

template <class Term>
double sum_of(std::size_t count, Term term) {
  RoundNearest guard;
  MpfrScope scope;
  Number sum(kExact), x(mpfr_prec_t{128});
  mpfr_set_zero(sum.get(), 1);
  for (std::size_t i = 0; i < count; ++i) {
    term(i, x.get());
    mpfr_add(sum.get(), sum.get(), x.get(), MPFR_RNDN);
  }
  return mpfr_get_d(sum.get(), MPFR_RNDN);
}

}  // namespace

double sum_nearest(std::span<const double> x) {
  return sum_of(x.size(), [&](std::size_t i, mpfr_ptr term) { mpfr_set_d(term, x[i], MPFR_RNDN); });
}

double sum_abs_nearest(std::span<const double> x) {
  return sum_of(x.size(), [&](std::size_t i, mpfr_ptr term) { mpfr_set_d(term, std::abs(x[i]), MPFR_RNDN); });
}

double sum_sqr_nearest(std::span<const double> x) { return dot_nearest(x, x); }

double dot_nearest(std::span<const double> x, std::span<const double> y) {
  require(x.size() == y.size(), "dot_nearest: {} and {} numbers", x.size(), y.size());
  return sum_of(x.size(), [&](std::size_t i, mpfr_ptr term) {
    mpfr_set_d(term, x[i], MPFR_RNDN);
    mpfr_mul_d(term, term, y[i], MPFR_RNDN);
  });
}

}  // namespace hcsp
