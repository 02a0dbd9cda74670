// SPDX-License-Identifier: Apache-2.0
// A local search in floating point for good points to prove feasible: sequential linear programming in a
// trust region, with elastic rows for the constraints (Fletcher and Sainz de la Maza 1989).
#pragma once

#include <vector>

#include "solver/search/linear_program.h"
#include "solver/search/minimisation.h"

namespace hcsp {

class LocalSearch {
 public:
  explicit LocalSearch(const Minimisation& problem);

  /// Moves a point in the domains towards a local minimum, with each inequality kept by a margin where that
  /// can be, a part of its size; whole numbers stay as they are. PRECONDITION: the thread rounds upward.
  void improve(std::vector<double>& point, double margin, int most_steps);

 private:
  // What is known at a point.
  struct Place {
    double objective = 0.0, violation = 0.0;
    std::vector<double> values;  // by relation
  };
  bool evaluate(const std::vector<double>& point, Place& place);
  void expand(const std::vector<double>& point);
  bool step(const std::vector<double>& point, const Place& place, std::vector<double>& next,
            double& promised);

  const Minimisation& problem_;
  TapeRun run_;
  LinearProgram program_;
  double margin_ = 0.0, penalty_ = 0.0, radius_ = 0.0;
  std::vector<Interval> box_;
  std::vector<std::vector<Interval>> slopes_;  // by relation
  std::vector<double> size_;                   // by relation: how large its terms are
};

}  // namespace hcsp
