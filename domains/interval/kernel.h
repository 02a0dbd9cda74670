// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic for inner loops. PRECONDITION of everything in namespace up: the thread rounds upward
// (rounding.h: RoundUpward is alive). A lower bound is then the negated upper bound of the negated value, so
// that one rounding mode serves both and none is switched: -((-a) - b) rounds a + b down. This relies on
// -frounding-math, which the target hcsp_domains hands to whoever includes this.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "domains/interval/interval.h"

namespace hcsp::up {

inline double add_down(double a, double b) { return -((-a) - b); }
inline double sub_down(double a, double b) { return -(b - a); }
inline double mul_down(double a, double b) { return -((-a) * b); }
inline double div_down(double a, double b) { return -((-a) / b); }

/// The least double above x and the greatest below it, by stepping the bits: adding the least subnormal would
/// do the same in upward rounding, but costs a microcode assist.
inline double next_up(double x) {
  if (x == kInfinity) return x;
  const auto bits = std::bit_cast<std::int64_t>(x);
  if ((bits & INT64_MAX) == 0) return std::numeric_limits<double>::denorm_min();
  return std::bit_cast<double>(bits >= 0 ? bits + 1 : bits - 1);
}
inline double next_down(double x) { return -next_up(-x); }

/// sqrt rounded down, for x >= 0: the upward root, or the double below it where that was rounded. It was just
/// when its square, rounded upward, is above x.
inline double sqrt_down(double x) {
  const double root = std::sqrt(x);
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(root) -
                               static_cast<std::int64_t>(root * root != x));
}

/// What the kernels put in place of NaN: the bound of the empty set where empty met unbounded, and 0 for the
/// product 0 * oo, since oo is not a value that is taken (IEEE 1788-2015, 9.1; level 2 of the product).
inline Bounds empty_for_nan(const Bounds& sum) { return greatest(sum, Bounds{-kInfinity, -kInfinity}); }
inline Bounds zero_for_nan(const Bounds& product) { return product == product ? product : Bounds{}; }

/// Each with its sign bit cleared.
inline Bounds magnitude(const Bounds& x) {
  using Words [[gnu::vector_size(16)]] = std::int64_t;
  return std::bit_cast<Bounds>(std::bit_cast<Words>(x) & INT64_MAX);
}

inline double zero_for_nan(double product) { return product == product ? product : 0.0; }

/// For empty sets with the bounds of Interval::empty(), as every operation gives them.
inline bool is_any_empty(const Interval& a, const Interval& b) {
  return least(a.bounds(), b.bounds())[1] == -kInfinity;
}

inline Interval add(const Interval& a, const Interval& b) {
  return Interval::of_bounds(empty_for_nan(a.bounds() + b.bounds()));
}

inline Interval sub(const Interval& a, const Interval& b) {
  return Interval::of_bounds(empty_for_nan(a.bounds() + swapped(b.bounds())));
}

/// The greatest of the four products of bounds, and of their negations: no branch on signs.
inline Interval mul(const Interval& a, const Interval& b) {
  if (is_any_empty(a, b)) return Interval::empty();
  const Bounds by = a.bounds(), by_negated = -swapped(by);
  const Bounds low = Bounds{} - b.bounds()[0], high = Bounds{} + b.bounds()[1];
  return Interval::of_bounds(
      greatest(greatest(zero_for_nan(by * low), zero_for_nan(by * high)),
               greatest(zero_for_nan(by_negated * low), zero_for_nan(by_negated * high))));
}

/// a / b for b >= 0 or b <= 0, a bound of b possibly 0, not both: the divisor that gives a quotient's extreme
/// depends on the sign of the numerator's bound alone. No branch; neither is empty.
inline Bounds quotient(const Bounds& a, const Bounds& b) {
  const auto negative = __builtin_shufflevector(b, b, 1, 1) <= 0.0;
  const Bounds x = negative ? swapped(a) : a, y = negative ? swapped(b) : b;
  const Bounds near = 0.0 - __builtin_shufflevector(y, y, 0, 0);  // upward, so that a zero is +0
  const Bounds far = __builtin_shufflevector(y, y, 1, 1);
  return x / (x > 0.0 ? near : far);
}

inline Interval div_by_signed(const Interval& a, const Interval& b) {
  return a.is_empty() ? a : Interval::of_bounds(quotient(a.bounds(), b.bounds()));
}

