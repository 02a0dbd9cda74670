// SPDX-License-Identifier: Apache-2.0
// Relations whose terms may be undefined.
#pragma once

#include "solver/expression/operators.h"

namespace hcsp::online {

/// The truth of a relation on a box, given what its operator's forward tells: it is false where a term is
/// undefined.
inline Interval truth(const Interval& forward, const Interval& a, const Interval& b, bool are_defined) {
  if (up::is_any_empty(a, b)) return kFalse;
  return are_defined ? forward : join(forward, kFalse);
}

}  // namespace hcsp::online
