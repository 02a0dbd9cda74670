// SPDX-License-Identifier: Apache-2.0
// What "for every t" says of functions on phases, as relations between reals: neither more nor less.
#pragma once

#include "solver/phases/phase_function.h"

namespace hcsp {

/// a(t) == b(t) at every instant: coefficient by coefficient. Of continuous functions the values at the start
/// of a later phase follow from those before, and are not stated again.
std::vector<Expr> equal_for_all_time(const PhaseFunction& a, const PhaseFunction& b);

/// a(t) <= b(t), or a(t) < b(t), at every instant: at the ends of the phases, and at maxima of a - b between
/// them. None where the difference has a degree above 3.
std::optional<std::vector<Expr>> less_for_all_time(const std::vector<Expr>& durations, const PhaseFunction& a,
                                                   const PhaseFunction& b, bool strict);

/// x' == f during every phase, and x continuous.
std::vector<Expr> derivative_for_all_time(const PhaseFunction& x, const PhaseFunction& f);

}  // namespace hcsp
