// SPDX-License-Identifier: Apache-2.0
// "The least value of an expression over the solutions of a system", as its search sees it.
#pragma once

#include <memory>
#include <vector>

#include "solver/search/system.h"

namespace hcsp {

struct Minimisation {
  /// `value` is an input that stands for the objective's value, and occurs nowhere else.
  Minimisation(Dag& dag, NodeId objective, const std::vector<NodeId>& relations,
               std::vector<System::Unknown> unknowns, const Input& value,
               const std::vector<NodeId>& implied = {});

  System constraints;
  /// The constraints and one unknown more, the last, that equals the objective.
  System with_value;
  /// Whether the objective has slopes: then "value - objective == 0" is relation 0 of with_value.
  bool has_slopes;
  /// "The objective's slope along an unknown is zero", of each unknown but whole numbers that it depends on;
  /// nothing where it has none everywhere, or has kinks.
  std::unique_ptr<const System> gradient;
  std::vector<std::uint32_t> gradient_unknowns;  ///< by relation of it
  Program objective;
  std::vector<std::uint32_t> objective_unknowns;  ///< by input of the program

  [[nodiscard]] std::uint32_t value() const { return static_cast<std::uint32_t>(constraints.size()); }
};

/// Evaluates the objective. PRECONDITION: the thread rounds upward.
class ObjectiveRun {
 public:
  explicit ObjectiveRun(const Minimisation& problem) : problem_(problem), evaluation_(problem.objective) {}
  /// The objective's values on a box; entire unless it is defined on all of it.
  Interval on(const std::vector<Interval>& box);

 private:
  const Minimisation& problem_;
  Evaluation evaluation_;
};

}  // namespace hcsp
