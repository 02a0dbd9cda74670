// SPDX-License-Identifier: Apache-2.0
// asin, acos, atan of points in double-double under round to nearest, for the reverse operations. No libm
// function but sqrt, which IEEE 754 specifies exactly, is relied upon.
#include "domains/interval/arcs.h"

#include <cmath>

#include "domains/interval/elementary_tables.h"

namespace hcsp {

namespace {

/// Below this, x^2 / 6 is less than the relative gap between doubles.
constexpr double kTiny = 0x1p-26;

/// a + c b, normalised, within 8 u^2 (|a| + |c b|).
DoubleDouble add_multiple(DoubleDouble a, double c, DoubleDouble b) {
  const DoubleDouble product = two_product(c, b.hi);
  const DoubleDouble sum = two_sum(a.hi, product.hi);
  return two_sum(sum.hi, sum.lo + (a.lo + (product.lo + c * b.lo)));
}

/// The angle of (x, y) for 0 <= y <= x, x > 0, within 2^-65 relative. The vector is turned by -atan c, c =
/// j/64 next to y/x: q = (y - c x) / (x + c y) and the angle is atan c + atan q, |q| < 2^-6.99. For c = 0, q
/// = y / x within 15 u^2 + 56 u^3; else its absolute error is below 40 u^2 while the angle is above 2^-7.1.
/// atan q - q is taken in double. In units of 2^-67 |q|: leaving q.lo out of it costs 1, its 5 roundings 1.7,
/// the sums after it 1.1, the truncation 0.02.
DoubleDouble angle_in_octant(DoubleDouble y, DoubleDouble x) {
  const auto j = static_cast<std::size_t>(y.hi / x.hi / kAtanSpacing + 0.5);
  const double c = static_cast<double>(j) * kAtanSpacing;
  const DoubleDouble q = j == 0 ? divide(y, x) : divide(add_multiple(y, -c, x), add_multiple(x, c, y));
  const double z = q.hi * q.hi;
  const double series = z * (-kInverse<3> + z * (kInverse<5> - z * (kInverse<7> - z * (kInverse<9>))));
  const DoubleDouble base = kArctangents[j];
  const DoubleDouble sum = fast_two_sum(base.hi, q.hi);  // |base| > |q|, or base is 0
  return fast_two_sum(sum.hi, sum.lo + (base.lo + (q.lo + q.hi * series)));
}

/// The angle of (x, y) in (0, pi), for y > 0 and x != 0.
DoubleDouble angle_in_upper_half(DoubleDouble y, DoubleDouble x) {
  const bool left = x.hi < 0;
  if (left) x = negate(x);
  if (y.hi <= x.hi) {
    const DoubleDouble acute = angle_in_octant(y, x);
    return left ? add(kPi, negate(acute)) : acute;
  }
  const DoubleDouble rest = angle_in_octant(x, y);
  return add(kHalfPi, left ? rest : negate(rest));
}

/// sqrt(1 - c^2) within 2^-101 relative: the factors of (1 - c) (1 + c) are exact.
DoubleDouble other_leg(double c) { return square_root(multiply(two_sum(1.0, -c), two_sum(1.0, c))); }

}  // namespace

DoubleDouble arcsine(double c) {
  if (c < 0) return negate(arcsine(-c));
  if (c <= kTiny) return {c, c * c * c / 6};
  return c == 1 ? kHalfPi : angle_in_upper_half({c, 0.0}, other_leg(c));
}

DoubleDouble arccosine(double c) {
  if (c == 1) return {0.0, 0.0};
  if (c == -1) return kPi;
  if (std::abs(c) <= kTiny) return add(kHalfPi, negate(arcsine(c)));
  return angle_in_upper_half(other_leg(c), {c, 0.0});
}

DoubleDouble arctangent(double c) {
  if (c < 0) return negate(arctangent(-c));
  if (c <= kTiny) return {c, -c * c * c / 3};
  if (c == kInfinity) return kHalfPi;
  if (c >= 1 / kTiny) return add(kHalfPi, {-1 / c, 0.0});
  return angle_in_upper_half({c, 0.0}, {1.0, 0.0});
}

}  // namespace hcsp
