// SPDX-License-Identifier: Apache-2.0
// Defined unknowns eliminated from a case: an equation that gives an unknown in terms of the others defines
// it, and the expression that it equates is the other side from then on, so that what it states holds by
// construction and not up to rounding.
#pragma once

#include <vector>

#include "solver/online/cases.h"

namespace hcsp::online {

/// "The expression is defined, and in `wanted`."
struct Requirement {
  NodeId root;
  Interval wanted;  ///< [1, 1] of Booleans, {0} of equations, a ray or all numbers otherwise
  bool strict;      ///< the finite bound itself is not allowed
  std::uint32_t name;
  bool is_implied = false;
  [[nodiscard]] bool is_equation() const { return wanted.is_point() && wanted.lo() == 0.0; }
};

/// variable <= value, or >= value, of parameters alone. A requirement tells the same.
struct Bound {
  Input variable;
  NodeId value;
  bool is_upper;
};

/// A case in terms of fewer unknowns, its core.
struct View {
  std::vector<Input> core;
  std::vector<Definition> definitions;    ///< of all other unknowns, by the core and by parameters
  std::vector<Requirement> requirements;  ///< with an unknown in them
  std::vector<Requirement> conditions;    ///< by parameters alone
  std::vector<Bound> bounds;              ///< of the core
  std::vector<NodeId> nonzero;            ///< of parameters; where one could be 0 the view says nothing
  std::vector<NodeId> wanted;             ///< those of the case
};

enum class Purpose : std::uint8_t {
  search,  ///< by all relations: its solutions are all of those that obey the implied ones, too
  proof,   ///< by the constraints alone: what obeys it is a solution
};

/// `name_of`: by unknown, among the names of what was stated: that of its domain.
/// `first`: facts of the same graph for the first values of parameters.
View eliminate(Dag& dag, Facts& facts, Facts& first, const Case& one, const Unknowns& unknowns,
               Purpose purpose, const std::map<Input, std::uint32_t>& name_of);

}  // namespace hcsp::online
