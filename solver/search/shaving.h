// SPDX-License-Identifier: Apache-2.0
// 3B and constructive interval disjunction (Lhomme 1993; Trombettoni and Chabert 2007): a domain is cut in
// slices, and what is inconsistent at its ends is taken off; of the rest, the hull of what each part leaves.
#pragma once

#include <vector>

#include "solver/search/hc4.h"

namespace hcsp {

class Shaving {
 public:
  explicit Shaving(Hc4& hc4) : hc4_(hc4) {}

  /// Contracts a box by one of its unknowns; false when it has no solution.
  bool contract(std::vector<Interval>& box, std::uint32_t v);

 private:
  Hc4& hc4_;
  std::vector<Interval> slice_, hull_;
};

}  // namespace hcsp
