// SPDX-License-Identifier: Apache-2.0
// All solutions of a system: boxes are contracted, proven, or cut in two, until nothing is left but solutions
// of the precision asked for.
#pragma once

#include <vector>

#include "solver/engine/propagation.h"
#include "solver/result.h"
#include "solver/search/system.h"

namespace hcsp {

struct SearchOptions {
  double precision = 1e-3;  ///< a box of which no side is wider is not cut any more
  unsigned threads = 1;
  double time_limit = 0.0;    ///< seconds; 0 is none
  double spent_before = 0.0;  ///< seconds that preparing the data took, for Statistics::seconds
  const std::atomic<bool>* cancel = nullptr;  ///< set it (Ctrl-C) to stop the search
  Clock clock = steady_clock();
};

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
