// SPDX-License-Identifier: Apache-2.0
// Global optimisation: boxes are contracted, bounded from below and cut in two, best first, until no point
// that is not proven to be worse than a point that is proven feasible could be much better.
#pragma once

#include <optional>
#include <vector>

#include "solver/search/branch_and_prune.h"
#include "solver/search/minimisation.h"
#include "solver/search/search_options.h"

namespace hcsp {

struct MinimumAnswer {
  /// Holds the infimum of the objective over the solutions. Its upper bound is the objective's at a point
  /// that is proven to exist in `best`, oo without one; empty when there is no solution.
  Interval minimum = Interval::empty();
  std::optional<std::vector<Interval>> best;
  std::vector<std::vector<Interval>> boxes;       ///< that hold, with those unexplored, every minimiser
  std::vector<std::vector<Interval>> unexplored;  ///< when a limit stopped the search
  std::uint64_t cells = 0;                        ///< boxes that were looked at
};

/// Whether a bracket of the minimum is as narrow as asked for, absolutely or relatively.
bool is_close(const Interval& minimum, const SearchOptions& options);

/// What is proven before the search begins.
struct KnownOptimum {
  std::optional<std::vector<Interval>> solution;  ///< a box that holds one
  Interval minimum = Interval::entire();          ///< holds the infimum; empty: there is no solution
};

/// Ends when the bracket is close, when what is left cannot be cut any more, or at a limit; then the answer
/// is still guaranteed. Answers of different numbers of threads overlap.
MinimumAnswer branch_and_bound(const Minimisation& problem, const SearchOptions& options,
                               const KnownOptimum& known = {});

}  // namespace hcsp
