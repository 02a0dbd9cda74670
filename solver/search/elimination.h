// SPDX-License-Identifier: Apache-2.0
// Gauss-Jordan elimination of the equations, each in its mean value form over a box, those that are nearly
// linear first: what is left relates few unknowns, and contracts them where the equations one by one do not.
// Unlike Newton's preconditioner it keeps what is linear apart from what is not, so that it serves on wide
// boxes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/search/system.h"

namespace hcsp {

class Elimination {
 public:
  explicit Elimination(const System& system);

  /// Contracts a box; false when it has no solution. PRECONDITION: the thread rounds upward.
  bool contract(std::vector<Interval>& box);

 private:
  bool expand(const std::vector<Interval>& box);
  void eliminate(const std::vector<Interval>& box);
  bool contract_by(Eigen::Index row, std::vector<Interval>& box);

  const System& system_;
  std::vector<std::uint32_t> equations_;
  TapeRun run_;
  std::vector<std::vector<Interval>> slopes_;  // by equation and unknown
  std::vector<Interval> center_, values_, row_, terms_, sums_;
  std::vector<double> bend_;          // by equation: how far it is from linear over the box
  std::vector<std::uint32_t> order_;  // of the equations that have a mean value form, the straightest first
  Eigen::MatrixXd middle_, combination_;  // rows of the elimination, and how the equations make them
};

}  // namespace hcsp
