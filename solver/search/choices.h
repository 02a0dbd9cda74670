// SPDX-License-Identifier: Apache-2.0
// The relations of a system that are no expression in an interval, contracted as formulas; and the whole
// numbers among the unknowns.
#pragma once

#include <vector>

#include "solver/contractors/formula.h"
#include "solver/search/system.h"

namespace hcsp {

class Choices {
 public:
  explicit Choices(const System& system);

  /// Contracts a box by each relation once and to whole numbers; false when it has no solution. PRECONDITION:
  /// the thread rounds upward.
  bool contract(std::vector<Interval>& box);
  /// Whether all but those that are implied hold for every point of a box.
  bool all_hold(const std::vector<Interval>& box);

 private:
  struct One {
    const System::Choice* choice;
    Formula formula;
    Evaluation evaluation;
  };
  static bool shrink_to_whole(Interval& domain);

  const System& system_;
  std::vector<One> all_;
  std::vector<Interval> values_;
};

}  // namespace hcsp
