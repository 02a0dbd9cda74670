// SPDX-License-Identifier: Apache-2.0
// A Problem as a set, and its subpavings.
#include <algorithm>

#include "domains/interval/kernel.h"
#include "domains/rounding.h"
#include "solver/problem_impl.h"
#include "solver/search/pave.h"

namespace hcsp {

namespace {

// Bounds of the volume of boxes, where a whole number counts 1.
Interval volume_of(const std::vector<Interval>& boxes, const std::vector<System::Unknown>& coordinates) {
  const RoundUpward guard;
  const Interval one = Interval::raw(1.0, 1.0);
  Interval volume = Interval::raw(0.0, 0.0);
  for (std::size_t first = 0; first < boxes.size(); first += coordinates.size()) {
    Interval product = one;
    for (std::size_t v = 0; v < coordinates.size(); ++v) {
      const Interval& side = boxes[first + v];
      const Interval ends = up::sub(Interval::raw(side.hi(), side.hi()), Interval::raw(side.lo(), side.lo()));
      product = up::mul(product, coordinates[v].is_whole ? up::add(ends, one) : ends);
    }
    volume = up::add(volume, product);
  }
  return volume;
}

std::vector<Interval> hull_of(const PavingAnswer& answer, std::size_t dim) {
  std::vector<Interval> hull(dim, Interval::empty());
  for (const auto* boxes : {&answer.boxes.inside, &answer.boxes.boundary, &answer.unexplored}) {
    for (std::size_t i = 0; i < boxes->size(); ++i) hull[i % dim] = join(hull[i % dim], (*boxes)[i]);
  }
  return hull;
}

}  // namespace

bool Problem::is_region() const {
  const bool all_reals = std::all_of(impl_->kinds.begin(), impl_->kinds.end(), [](DomainKind kind) {
    return kind == DomainKind::real || kind == DomainKind::polynomial;
  });
  return all_reals && impl_->is_system;
}

Expr Problem::for_every(std::string name, const Interval& domain, const std::function<Expr(Expr)>& relation,
                        const std::optional<Interval>& certain) {
  return impl_->quantified(Op::for_every, name, domain, relation, certain);
}

Expr Problem::for_some(std::string name, const Interval& domain, const std::function<Expr(Expr)>& relation,
                       const std::optional<Interval>& certain) {
  return impl_->quantified(Op::for_some, name, domain, relation, certain);
}

// The coordinates are free, the other unknowns of the constraints bound by "for some".
PointSet Problem::Impl::point_set_of(const std::vector<Expr>& variables) {
  const auto unknown = [&](const Input& input) {
    System::Unknown made{input, graph.initial<Interval>(input.variable), whole.contains(input.variable)};
    const auto known = certain.find(input.variable);
    if (known != certain.end()) made.certain = known->second;
    return made;
  };
  std::vector<System::Unknown> unknowns;
  std::set<Input> known;
  for (const Expr& variable : variables) {
    require(&variable.dag() == &dag, "Problem: the variable belongs to another problem");
    const DagNode& node = dag[variable.node()];
    const bool is_unknown = node.op == Op::input && !bound.contains(node.input.variable) &&
                            !parameters.contains(node.input.variable);
    require(is_unknown, "Problem: pave() takes unknowns, not expressions");
    require(known.insert(node.input).second, "Problem: {} is paved twice",
            graph.variable(node.input.variable).name());
    unknowns.push_back(unknown(node.input));
  }
  std::vector<NodeId> all = relations_of_search().stated;
  if (all.empty()) all.push_back(dag.constant(kTrue));
  NodeId relation = all.front();
  for (std::size_t i = 1; i < all.size(); ++i) relation = dag.apply(Op::logical_and, {relation, all[i]}, 2);
  const Program program(dag, {relation});
  for (const Input& input : program.inputs()) {
    if (!known.insert(input).second) continue;
    unknowns.push_back(unknown(input));
    if (!bound.contains(input.variable)) relation = dag.apply(Op::for_some, {dag.input(input), relation}, 2);
  }
  return {dag, relation, variables.size(), unknowns};
}

Result Problem::pave(const std::vector<Expr>& variables, const SearchOptions& options) {
  require(is_region(), "Problem: pave() is for relations between reals");
  require(options.precision > 0, "Problem: a precision of {}", options.precision);
  require(!variables.empty(), "Problem: pave() of no variables");
  const double started = options.clock();
  define_phases();
  const PointSet set = impl_->point_set_of(variables);
  PavingAnswer answer = hcsp::pave(set, options);
  const std::vector<System::Unknown> coordinates(set.unknowns.begin(),
                                                 set.unknowns.begin() + static_cast<std::ptrdiff_t>(set.dim));
  Result result;
  result.model = impl_->name;
  Paving& paving = result.paving.emplace();
  for (const System::Unknown& coordinate : coordinates)
    paving.names.push_back(impl_->graph.variable(coordinate.input.variable).name());
  const std::vector<Interval> hull = hull_of(answer, set.dim);
  const bool is_feasible = !hull.front().is_empty();
  const ProblemView view = impl_->view();
  const auto value_of = [&](VariableId id) {
    if (!is_feasible) return Interval::empty();
    for (std::size_t v = 0; v < set.dim; ++v) {
      if (coordinates[v].input.variable == id) return hull[v];
    }
    return impl_->graph.initial<Interval>(id);
  };
  result.variables = declared_domains(view, [&](VariableId id) -> Domain {
    const bool is_tube = view.kinds[id] == DomainKind::polynomial;
    return is_tube ? view.polynomials(id, value_of) : Domain(value_of(id));
  });
  result.status = !answer.unexplored.empty() ? Status::limit
                  : is_feasible              ? Status::solved
                                             : Status::infeasible;
  paving.inside_volume = volume_of(answer.boxes.inside, coordinates).lo();
  paving.boundary_volume =
      (volume_of(answer.boxes.boundary, coordinates) + volume_of(answer.unexplored, coordinates)).hi();
  paving.inside = std::move(answer.boxes.inside);
  paving.boundary = std::move(answer.boxes.boundary);
  paving.outside = std::move(answer.boxes.outside);
  paving.unexplored = std::move(answer.unexplored);
  paving.cells = answer.cells;
  result.statistics.seconds = options.spent_before + options.clock() - started;
  result.statistics.threads = options.threads;
  return result;
}

}  // namespace hcsp
