// SPDX-License-Identifier: Apache-2.0
#include "solver/online/compiler.h"

#include <algorithm>

#include "solver/expression/operators.h"

namespace hcsp::online {

namespace {

std::vector<Interval> domains_of(const View& view, const Question& question, bool is_certain) {
  std::vector<Interval> domains;
  for (const Input& input : view.core) {
    const Unknowns& unknowns = question.unknowns;
    domains.push_back(is_certain ? unknowns.certain_domain(input) : unknowns.domains.at(input));
  }
  return domains;
}

// The register of an unknown in the code of a view; none where the view does not speak of it.
std::optional<Register> register_in(const View& view, const Code& code, const Input& input) {
  const auto core = std::find(view.core.begin(), view.core.end(), input);
  if (core != view.core.end()) return code.first() + static_cast<Register>(core - view.core.begin());
  for (std::size_t i = 0; i < view.definitions.size(); ++i) {
    if (view.definitions[i].variable == input) return code.definitions[i];
  }
  return {};
}

struct Pair {
  View search, proof;
};

std::map<Input, std::size_t> places_of(const std::vector<Input>& parameters) {
  std::map<Input, std::size_t> places;
  for (std::size_t i = 0; i < parameters.size(); ++i) places.emplace(parameters[i], i);
  return places;
}

}  // namespace

Compiled::Compiled(const Question& question)
    : prefix(question.parameters),
      followers(*question.dag, question.followed, places_of(question.parameters)),
      has_objective(question.has_objective),
      names(question.names),
      parameter_names(question.parameter_names),
      has_family(!question.family.empty()),
      is_decisive(question.names.size(), !has_family),
      parameter_values(question.parameter_values),
      parameter_places(question.parameter_places),
      variable_places(question.variable_places),
      variables(question.variables),
      tubes(question.tubes) {}

std::size_t Compiled::most_registers() const {
  return most(cases, [](const Code& code) { return code.registers(); });
}

std::size_t Compiled::most_core() const {
  return most(cases, [](const Code& code) { return code.core(); });
}

std::size_t Compiled::most_surfaces() const {
  return most(cases, [](const Code& code) { return code.surfaces; });
}

namespace {

Case copy_of(const Case& one, const Dag& from, Dag& to) {
  Rewriter import(from, to);
  Case copy = one;
  for (Statement& statement : copy.statements) statement.relation = import(statement.relation);
  for (Definition& definition : copy.definitions) definition.value = import(definition.value);
  for (NodeId& node : copy.wanted) node = import(node);
  return copy;
}

}  // namespace

Compiled compile_cases(const Question& question, std::size_t most_cases) {
  Compiled compiled(question);
  Dag dag;
  Rewriter import(*question.dag, dag);
  Case whole;
  for (const Statement& own : question.statements)
    whole.statements.push_back({import(own.relation), own.name, own.is_implied});
  whole.objectives = question.has_objective ? 1 : 0;
  for (const NodeId node : question.wanted) whole.wanted.push_back(import(node));
  const Unknowns& unknowns = question.unknowns;
  Unknowns at_first = unknowns;
  for (std::size_t p = 0; p < question.parameters.size(); ++p)
    at_first.domains[question.parameters[p]] = question.parameter_values[p];
  Facts facts(dag, unknowns);
  // In a family nothing but what speaks of parameters alone, and is not of the family, leaves no solution.
  for (const Statement& stated : whole.statements) {
    if (facts.is_given(stated.relation) && !question.family.contains(stated.name))
      compiled.is_decisive[stated.name] = true;
  }
  const std::vector<Case> cases = split_into_cases(dag, facts, whole, unknowns, most_cases);
  std::vector<Pair> views;
  for (const Case& shared : cases) {
    // A graph of its own: small, and all of it of use.
    Dag own;
    const Case one = copy_of(shared, dag, own);
    Facts known(own, unknowns), first(own, at_first);
    const Pair& pair = views.emplace_back(
        Pair{eliminate(own, known, first, one, unknowns, Purpose::search, question.name_of),
             eliminate(own, known, first, one, unknowns, Purpose::proof, question.name_of)});
    compiled.cases.push_back(
        {Code(own, compiled.prefix, known, pair.search, whole.objectives, Purpose::search),
         Code(own, compiled.prefix, known, pair.proof, whole.objectives, Purpose::proof),
         domains_of(pair.search, question, false),
         domains_of(pair.proof, question, true),
         {},
         {}});
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CompiledCase& own = compiled.cases[i];
    const Pair& pair = views[i];
    own.search.place_after(compiled.prefix.size());
    own.proof.place_after(compiled.prefix.size());
    std::vector<Source>& sources =
        compiled.sources.emplace_back(question.variables, Source{false, 0, Interval::entire()});
    for (const auto& [input, domain] : unknowns.domains) {
      Source& source = sources[input.variable];
      source.value = domain;
      const auto chosen = cases[i].chosen.find(input);
      if (chosen != cases[i].chosen.end()) source.value = Interval::raw(chosen->second, chosen->second);
      if (const auto reg = register_in(pair.proof, own.proof, input)) source = {true, *reg, {}};
    }
    for (std::size_t p = 0; p < question.parameters.size(); ++p)
      sources[question.parameters[p].variable] = {true, static_cast<Register>(p), {}};
    for (std::size_t v = 0; v < pair.proof.core.size(); ++v) {
      const auto reg = register_in(pair.search, own.search, pair.proof.core[v]);
      own.candidate.push_back({reg.has_value(), reg.value_or(0), own.proof_domains[v]});
    }
    for (std::size_t v = 0; v < pair.search.core.size(); ++v) {
      const auto reg = register_in(pair.proof, own.proof, pair.search.core[v]);
      own.found.push_back({reg.has_value(), reg.value_or(0), own.search_domains[v]});
    }
  }
  compiled.givens = share_givens(compiled.prefix, compiled.cases);
  return compiled;
}

}  // namespace hcsp::online
