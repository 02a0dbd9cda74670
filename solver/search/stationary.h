// SPDX-License-Identifier: Apache-2.0
// First-order conditions of optimality: where no constraint can be active, the slopes of the objective are
// zero at every minimiser (Fermat), which interval Newton contracts to.
#pragma once

#include <vector>

#include "solver/search/choices.h"
#include "solver/search/minimisation.h"
#include "solver/search/newton.h"

namespace hcsp {

class Stationary {
 public:
  explicit Stationary(const Minimisation& problem);
  Stationary(const Stationary&) = delete;
  Stationary& operator=(const Stationary&) = delete;

  /// Contracts a box of the unknowns and the objective's value to what can hold a minimiser; false when it
  /// holds none. The box is bounded in the unknowns, or nothing is done: a minimum that is only approached
  /// far out is not stationary anywhere. PRECONDITION: the thread rounds upward.
  bool contract(std::vector<Interval>& box);

 private:
  bool find_free(const std::vector<Interval>& box);
  bool is_inside();
  void keep_defined();
  bool is_concave();

  const Minimisation& problem_;
  TapeRun run_, gradient_run_;
  Choices choices_;
  MeanValueForms forms_;
  Newton newton_;
  std::vector<Interval> point_, around_, slopes_;
  std::vector<std::uint32_t> rows_,
      columns_;  // of the unknowns that can move both ways: equations and unknowns
};

}  // namespace hcsp
