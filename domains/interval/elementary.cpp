// SPDX-License-Identifier: Apache-2.0
// sin, cos, atan2 (and asin, acos of points). A bound is computed in double-double under round to nearest
// with a proven relative error below 2^-64; where that decides which two neighbouring doubles enclose the
// value (about 2047 times in 2048) they are the tightest bounds, elsewhere MPFR decides. Tightest point
// enclosures are monotone, which makes every function here inclusion-isotone. No libm function but sqrt,
// which IEEE 754 specifies exactly, is relied upon.
#include "domains/interval/elementary_point.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "domains/interval/double_double.h"
#include "domains/interval/elementary_tables.h"
#include "domains/interval/kernel.h"
#include "domains/interval/mpfr_scope.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

/// Below this, x^2 / 2 and x^2 / 6 are less than the relative gap between doubles.
constexpr double kTiny = 0x1p-26;
/// Bounds the relative error of every double-double result below; the proofs stand where they are computed.
constexpr double kRelativeError = 0x1p-64;

/// The neighbours of a finite x != 0, away from and towards zero.
double away_from_zero(double x) { return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + 1); }
double towards_zero(double x) { return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) - 1); }
double above(double x) { return x > 0 ? away_from_zero(x) : towards_zero(x); }
double below(double x) { return x > 0 ? towards_zero(x) : away_from_zero(x); }

/// Rounding test: the doubles around a value v, no double itself, that lies within kRelativeError of value.
/// Empty when value is too near to a double to tell on which side of it v lies.
Interval neighbours(DoubleDouble value) {
  const double error = kRelativeError * std::abs(value.hi);
  if (value.lo > error) return Interval::raw(value.hi, above(value.hi));
  if (value.lo < -error) return Interval::raw(below(value.hi), value.hi);
  return Interval::empty();
}

/// The doubles around a value of which number is the 53-bit value rounded down, `inexact` saying whether it
/// was rounded. Rounding in one direction twice is rounding once, so that subnormal results are right too.
Interval doubles_around(Number& number, bool inexact) {
  const double lo = mpfr_get_d(number.get(), MPFR_RNDD);
  if (inexact) mpfr_nextabove(number.get());
  return Interval::raw(lo, mpfr_get_d(number.get(), MPFR_RNDU));
}

/// The tightest enclosure of sin(x + shift pi/2), and in which quarter turn [q pi/2, (q+1) pi/2) modulo 4 the
/// argument x + shift pi/2 lies.
struct Wave {
  Interval value;
  int quadrant;
};

Wave tiny_wave(double x, int shift) {
  const int quadrant = ((x >= 0 ? 0 : 3) + shift) & 3;
  if (shift == 1) return {Interval::raw(x == 0 ? 1.0 : towards_zero(1.0), 1.0), quadrant};
  if (x == 0) return {Interval::raw(0.0, 0.0), quadrant};
  return {x > 0 ? Interval::raw(towards_zero(x), x) : Interval::raw(x, towards_zero(x)), quadrant};
}

/// For huge x, and where the rounding test does not decide. The signs tell the quadrant, for neither the sine
/// nor the cosine of a double other than 0 is 0, and rounding keeps the sign of what is above 2^-1000: a
/// double up to 2^1024 is not nearer than 2^-62 to a multiple of pi/2 (Muller, Elementary Functions, 3rd ed.,
/// table 11.1).
[[gnu::noinline]] Wave wave_by_mpfr(double x, int shift) {
  MpfrScope scope;
  Number argument(x), sine(mpfr_prec_t{53}), cosine(mpfr_prec_t{53});
  mpfr_sin_cos(sine.get(), cosine.get(), argument.get(), MPFR_RNDD);
  const bool right = mpfr_sgn(cosine.get()) > 0, upper = mpfr_sgn(sine.get()) > 0;
  const int quadrant = upper ? (right ? 0 : 1) : (right ? 3 : 2);
  return {doubles_around(shift == 0 ? sine : cosine, true), (quadrant + shift) & 3};
}

