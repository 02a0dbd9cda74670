// SPDX-License-Identifier: Apache-2.0
#include "solver/search/minimisation.h"

#include <algorithm>
#include <map>
#include <set>

#include "solver/expression/operators.h"

namespace hcsp {

namespace {

std::vector<NodeId> with_objective(Dag& dag, NodeId objective, std::vector<NodeId> relations,
                                   const Input& value) {
  relations.insert(relations.begin(), dag.apply(Op::equal, {dag.input(value), objective}, 2));
  return relations;
}

bool is_number(const Dag& dag, NodeId id, double value) {
  return dag[id].op == Op::constant && dag[id].value == Interval::raw(value, value);
}
NodeId times(Dag& dag, NodeId a, NodeId b) {
  if (is_number(dag, a, 1.0)) return b;
  if (is_number(dag, b, 1.0)) return a;
  if (is_number(dag, a, -1.0)) return dag.apply(Op::neg, {b}, 1);
  if (is_number(dag, b, -1.0)) return dag.apply(Op::neg, {a}, 1);
  return dag.apply(Op::mul, {a, b}, 2);
}

std::vector<System::Unknown> with_one_more(std::vector<System::Unknown> unknowns, const Input& value) {
  unknowns.push_back({value, Interval::entire(), false});
  return unknowns;
}

// Kinks have slopes, but no minimum is where those are zero.
bool is_smooth(const Dag& dag, NodeId objective) {
  const std::vector<NodeId> needed = needed_nodes(dag, {objective});
  return fits_tape(dag, objective) && std::none_of(needed.begin(), needed.end(), [&](NodeId id) {
           return dag[id].op == Op::abs || dag[id].op == Op::min || dag[id].op == Op::max;
         });
}

// The derivatives of a node by the inputs that it depends on, from the root to the leaves.
std::map<Input, NodeId> derivatives_of(Dag& dag, NodeId root) {
  std::map<NodeId, NodeId> adjoints{{root, dag.constant(Interval::raw(1.0, 1.0))}};
  std::map<Input, NodeId> result;
  const std::vector<NodeId> needed = needed_nodes(dag, {root});
  std::set<NodeId> varying;
  for (const NodeId id : needed) {
    bool varies = dag[id].op == Op::input;
    for (int k = 0; k < operator_entry(dag[id].op).arity; ++k)
      varies = varies || varying.contains(dag[id].operands[static_cast<std::size_t>(k)]);
    if (varies) varying.insert(id);
  }
  for (auto id = needed.rbegin(); id != needed.rend(); ++id) {
    const auto adjoint = adjoints.find(*id);
    if (adjoint == adjoints.end()) continue;
    if (dag[*id].op == Op::input) result.emplace(dag[*id].input, adjoint->second);
    for (int k = 0; k < operator_entry(dag[*id].op).arity; ++k) {
      const NodeId operand = dag[*id].operands[static_cast<std::size_t>(k)];
      if (!varying.contains(operand)) continue;
      const NodeId slope = operator_entry(dag[*id].op).partial(dag, *id, k);
      const NodeId part = times(dag, adjoint->second, slope);
      const auto [sum, is_first] = adjoints.try_emplace(operand, part);
      if (!is_first) sum->second = dag.apply(Op::add, {sum->second, part}, 2);
    }
  }
  return result;
}

}  // namespace

Minimisation::Minimisation(Dag& dag, NodeId node, const std::vector<NodeId>& relations,
                           std::vector<System::Unknown> unknowns, const Input& value,
                           const std::vector<NodeId>& implied)
    : constraints(dag, relations, unknowns, implied),
      with_value(dag, with_objective(dag, node, relations, value), with_one_more(unknowns, value), implied),
      has_slopes(fits_tape(dag, node)),
      objective(dag, {node}) {
  std::map<Input, std::uint32_t> place_of;
  for (std::uint32_t v = 0; v < unknowns.size(); ++v) place_of.emplace(unknowns[v].input, v);
  for (const Input& input : objective.inputs()) objective_unknowns.push_back(place_of.at(input));
  if (!is_smooth(dag, node)) return;
  std::vector<NodeId> conditions;
  for (const auto& [input, slope] : derivatives_of(dag, node)) {
    const std::uint32_t v = place_of.at(input);
    if (unknowns[v].is_whole) continue;
    conditions.push_back(dag.apply(Op::equal, {slope, dag.constant(Interval::raw(0.0, 0.0))}, 2));
    gradient_unknowns.push_back(v);
  }
  gradient = std::make_unique<const System>(dag, conditions, unknowns);
  if (gradient->relations.size() != conditions.size()) gradient.reset();
}

Interval ObjectiveRun::on(const std::vector<Interval>& box) {
  for (std::uint32_t i = 0; i < problem_.objective_unknowns.size(); ++i)
    evaluation_.set(i, box[problem_.objective_unknowns[i]]);
  evaluation_.forward();
  const std::uint32_t root = problem_.objective.root();
  return evaluation_.defined(root) ? evaluation_.get(root) : Interval::entire();
}

}  // namespace hcsp
