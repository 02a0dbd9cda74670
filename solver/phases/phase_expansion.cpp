// SPDX-License-Identifier: Apache-2.0
// What statements about tubes on phases say of reals.
#include <fmt/format.h>

#include <algorithm>

#include "solver/expression/operators.h"
#include "solver/expression/substitution.h"
#include "solver/phases/folding.h"
#include "solver/phases/for_all_time.h"
#include "solver/phases/phase_tubes.h"

namespace hcsp {

std::vector<PhaseTubes::Expanded> PhaseTubes::expand(
    const std::vector<PhaseStatement>& statements,
    const std::function<Expr(const std::string&)>& unknown_start) {
  unknown_start_ = unknown_start;
  statements_ = &statements;
  collect_claims(statements);
  for (auto& [leaf, component] : components_) {
    if (define(component)) continue;
    throw PhaseError(leaf.first, fmt::format("{} has no definition: der({}) == f, or {} == f", component.name,
                                             component.name, component.name));
  }
  std::vector<std::vector<Expr>> parts(statements.size());
  for (const auto& claim : claims_) {
    at_hand_ = claim->statement;
    span_ = statements[claim->statement].span;
    parts[claim->statement].push_back(claim->is_used ? definedness(*claim) : expanded_claim(*claim));
  }
  std::vector<Expanded> all;
  for (std::size_t i = 0; i < statements.size(); ++i)
    all.push_back({statements[i].name, folding::conjunction(dag_, parts[i]), statements[i].is_implied});
  statements_ = nullptr;
  return all;
}

Expr PhaseTubes::expand(Expr expression) { return expanded_at_gates(expression.node()); }

void PhaseTubes::refuse(const std::string& message) const {
  throw PhaseError(statements_ == nullptr || !at_hand_ ? std::string() : (*statements_)[*at_hand_].name,
                   message);
}

// A definition states no more than that what it equates has a value.
Expr PhaseTubes::definedness(const Claim& claim) {
  std::vector<Expr> all;
  const PhaseFunction function = function_of(claim.defined_by);
  for (const Piece& piece : function.pieces()) {
    for (const Expr& coefficient : piece.polynomial.coefficients)
      all.push_back(folding::equality(coefficient, coefficient));
  }
  return folding::conjunction(dag_, all);
}

Expr PhaseTubes::expanded_claim(const Claim& claim) {
  if (!claim.derivative_of) return expanded_relation(claim.expression);
  const PhaseFunction& x = *components_.at(*claim.derivative_of).function;
  const PhaseFunction slope = function_of(claim.expression);
  return folding::conjunction(dag_, derivative_for_all_time(in_span(x), in_span(slope)));
}

// A relation between tubes is one truth: that it holds at every instant.
Expr PhaseTubes::expanded_relation(NodeId node) {
  if (!mentions_tubes(node)) return expr(node);
  const DagNode at = dag_[node];
  if (is_relation(at.op)) return expanded_comparison(node);
  if (!is_boolean(at.op) && at.op != Op::if_then_else) refuse("this is no relation between tubes");
  if (is_quantifier(at.op)) refuse("a tube within a quantifier over reals on a time line with phases");
  std::array<NodeId, 3> operands = at.operands;
  const int arity = operator_entry(at.op).arity;
  for (int k = 0; k < arity; ++k) {
    NodeId& operand = operands[static_cast<std::size_t>(k)];
    operand = expanded_relation(operand).node();
  }
  return expr(dag_.apply(at.op, operands, arity));
}

Expr PhaseTubes::expanded_comparison(NodeId node) {
  const DagNode at = dag_[node];
  const PhaseFunction a = in_span(function_of(at.operands[0])), b = in_span(function_of(at.operands[1]));
  const auto x = a.constant(), y = b.constant();
  if (x && y) {
    if (at.op == Op::equal) return folding::equality(*x, *y);
    return expr(dag_.apply(at.op, {x->node(), y->node()}, 2));
  }
  if (at.op == Op::equal) return folding::conjunction(dag_, equal_for_all_time(a, b));
  if (at.op == Op::not_equal) refuse("tubes that differ at every instant on a time line with phases");
  const auto first = durations_.begin() + static_cast<std::ptrdiff_t>(span_ ? span_->from : 0);
  const std::vector<Expr> durations(first, first + static_cast<std::ptrdiff_t>(a.pieces().size()));
  const auto less = less_for_all_time(durations, a, b, at.op == Op::less);
  if (!less)
    refuse(
        "the sides of this inequality differ by a polynomial of a degree above 3 on some phase: where it is "
        "greatest is not decided");
  return folding::conjunction(dag_, *less);
}

// Of an expression that takes tubes at gates, but not at the time at hand.
Expr PhaseTubes::expanded_at_gates(NodeId node) {
  std::map<NodeId, NodeId> places;
  for (const NodeId id : needed_nodes(dag_, {node})) {
    const DagNode leaf = dag_[id];
    if (leaf.op != Op::input) continue;
    if (leaf.input.kind == Input::Kind::tube || leaf.input.kind == Input::Kind::time)
      refuse("a value that varies with time, where a number belongs");
    if (leaf.input.kind != Input::Kind::gate) continue;
    const PhaseFunction& tube = function(leaf.input.variable, leaf.input.component);
    places.emplace(id, tube.at_gate(leaf.input.gate).node());
  }
  return places.empty() ? expr(node) : expr(Substitution(dag_, std::move(places)).of(node));
}

PhaseFunction PhaseTubes::in_span(const PhaseFunction& function) const {
  return span_ ? function.between(span_->from, span_->to) : function;
}

PhaseFunction PhaseTubes::function_of_time() const {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < phases(); ++i)
    pieces.push_back({{{gates_[i], folding::number(dag_, 1.0)}}, gates_[i + 1]});
  return PhaseFunction(std::move(pieces), true);
}

