// SPDX-License-Identifier: Apache-2.0
// The interval Newton operator of Hansen and Sengupta on the equations of a system, preconditioned by an
// approximate inverse of the Jacobian's midpoint (Neumaier, Interval Methods for Systems of Equations, 1990,
// chapter 5). It contracts boxes, and proves what they hold. Of a system with more unknowns than equations
// some unknowns are parameters, of one with fewer some equations are left out.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/search/mean_value.h"

namespace hcsp {

class Newton {
 public:
  Newton(const System& system, MeanValueForms& forms);

  enum class Outcome : std::uint8_t { nothing, contracted, empty, proven };
  /// One step on a box, which is contracted in place. PRECONDITION: the thread rounds upward.
  /// proven: for every value of the parameters in the box, the equations that are not left out have exactly
  /// one solution in reach(), which is a little larger than the box; it is in enclosure(). The box has no
  /// other.
  Outcome contract(std::vector<Interval>& box);
  [[nodiscard]] const std::vector<Interval>& reach() const { return reach_; }
  /// How many equations there are but those that the others imply, which are left out of all proofs.
  [[nodiscard]] std::size_t equations() const { return needed_.size(); }
  /// Whether the parameters have but one value there: then it is one solution.
  [[nodiscard]] bool is_one() const;
  [[nodiscard]] const std::vector<Interval>& enclosure() const { return image_; }

  /// Whether the equations, as many as unknowns, have exactly one solution near a box: reach() and
  /// enclosure() are then as after contract(). PRECONDITION: the thread rounds upward.
  bool prove_alone(const std::vector<Interval>& box, double farthest);

  /// Whether the equations have a solution near a box for every value of the parameters in it. Then
  /// enclosure() holds these solutions, and every one in the box. PRECONDITION: the thread rounds upward.
  bool prove_some(const std::vector<Interval>& box);

  // Of one Newton, either those above are called or one of those below.

  /// One step on a box with some equations and as many unknowns; it may be proven, too: then the box has
  /// exactly one solution of them for every value of the other unknowns. PRECONDITION: the thread rounds
  /// upward.
  Outcome contract(std::vector<Interval>& box, std::span<const std::uint32_t> rows,
                   std::span<const std::uint32_t> columns);

  /// Whether, for every value that the other unknowns have in `reach`, some equations have exactly one
  /// solution there in as many unknowns that are to be solved for. Then it is in enclosure(). PRECONDITION:
  /// the thread rounds upward.
  bool prove_in(const std::vector<Interval>& reach, std::span<const std::uint32_t> rows,
                std::span<const std::uint32_t> solved);

 private:
  Outcome step(const std::vector<Interval>& box, std::vector<Interval>& image);
  void polish();
  bool expand_over(const std::vector<Interval>& box);
  bool choose_square(const std::vector<Interval>& box);
  bool precondition();

  const System& system_;
  MeanValueForms& forms_;
  std::vector<std::uint32_t> needed_;          // the equations that no others imply
  std::vector<std::uint32_t> rows_, columns_;  // the equations and unknowns at hand, as many of either
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> inverse_;
  std::vector<Interval> reach_, image_, next_;
};

}  // namespace hcsp
