// SPDX-License-Identifier: Apache-2.0
// Kernels in a rounding mode of their own, whatever the caller has set: comparisons count, too, where
// denormals are flushed. Operands enter and results leave opaquely, so that no operation can be scheduled
// outside the guard's lifetime. For source files only.
#pragma once

#include "domains/interval/interval.h"
#include "domains/interval/mpfr_scope.h"
#include "domains/rounding.h"

namespace hcsp {

inline Interval opaque_bounds(const Interval& a) { return Interval::raw(opaque(a.lo()), opaque(a.hi())); }

template <class Kernel, class... Operands>
Interval upward(Kernel kernel, const Operands&... operands) {
  RoundUpward guard;
  return opaque_bounds(kernel(opaque_bounds(operands)...));
}

/// Under round to nearest, for MPFR: out of the way of the common case.
template <class Kernel, class... Operands>
[[gnu::noinline, gnu::cold]] Interval exactly(Kernel kernel, const Operands&... operands) {
  RoundNearest guard;
  MpfrScope scope;
  return opaque_bounds(kernel(opaque_bounds(operands)...));
}

}  // namespace hcsp
