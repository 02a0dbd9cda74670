// SPDX-License-Identifier: Apache-2.0
// Reverse operations (IEEE 1788-2015, 10.5.4): the part of x for which an operation can give a value in c, as
// its hull. Enclosures, at most one ulp wider a side than the tightest. Sound in any rounding mode of the
// caller, and inclusion-isotone.
#pragma once

#include <array>

#include "domains/interval/interval.h"

namespace hcsp {

Interval sqr_rev(const Interval& c, const Interval& x = {});
Interval abs_rev(const Interval& c, const Interval& x = {});
Interval pown_rev(const Interval& c, const Interval& x, int n);
Interval sin_rev(const Interval& c, const Interval& x = {});
Interval cos_rev(const Interval& c, const Interval& x = {});
Interval tan_rev(const Interval& c, const Interval& x = {});
Interval cosh_rev(const Interval& c, const Interval& x = {});
/// The part of x with x b in c for some b of B.
Interval mul_rev(const Interval& b, const Interval& c, const Interval& x = {});
/// The two parts of c / b on either side of 0, the second empty unless b holds 0 in its inside: {x : x b in c
/// for some b of B}, ordered (IEEE 1788-2015, 10.5.5).
std::array<Interval, 2> mul_rev_to_pair(const Interval& b, const Interval& c);
/// The part of x with x^b in c for some b of B.
Interval pow_rev1(const Interval& b, const Interval& c, const Interval& x = {});
/// The part of x with a^x in c for some a of A.
Interval pow_rev2(const Interval& a, const Interval& c, const Interval& x = {});
/// The part of y with atan2(y, x) in c for some x, and of x for some y.
Interval atan2_rev1(const Interval& x, const Interval& c, const Interval& y = {});
Interval atan2_rev2(const Interval& y, const Interval& c, const Interval& x = {});
/// Contracts both to the part for which atan2(y, x) can lie in angle; returns false when none is left.
bool atan2_rev(const Interval& angle, Interval& y, Interval& x);

}  // namespace hcsp
