// SPDX-License-Identifier: Apache-2.0
// A system of relations between reals, as search sees it: unknowns numbered through, and expressions that
// have to lie in an interval each.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "domains/interval/interval.h"
#include "solver/expression/program.h"
#include "solver/search/tape.h"

namespace hcsp {

struct System {
  /// "root i of the tape lies in `wanted`": {0} for an equation, a ray for an inequality.
  struct Relation {
    Interval wanted;
    bool strict;              ///< the finite bound itself is not allowed
    bool is_implied = false;  ///< no proof has to show it
    [[nodiscard]] bool is_equation() const { return wanted.is_point(); }
  };
  /// Any other relation: one with connectives, choices or !=.
  struct Choice {
    NodeId relation;
    Program program;
    std::vector<std::uint32_t> unknowns;  ///< by input of the program
    bool is_implied = false;
  };

  struct Unknown {
    Input input;
    Interval domain;
    bool is_whole = false;
    bool is_given = false;                 ///< for every value of it: equations are never solved for it
    std::optional<Interval> certain = {};  ///< what of the domain certainly belongs to it; all by default

    [[nodiscard]] const Interval& certain_part() const { return certain ? *certain : domain; }
  };

  /// Sorts the conjuncts of relations between the unknowns; adds nodes to the graph, which outlives the
  /// system. What is implied contracts like any other relation, but is never what a proof shows, nor what it
  /// counts as an equation.
  System(Dag& dag, const std::vector<NodeId>& relations, const std::vector<Unknown>& unknowns,
         const std::vector<NodeId>& implied = {});

  /// Number of unknowns.
  [[nodiscard]] std::size_t size() const { return domains.size(); }

  Dag& dag;
  std::vector<NodeId> stated;          ///< the relations as they were given, those that are implied last
  std::size_t implied = 0;             ///< how many they are
  std::vector<Input> inputs;           ///< by unknown
  std::vector<Interval> domains;       ///< by unknown
  std::vector<Interval> certain;       ///< by unknown: where there may be proofs that it has a value
  std::vector<std::uint8_t> is_whole;  ///< by unknown
  std::vector<std::uint8_t> is_given;  ///< by unknown
  std::vector<Relation> relations;     ///< by root of the tape
  std::vector<Choice> choices;
  std::vector<std::vector<std::uint32_t>> relations_of;  ///< by unknown: the relations that it occurs in
  std::unique_ptr<const Tape> tape;
};

}  // namespace hcsp
