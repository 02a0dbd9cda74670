// SPDX-License-Identifier: Apache-2.0
// The conditions of Fritz John (1948) for a minimum under constraints: multipliers, not all zero, of the
// objective, the equations and the inequalities that can be active add up their slopes to zero, but for what
// the bounds of domains hold back. Over a box the slopes are intervals; that no multipliers do it for any
// slopes in them is proven by a linear program. Where functions have kinks, the intervals hold their
// generalised slopes (Clarke 1976). What is implied has none: a best solution is one of the constraints
// alone.
#pragma once

#include <vector>

#include "solver/search/choices.h"
#include "solver/search/linear_program.h"
#include "solver/search/minimisation.h"

namespace hcsp {

class FritzJohn {
 public:
  explicit FritzJohn(const Minimisation& problem);
  FritzJohn(const FritzJohn&) = delete;
  FritzJohn& operator=(const FritzJohn&) = delete;

  /// False when a box of the unknowns and the objective's value holds no minimiser: proven. A box that is not
  /// bounded in the unknowns is not looked at. PRECONDITION: the thread rounds upward.
  bool may_hold_minimiser(const std::vector<Interval>& box);

 private:
  struct Multiplier {
    std::uint32_t relation;
    double sign;   // of the slopes; the objective's are those of "value - objective", turned round
    double scale;  // that brings the slopes to a size of about 1
  };
  bool expand_around(const std::vector<Interval>& box);
  bool may_have_multipliers(std::uint32_t signs);
  void collect_multipliers(std::uint32_t signs);
  void add_row(std::uint32_t v);

  const Minimisation& problem_;
  TapeRun run_;
  Choices choices_;
  LinearProgram program_;
  std::vector<Interval> around_;
  std::vector<std::vector<Interval>> slopes_;  // by relation of with_value
  std::vector<Multiplier> multipliers_;
  std::size_t equations_ = 0;  // among the relations
};

}  // namespace hcsp
