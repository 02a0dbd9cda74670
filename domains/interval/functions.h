// SPDX-License-Identifier: Apache-2.0
// Forward operations of IEEE 1788-2015, 9.1, beyond those of interval.h: tightest enclosures of the image of
// the arguments' part in the domain of definition, the empty set where that is empty. Sound in any rounding
// mode of the caller.
#pragma once

#include "domains/interval/interval.h"

namespace hcsp {

Interval recip(const Interval& a);
/// a b + c, rounded once.
Interval fma(const Interval& a, const Interval& b, const Interval& c);
/// Intersection and convex hull (IEEE 1788-2015, 9.3): meet and join of interval.h, which compare as the
/// thread does, for callers that have subnormal numbers flushed.
Interval intersection(const Interval& a, const Interval& b);
Interval convex_hull(const Interval& a, const Interval& b);
/// a^n; a^0 is 1 everywhere.
Interval pown(const Interval& a, int n);
/// a^b = exp(b log a) for a > 0, and 0 for a == 0 and b > 0.
Interval pow(const Interval& a, const Interval& b);
/// The real n-th root, of a negative number for odd n only; a^(1/n) for negative n. Throws
/// std::invalid_argument for n == 0.
Interval rootn(const Interval& a, int n);

Interval exp(const Interval& a);
Interval exp2(const Interval& a);
Interval exp10(const Interval& a);
Interval expm1(const Interval& a);
Interval log(const Interval& a);
Interval log2(const Interval& a);
Interval log10(const Interval& a);
Interval log1p(const Interval& a);
Interval tan(const Interval& a);
Interval asin(const Interval& a);
Interval acos(const Interval& a);
Interval atan(const Interval& a);
Interval sinh(const Interval& a);
Interval cosh(const Interval& a);
Interval tanh(const Interval& a);
Interval asinh(const Interval& a);
Interval acosh(const Interval& a);
Interval atanh(const Interval& a);

// Step functions; the image is a set of integers, and this its hull.
Interval sign(const Interval& a);
Interval ceil(const Interval& a);
Interval floor(const Interval& a);
Interval trunc(const Interval& a);
Interval round_ties_to_even(const Interval& a);
Interval round_ties_to_away(const Interval& a);

/// The tightest z with b + z containing a (IEEE 1788-2015, 9.2): exists where a is at least as wide as b and
/// both are bounded; the whole line otherwise.
Interval cancel_minus(const Interval& a, const Interval& b);
/// cancel_minus(a, -b).
Interval cancel_plus(const Interval& a, const Interval& b);

}  // namespace hcsp
