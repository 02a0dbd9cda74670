// SPDX-License-Identifier: Apache-2.0
// sin and cos of both bounds at once (lanes.h).
#include "domains/interval/sin_cos.h"

#include "domains/interval/arcs.h"
#include "domains/interval/elementary_tables.h"
#include "domains/interval/kernel.h"
#include "domains/interval/lanes.h"

namespace hcsp::up {

namespace {

/// Below this, x^2 / 2 and x^2 / 6 are less than the relative gap between doubles.
constexpr double kTiny = 0x1p-26;

/// The tightest enclosures of sin(x + shift pi/2) of two x, and in which quarter turns [q pi/2, (q+1) pi/2),
/// modulo 4, the arguments x + shift pi/2 lie.
struct Waves {
  Bounds below, above;
  Words quadrant;
};

/// One lane of Waves.
struct Wave {
  Interval value;
  int quadrant;
};

Wave tiny_wave(double x, int shift) {
  const int quadrant = ((x >= 0 ? 0 : 3) + shift) & 3;
  if (shift == 1) return {Interval::raw(x == 0 ? 1.0 : next_down(1.0), 1.0), quadrant};
  if (x == 0) return {Interval::raw(0.0, 0.0), quadrant};
  return {x > 0 ? Interval::raw(next_down(x), x) : Interval::raw(x, next_up(x)), quadrant};
}

/// For huge x, and where the rounding test does not decide. The signs tell the quadrant, for neither the sine
/// nor the cosine of a double other than 0 is 0, and rounding keeps the sign of what is above 2^-1000: a
/// double up to 2^1024 is not nearer than 2^-62 to a multiple of pi/2 (Muller, Elementary Functions, 3rd ed.,
/// table 11.1).
Wave wave_by_mpfr(double x, int shift) {
  int quadrant = 0;
  const auto sine_or_cosine = [&](const Interval& point) {
    Number argument(point.lo()), sine(mpfr_prec_t{53}), cosine(mpfr_prec_t{53});
    mpfr_sin_cos(sine.get(), cosine.get(), argument.get(), MPFR_RNDD);
    const bool right = mpfr_sgn(cosine.get()) > 0, upper = mpfr_sgn(sine.get()) > 0;
    quadrant = upper ? (right ? 0 : 1) : (right ? 3 : 2);
    Number& value = shift == 0 ? sine : cosine;
    const double lo = mpfr_get_d(value.get(), MPFR_RNDN);
    mpfr_nextabove(value.get());
    return Interval::raw(lo, mpfr_get_d(value.get(), MPFR_RNDN));
  };
  const Interval value = exactly(sine_or_cosine, Interval::raw(x, x));
  return {value, (quadrant + shift) & 3};
}

[[gnu::noinline, gnu::cold]] void decide_lane(Waves& waves, int lane, double x, int shift) {
  const Wave wave = std::abs(x) <= kTiny ? tiny_wave(x, shift) : wave_by_mpfr(x, shift);
  waves.below[lane] = wave.value.lo();
  waves.above[lane] = wave.value.hi();
  waves.quadrant[lane] = wave.quadrant;
}

/// x - k pi/2 for the integer k nearest to x / (pi/2), |x| < 2^20 (Cody and Waite). The first three parts of
/// pi/2 have 33 bits, so that their products with k < 2^20 are exact, as is the first difference: both terms
/// are multiples of 2^-53 (when k > 0, x > 1/2) and it is below 1. In the sums that follow the first summand
/// is the greater, or both are multiples of 2^-66 (2^-101) below 2^-13 (2^-48) and the sum is exact. Absolute
/// error: 2^-99 |r| + 2^-129.
Pair reduce(const Bounds& x, const Bounds& k) {
  const Bounds first = x - k * 0x1.921fb544p+0;
  const Pair second = fast_two_sum(first, -(k * 0x1.0b4611a6p-34));
  const Pair third = fast_two_sum(second.hi, -(k * 0x1.3198a2ep-69));
  return fast_two_sum(third.hi, (second.lo + third.lo) - k * 0x1.b839a252049c1p-104);
}

/// sin r or, where odd is 1, cos r, with the signs of flips changed, for |r| in [2^-56, 0.7854], r > 0,
/// within 2^-68 relative. With c = j/512 next to r and d = r - c, |d| < 2^-9.99, f(r) = B + M d + B (cos d -
/// 1) + M (sin d - d) where (B, M) is (sin c, cos c) or (cos c, -sin c). The upper halves of M and d multiply
/// exactly, the rest of M d is below 2^-25 |M d|; corrections are taken in double. Their truncation is below
/// 2^-79. In units of 2^-73 B: leaving d.lo out of cos d - 1 costs 2, its roundings 3, the products and sums
/// after it 5; what the rest of M d and M (sin d - d) costs is below 2^-72 |M d|. |M d| < 0.51 B where B is
/// not 0, so B < 2.05 f(r): together 2^-68.6. Where B is 0 (the sine, j = 0), only the latter counts.
Pair sine_or_cosine(const Pair& r, const Words& odd, const Words& flips) {
  // A little less than 1/2, so that r > 2^-10 where j > 0 and r.hi - c is exact: 0, or at least
  // an ulp of r.hi, which is more than r.lo.
  const Bounds place = r.hi * (1 / kSineSpacing) + (0.5 - 0x1p-12);
  const int low = static_cast<int>(place[0]), high = static_cast<int>(place[1]);
  const Bounds c{static_cast<double>(low), static_cast<double>(high)};
  const Pair d = fast_two_sum(r.hi - c * kSineSpacing, r.lo);
  static constexpr const DoubleDouble* kTables[] = {kSines.data(), kCosines.data()};
  Pair base = gathered(kTables[odd[0]][low], kTables[odd[1]][high]);
  Pair slope = gathered(kTables[1 - odd[0]][low], kTables[1 - odd[1]][high]);
  base = {flipped(base.hi, flips), flipped(base.lo, flips)};
  const Words slope_flips = flips ^ (odd << 63);
  slope = {flipped(slope.hi, slope_flips), flipped(slope.lo, slope_flips)};

  const Bounds z = d.hi * d.hi;
  const Bounds cosine_minus_1 = z * (-0.5 + z * (kInverse<24> - z * (kInverse<720>)));
  const Bounds sine_minus_d = d.hi * (z * (-kInverse<6> + z * (kInverse<120> - z * (kInverse<5040>))));
  const Bounds slope_upper = upper_bits(slope.hi), d_upper = upper_bits(d.hi);
  const Bounds linear = slope_upper * d_upper;
  const Bounds linear_rest =
      slope_upper * (d.hi - d_upper) + ((slope.hi - slope_upper) + slope.lo) * d.hi + slope.hi * d.lo;
  const Bounds correction = base.hi * cosine_minus_1 + slope.hi * sine_minus_d;
  const Pair sum = fast_two_sum(base.hi, linear);  // |base| > |linear|, or base is 0
  return fast_two_sum(sum.hi, sum.lo + (base.lo + (linear_rest + correction)));
}

constexpr double kRelativeError = 0x1p-68;

Waves waves_of(const Bounds& x, int shift) {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  const Bounds size = magnitude(x);
  const Words usual = (size > kTiny) & (size < 0x1p20);
  const Bounds y = usual ? x : Bounds{1.0, 1.0};
  const Bounds shifted = (y * kTwoOverPi - 0.5) + kRounder;
  Pair r = reduce(y, shifted - kRounder);
  const Words negative = r.hi < 0;
  const Words quarter = words(shifted) + shift;
  const Words odd = quarter & 1;
  // The sine of a negative r is negative; so is either wave in the lower half turn.
  const Words flips = ((quarter << 62) ^ (negative & ~-odd)) & INT64_MIN;
  r = {flipped(r.hi, negative & INT64_MIN), flipped(r.lo, negative & INT64_MIN)};
  // Above 2^-56 the error 2^-129 of r is 2^-73 relative, and its sign is sure.
  const Words sound = usual & (r.hi >= 0x1p-56);
  const Neighbours ends(sine_or_cosine(r, odd, flips), kRelativeError);
  Waves waves{ends.below, ends.above, (quarter + negative) & 3};
  const Words sure = sound & ends.sure;
  if (!both(sure)) {
    for (int lane = 0; lane < 2; ++lane)
      if (sure[lane] == 0) decide_lane(waves, lane, x[lane], shift);
  }
  return waves;
}

/// The image of [lo, hi] under sin(x + shift pi/2): the values at the ends, and the extrema in between, which
/// are at the end of quadrant 0 (maximum) and of quadrant 2 (minimum).
Interval wave_image(const Interval& a, int shift) {
  const double width = a.hi() - a.lo();
  if (!(width <= 6.5)) return kUnit;  // a period is below 6.3
  if (width < 0) return Interval::empty();
  const Waves ends = waves_of(Bounds{a.lo(), a.hi()}, shift);
  auto quadrants = (ends.quadrant[1] - ends.quadrant[0]) & 3;
  // Modulo 4, one step or none (at most pi) looks like five or four (at least 3 pi / 2).
  quadrants += width > 4.0 && quadrants <= 1 ? 4 : 0;
  const std::int64_t to_maximum = -ends.quadrant[0] & 3, to_minimum = (2 - ends.quadrant[0]) & 3;
  const Bounds left{-ends.below[0], ends.above[0]}, right{-ends.below[1], ends.above[1]};
  const Words passed{to_minimum, to_maximum};
  const Bounds unit{1.0, 1.0}, image = greatest(left, right);
  return Interval::of_bounds(passed < quadrants ? unit : image);
}

}  // namespace

Interval sin(const Interval& a) { return wave_image(a, 0); }
Interval cos(const Interval& a) { return wave_image(a, 1); }

}  // namespace hcsp::up
