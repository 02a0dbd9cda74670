// SPDX-License-Identifier: Apache-2.0
// A Problem as a system of relations between reals, and its solutions.
#include <algorithm>

#include "solver/expression/substitution.h"
#include "solver/online/compiled_problem.h"
#include "solver/problem_impl.h"
#include "solver/search/branch_and_bound.h"
#include "solver/search/branch_and_prune.h"

namespace hcsp {

namespace {

// Of the unknowns that some relation speaks of; the others may have any value of their domains.
std::vector<Input> inputs_of(const Dag& dag, const std::vector<NodeId>& relations) {
  return relations.empty() ? std::vector<Input>{} : Program(dag, relations).inputs();
}

std::vector<NodeId> joined(std::vector<NodeId> all, const std::vector<NodeId>& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

struct CompiledAnswer {
  KnownOptimum known;
  std::string refuted_by;  ///< a constraint, where there is no solution
};

// The unknowns of a search, and what its boxes tell of all of the problem's.
struct SearchView {
  const ProblemView problem;
  const std::set<VariableId>& given;
  std::vector<System::Unknown> unknowns;
  std::map<VariableId, std::size_t> place_of;

  SearchView(const ProblemView& view, const std::vector<Input>& inputs, const std::set<VariableId>& whole,
             const std::set<VariableId>& given_numbers, const std::map<VariableId, Interval>& certain)
      : problem(view), given(given_numbers) {
    for (const Input& input : inputs) {
      place_of.emplace(input.variable, unknowns.size());
      unknowns.push_back(
          {input, view.graph.initial<Interval>(input.variable), whole.contains(input.variable)});
      const auto known = certain.find(input.variable);
      if (known != certain.end()) unknowns.back().certain = known->second;
    }
  }

  [[nodiscard]] std::vector<ResultVariable> variables_in(const std::vector<Interval>& box) const {
    const auto value_of = [&](VariableId id) {
      const auto place = place_of.find(id);
      return place == place_of.end() ? problem.graph.initial<Interval>(id) : box[place->second];
    };
    return declared_domains(problem, [&](VariableId id) -> Domain {
      const bool is_tube = problem.kinds[id] == DomainKind::polynomial;
      return is_tube ? problem.polynomials(id, value_of) : Domain(value_of(id));
    });
  }

  // Where a family has no solution there may be others, anywhere.
  [[nodiscard]] std::vector<Interval> domains() const {
    std::vector<Interval> all;
    for (const System::Unknown& unknown : unknowns) all.push_back(unknown.domain);
    return all;
  }

  // What compiling finds: on phases it eliminates what is defined, and so proves limits that are reached,
  // which search by itself cannot.
  [[nodiscard]] CompiledAnswer compiled_answer(Problem& stated, Expr objective,
                                               const SearchOptions& options) const {
    CompiledAnswer answer;
    KnownOptimum& known = answer.known;
    try {
      OnlineOptions online;
      online.precision = options.precision;
      online.most_boxes = 20000;  // there is no cycle to keep
      CompiledProblem compiled = compile(stated, objective, online);
      const OnlineStatus status = compiled.solve();
      if (status == OnlineStatus::infeasible) answer.refuted_by = compiled.reason();
      if (!compiled.reason().empty()) known.minimum = Interval::empty();
      if (!compiled.has_solution()) return answer;
      known.minimum = compiled.objective();
      known.solution.emplace();
      for (const System::Unknown& unknown : unknowns)
        known.solution->push_back(compiled.value(RealVariable{unknown.input.variable}));
    } catch (const std::invalid_argument&) {  // too many cases
    }
    return answer;
  }

  // Unknowns that are in no relation have many values.
  [[nodiscard]] bool is_of_all() const {
    for (VariableId v = 0; v < problem.kinds.size(); ++v) {
      const bool has_values =
          problem.kinds[v] == DomainKind::real && !place_of.contains(v) && !given.contains(v);
      if (has_values && !problem.graph.initial<Interval>(v).is_point()) return false;
    }
    return true;
  }
};

// A result with the boxes of a search in it, and around all of them.
Result result_of(const SearchView& view, const std::vector<FoundBox>& found,
                 const std::vector<std::vector<Interval>>& unexplored, std::uint64_t cells) {
  Result result;
  result.model = view.problem.name;
  result.search.emplace();
  result.search->cells = cells;
  std::vector<Interval> around(view.unknowns.size(), Interval::empty());
  const auto widen = [&](const std::vector<Interval>& box) {
    for (std::size_t v = 0; v < box.size(); ++v) around[v] = join(around[v], box[v]);
  };
  for (const FoundBox& box : found) {
    const bool is_one_of_many = box.certificate == Certificate::unique && !view.is_of_all();
    result.search->solutions.push_back(
        {is_one_of_many ? Certificate::exists : box.certificate, box.reason, view.variables_in(box.box)});
    widen(box.box);
  }
  for (const std::vector<Interval>& box : unexplored) {
    result.search->unexplored.push_back(view.variables_in(box));
    widen(box);
  }
  const bool is_feasible = !found.empty() || !unexplored.empty();
  result.status = !unexplored.empty() ? Status::limit : is_feasible ? Status::solved : Status::infeasible;
  result.variables = view.variables_in(around);
  for (ResultVariable& variable : result.variables) {
    if (!is_feasible) std::visit([](auto& domain) { domain = bottom(domain); }, variable.domain);
  }
  return result;
}

void tell_time(Result& result, double started, const SearchOptions& options) {
  result.statistics.seconds = options.spent_before + options.clock() - started;
  result.statistics.threads = options.threads;
}

}  // namespace

// A number of several values is one of them wherever it stands, and another one than any else's.
NodeId Problem::Impl::with_values_of_parameters(NodeId id) {
  std::map<NodeId, NodeId> places;
  for (const VariableId parameter : parameters) {
    const Interval& value = graph.initial<Interval>(parameter);
    std::optional<NodeId>& own = values_of_parameters[parameter];
    const auto follows = followed.find(parameter);
    if (!own && follows != followed.end()) own = Substitution(dag, places).of(follows->second);
    if (!own) own = value.is_point() ? dag.constant(value) : dag.own_constant(value);
    places.emplace(input(Input::Kind::real, parameter, 0).node(), *own);
  }
  return Substitution(dag, std::move(places)).of(id);
}

Problem::Impl::SearchRelations Problem::Impl::relations_of_search() {
  SearchRelations all;
  for (const Stated& stated : relations)
    (stated.is_implied ? all.implied : all.stated).push_back(with_values_of_parameters(stated.relation));
  bool is_possible = true;
  for (VariableId v = 0; v < kinds.size(); ++v)
    is_possible = is_possible && !graph.initial<Interval>(v).is_empty();
  if (!is_possible) all.stated.push_back(dag.constant(kFalse));
  return all;
}

bool Problem::is_system() const { return is_region() && impl_->bound.empty(); }

Result Problem::solve_all(const SearchOptions& options) {
  require(is_system(), "Problem: solve_all() is for relations between reals");
  require(options.precision > 0, "Problem: a precision of {}", options.precision);
  const double started = options.clock();
  define_phases();
  const auto [relations, implied] = impl_->relations_of_search();
  const SearchView view(impl_->view(), inputs_of(impl_->dag, joined(relations, implied)), impl_->whole,
                        impl_->parameters, impl_->certain);
  const System system(impl_->dag, relations, view.unknowns, implied);
  SearchAnswer answer = branch_and_prune(system, options);
  if (answer.found.empty() && answer.unexplored.empty() && !impl_->family.empty())
    answer.unexplored.push_back(view.domains());
  Result result = result_of(view, answer.found, answer.unexplored, answer.cells);
  tell_time(result, started, options);
  return result;
}

Result Problem::minimize(Expr objective, const SearchOptions& options) {
  require(is_system(), "Problem: minimize() is for relations between reals");
  require(options.precision > 0, "Problem: a precision of {}", options.precision);
  require(!impl_->holds_or_not(impl_->node_of(objective)), "Problem: the objective is a relation");
  const double started = options.clock();
  define_phases();
  if (impl_->phases != nullptr) objective = impl_->phases->expand(objective);
  const NodeId node = impl_->with_values_of_parameters(objective.node());
  const auto [relations, implied] = impl_->relations_of_search();
  std::vector<NodeId> all = joined(relations, implied);
  all.push_back(node);
  const SearchView view(impl_->view(), inputs_of(impl_->dag, all), impl_->whole, impl_->parameters,
                        impl_->certain);
  const Input value{Input::Kind::real, static_cast<VariableId>(impl_->kinds.size()), 0, 0};
  const Minimisation problem(impl_->dag, node, relations, view.unknowns, value, implied);
  const CompiledAnswer compiled =
      impl_->phases == nullptr ? CompiledAnswer{} : view.compiled_answer(*this, objective, options);
  MinimumAnswer answer = branch_and_bound(problem, options, compiled.known);
  if (answer.minimum.is_empty() && compiled.refuted_by.empty() && !impl_->family.empty()) {
    answer.minimum = Interval::entire();
    answer.unexplored.push_back(view.domains());
  }
  std::vector<FoundBox> found;
  if (answer.best) found.push_back({*answer.best, Certificate::exists, Reason::proven});
  for (const std::vector<Interval>& box : answer.boxes)
    found.push_back({box, Certificate::none, Reason::boundary});
  Result result = result_of(view, found, answer.unexplored, answer.cells);
  result.objective = answer.minimum;
  if (!compiled.refuted_by.empty()) result.explanation = Explanation{compiled.refuted_by, {}, {}, {}, true};
  tell_time(result, started, options);
  return result;
}

Result Problem::maximize(Expr objective, const SearchOptions& options) {
  Result result = minimize(-objective, options);
  result.objective = -*result.objective;
  return result;
}

}  // namespace hcsp
