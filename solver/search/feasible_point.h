// SPDX-License-Identifier: Apache-2.0
// Points that are proven to satisfy a system: inequalities hold on all of a box, and where there are
// equations, they are proven to have a solution in it, by Newton's method in as many unknowns as there are
// equations, the others being fixed (Kearfott 1998, On proving existence of feasible points in equality
// constrained optimization problems). Linear equations that the others imply, exactly, need no proof; nor
// does one that is 0 at every value that the unknowns that are not fixed can have.
#pragma once

#include <vector>

#include "solver/search/choices.h"
#include "solver/search/implied_equations.h"
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
  struct Row {
    std::uint32_t relation;
    double value;  // how far it is from where it should be
  };
  void put_in_domains(std::vector<double>& point) const;
  bool evaluate(const std::vector<double>& point);
  bool correct(std::vector<double>& point);
  bool choose_solved(const std::vector<double>& point);
  bool prove(const std::vector<double>& point);
  bool holds();
  [[nodiscard]] double room(std::size_t v, double x) const;
  [[nodiscard]] Eigen::MatrixXd jacobian(const std::vector<double>& point);

  const System& system_;
  MeanValueForms forms_;
  Newton newton_;
  Choices choices_;
  TapeRun run_;
  std::vector<std::uint32_t> equations_;  // by number among equations: their relations
  std::vector<std::uint8_t> is_implied_;  // by number
  std::vector<std::uint8_t> is_active_;   // by relation: an inequality that was violated
  std::vector<Row> rows_;
  std::vector<Interval> box_, reach_, slopes_;
  std::vector<std::uint32_t> solved_,
      solved_by_;  // unknowns, and the numbers of the equations that they solve
};

}  // namespace hcsp
