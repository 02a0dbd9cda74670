// SPDX-License-Identifier: Apache-2.0
// Unknowns that are given, but for next to no play: data. Searches do not cut them, and proofs solve for them
// last.
#pragma once

#include <algorithm>
#include <cmath>

#include "domains/interval/interval.h"

namespace hcsp::online {

/// Near 0 next to none is 1e-12.
inline bool is_thin(const Interval& x) {
  constexpr double kThin = 1e-9, kSmall = 1e-3;
  return x.is_bounded() && x.hi() - x.lo() <= kThin * std::max({std::abs(x.lo()), std::abs(x.hi()), kSmall});
}

}  // namespace hcsp::online
