// SPDX-License-Identifier: Apache-2.0
// Gauss-Jordan elimination of the equations, each in its mean value form over a box, those that are nearly
// linear first: what is left relates few unknowns, and contracts them where the equations one by one do not.
// Unlike Newton's preconditioner it keeps what is linear apart from what is not, so that it serves on wide
// boxes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/search/mean_value.h"

namespace hcsp {

class Elimination {
 public:
  explicit Elimination(MeanValueForms& forms) : forms_(forms) {}

  /// Contracts a box; false when it has no solution. PRECONDITION: the thread rounds upward.
  bool contract(std::vector<Interval>& box);

 private:
  void order(const std::vector<Interval>& box);
  void eliminate(const std::vector<Interval>& box);
  bool contract_by(const MeanValueForms::Form& form, std::vector<Interval>& box);

  MeanValueForms& forms_;
  std::vector<std::uint32_t> order_;  // of the equations that have a mean value form, the straightest first
  std::vector<double> bend_;          // by equation: how far it is from linear over the box
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows middle_, combination_;  // by place in the order: what is left of it, and how the equations make that
  std::vector<Interval> terms_, sums_;
};

}  // namespace hcsp
