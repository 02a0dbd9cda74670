// SPDX-License-Identifier: Apache-2.0
// A Problem whose time line is made of phases: its tubes become polynomials, and what is stated of them
// relations between reals.
#include "solver/contractors/relation.h"
#include "solver/phases/folding.h"
#include "solver/problem_impl.h"

namespace hcsp {

void Problem::set_phases(Expr end, const VectorExpr& durations) {
  require(impl_->phases == nullptr && impl_->line == nullptr,
          "Problem: there is one time line, and it is set already");
  require(!durations.empty(), "Problem: a time line of no phases");
  impl_->node_of(end);
  Expr total = constant(Interval(0.0));
  for (const Expr& duration : durations) {
    impl_->node_of(duration);
    total = folding::sum(total, duration);
  }
  impl_->phases = std::make_unique<PhaseTubes>(impl_->dag, durations, end);
  constrain("phases", end == total);
  for (const Expr& duration : durations) {
    const DagNode& node = impl_->dag[duration.node()];
    const bool is_known =
        node.op == Op::input && impl_->graph.initial<Interval>(node.input.variable).lo() >= 0.0;
    if (!is_known) constrain("phases", Interval(0.0) <= duration);
  }
}

std::size_t Problem::phases() const { return impl_->phases == nullptr ? 0 : impl_->phases->phases(); }

Expr Problem::gate(std::size_t k) {
  require(impl_->phases != nullptr && k <= impl_->phases->phases(), "Problem: there is no gate {}", k);
  return impl_->phases->gate(k);
}

std::optional<std::size_t> Problem::gate_at(Expr instant) const {
  return impl_->phases == nullptr ? std::nullopt : impl_->phases->gate_of(instant);
}

void Problem::during_phases(std::size_t from, std::size_t to, const std::function<void()>& body) {
  require(from < to && to <= phases(), "Problem: no time between the gates {} and {}", from, to);
  const Meanwhile at_hand(impl_->span, std::optional(PhaseSpan{from, to}));
  body();
}

TubeVariable Problem::hold(const std::vector<VectorExpr>& values) {
  require(impl_->phases != nullptr, "Problem: hold() needs a time line with phases");
  require(!values.empty() && !values.front().empty(), "Problem: no values that hold");
  for (const VectorExpr& of_phase : values) {
    for (const Expr& value : of_phase) impl_->node_of(value);
  }
  const std::string name = impl_->free_name("hold");
  const TubeVariable tube{impl_->add(name, Interval::entire(), DomainKind::polynomial, true),
                          values.front().size()};
  impl_->phases->declare_hold(tube.id, name, values);
  return tube;
}

void Problem::define_phases() { impl_->expand_phases(); }

TubeVariable Problem::Impl::add_phase_tube(const std::string& tube, std::size_t dim) {
  const TubeVariable made{add(tube, Interval::entire(), DomainKind::polynomial), dim};
  phases->declare(made.id, tube, dim);
  return made;
}

void Problem::Impl::state_on_phases(PhaseStatement statement) {
  require(!is_expanded, "Problem: {} is stated after the phases were defined", statement.name);
  statement.span = span;
  statements.push_back(std::move(statement));
}

void Problem::Impl::expand_phases() {
  if (phases == nullptr || is_expanded) return;
  const auto unknown_start = [&](const std::string& start) {
    return input(Input::Kind::real, add(free_name(start), Interval::entire(), DomainKind::real, true), 0);
  };
  for (const auto& [stated, relation, is_implied] : phases->expand(statements, unknown_start)) {
    if (dag[relation.node()].op == Op::constant && dag[relation.node()].value == kTrue) continue;
    relations.push_back({stated, relation.node(), is_implied});
    state(make_relation_contractor(stated, dag, relation.node(), context()), true);
  }
  is_expanded = true;
}

}  // namespace hcsp
