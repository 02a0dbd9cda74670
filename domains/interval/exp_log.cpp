// SPDX-License-Identifier: Apache-2.0
// exp and log of both bounds at once, in double-double on two lanes, under upward rounding: the error-free
// transforms then err by at most 2^-100 of their result (Boldo, Graillat, Muller, ACM TOMS 44(1), 2017), far
// below the bounds claimed here, and no rounding mode need be switched. A bound whose double-double value is
// too near to a double for them is decided by MPFR: about one in two thousand.
#include "domains/interval/exp_log.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "domains/interval/elementary_point.h"
#include "domains/interval/exp_log_tables.h"
#include "domains/interval/kernel.h"
#include "domains/interval/point_functions.h"

namespace hcsp::up {

namespace {

using Pair = Doubled<Bounds>;
using Words [[gnu::vector_size(16)]] = std::int64_t;

Words words(const Bounds& x) { return std::bit_cast<Words>(x); }

constexpr double kRelativeError = 0x1p-64;

/// The doubles on either side of values that are within kRelativeError of hi + lo; as the thread rounds
/// upward, lo is in (-ulp, 0] and they are hi and the one below it. PRECONDITION: hi is normal and not 0.
struct Neighbours {
  explicit Neighbours(const Pair& value)
      : below(words(value.hi) + ((value.hi > 0) | 1)), above(words(value.hi)) {
    const Bounds error = kRelativeError * (value.hi < 0 ? -value.hi : value.hi);
    const Bounds gap = value.hi - std::bit_cast<Bounds>(below);
    is_sure = both((-value.lo > error) & (gap + value.lo > error));
  }
  Words below, above;
  bool is_sure;
};

Interval by_mpfr(Function f, const Interval& a) {
  RoundNearest guard;
  MpfrScope scope;
  return opaque_bounds(
      Interval::raw(rounded(f, opaque(a.lo()), MPFR_RNDD), rounded(f, opaque(a.hi()), MPFR_RNDU)));
}

/// From the double below the first to the double above the second.
Interval outer(const Neighbours& ends, const Words& scale) {
  return Interval::raw(std::bit_cast<Bounds>(ends.below + scale)[0],
                       std::bit_cast<Bounds>(ends.above + scale)[1]);
}

}  // namespace

// x = k log(2)/128 + r, exp x = 2^(k/128) exp r. k log(2)/128 is subtracted in two parts, the first exactly,
// the second within 2^-76; |r| < 2^-7.5. Of exp r - 1 = r + r^2/2 + ..., all but r.hi is taken in double: its
// terms are below 2^-15.9, so their roundings, three of 2^-68, come to 2^-66.4, and the truncation is below
// 2^-75.
Interval exp(const Interval& a) {
  const Bounds x{a.lo(), a.hi()};
  const Bounds size = x < 0 ? -x : x;
  if (!both((size > 0x1p-54) & (size < 708.0))) {
    if (a.is_empty()) return a;
    return by_mpfr(mpfr_exp, a);
  }
  constexpr double kPerUnit = 0x1.71547652b82fep+7;                             // 128 / log 2
  constexpr double kStep = 0x1.62e42ffp-8, kStepRest = -0x1.718432a1b0e26p-42;  // log(2) / 128
  constexpr double kRounder = 0x1.8p52;  // what is added to it becomes an integer, in its low bits
  const Bounds shifted = (x * kPerUnit - 0.5) + kRounder;
  const Bounds k = shifted - kRounder;
  const Pair r = two_sum(x - k * kStep, k * -kStepRest);
  const Bounds z = r.hi;
  const Bounds series = z * (1.0 / 24 + z * (1.0 / 120 + z * (1.0 / 720 + z * (1.0 / 5040))));
  const Bounds rest = r.lo + z * r.lo + z * z * (0.5 + z * (1.0 / 6 + series));
  const Pair p = fast_two_sum(z, rest);
  const Words number = words(shifted) << 32 >> 32;
  const DoubleDouble &low = kPowersOfTwo[static_cast<std::size_t>(number[0] & 127)],
                     &high = kPowersOfTwo[static_cast<std::size_t>(number[1] & 127)];
  const Bounds table{low.hi, high.hi}, table_rest{low.lo, high.lo};
  const Pair product = two_product(table, p.hi);
  const Pair sum = fast_two_sum(table, product.hi);
  const Bounds small = product.lo + (table * p.lo + (table_rest + table_rest * p.hi));
  const Neighbours ends(fast_two_sum(sum.hi, sum.lo + small));
  return ends.is_sure ? outer(ends, number >> 7 << 52) : by_mpfr(mpfr_exp, a);
}

// x = 2^e m, m next to 1 / r for an r of 20 bits, z = m r - 1 exactly, |z| < 2^-7.9: log x = e log 2 - log r
// + log(1 + z). z^2 is exact but for 2^-78 of it, the terms from z^3/3 on, below 2^-17.4 |z|, are taken in
// double, the truncation is below 2^-74 |z|. For m next to 1 r is 1 and e is 0, so that the result is z (1 +
// ...); elsewhere it is at least 2^-8.5.
Interval log(const Interval& a) {
  const bool from_zero = a.lo() <= 0;
  const Bounds x{from_zero ? 2.0 : a.lo(), a.hi()};
  if (!both((x >= 0x1p-1022) & (x < kInfinity) & (x != 1.0))) {
    if (a.is_empty() || a.hi() <= 0) return Interval::empty();
    return by_mpfr(mpfr_log, Interval::raw(std::max(a.lo(), 0.0), a.hi()));
  }
  constexpr std::int64_t kRootOfHalf = 0x3fe6a09e667f3bcd;
  constexpr double kLog2 = 0x1.62e42fefa4p-1, kLog2Rest = -0x1.8432a1b0e2634p-43;
  const Words exponent = (words(x) - kRootOfHalf) >> 52;
  const Bounds m = std::bit_cast<Bounds>(words(x) - (exponent << 52));
  const auto entry = [&](int lane) -> const Reciprocal& {
    return kReciprocals[static_cast<std::size_t>(static_cast<int>(m[lane] * 128 + 0.5) - kFirstReciprocal)];
  };
  const Reciprocal &low = entry(0), &high = entry(1);
  const Bounds r{low.r, high.r}, e{static_cast<double>(exponent[0]), static_cast<double>(exponent[1])};
  const auto upper_bits = [](const Bounds& b) {  // 26 of them: their square is exact
    return std::bit_cast<Bounds>(words(b) & ~0x7ffffffLL);
  };
  const Bounds m_high = upper_bits(m);
  const Pair z = two_sum(m_high * r - 1.0, (m - m_high) * r);
  const Bounds z_high = upper_bits(z.hi), half_square = 0.5 * z_high * z_high;
  const Bounds square_rest = (z.hi - z_high) * (z.hi + z_high) + 2.0 * z.hi * z.lo;
  const Bounds t = z.hi;
  const Bounds tail = 1.0 / 5 - t * (1.0 / 6 - t * (1.0 / 7 - t * (1.0 / 8 - t * (1.0 / 9))));
  const Bounds series = t * t * t * (1.0 / 3 - t * (0.25 - t * tail));
  const Pair first = two_sum(e * kLog2, Bounds{low.log.hi, high.log.hi});
  const Pair second = two_sum(first.hi, z.hi), third = two_sum(second.hi, -half_square);
  const Bounds table_rest = e * kLog2Rest + Bounds{low.log.lo, high.log.lo};
  const Bounds small = table_rest + (z.lo + (series - 0.5 * square_rest));
  const Neighbours ends(fast_two_sum(third.hi, first.lo + second.lo + third.lo + small));
  if (!ends.is_sure) return by_mpfr(mpfr_log, Interval::raw(std::max(a.lo(), 0.0), a.hi()));
  const Interval image = outer(ends, Words{});
  return from_zero ? Interval::raw(-kInfinity, image.hi()) : image;
}

}  // namespace hcsp::up
