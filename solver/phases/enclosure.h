// SPDX-License-Identifier: Apache-2.0
// The tubes of a time line with phases where the reals are known within intervals.
#pragma once

#include <functional>

#include "domains/polynomial_tube.h"
#include "solver/expression/program.h"
#include "solver/phases/phase_tubes.h"

namespace hcsp {

/// The expressions that tell all of a tube that was declared, after expand(), in the order of
/// PolynomialTube::assign(), and a tube that has so many intervals, nothing known.
std::vector<NodeId> expressions_of(const PhaseTubes& tubes, VariableId tube);
PolynomialTube unknown_tube(const PhaseTubes& tubes, VariableId tube);

/// A tube that was declared, after expand(), compiled to be evaluated on many boxes.
class TubeEnclosure {
 public:
  TubeEnclosure(const Dag& dag, const PhaseTubes& tubes, VariableId tube)
      : program_(dag, expressions_of(tubes, tube)), unknown_(unknown_tube(tubes, tube)) {}

  /// `value_of` says what is known of a real.
  [[nodiscard]] PolynomialTube on(const std::function<Interval(VariableId)>& value_of) const;

 private:
  Program program_;
  PolynomialTube unknown_;
};

}  // namespace hcsp
