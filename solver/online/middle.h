// SPDX-License-Identifier: Apache-2.0
// A number in the middle of an interval, or somewhere in one that is not bounded.
#pragma once

#include <algorithm>

#include "domains/interval/interval.h"

namespace hcsp::online {

/// PRECONDITION: not empty.
inline double middle(const Interval& x) {
  if (!x.is_bounded()) return x.lo() > -kInfinity ? x.lo() : x.hi() < kInfinity ? x.hi() : 0.0;
  return std::min(std::max(0.5 * x.lo() + 0.5 * x.hi(), x.lo()), x.hi());
}

}  // namespace hcsp::online
