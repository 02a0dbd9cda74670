// SPDX-License-Identifier: Apache-2.0
// What compilation needs to know of a Problem.
#include "solver/online/compiler.h"
#include "solver/phases/enclosure.h"
#include "solver/problem_impl.h"

namespace hcsp::online {

namespace {

Input input_of(VariableId id) { return {Input::Kind::real, id, 0, 0}; }

// Names of parameters and unknowns, one by one and as vectors.
struct Places {
  const ContractorGraph& graph;
  const std::map<VariableId, VectorGroup>& vectors;
  Question& question;

  void add(VariableId id, bool is_parameter) {
    const std::string& name = graph.variable(id).name();
    const std::size_t place = is_parameter ? question.parameters.size() - 1 : id;
    auto& places = is_parameter ? question.parameter_places : question.variable_places;
    places[name] = {place, 1};
    if (is_parameter) question.variable_places[name] = {id, 1};
    const auto vector = vectors.find(id);
    if (vector == vectors.end()) return;
    places[vector->second.name] = {place, vector->second.dim};
    if (is_parameter) question.variable_places[vector->second.name] = {id, vector->second.dim};
  }
};

}  // namespace

Question question_of(Problem& problem, const std::optional<Expr>& objective,
                     const std::vector<Expr>& outputs) {
  require(problem.is_system(), "compile: the problem is not one of relations between numbers");
  problem.define_phases();
  Problem::Impl& impl = *problem.impl_;
  Question question{};
  question.dag = &impl.dag;
  question.followed = impl.followed;
  question.has_objective = objective.has_value();
  question.variables = impl.kinds.size();
  const auto wanted_node = [&](const Expr& expression) {
    return impl.node_of(impl.phases == nullptr ? expression : impl.phases->expand(expression));
  };
  if (objective) {
    question.wanted.push_back(wanted_node(*objective));
    require(!impl.holds_or_not(question.wanted[0]), "compile: the objective is a relation");
  }
  for (const Expr& output : outputs) question.wanted.push_back(wanted_node(output));
  for (VariableId id = 0; id < impl.kinds.size(); ++id) {
    if (impl.kinds[id] != DomainKind::polynomial || impl.graph.variable(id).hidden()) continue;
    const std::vector<NodeId> all = expressions_of(*impl.phases, id);
    question.tubes.push_back(
        {impl.graph.variable(id).name(), unknown_tube(*impl.phases, id), question.wanted.size()});
    question.wanted.insert(question.wanted.end(), all.begin(), all.end());
  }
  for (const auto& stated : impl.relations) {
    question.statements.push_back(
        {stated.relation, static_cast<std::uint32_t>(question.names.size()), stated.is_implied});
    question.names.push_back(stated.name);
    if (impl.family.contains(stated.name)) question.family.insert(question.statements.back().name);
  }
  Places places{impl.graph, impl.vectors, question};
  Unknowns& unknowns = question.unknowns;
  for (VariableId id = 0; id < impl.kinds.size(); ++id) {
    if (impl.kinds[id] != DomainKind::real) continue;  // a tube on phases, which is expanded
    const Input input = input_of(id);
    const Interval domain = impl.graph.initial<Interval>(id);
    const bool is_parameter = impl.parameters.contains(id);
    if (is_parameter) {
      unknowns.parameters.insert(input);
      unknowns.domains[input] = Interval::entire();
      question.parameters.push_back(input);
      question.parameter_values.push_back(domain);
      const auto vector = impl.vectors.find(id);
      question.parameter_names.push_back(vector != impl.vectors.end() ? vector->second.name
                                                                      : impl.graph.variable(id).name());
    } else {
      question.name_of[input] = static_cast<std::uint32_t>(question.names.size());
      unknowns.domains[input] = domain;
      if (const auto certain = impl.certain.find(id); certain != impl.certain.end())
        unknowns.certain[input] = certain->second;
      if (impl.whole.contains(id)) unknowns.whole.insert(input);
      if (domain.is_empty())
        question.statements.push_back(
            {impl.dag.constant(kFalse), static_cast<std::uint32_t>(question.names.size()), false});
      question.names.push_back(impl.graph.variable(id).name());
    }
    places.add(id, is_parameter);
  }
  return question;
}

}  // namespace hcsp::online
