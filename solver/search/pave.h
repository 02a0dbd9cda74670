// SPDX-License-Identifier: Apache-2.0
// Subpavings of a set (set inversion: Jaulin and Walter, Automatica 29(4), 1993; by separators: Jaulin and
// Desrochers 2014): boxes are decided, contracted from both sides, or cut, until they are as small as is
// asked for.
#pragma once

#include <vector>

#include "solver/search/point_set.h"
#include "solver/search/search_options.h"

namespace hcsp {

/// Boxes one after another, each so many intervals as the set has coordinates.
struct PavedBoxes {
  std::vector<Interval> inside;    ///< every point belongs to the set
  std::vector<Interval> boundary;  ///< no side is wider than the precision, or can be cut
  std::vector<Interval> outside;   ///< no point belongs
};

struct PavingAnswer {
  PavedBoxes boxes;
  std::vector<Interval> unexplored;  ///< what a limit left, in no order
  std::uint64_t cells = 0;           ///< boxes that were looked at
};

/// The boxes of an answer cover the domain and meet each other in faces only; of a whole number they have
/// different values. They come in the order of the cuts, the same for any number of threads unless a limit
/// stops the search.
PavingAnswer pave(const PointSet& set, const SearchOptions& options);

}  // namespace hcsp