/// sin r or cos r for r in [2^-56, 0.7854], within 2^-65 relative. With c = j/128 next to r and d = r - c
/// exactly, |d| < 2^-7.99, f(r) = B + M d + B (cos d - 1) + M (sin d - d) where (B, M) is (sin c, cos c) or
/// (cos c, -sin c). M d is taken in double-double, the corrections in double. Their truncation is below
/// 2^-80. In units of 2^-70 B: leaving d.lo out of cos d - 1 costs 2, its 3 roundings 3.1, the products and
/// sums after it 5; what M (sin d - d) costs, 2.5 units of 2^-70 |M d|, is 1.3 more, since |M d| < 0.51 B
/// where B is not 0; and B < 2.02 f(r). Where B is 0 (the sine, j = 0), it is the last alone.
DoubleDouble sine_or_cosine(DoubleDouble r, bool cosine) {
  // A little less than 1/2, so that r > 2^-8 where j > 0: both terms of d are then multiples of 2^-60 and d
  // is exact.
  const auto j = static_cast<std::size_t>(r.hi / kSineSpacing + (0.5 - 0x1p-12));
  const DoubleDouble d = two_sum(r.hi - static_cast<double>(j) * kSineSpacing, r.lo);
  const DoubleDouble base = cosine ? kCosines[j] : kSines[j];
  const DoubleDouble slope = cosine ? negate(kSines[j]) : kCosines[j];
  const double z = d.hi * d.hi;
  const double cosine_minus_1 = z * (-0.5 + z * (1.0 / 24 - z * (1.0 / 720)));
  const double sine_minus_d = d.hi * (z * (-1.0 / 6 + z * (1.0 / 120 - z * (1.0 / 5040))));
  const DoubleDouble linear = two_product(slope.hi, d.hi);
  const double linear_lo = linear.lo + (slope.hi * d.lo + slope.lo * d.hi);
  const double correction = base.hi * cosine_minus_1 + slope.hi * sine_minus_d;
  const DoubleDouble sum = fast_two_sum(base.hi, linear.hi);  // |base| > |linear|, or base is 0
  return fast_two_sum(sum.hi, sum.lo + (base.lo + (linear_lo + correction)));
}

/// x - k pi/2 for the integer k nearest to x / (pi/2), |x| < 2^20 (Cody and Waite). The first three parts of
/// pi/2 have 33 bits, so that their products with k < 2^20 are exact, as is the first difference: both terms
/// are multiples of 2^-53 (when k > 0, x > 1/2) and it is below 1. Absolute error: 2^-103 |r| + 2^-130.
DoubleDouble reduce(double x, double k) {
  const double first = x - k * 0x1.921fb544p+0;
  const DoubleDouble second = two_sum(first, -(k * 0x1.0b4611a6p-34));
  const DoubleDouble third = two_sum(second.hi, -(k * 0x1.3198a2ep-69));
  return fast_two_sum(third.hi, (second.lo + third.lo) - k * 0x1.b839a252049c1p-104);
}

Wave wave(double x, int shift) {
  if (std::abs(x) <= kTiny) return tiny_wave(x, shift);
  if (std::abs(x) >= 0x1p20) return wave_by_mpfr(x, shift);
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  const auto k = static_cast<int>(x * kTwoOverPi + (x > 0 ? 0.5 : -0.5));
  const DoubleDouble r = reduce(x, k);
  // Above 2^-56 the error 2^-130 is 2^-74 relative, and the sign of r is sure.
  if (!(std::abs(r.hi) >= 0x1p-56)) return wave_by_mpfr(x, shift);
  const bool negative = r.hi < 0;
  const int quarter = (k + shift) & 3;
  const bool cosine = (quarter & 1) != 0;
  const bool flip = (quarter >= 2) != (negative && !cosine);
  DoubleDouble value = sine_or_cosine(negative ? negate(r) : r, cosine);
  if (flip) value = negate(value);
  const Interval around = neighbours(value);
  if (around.is_empty()) return wave_by_mpfr(x, shift);
  return {around, (quarter - (negative ? 1 : 0)) & 3};
}

