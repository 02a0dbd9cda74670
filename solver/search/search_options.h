// SPDX-License-Identifier: Apache-2.0
// What a search may be told, and what it tells while it runs.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "solver/engine/propagation.h"

namespace hcsp {

/// Which box is looked at next: the one that was cut last, or the best of all (of `minimize`: that of the
/// least lower bound; else the widest).
enum class SearchOrder : std::uint8_t { depth_first, best_first };

/// Which unknown of a box is cut. smear: with which the equations vary most, each counting alike
/// (Trombettoni et al. 2011, smearSumRel); smear_max: with which one of them does (Kearfott's maximal smear);
/// largest_first: the widest; round_robin: one after another.
enum class Bisector : std::uint8_t { smear, smear_max, largest_first, round_robin };

/// Read it from another thread.
struct SearchProgress {
  std::atomic<std::uint64_t> cells = 0;  ///< boxes that were looked at
  std::atomic<std::int64_t> open = 0;    ///< boxes that wait
};

struct SearchOptions {
  /// A box of which no side is wider is not cut any more; of the bracket of a minimum, the absolute or the
  /// relative width, whichever is reached first.
  double precision = 1e-3;
  double absolute_precision = 0.0;  ///< of the bracket of a minimum, the absolute width; 0 is `precision`
  std::optional<SearchOrder> order = {};  ///< where none is given: best first to minimise, else depth first
  Bisector bisector = Bisector::smear;
  unsigned threads = 1;
  double time_limit = 0.0;    ///< seconds; 0 is none
  double spent_before = 0.0;  ///< seconds that preparing the data took, for Statistics::seconds
  const std::atomic<bool>* cancel = nullptr;  ///< set it (Ctrl-C, a memory limit) to stop the search
  SearchProgress* progress = nullptr;         ///< kept up to date if there is one
  /// Takes the state of the search every so many seconds, to be kept: with it as `resume` a later search of
  /// the same problem goes on from there, and its answer holds what both found.
  std::function<void(const std::string&)> checkpoint = {};
  double checkpoint_period = 0.05;
  std::string resume = {};  ///< std::invalid_argument where it is no state of this problem
  Clock clock = steady_clock();
};

}  // namespace hcsp
