// SPDX-License-Identifier: Apache-2.0
// The polytope hull: the box around the solutions of a system's linear relaxation over a box (relaxation.h),
// by a linear program for each bound that may move.
#pragma once

#include <vector>

#include "solver/search/relaxation.h"

namespace hcsp {

class PolytopeHull {
 public:
  explicit PolytopeHull(const System& system) : system_(system), relaxation_(system) {}

  /// Contracts a box, all sides of it, or but the lower bound of one unknown and what that shows of the
  /// others; false when it has no solution. PRECONDITION: the thread rounds upward.
  bool contract(std::vector<Interval>& box);
  bool contract_below(std::vector<Interval>& box, std::uint32_t v);
  /// After contract_below(): where the relaxation is least, by unknown; empty where that is not known.
  [[nodiscard]] const std::vector<double>& least_at() const { return least_at_; }
  /// Goes on with contract() after contract_below(), of the same box.
  bool contract_sides(std::vector<Interval>& box);

 private:
  void note_reached(std::size_t unknowns);
  bool take(std::vector<Interval>& box);

  const System& system_;
  Relaxation relaxation_;
  LinearProgram program_;
  std::vector<Interval> stated_;  // the unknowns' columns as they were stated
  std::vector<std::uint8_t>
      reached_;  // by side: a solution of the relaxation lies there, so no program moves it
  std::vector<double> least_at_;
};

}  // namespace hcsp