inline Interval div(const Interval& a, const Interval& b) {
  const Bounds x = a.bounds(), y = b.bounds();
  if (is_any_empty(a, b) || both(y == 0.0)) return Interval::empty();
  if (both(x == 0.0)) return a;
  const auto positive = y > 0.0;  // both: 0 is inside b
  const auto is_around_zero = positive & __builtin_shufflevector(positive, positive, 1, 0);
  // By bits: of a choice the compiler makes a branch, which would be mispredicted.
  using Words [[gnu::vector_size(16)]] = std::int64_t;
  const Words entire = std::bit_cast<Words>(Interval::entire().bounds()),
              image = std::bit_cast<Words>(quotient(x, y));
  return Interval::of_bounds(std::bit_cast<Bounds>((is_around_zero & entire) | (~is_around_zero & image)));
}

/// (-mig, mag), of the empty set its bounds.
inline Bounds magnitudes(const Interval& a) {
  const Bounds x = a.bounds(), mag = greatest(x, swapped(x));
  const Bounds minus_mig = least(least(x, swapped(x)), Bounds{-0.0, -0.0});
  return __builtin_shufflevector(minus_mig, mag, 0, 3);
}

inline Interval abs(const Interval& a) { return Interval::of_bounds(magnitudes(a)); }

inline Interval sqr(const Interval& a) {
  const Bounds v = magnitudes(a);
  return Interval::of_bounds(v * magnitude(v));
}

/// factor a, for a finite factor that is not 0.
inline Interval scale(double factor, const Interval& a) {
  const Bounds x = factor < 0.0 ? swapped(a.bounds()) : a.bounds();
  return Interval::of_bounds(std::abs(factor) * x);
}

/// The root and the square of a non-empty interval of bounds >= 0.
inline Bounds root(const Bounds& x) { return Bounds{-sqrt_down(-x[0]), std::sqrt(x[1])}; }
inline Bounds square_of_positive(const Bounds& x) { return x * Bounds{-x[0], x[1]}; }

inline Interval sqrt(const Interval& a) {
  if (a.is_empty() || a.hi() < 0) return Interval::empty();
  return Interval::of_bounds(root(least(a.bounds(), Bounds{0.0, kInfinity})));
}

inline Interval max(const Interval& a, const Interval& b) {
  const Bounds x = a.bounds(), y = b.bounds(), lo = least(x, y), hi = greatest(x, y);
  return Interval::of_bounds(lo[1] == -kInfinity ? lo : __builtin_shufflevector(lo, hi, 0, 3));
}

inline Interval min(const Interval& a, const Interval& b) { return -up::max(-a, -b); }

// Reverse operations (IEEE 1788-2015, 9.1 and 10.5.4): the part of x for which the operation can give a value
// in c.

/// {x in X : there is b in B with x * b in c}: exact up to rounding, the two parts of a division by an
/// interval around zero are both met with X before they are joined.
inline Interval mul_rev(const Interval& b, const Interval& c, const Interval& x) {
  if (b.is_empty() || c.is_empty() || x.is_empty()) return Interval::empty();
  if (b.contains(0) && c.contains(0)) return x;
  if (b.lo() >= 0 || b.hi() <= 0) return meet(up::div(c, b), x);
  const Interval negative = meet(div_by_signed(c, Interval::raw(b.lo(), 0.0)), x);
  const Interval positive = meet(div_by_signed(c, Interval::raw(0.0, b.hi())), x);
  return join(negative, positive);
}

/// {x in X : |x| in c}.
inline Interval abs_rev(const Interval& c, const Interval& x) {
  const Interval right = meet(c, Interval::raw(0.0, kInfinity));
  if (right.is_empty()) return right;
  return join(meet(right, x), meet(-right, x));
}

/// {x in X : x^2 in c}.
inline Interval sqr_rev(const Interval& c, const Interval& x) { return up::abs_rev(up::sqrt(c), x); }

/// {x in X : sqrt(x) in c}.
inline Interval sqrt_rev(const Interval& c, const Interval& x) {
  const Interval root = meet(c, Interval::raw(0.0, kInfinity));
  return root.is_empty() ? root : meet(up::sqr(root), x);
}

/// {x in X : there is b in B with min(x, b) in c}; max is its mirror image.
inline Interval min_rev(const Interval& b, const Interval& c, const Interval& x) {
  if (b.is_empty() || c.is_empty() || x.is_empty()) return Interval::empty();
  if (b.hi() < c.lo()) return Interval::empty();
  // Where b alone can give a value in c, x is only bounded below.
  const double hi = b.lo() <= c.hi() ? kInfinity : c.hi();
  return meet(x, Interval::raw(c.lo(), hi));
}

inline Interval max_rev(const Interval& b, const Interval& c, const Interval& x) {
  return -min_rev(-b, -c, -x);
}

}  // namespace hcsp::up
