// SPDX-License-Identifier: Apache-2.0
// What functions of both bounds at once share: values in double-double on two lanes, under upward rounding.
// The error-free transforms then err by at most 2^-100 of their result (Boldo, Graillat, Muller, ACM TOMS
// 44(1), 2017), far below the errors that the functions claim, and no rounding mode need be switched. A lane
// that the rounding test does not decide, or whose argument is out of the common range, goes to MPFR. For
// source files only. PRECONDITION of everything here: the thread rounds upward (kernel.h).
#pragma once

#include <bit>
#include <cstdint>

#include "domains/interval/double_double.h"
#include "domains/interval/guarded.h"
#include "domains/interval/kernel.h"

namespace hcsp::up {

using Pair = Doubled<Bounds>;
using Words [[gnu::vector_size(16)]] = std::int64_t;

inline Words words(const Bounds& x) { return std::bit_cast<Words>(x); }
/// The sign bits of x.
inline Words sign_of(const Bounds& x) { return words(x) & INT64_MIN; }
/// x with the signs of flips changed.
inline Bounds flipped(const Bounds& x, const Words& flips) { return std::bit_cast<Bounds>(words(x) ^ flips); }

/// x truncated to 26 bits: a product of two such is exact. The rest, x minus this, has 27 bits.
inline Bounds upper_bits(const Bounds& x) { return std::bit_cast<Bounds>(words(x) & ~0x7ffffffLL); }

/// Two entries of tables.
inline Pair gathered(const DoubleDouble& low, const DoubleDouble& high) {
  return {Bounds{low.hi, high.hi}, Bounds{low.lo, high.lo}};
}

/// What is added to and subtracted from a number below 2^51 rounds it up to an integer, and leaves this in
/// the sum's low bits.
inline constexpr double kRounder = 0x1.8p52;

/// The doubles on either side of values that are within `relative_error` of hi + lo, where they are sure. As
/// the thread rounds upward, lo is in (-ulp, 0] and they are hi and the one below it. PRECONDITION: hi is
/// normal and not 0 in the lanes that matter.
struct Neighbours {
  Neighbours(const Pair& value, double relative_error)
      : below(std::bit_cast<Bounds>(words(value.hi) + ((value.hi > 0) | 1))), above(value.hi) {
    const Bounds error = relative_error * magnitude(value.hi);
    sure = (-value.lo > error) & (value.hi - below + value.lo > error);
  }
  Bounds below, above;
  Words sure;
};

/// The bounds (-lo, hi) of an interval whose ends are within `relative_error` of main + rest, where they are
/// sure: either end rounds to one double whatever the error is. The error must leave room for an ulp of rest.
/// PRECONDITION: main is normal and not 0 in the lanes that matter, and rest is far below it.
struct OutwardEnds {
  OutwardEnds(const Bounds& main, const Bounds& rest, double relative_error) {
    constexpr Words kLowerEnd{INT64_MIN, 0};
    const Bounds error = relative_error * magnitude(main);
    const Bounds m = flipped(main, kLowerEnd), r = flipped(rest, kLowerEnd);
    bounds = m + (r + error);
    sure = bounds == m + (r - error);
  }
  Bounds bounds;
  Words sure;
};

}  // namespace hcsp::up
