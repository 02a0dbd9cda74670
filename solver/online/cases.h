// SPDX-License-Identifier: Apache-2.0
// A problem as alternatives: one case for each choice of its Booleans and small whole numbers, and of the
// alternatives of relations that state equations, each specialised by folding.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "solver/expression/dag.h"
#include "solver/online/rewriter.h"

namespace hcsp::online {

struct Statement {
  NodeId relation;
  std::uint32_t name;  ///< among the names of what was stated
  bool is_implied;
};

/// variable == value.
struct Definition {
  Input variable;
  NodeId value;
};

struct Case {
  std::vector<Statement> statements;  ///< all hold; none is a conjunction
  std::vector<NodeId> wanted;         ///< the objective, and other expressions, in this case
  std::size_t objectives = 0;         ///< 1 where there is an objective; search wants nothing else
  std::map<Input, double> chosen;     ///< the whole numbers' values
  /// Of unknowns that constraints equate to what parameters decide: nothing else speaks of them any more.
  std::vector<Definition> definitions;
};

/// Every solution is in one of the cases at least; where there is none for sure one case says "false" by the
/// name of what refutes. Throws std::invalid_argument where they are more than `most`, or a whole number has
/// too many values.
std::vector<Case> split_into_cases(Dag& dag, Facts& facts, const Case& whole, const Unknowns& unknowns,
                                   std::size_t most);

}  // namespace hcsp::online
