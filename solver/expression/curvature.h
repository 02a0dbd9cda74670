// SPDX-License-Identifier: Apache-2.0
// Where functions of one operand are convex or concave.
#pragma once

#include "solver/expression/dag.h"

namespace hcsp {

/// 1 where y = op(a) is convex on all of [a], -1 where it is concave, 0 where neither is told. `n` is the
/// exponent of powers and roots. The operator is defined on all of [a].
int curvature(Op op, const Interval& a, const Interval& n, const Interval& y);

}  // namespace hcsp
