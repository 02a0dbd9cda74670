// SPDX-License-Identifier: Apache-2.0
// The interval Newton operator of Hansen and Sengupta on the equations of a system, preconditioned by an
// approximate inverse of the Jacobian's midpoint (Neumaier, Interval Methods for Systems of Equations, 1990,
// chapter 5). It contracts boxes, and proves what they hold. Of a system with more unknowns than equations
// some unknowns are parameters, of one with fewer some equations are left out.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/search/system.h"

namespace hcsp {

class Newton {
 public:
  explicit Newton(const System& system);

  [[nodiscard]] std::size_t equations() const { return equations_.size(); }

  enum class Outcome : std::uint8_t { nothing, contracted, empty, proven };
  /// One step on a box, which is contracted in place. PRECONDITION: the thread rounds upward.
  /// proven: for every value of the parameters in the box, the equations that are not left out have exactly
  /// one solution in reach(), which is a little larger than the box; it is in enclosure(). The box has no
  /// other.
  Outcome contract(std::vector<Interval>& box);
  [[nodiscard]] const std::vector<Interval>& reach() const { return reach_; }
  /// Whether the parameters have but one value there: then it is one solution.
  [[nodiscard]] bool is_one() const;
  [[nodiscard]] const std::vector<Interval>& enclosure() const { return image_; }

  /// Whether the equations have a solution near a box for every value of the parameters in it, which
  /// enclosure() then holds: with the box, which is contracted, every solution of the box. PRECONDITION: the
  /// thread rounds upward.
  bool prove_some(const std::vector<Interval>& box);

  /// How much the equations vary over a box with each unknown: of what each equation varies, the unknown's
  /// share, summed over the equations (Trombettoni et al. 2011, smearSumRel).
  const std::vector<double>& smear(const std::vector<Interval>& box);

 private:
  Outcome step(const std::vector<Interval>& box, std::vector<Interval>& image);
  void polish();
  bool evaluate_jacobian(const std::vector<Interval>& box);
  bool choose_square(const std::vector<Interval>& box);
  bool precondition();

  const System& system_;
  std::vector<std::uint32_t> equations_;
  TapeRun run_;
  std::vector<std::vector<Interval>> jacobian_;  // by equation and unknown
  std::vector<std::uint32_t> rows_, columns_;    // the equations and unknowns at hand, as many of either
  Eigen::MatrixXd inverse_;
  std::vector<Interval> reach_, image_, center_, values_, row_;
  std::vector<double> smear_;
};

}  // namespace hcsp
