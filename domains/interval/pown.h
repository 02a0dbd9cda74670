// SPDX-License-Identifier: Apache-2.0
// The tightest enclosures of integer powers and roots for inner loops. PRECONDITION: the thread rounds upward
// (kernel.h).
#pragma once

#include "domains/interval/interval.h"

namespace hcsp::up {

Interval pown(const Interval& a, int n);
/// pown(a, 3), the odd power that models have most.
Interval cube(const Interval& a);
/// n is not 0.
Interval rootn(const Interval& a, int n);

}  // namespace hcsp::up