/// The image of [lo, hi] under sin(x + shift pi/2): the values at the ends, and the extrema in between, which
/// are at the end of quadrant 0 (maximum) and of quadrant 2 (minimum).
Interval wave_image(const Interval& a, int shift) {
  RoundNearest guard;
  if (a.is_empty()) return a;
  if (!a.is_bounded()) return kUnit;
  const double lo = opaque(a.lo()), hi = opaque(a.hi());
  const double width = hi - lo;
  if (width > 6.5) return kUnit;  // a period is below 6.3
  const Wave left = wave(lo, shift);
  if (lo == hi) return opaque_bounds(left.value);
  const Wave right = wave(hi, shift);
  int quadrants = (right.quadrant - left.quadrant) & 3;
  // Modulo 4, one step or none (at most pi) looks like five or four (at least 3 pi / 2).
  if (width > 4.0 && quadrants <= 1) quadrants += 4;
  const bool maximum = ((0 - left.quadrant) & 3) < quadrants;
  const bool minimum = ((2 - left.quadrant) & 3) < quadrants;
  return opaque_bounds(Interval::raw(minimum ? -1.0 : std::min(left.value.lo(), right.value.lo()),
                                     maximum ? 1.0 : std::max(left.value.hi(), right.value.hi())));
}

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
  const double series = z * (-1.0 / 3 + z * (1.0 / 5 - z * (1.0 / 7 - z * (1.0 / 9))));
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

/// Where products and quotients of two numbers, and their errors, can neither overflow nor underflow.
bool is_moderate(double x) { return 0x1p-300 <= x && x <= 0x1p300; }

[[gnu::noinline]] Interval angle_by_mpfr(double y, double x) {
  MpfrScope scope;
  Number result(mpfr_prec_t{53}), ordinate(y), abscissa(x);
  const int ternary = mpfr_atan2(result.get(), ordinate.get(), abscissa.get(), MPFR_RNDD);
  return doubles_around(result, ternary != 0);
}

/// atan2(y, x) for y >= 0; not for (0, 0). An infinite argument stands for the limit.
Interval angle(double y, double x) {
  if (x == kInfinity || (y == 0 && x > 0)) return Interval::raw(0.0, 0.0);
  if (x == -kInfinity || y == 0) return kPiBounds;
  if (y == kInfinity || x == 0) return kHalfPiBounds;
  if (is_moderate(y) && is_moderate(std::abs(x))) {
    const Interval around = neighbours(angle_in_upper_half({y, 0.0}, {x, 0.0}));
    if (!around.is_empty()) return around;
  }
  return angle_by_mpfr(y, x);
}

/// The least and the greatest angle over a box in the upper half plane, y.lo >= 0; the box is not the origin
/// alone. The angle falls with x, and it rises with y where x > 0 and falls with y where x < 0.
double least_angle(const Interval& y, const Interval& x) {
  if (x.hi() == 0) return y.hi() == 0 ? kPiBounds.lo() : kHalfPiBounds.lo();
  return angle(x.hi() > 0 ? y.lo() : y.hi(), x.hi()).lo();
}

double greatest_angle(const Interval& y, const Interval& x) {
  if (x.lo() == 0) return y.hi() == 0 ? 0.0 : kHalfPiBounds.hi();
  return angle(x.lo() > 0 ? y.hi() : y.lo(), x.lo()).hi();
}

Interval angles(const Interval& y, const Interval& x) {
  if (y.lo() >= 0 && y.is_point() && x.is_point()) return angle(y.lo(), x.lo());
  if (y.lo() >= 0) return Interval::raw(least_angle(y, x), greatest_angle(y, x));
  if (y.hi() < 0 || (y.hi() == 0 && x.lo() >= 0)) return -angles(-y, x);
  if (x.lo() < 0) return Interval::raw(-kPiBounds.hi(), kPiBounds.hi());  // the cut: angles jump by 2 pi
  return Interval::raw(-greatest_angle(Interval::raw(0.0, -y.lo()), x),
                       greatest_angle(Interval::raw(0.0, y.hi()), x));
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

Interval pi() { return kPiBounds; }
Interval sin(const Interval& a) { return wave_image(a, 0); }
Interval cos(const Interval& a) { return wave_image(a, 1); }

Interval atan2(const Interval& y, const Interval& x) {
  RoundNearest guard;
  const Interval ordinate = opaque_bounds(y), abscissa = opaque_bounds(x);
  if (ordinate.is_empty() || abscissa.is_empty()) return Interval::empty();
  const bool origin = ordinate.lo() == 0 && ordinate.hi() == 0 && abscissa.lo() == 0 && abscissa.hi() == 0;
  return origin ? Interval::empty() : opaque_bounds(angles(ordinate, abscissa));
}

}  // namespace hcsp
