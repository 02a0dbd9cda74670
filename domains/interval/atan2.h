// SPDX-License-Identifier: Apache-2.0
// The tightest enclosures of atan2 and atan for inner loops. PRECONDITION: the thread rounds upward
// (kernel.h).
#pragma once

#include "domains/interval/interval.h"

namespace hcsp::up {

Interval atan2(const Interval& y, const Interval& x);
Interval atan(const Interval& a);

}  // namespace hcsp::up
