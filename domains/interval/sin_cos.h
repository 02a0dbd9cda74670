// SPDX-License-Identifier: Apache-2.0
// The tightest enclosures of sin and cos for inner loops. PRECONDITION: the thread rounds upward (kernel.h).
#pragma once

#include "domains/interval/interval.h"

namespace hcsp::up {

Interval sin(const Interval& a);
Interval cos(const Interval& a);

}  // namespace hcsp::up
