// SPDX-License-Identifier: Apache-2.0
// The tightest enclosures of exp and log for inner loops. PRECONDITION: the thread rounds upward (kernel.h).
#pragma once

#include "domains/interval/interval.h"

namespace hcsp::up {

Interval exp(const Interval& a);
Interval log(const Interval& a);

}  // namespace hcsp::up
