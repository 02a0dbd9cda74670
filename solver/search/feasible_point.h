// SPDX-License-Identifier: Apache-2.0
// Points that are proven to satisfy a system: inequalities hold on all of a box, and where there are equations, they
// are proven to have a solution in it, by Newton's method in as many unknowns as there are equations, the others
// being fixed (Kearfott 1998, On proving existence of feasible points in equality constrained optimization
// problems).
#pragma once

#include <vector>

#include "solver/search/choices.h"
#include "solver/search/newton.h"

namespace hcsp {

class FeasiblePoint {
 public:
  explicit FeasiblePoint(const System& system);
  FeasiblePoint(const FeasiblePoint&) = delete;
  FeasiblePoint& operator=(const FeasiblePoint&) = delete;

  /// Looks for one near a point. Then box() holds it. PRECONDITION: the thread rounds upward.
  bool find(std::vector<double> near);
  [[nodiscard]] const std::vector<Interval>& box() const { return box_; }

 private:
  void put_in_domains(std::vector<double>& point) const;
  bool correct(std::vector<double>& point);
  bool choose_solved(const std::vector<double>& point);
  bool prove(const std::vector<double>& point);
  bool holds();
  void linearise(const std::vector<double>& point);
  [[nodiscard]] double room(std::size_t v, double x) const;

  const System& system_;
  MeanValueForms forms_;
  Newton newton_;
  Choices choices_;
  TapeRun run_;
  std::vector<Interval> box_, reach_;
  std::vector<std::uint32_t> solved_;
  Eigen::MatrixXd jacobian_;  // of the equations, by unknown times its room
  Eigen::VectorXd values_, room_;
};

}  // namespace hcsp
