// SPDX-License-Identifier: Apache-2.0
#include "solver/search/system.h"

#include <algorithm>

namespace hcsp {

namespace {

struct Sorted {
  std::vector<NodeId> roots;
  std::vector<System::Relation> relations;
  std::vector<NodeId> choices;
};

void sort(Dag& dag, NodeId id, Sorted& sorted) {
  const DagNode node = dag[id];
  if (node.op == Op::logical_and) {
    sort(dag, node.operands[0], sorted);
    return sort(dag, node.operands[1], sorted);
  }
  const bool is_order = node.op == Op::less || node.op == Op::less_equal;
  const NodeId a = node.operands[0], b = node.operands[1];
  if (!(is_order || node.op == Op::equal) || !fits_tape(dag, a) || !fits_tape(dag, b)) {
    sorted.choices.push_back(id);
    return;
  }
  const auto is_zero = [&](NodeId side) {
    return dag[side].op == Op::constant && dag[side].value == Interval::raw(0.0, 0.0);
  };
  sorted.roots.push_back(is_zero(b) ? a : dag.apply(Op::sub, {a, b}, 2));
  sorted.relations.push_back({Interval::raw(is_order ? -kInfinity : 0.0, 0.0), node.op == Op::less});
}

}  // namespace

System::System(Dag& graph, const std::vector<NodeId>& stated, std::vector<Input> inputs)
    : dag(graph), unknowns(std::move(inputs)) {
  Sorted sorted;
  for (const NodeId relation : stated) sort(dag, relation, sorted);
  relations = std::move(sorted.relations);
  tape = std::make_unique<const Tape>(dag, sorted.roots, unknowns);
  relations_of.resize(unknowns.size());
  for (std::uint32_t i = 0; i < relations.size(); ++i) {
    for (const std::uint32_t v : tape->variables(i)) relations_of[v].push_back(i);
  }
  for (const NodeId relation : sorted.choices) {
    Choice& choice = choices.emplace_back(Choice{relation, Program(dag, {relation}), {}});
    for (const Input& input : choice.program.inputs()) {
      const auto found = std::find(unknowns.begin(), unknowns.end(), input);
      choice.unknowns.push_back(static_cast<std::uint32_t>(found - unknowns.begin()));
    }
  }
}

}  // namespace hcsp
