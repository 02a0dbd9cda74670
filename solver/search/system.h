// SPDX-License-Identifier: Apache-2.0
// A system of relations between reals, as search sees it: unknowns numbered through, and expressions that
// have to lie in an interval each.
#pragma once

#include <memory>
#include <vector>

#include "domains/interval/interval.h"
#include "solver/expression/program.h"
#include "solver/search/tape.h"

namespace hcsp {

struct System {
  /// "root i of the tape lies in `wanted`": {0} for an equation, a ray for an inequality.
  struct Relation {
    Interval wanted;
    bool strict;  ///< the finite bound itself is not allowed
    [[nodiscard]] bool is_equation() const { return wanted.is_point(); }
  };
  /// Any other relation: one with connectives, choices or !=.
  struct Choice {
    NodeId relation;
    Program program;
    std::vector<std::uint32_t> unknowns;  ///< by input of the program
  };

  /// Sorts the conjuncts of relations; adds nodes to the graph, which outlives the system.
  System(Dag& dag, const std::vector<NodeId>& relations, std::vector<Input> unknowns);

  Dag& dag;
  std::vector<Input> unknowns;
  std::vector<Interval> domains;       ///< by unknown; to be filled in
  std::vector<std::uint8_t> is_whole;  ///< by unknown; to be filled in
  std::vector<Relation> relations;     ///< by root of the tape
  std::vector<Choice> choices;
  std::vector<std::vector<std::uint32_t>> relations_of;  ///< by unknown: the relations that it occurs in
  std::unique_ptr<const Tape> tape;
};

}  // namespace hcsp
