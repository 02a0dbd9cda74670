// SPDX-License-Identifier: Apache-2.0
// A Problem as a system of relations between reals, and its solutions.
#include <algorithm>

#include "solver/problem_impl.h"
#include "solver/search/branch_and_prune.h"

namespace hcsp {

namespace {

// Of the unknowns that some relation speaks of; the others may have any value of their domains.
std::vector<Input> inputs_of(const Dag& dag, const std::vector<NodeId>& relations) {
  return relations.empty() ? std::vector<Input>{} : Program(dag, relations).inputs();
}

}  // namespace

bool Problem::is_system() const { return is_region() && impl_->bound.empty(); }

Result Problem::solve_all(const SearchOptions& options) {
  require(is_system(), "Problem: solve_all() is for relations between reals");
  require(options.precision > 0, "Problem: a precision of {}", options.precision);
  const double started = options.clock();
  std::vector<System::Unknown> unknowns;
  std::map<VariableId, std::size_t> place_of;
  for (const Input& input : inputs_of(impl_->dag, impl_->relations)) {
    place_of.emplace(input.variable, unknowns.size());
    unknowns.push_back(
        {input, impl_->graph.initial<Interval>(input.variable), impl_->whole.contains(input.variable)});
  }
  const System system(impl_->dag, impl_->relations, unknowns);
  const SearchAnswer answer = branch_and_prune(system, options);

  const auto variables_in = [&](const std::vector<Interval>& box) {
    return declared_domains(impl_->view(), [&](VariableId id) -> Domain {
      const auto place = place_of.find(id);
      return place == place_of.end() ? impl_->graph.initial<Interval>(id) : box[place->second];
    });
  };
  // Unknowns that are in no relation have many values.
  bool all_related = true;
  for (VariableId v = 0; v < impl_->kinds.size(); ++v)
    all_related = all_related && (place_of.contains(v) || impl_->graph.initial<Interval>(v).is_point());
  Result result;
  result.model = impl_->name;
  result.search.emplace();
  result.search->cells = answer.cells;
  std::vector<Interval> around(system.size(), Interval::empty());
  const auto widen = [&](const std::vector<Interval>& box) {
    for (std::size_t v = 0; v < box.size(); ++v) around[v] = join(around[v], box[v]);
  };
  for (const FoundBox& found : answer.found) {
    const bool is_one_of_many = found.certificate == Certificate::unique && !all_related;
    result.search->solutions.push_back(
        {is_one_of_many ? Certificate::exists : found.certificate, found.reason, variables_in(found.box)});
    widen(found.box);
  }
  for (const std::vector<Interval>& box : answer.unexplored) {
    result.search->unexplored.push_back(variables_in(box));
    widen(box);
  }
  const bool is_feasible = !answer.found.empty() || !answer.unexplored.empty();
  result.status = !answer.unexplored.empty() ? Status::limit
                  : is_feasible              ? Status::solved
                                             : Status::infeasible;
  result.variables = variables_in(around);
  for (ResultVariable& variable : result.variables) {
    if (!is_feasible) std::visit([](auto& domain) { domain = bottom(domain); }, variable.domain);
  }
  result.statistics.seconds = options.spent_before + options.clock() - started;
  result.statistics.threads = options.threads;
  return result;
}

}  // namespace hcsp
