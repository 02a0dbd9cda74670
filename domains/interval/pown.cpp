// SPDX-License-Identifier: Apache-2.0
// Integer powers of both bounds at once (lanes.h), and roots.
#include "domains/interval/pown.h"

#include <cmath>
#include <optional>

#include "domains/interval/cube.h"
#include "domains/interval/kernel.h"
#include "domains/interval/lanes.h"

namespace hcsp::up {

namespace {

const Interval kPositive = Interval::raw(0.0, kInfinity);

/// x^n rounded, for n != 0 and x >= 0 where n is even; 0 to a negative power is +oo.
double power(double x, int n, mpfr_rnd_t direction) {
  if (x == 0 && n < 0) return kInfinity;
  Number base(x), result(mpfr_prec_t{53});
  mpfr_pow_si(result.get(), base.get(), n, direction);
  return mpfr_get_d(result.get(), direction);
}

/// The real |n|-th root of x, its reciprocal for n < 0.
double root_of(double x, int n, mpfr_rnd_t direction) {
  if (x == 0 && n < 0) return kInfinity;
  Number argument(x), result(mpfr_prec_t{53});
  mpfr_rootn_si(result.get(), argument.get(), n, direction);
  return mpfr_get_d(result.get(), direction);
}

/// The image of x -> f(x, n), a power or a root, on a part of x >= 0 where f is monotone.
using Monomial = double (*)(double, int, mpfr_rnd_t);

Interval on_positive(Monomial f, const Interval& a, int n) {
  if (a.is_empty() || (n < 0 && a.hi() == 0)) return Interval::empty();
  const bool falls = n < 0;
  return Interval::raw(f(falls ? a.hi() : a.lo(), n, MPFR_RNDD), f(falls ? a.lo() : a.hi(), n, MPFR_RNDU));
}

/// An odd function on both sides of 0.
Interval odd(Monomial f, const Interval& a, int n) {
  return join(on_positive(f, meet(a, kPositive), n), -on_positive(f, meet(-a, kPositive), n));
}

Interval power_by_mpfr(const Interval& a, int n) {
  const auto image = [n](const Interval& x) {
    return n % 2 == 0 ? on_positive(power, up::abs(x), n) : odd(power, x, n);
  };
  return exactly(image, a);
}

constexpr int kMostFactors = 8;

/// Lane by lane x^n, and -x^n where sign tells so, by n - 1 products: the upper halves of the factors
/// multiply exactly, so that a product errs by 2^-103 at most, relative to it.
Pair power_of(const Bounds& x, int n, const Words& sign) {
  const Bounds x_upper = upper_bits(x), x_rest = x - x_upper;
  Pair power{flipped(x, sign), Bounds{}};
  for (int i = 1; i < n; ++i) {
    const Bounds upper = upper_bits(power.hi), rest = power.hi - upper, product = power.hi * x;
    const Bounds error = ((upper * x_upper - product) + upper * x_rest + rest * x_upper) + rest * x_rest;
    power = {product, error + power.lo * x};
  }
  return power;
}

/// Where x has but 53 / (n - 1) bits: all products but the last are exact, and that one is rounded once. Any
/// number with an n-th power that is a double is so short.
Words is_short(const Bounds& x, int n) {
  const std::int64_t rest = (std::int64_t{1} << (53 - 53 / (n - 1))) - 1;
  return (words(x) & rest) == 0;
}

/// Where neither the power nor its error overflows or underflows; 0 and infinities are their own powers.
Words is_moderate(const Bounds& x, int n) {
  const double most = std::bit_cast<double>(std::int64_t{1023 + 900 / n} << 52);
  const Bounds size = magnitude(x);
  return ((size >= 1 / most) & (size <= most)) | (size == 0.0) | (size == kInfinity);
}

/// [r, s] with r^n < x < s^n for neighbouring doubles, or the root itself where it is a double: found from a
/// guess and proven by the powers; none where that is too close to tell, or where a power might overflow. For
/// 2 <= n <= kMostFactors.
std::optional<Interval> around_root(double x, int n) {
  constexpr double kLeast = 0x1p-900, kMost = 0x1p900, kError = 0x1p-88;
  constexpr int kMostSteps = 4;
  if (!(x >= kLeast && x <= kMost)) return {};
  double root = std::pow(x, 1.0 / n);
  for (int step = 0; step < kMostSteps; ++step) {
    const Bounds candidates{root, next_up(root)};
    const Pair power = power_of(candidates, n, Words{});
    const Bounds above = (power.hi - x) + power.lo;
    const auto is_exact = (above == 0.0) & is_short(candidates, n);
    if (is_exact[0] != 0) return Interval::raw(root, root);
    if (!both((magnitude(above) > x * kError) | is_exact)) return {};
    if (above[0] < 0 && above[1] > 0) return Interval::raw(root, next_up(root));
    root = above[0] > 0 ? next_down(root) : next_up(root);
  }
  return {};
}

/// The root of x rounded upward, or -x rounded downward, as a bound (-lo, hi) wants it.
std::optional<double> root_above(double x, int n) {
  if (x == 0 || x == kInfinity || x == -kInfinity) return x;
  const auto root = around_root(std::abs(x), n);
  if (!root) return {};
  return x > 0 ? root->hi() : -root->lo();
}

}  // namespace

Interval cube(const Interval& a) {
  const Bounds image = cube_or_nan<Words>(a.bounds());
  if (both(image == image)) return Interval::of_bounds(image);
  return a.is_empty() ? a : power_by_mpfr(a, 3);
}

// Of an odd power both bounds (-lo, hi) are powers of bounds (-lo, hi), rounded upward; of an even one they
// are minus a power of the least and a power of the greatest magnitude.
Interval pown(const Interval& a, int n) {
  if (n == 3) return cube(a);
  if (a.is_empty() || n == 1) return a;
  if (n == 0) return Interval::raw(1.0, 1.0);
  if (n == 2) return up::sqr(a);
  if (n < 0 || n > kMostFactors) return power_by_mpfr(a, n);
  const bool even = n % 2 == 0;
  const Interval size = up::abs(a);
  const Bounds x = even ? Bounds{size.lo(), size.hi()} : a.bounds();
  const Pair power = power_of(x, n, even ? Words{INT64_MIN, 0} : Words{});
  const Words is_rounded_once = is_short(x, n);
  const Neighbours ends(fast_two_sum(power.hi, power.lo), 0x1p-90);
  if (!both(is_moderate(x, n) & (is_rounded_once | ends.sure))) return power_by_mpfr(a, n);
  return Interval::of_bounds(is_rounded_once ? power.hi : ends.above);
}

Interval rootn(const Interval& a, int n) {
  if (n == 1) return a;
  const Interval domain = n % 2 == 0 ? meet(a, kPositive) : a;
  if (2 <= n && n <= kMostFactors && !domain.is_empty()) {
    const auto lower = root_above(domain.bounds()[0], n), upper = root_above(domain.bounds()[1], n);
    if (lower && upper) return Interval::of_bounds(Bounds{*lower, *upper});
  }
  const auto image = [n](const Interval& x) {
    return n % 2 == 0 ? on_positive(root_of, meet(x, kPositive), n) : odd(root_of, x, n);
  };
  return exactly(image, a);
}

}  // namespace hcsp::up
