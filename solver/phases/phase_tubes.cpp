// SPDX-License-Identifier: Apache-2.0
// Which statements define the tubes. Expansion is in phase_expansion.cpp.
#include "solver/phases/phase_tubes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "domains/check.h"
#include "solver/expression/operators.h"
#include "solver/phases/folding.h"

namespace hcsp {

PhaseTubes::PhaseTubes(Dag& dag, std::vector<Expr> durations, Expr end)
    : dag_(dag), durations_(std::move(durations)) {
  gates_.push_back(folding::number(dag, 0.0));
  for (const Expr& duration : durations_) gates_.push_back(folding::sum(gates_.back(), duration));
  gates_.back() = end;
}

// The sum of all durations is the end, too.
std::optional<std::size_t> PhaseTubes::gate_of(Expr instant) const {
  for (std::size_t k = 0; k < gates_.size(); ++k) {
    if (gates_[k].node() == instant.node()) return k;
  }
  const Expr sum = folding::sum(gates_[gates_.size() - 2], durations_.back());
  return sum.node() == instant.node() ? std::optional(phases()) : std::nullopt;
}

void PhaseTubes::declare(VariableId tube, std::string name, std::size_t dim) {
  dims_[tube] = dim;
  for (std::uint32_t c = 0; c < dim; ++c)
    components_[{tube, c}].name = dim == 1 ? name : fmt::format("{}[{}]", name, c + 1);
}

void PhaseTubes::declare_hold(VariableId tube, std::string name,
                              const std::vector<std::vector<Expr>>& values) {
  require(values.size() == phases(), "Problem: {} values that hold for {} phases", values.size(), phases());
  const std::size_t dim = values.front().size();
  declare(tube, std::move(name), dim);
  for (std::uint32_t c = 0; c < dim; ++c) components_[{tube, c}].held = values_of_component(values, c);
}

std::vector<Expr> PhaseTubes::values_of_component(const std::vector<std::vector<Expr>>& values,
                                                  std::size_t component) {
  std::vector<Expr> held;
  for (const std::vector<Expr>& of_phase : values) {
    require(of_phase.size() == values.front().size(), "Problem: vectors of {} and {} components that hold",
            values.front().size(), of_phase.size());
    held.push_back(of_phase[component]);
  }
  return held;
}

// ---- Claims: conjuncts of the statements.

void PhaseTubes::collect_claims(const std::vector<PhaseStatement>& statements) {
  claims_.clear();
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const PhaseStatement& statement = statements[i];
    if (statement.derivative_of) {
      const Leaf leaf{statement.derivative_of->variable, statement.derivative_of->component};
      claims_.push_back(std::make_unique<Claim>(Claim{i, statement.expression, leaf}));
      if (!statement.span) components_.at(leaf).derivatives.push_back(claims_.back().get());
    } else {
      collect_conjuncts(statement, i, statement.expression);
    }
  }
}

void PhaseTubes::collect_conjuncts(const PhaseStatement& statement, std::size_t number, NodeId node) {
  if (dag_[node].op == Op::logical_and) {
    for (const std::size_t side : {0U, 1U}) collect_conjuncts(statement, number, dag_[node].operands[side]);
    return;
  }
  claims_.push_back(std::make_unique<Claim>(Claim{number, node, {}}));
  const bool may_define = !statement.is_implied && !statement.span;
  if (may_define && dag_[node].op == Op::equal) collect_candidates(*claims_.back());
}

// x == f defines x, and x(0) == e its value at the start.
void PhaseTubes::collect_candidates(Claim& claim) {
  const auto sides = dag_[claim.expression].operands;
  for (const std::size_t side : {0U, 1U}) {
    const NodeId other = sides[1 - side];
    if (const auto leaf = leaf_in(sides[side], Input::Kind::tube))
      components_.at(*leaf).equal_to.emplace_back(&claim, other);
    const auto leaf = leaf_in(sides[side], Input::Kind::gate);
    const bool is_start = leaf && dag_[sides[side]].input.gate == 0 && !mentions_tubes(other);
    if (is_start) components_.at(*leaf).starts.emplace_back(&claim, other);
  }
}

std::optional<PhaseTubes::Leaf> PhaseTubes::leaf_in(NodeId node, Input::Kind kind) const {
  const DagNode& found = dag_[node];
  if (found.op != Op::input || found.input.kind != kind) return {};
  return Leaf{found.input.variable, found.input.component};
}

bool PhaseTubes::mentions_tubes(NodeId node) const {
  const std::vector<NodeId> needed = needed_nodes(dag_, {node});
  return std::any_of(needed.begin(), needed.end(), [&](NodeId id) {
    const DagNode& leaf = dag_[id];
    return leaf.op == Op::input && leaf.input.kind != Input::Kind::real &&
           leaf.input.kind != Input::Kind::point;
  });
}

// ---- Definitions.

// False where none of the candidates gives one: for now, where tubes that are at hand occur in them.
bool PhaseTubes::define(Component& component) {
  if (component.function) return true;
  if (component.is_at_hand) return false;
  component.is_at_hand = true;
  const bool is_defined = !component.held.empty()
                              ? define_by_values(component)
                              : define_by_equation(component) || define_by_derivative(component);
  component.is_at_hand = false;
  return is_defined;
}

bool PhaseTubes::define_by_values(Component& component) {
  for (const Expr& value : component.held) {
    if (!can_define(value.node())) return false;
  }
  std::vector<Expr> values;
  for (const Expr& value : component.held) values.push_back(expanded_at_gates(value.node()));
  component.function = PhaseFunction::hold(values);
  return true;
}

bool PhaseTubes::define_by_equation(Component& component) {
  for (const auto& [claim, value] : component.equal_to) {
    if (claim->is_used || !can_define(value)) continue;
    claim->use(value);
    const auto outer = std::exchange(at_hand_, claim->statement);
    component.function = function_of(value);
    at_hand_ = outer;
    return true;
  }
  return false;
}

bool PhaseTubes::define_by_derivative(Component& component) {
  for (Claim* claim : component.derivatives) {
    if (!can_define(claim->expression)) continue;
    claim->use(claim->expression);
    const auto outer = std::exchange(at_hand_, claim->statement);
    std::optional<Expr> start;
    for (const auto& [stated, value] : component.starts) {
      if (stated->is_used) continue;
      stated->use(value);
      start = expr(value);
      break;
    }
    if (!start) start = unknown_start_(component.name + "(0)");
    component.function = PhaseFunction::integral(durations_, function_of(claim->expression), *start);
    at_hand_ = outer;
    return true;
  }
  return false;
}

// Whether all tubes that an expression takes are defined, or can be.
bool PhaseTubes::can_define(NodeId expression) {
  for (const NodeId id : needed_nodes(dag_, {expression})) {
    const DagNode& leaf = dag_[id];
    const bool is_tube = leaf.op == Op::input &&
                         (leaf.input.kind == Input::Kind::tube || leaf.input.kind == Input::Kind::gate);
    if (is_tube && !define(components_.at({leaf.input.variable, leaf.input.component}))) return false;
  }
  return true;
}

const PhaseFunction& PhaseTubes::function(VariableId tube, std::size_t component) const {
  return *components_.at({tube, static_cast<std::uint32_t>(component)}).function;
}

}  // namespace hcsp
