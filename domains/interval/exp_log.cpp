// SPDX-License-Identifier: Apache-2.0
// exp and log of both bounds at once (lanes.h).
#include "domains/interval/exp_log.h"

#include "domains/interval/exp_log_tables.h"
#include "domains/interval/kernel.h"
#include "domains/interval/lanes.h"
#include "domains/interval/point_functions.h"

namespace hcsp::up {

namespace {

Interval by_mpfr(Function f, const Interval& a) {
  return exactly(
      [f](const Interval& x) {
        return Interval::raw(rounded(f, x.lo(), MPFR_RNDD), rounded(f, x.hi(), MPFR_RNDU));
      },
      a);
}

}  // namespace

// x = k log(2)/512 + r, exp x = 2^(k/512) exp r. k log(2)/512 is subtracted in two parts, the first exactly,
// the second within 2^-76; |r| < 2^-10.5. Of exp r - 1 = r + r^2/2 + ..., all but r.hi is taken in double:
// its terms are below 2^-22, so their roundings, three of 2^-74, come to 2^-72.4, and the truncation is below
// 2^-72.4.
Interval exp(const Interval& a) {
  const Bounds x{a.lo(), a.hi()};
  const Bounds size = magnitude(x);
  if (!both((size > 0x1p-54) & (size < 708.0))) {
    if (a.is_empty()) return a;
    return by_mpfr(mpfr_exp, a);
  }
  constexpr double kPerUnit = 0x1.71547652b82fep+9;                              // 512 / log 2
  constexpr double kStep = 0x1.62e42ffp-10, kStepRest = -0x1.718432a1b0e26p-44;  // log(2) / 512
  const Bounds shifted = (x * kPerUnit - 0.5) + kRounder;
  const Bounds k = shifted - kRounder;
  const Pair r = two_sum(x - k * kStep, k * -kStepRest);
  const Bounds z = r.hi;
  const Bounds series = z * (kInverse<24> + z * (kInverse<120>));
  const Bounds rest = r.lo + z * r.lo + z * z * (0.5 + z * (kInverse<6> + series));
  const Pair p = fast_two_sum(z, rest);
  const Words number = words(shifted);  // k in its low 51 bits
  const Pair power = gathered(kPowersOfTwo[static_cast<std::size_t>(number[0] & 511)],
                              kPowersOfTwo[static_cast<std::size_t>(number[1] & 511)]);
  const Bounds power_upper = upper_bits(power.hi), p_upper = upper_bits(p.hi);
  const Pair sum = fast_two_sum(power.hi, power_upper * p_upper);
  const Bounds product_rest = power_upper * (p.hi - p_upper) + (power.hi - power_upper) * p.hi;
  const Bounds small = product_rest + (power.hi * p.lo + (power.lo + power.lo * p.hi));
  const OutwardEnds ends(sum.hi, sum.lo + small, 0x1p-70);
  if (!both(ends.sure)) return by_mpfr(mpfr_exp, a);
  return Interval::of_bounds(std::bit_cast<Bounds>(words(ends.bounds) + ((number & ~511) << 43)));
}

// x = 2^e m, m next to 1 / r for an r of 21 bits, z = m r - 1 exactly, |z| < 2^-9.4: log x = e log 2 - log r
// + log(1 + z). z^2 is exact but for 2^-78 of it; the terms from z^3/3 on are taken in double. For m next to
// 1 r is 1 and e is 0; elsewhere the result is at least 2^-10.1, and everywhere at least 0.998 |z|. Where
// that is no more than 2^-10, z^3/3 is below 2^-21.5 of it, and the dozen roundings on its scale come to
// 2^-69.9; the truncation is below 2^-72. Every first summand is 0 or the greater, but for z's, where that is
// below 2^-25: then both are multiples of 2^-72 and the sum is exact.
Interval log(const Interval& a) {
  const bool from_zero = a.lo() <= 0;
  const Bounds x{from_zero ? 2.0 : a.lo(), a.hi()};
  if (!both((x >= 0x1p-1022) & (x < kInfinity) & (x != 1.0))) {
    if (a.is_empty() || a.hi() <= 0) return Interval::empty();
    return by_mpfr(mpfr_log, Interval::raw(std::max(a.lo(), 0.0), a.hi()));
  }
  constexpr std::int64_t kRootOfHalf = 0x3fe6a09e667f3bcd, kBias = 1023;
  constexpr double kLog2 = 0x1.62e42fefa4p-1, kLog2Rest = -0x1.8432a1b0e2634p-43;
  using Unsigned [[gnu::vector_size(16)]] = std::uint64_t;  // whose right shift is one instruction
  const Unsigned shifted = std::bit_cast<Unsigned>(words(x) + ((kBias << 52) - kRootOfHalf)) >> 52;
  const Words exponent = std::bit_cast<Words>(shifted) - kBias;
  const Bounds m = std::bit_cast<Bounds>(words(x) - (exponent << 52));
  const Bounds place = m * 512.0 + 0.5;
  const auto entry = [&](int lane) -> const Reciprocal& {
    return kReciprocals[static_cast<std::size_t>(static_cast<int>(place[lane]) - kFirstReciprocal)];
  };
  const Reciprocal &low = entry(0), &high = entry(1);
  const Bounds r{low.r, high.r};
  const Bounds e = std::bit_cast<Bounds>(exponent + words(Bounds{} + kRounder)) - kRounder;
  const Bounds m_high = upper_bits(m);
  const Pair z = fast_two_sum(m_high * r - 1.0, (m - m_high) * r);
  const Bounds z_high = upper_bits(z.hi), half_square = 0.5 * z_high * z_high;
  const Bounds square_rest = (z.hi - z_high) * (z.hi + z_high) + 2.0 * z.hi * z.lo;
  const Bounds t = z.hi;
  const Bounds square = t * t;
  const Bounds tail = kInverse<5> - t * (kInverse<6> - t * kInverse<7>);
  const Bounds series = t * square * (kInverse<3> - t * 0.25 + square * tail);
  const Pair first = fast_two_sum(e * kLog2, Bounds{low.log.hi, high.log.hi});
  const Pair second = fast_two_sum(first.hi, z.hi), third = fast_two_sum(second.hi, -half_square);
  const Bounds table_rest = e * kLog2Rest + Bounds{low.log.lo, high.log.lo};
  const Bounds small = table_rest + (z.lo + (series - 0.5 * square_rest));
  const OutwardEnds ends(third.hi, first.lo + second.lo + third.lo + small, 0x1p-69);
  if (!both(ends.sure)) return by_mpfr(mpfr_log, Interval::raw(std::max(a.lo(), 0.0), a.hi()));
  return Interval::of_bounds(from_zero ? Bounds{kInfinity, ends.bounds[1]} : ends.bounds);
}

}  // namespace hcsp::up
