// SPDX-License-Identifier: Apache-2.0
// atan2 and atan of both bounds at once (lanes.h).
#include "domains/interval/atan2.h"

#include "domains/interval/arcs.h"
#include "domains/interval/elementary_tables.h"
#include "domains/interval/lanes.h"

namespace hcsp::up {

namespace {

/// The doubles around atan2(y, x). An infinite argument stands for the limit.
Interval angle_by_mpfr(const Interval& y, const Interval& x) {
  Number result(mpfr_prec_t{53}), ordinate(y.lo()), abscissa(x.lo());
  const int ternary = mpfr_atan2(result.get(), ordinate.get(), abscissa.get(), MPFR_RNDD);
  const double lo = mpfr_get_d(result.get(), MPFR_RNDD);
  if (ternary != 0) mpfr_nextabove(result.get());
  return Interval::raw(lo, mpfr_get_d(result.get(), MPFR_RNDU));
}

/// Not for (0, 0); y is not infinite where x is.
[[gnu::noinline]] Interval decided_angle(double y, double x) {
  if (y < 0) return -decided_angle(-y, x);
  if (x == kInfinity || (y == 0 && x > 0)) return Interval::raw(0.0, 0.0);
  if (x == -kInfinity || y == 0) return kPiBounds;
  if (y == kInfinity || x == 0) return kHalfPiBounds;
  return exactly(angle_by_mpfr, Interval::raw(y, y), Interval::raw(x, x));
}

/// a - c b for 0 <= a, b and c = j kAtanSpacing, within 2^-99 relative to the greater of result and 2^-53 a:
/// c has 8 bits at most, b is taken in parts of 26 and 27 bits, and products are exact.
Pair minus_multiple(const Bounds& a, const Bounds& c, const Bounds& b) {
  const Bounds upper = upper_bits(b);
  const Pair first = two_sum(a, -(c * upper));
  const Pair second = two_sum(first.hi, -(c * (b - upper)));
  return fast_two_sum(second.hi, first.lo + second.lo);
}

/// n / d within 2^-74 relative. The remainder n - q d of the approximate quotient q is exact but for
/// roundings of 2^-77 n, since the first difference, of n and a product of 26 by 26 bits, is exact.
Pair quotient_of(const Pair& n, const Pair& d) {
  const Bounds inverse = 1.0 / d.hi, q = n.hi * inverse;
  const Bounds q_upper = upper_bits(q), d_upper = upper_bits(d.hi);
  const Bounds q_rest = q - q_upper, d_rest = d.hi - d_upper;
  const Bounds remainder =
      (((n.hi - q_upper * d_upper) - q_upper * d_rest) - q_rest * d_upper) - q_rest * d_rest;
  return fast_two_sum(q, (remainder + (n.lo - q * d.lo)) * inverse);
}

/// atan(b / a) for 0 < b <= a, as an unevaluated sum of three: within 2^-68 relative. The vector is turned by
/// -atan c, c = j/256 next to b/a: q = (b - c a) / (a + c b) and the angle is atan c + atan q, |q| < 2^-8.99.
/// atan q - q is taken in double, below 2^-19.5 |q|: its roundings, five of 2^-71.5 |q|, come to 2^-69.1 |q|,
/// leaving q.lo out of it to 2^-69.9 |q|, the truncation to 2^-75 |q|. Where c is not 0 the angle is above
/// |q|.
struct Octant {
  Pair base, turned;
};

Octant angle_in_octant(const Bounds& b, const Bounds& a) {
  const Bounds place = b / a * (1 / kAtanSpacing) + 0.5;
  const int low = static_cast<int>(place[0]), high = static_cast<int>(place[1]);
  const Bounds c = kAtanSpacing * Bounds{static_cast<double>(low), static_cast<double>(high)};
  const Pair q = quotient_of(minus_multiple(b, c, a), minus_multiple(a, -c, b));
  const Bounds z = q.hi * q.hi;
  const Bounds series = q.hi * (z * (-kInverse<3> + z * (kInverse<5> - z * (kInverse<7>))));
  return {gathered(kArctangents[static_cast<std::size_t>(low)], kArctangents[static_cast<std::size_t>(high)]),
          Pair{q.hi, q.lo + series}};
}

constexpr double kRelativeError = 0x1p-67;

/// Where products and quotients of two numbers, and their errors, can neither overflow nor underflow.
Words is_moderate(const Bounds& size) { return (size >= 0x1p-300) & (size <= 0x1p300); }

/// The tightest interval (-lo, hi) between the angles of two vectors (x, y). That is n pi/2 +- that of (max,
/// min) of |x| and |y|, with the sign of y: n is 0 or, left of 0, 2; above the diagonals 1.
Bounds angles_of(const Bounds& y, const Bounds& x) {
  const Bounds height = magnitude(y), breadth = magnitude(x);
  const Words usual = is_moderate(height) & is_moderate(breadth);
  const Bounds one{1.0, 1.0};
  const Bounds a = usual ? height : one, b = usual ? breadth : one;
  const Words steep = a > b, left = x < 0;
  const Octant octant = angle_in_octant(steep ? b : a, steep ? a : b);
  const Words turn = (steep & 1) | (left & ~steep & 2);
  const Words sign = sign_of(y), falls = ((steep ^ left) & INT64_MIN) ^ sign;
  const Bounds quarter_turns =
      flipped(Bounds{static_cast<double>(turn[0]), static_cast<double>(turn[1])}, sign);
  const Pair first = two_sum(quarter_turns * kHalfPi.hi, flipped(octant.base.hi, falls));
  const Pair second = two_sum(first.hi, flipped(octant.turned.hi, falls));
  const Bounds small = quarter_turns * kHalfPi.lo + flipped(octant.base.lo + octant.turned.lo, falls);
  const OutwardEnds ends(second.hi, first.lo + second.lo + small, kRelativeError);
  const Words sure = usual & ends.sure;
  if (both(sure)) return ends.bounds;
  Bounds bounds = ends.bounds;
  if (sure[0] == 0) bounds[0] = -decided_angle(y[0], x[0]).lo();
  if (sure[1] == 0) bounds[1] = decided_angle(y[1], x[1]).hi();
  return bounds;
}

/// The angles of the vectors (x, 0).
Interval angles_on_axis(const Interval& x) {
  if (x.lo() == 0 && x.hi() == 0) return Interval::empty();
  return Interval::raw(x.hi() > 0 ? 0.0 : kPiBounds.lo(), x.lo() < 0 ? kPiBounds.hi() : 0.0);
}

}  // namespace

// Over a box that the cut (x < 0, y = 0) does not cross, the angle rises with y where x > 0 and falls with y
// where x < 0, falls with x where y > 0 and rises with x where y < 0: its extremes are at corners. Where the
// deciding bound of x is 0, so is not the bound of y that is taken.
Interval atan2(const Interval& y, const Interval& x) {
  if (y.is_empty() || x.is_empty()) return Interval::empty();
  if (y.lo() == 0 && y.hi() == 0) return angles_on_axis(x);
  const bool above = y.lo() >= 0, below = y.hi() < 0 || (y.hi() == 0 && x.lo() >= 0);
  if (!above && !below && x.lo() < 0) return Interval::raw(-kPiBounds.hi(), kPiBounds.hi());
  const double y_near_right = below ? y.hi() : y.lo(), y_far_right = below ? y.lo() : y.hi();
  const double right_y = x.hi() > 0 ? y_near_right : y_far_right;
  const Bounds least_y_x = above ? Bounds{right_y, x.hi()} : Bounds{x.lo() < 0 ? y.hi() : y.lo(), x.lo()};
  const Bounds greatest_y_x = below ? Bounds{right_y, x.hi()} : Bounds{x.lo() < 0 ? y.lo() : y.hi(), x.lo()};
  return Interval::of_bounds(angles_of(__builtin_shufflevector(least_y_x, greatest_y_x, 0, 2),
                                       __builtin_shufflevector(least_y_x, greatest_y_x, 1, 3)));
}

Interval atan(const Interval& a) {
  if (a.is_empty()) return a;
  return Interval::of_bounds(angles_of(Bounds{a.lo(), a.hi()}, Bounds{1.0, 1.0}));
}

}  // namespace hcsp::up
