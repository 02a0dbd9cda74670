// SPDX-License-Identifier: Apache-2.0
#include "solver/search/system.h"

#include <map>

namespace hcsp {

namespace {

struct Sorted {
  std::vector<NodeId> roots;
  std::vector<System::Relation> relations;
  struct Choice {
    NodeId relation;
    bool is_implied;
  };
  std::vector<Choice> choices;
};

void sort(Dag& dag, NodeId id, bool is_implied, Sorted& sorted) {
  const DagNode node = dag[id];
  if (node.op == Op::logical_and) {
    sort(dag, node.operands[0], is_implied, sorted);
    return sort(dag, node.operands[1], is_implied, sorted);
  }
  const bool is_order = node.op == Op::less || node.op == Op::less_equal;
  const NodeId a = node.operands[0], b = node.operands[1];
  if (!(is_order || node.op == Op::equal) || !fits_tape(dag, a) || !fits_tape(dag, b)) {
    sorted.choices.push_back({id, is_implied});
    return;
  }
  const auto is_zero = [&](NodeId side) {
    return dag[side].op == Op::constant && dag[side].value == Interval::raw(0.0, 0.0);
  };
  sorted.roots.push_back(is_zero(b) ? a : dag.apply(Op::sub, {a, b}, 2));
  sorted.relations.push_back(
      {Interval::raw(is_order ? -kInfinity : 0.0, 0.0), node.op == Op::less, is_implied});
}

}  // namespace

System::System(Dag& graph, const std::vector<NodeId>& relations_stated, const std::vector<Unknown>& unknowns,
               const std::vector<NodeId>& relations_implied)
    : dag(graph), stated(relations_stated) {
  std::map<Input, std::uint32_t> place_of;
  for (const Unknown& unknown : unknowns) {
    place_of.emplace(unknown.input, static_cast<std::uint32_t>(inputs.size()));
    inputs.push_back(unknown.input);
    domains.push_back(unknown.domain);
    certain.push_back(unknown.certain_part());
    is_whole.push_back(unknown.is_whole ? 1 : 0);
    is_given.push_back(unknown.is_given ? 1 : 0);
  }
  Sorted sorted;
  for (const NodeId relation : relations_stated) sort(dag, relation, false, sorted);
  for (const NodeId relation : relations_implied) sort(dag, relation, true, sorted);
  implied = relations_implied.size();
  stated.insert(stated.end(), relations_implied.begin(), relations_implied.end());
  relations = std::move(sorted.relations);
  tape = std::make_unique<const Tape>(dag, sorted.roots, inputs);
  relations_of.resize(size());
  for (std::uint32_t i = 0; i < relations.size(); ++i) {
    for (const std::uint32_t v : tape->variables(i)) relations_of[v].push_back(i);
  }
  for (const auto& [relation, is_implied] : sorted.choices) {
    Choice& choice = choices.emplace_back(Choice{relation, Program(dag, {relation}), {}, is_implied});
    for (const Input& input : choice.program.inputs()) choice.unknowns.push_back(place_of.at(input));
  }
}

}  // namespace hcsp
