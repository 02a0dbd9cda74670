// SPDX-License-Identifier: Apache-2.0
// Small conflicting sets: QuickXplain (Junker, AAAI 2004) over whatever can be left out of a problem.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace hcsp {

/// What remains to be asked of a problem: is it infeasible with only these parts kept? Must be monotone: more
/// parts kept never make an infeasible problem feasible.
using InfeasibleWith = std::function<bool(const std::vector<std::size_t>& kept)>;

/// A minimal set of the parts 0, ..., count - 1 with which the problem is infeasible, none of which can be
/// left out; empty when it is infeasible without any. `preferred` lists all parts, the likeliest first.
/// Returns the parts in increasing order. stop() ends the search early: the set is then still infeasible, but
/// perhaps not minimal. PRECONDITION: the problem with all parts is infeasible.
std::vector<std::size_t> minimal_conflict(const std::vector<std::size_t>& preferred,
                                          const InfeasibleWith& infeasible,
                                          const std::function<bool()>& stop);

}  // namespace hcsp
