// SPDX-License-Identifier: Apache-2.0
// What the forward and the reverse elementary functions share. For source files only.
#pragma once

#include "domains/interval/double_double.h"
#include "domains/interval/interval.h"

namespace hcsp {

inline constexpr DoubleDouble kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
inline constexpr DoubleDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
inline constexpr Interval kPiBounds = Interval::raw(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1);
inline constexpr Interval kHalfPiBounds = Interval::raw(0x1.921fb54442d18p+0, 0x1.921fb54442d19p+0);
inline constexpr Interval kUnit = Interval::raw(-1.0, 1.0);

/// asin c and acos c for |c| <= 1, and atan c for any c or infinity, within 2^-64 relative. PRECONDITION:
/// round to nearest.
DoubleDouble arcsine(double c);
DoubleDouble arccosine(double c);
DoubleDouble arctangent(double c);

}  // namespace hcsp
