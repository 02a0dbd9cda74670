// SPDX-License-Identifier: Apache-2.0
// All solutions of a system: boxes are contracted, proven, or cut in two, until nothing is left but solutions
// of the precision asked for.
#pragma once

#include <vector>

#include "solver/result.h"
#include "solver/search/search_options.h"
#include "solver/search/system.h"

namespace hcsp {

/// A box of which a search says something.
struct FoundBox {
  std::vector<Interval> box;  ///< by unknown of the system
  Certificate certificate = Certificate::none;
  Reason reason = Reason::proven;
};

struct SearchAnswer {
  std::vector<FoundBox> found;                    ///< in the order of their lower bounds
  std::vector<std::vector<Interval>> unexplored;  ///< when a limit stopped the search, in that order too
  std::uint64_t cells = 0;                        ///< boxes that were looked at
};

/// Every solution of the system within its domains is in a box that was found or left unexplored; no two
/// unique ones hold the same. The answer is the same for any number of threads, unless a limit stops the
/// search.
SearchAnswer branch_and_prune(const System& system, const SearchOptions& options);

}  // namespace hcsp