PhaseFunction PhaseTubes::function_of(NodeId root) {
  for (const NodeId id : needed_nodes(dag_, {root})) {
    if (!functions_.contains(id)) functions_.emplace(id, function_of_node(id));
  }
  return functions_.at(root);
}

PhaseFunction PhaseTubes::function_of_node(NodeId id) {
  const DagNode node = dag_[id];
  if (node.op == Op::input && node.input.kind == Input::Kind::tube)
    return function(node.input.variable, node.input.component);
  if (node.op == Op::input && node.input.kind == Input::Kind::time) return function_of_time();
  if (node.op == Op::input && node.input.kind == Input::Kind::gate)
    return PhaseFunction(durations_,
                         function(node.input.variable, node.input.component).at_gate(node.input.gate));
  if (!mentions_tubes(id)) return PhaseFunction(durations_, expr(id));
  // A truth among numbers is one that is counted.
  if (is_boolean(node.op)) return PhaseFunction(durations_, expanded_relation(id));
  if (node.op == Op::if_then_else && mentions_tubes(node.operands[0]))
    refuse("a choice that falls anew at each instant on a time line with phases");
  std::vector<PhaseFunction> operands;
  bool is_constant = true;
  const int arity = operator_entry(node.op).arity;
  std::array<NodeId, 3> values{};
  for (int k = 0; k < arity; ++k) {
    operands.push_back(functions_.at(node.operands[static_cast<std::size_t>(k)]));
    const auto value = operands.back().constant();
    is_constant = is_constant && value;
    if (value) values[static_cast<std::size_t>(k)] = value->node();
  }
  if (is_constant) return PhaseFunction(durations_, expr(dag_.apply(node.op, values, arity)));
  const auto made = PhaseFunction::apply(node.op, operands);
  if (!made)
    refuse(
        fmt::format("`{}` of a tube is no polynomial of the time, as it has to be on a time line with phases",
                    operator_entry(node.op).name));
  return *made;
}

}  // namespace hcsp
