// SPDX-License-Identifier: Apache-2.0
#include "solver/search/minimisation.h"

#include <map>

namespace hcsp {

namespace {

std::vector<NodeId> with_objective(Dag& dag, NodeId objective, std::vector<NodeId> relations, const Input& value) {
  relations.insert(relations.begin(), dag.apply(Op::equal, {dag.input(value), objective}, 2));
  return relations;
}

std::vector<System::Unknown> with_one_more(std::vector<System::Unknown> unknowns, const Input& value) {
  unknowns.push_back({value, Interval::entire(), false});
  return unknowns;
}

}  // namespace

Minimisation::Minimisation(Dag& dag, NodeId node, const std::vector<NodeId>& relations,
                           std::vector<System::Unknown> unknowns, const Input& value)
    : constraints(dag, relations, unknowns),
      with_value(dag, with_objective(dag, node, relations, value), with_one_more(unknowns, value)),
      has_slopes(fits_tape(dag, node)),
      objective(dag, {node}) {
  std::map<Input, std::uint32_t> place_of;
  for (std::uint32_t v = 0; v < unknowns.size(); ++v) place_of.emplace(unknowns[v].input, v);
  for (const Input& input : objective.inputs()) objective_unknowns.push_back(place_of.at(input));
}

Interval ObjectiveRun::on(const std::vector<Interval>& box) {
  for (std::uint32_t i = 0; i < problem_.objective_unknowns.size(); ++i)
    evaluation_.set(i, box[problem_.objective_unknowns[i]]);
  evaluation_.forward();
  const std::uint32_t root = problem_.objective.root();
  return evaluation_.defined(root) ? evaluation_.get(root) : Interval::entire();
}

}  // namespace hcsp
