// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/minibex/compiler.h"

namespace hcsp::lang::minibex {

namespace {

constexpr std::uint64_t kStepsOfAConstraint = 100;  // it takes that much more memory than an expression

}  // namespace

void Compiler::goal() {
  if (program_.goal == nullptr) return;
  const Tensor found = evaluator_.value(*program_.goal);
  if (found.failed()) return;
  if (!found.is_scalar()) {
    diagnostics_.report(Code::wrong_type, program_.goal->range, "a number", describe(found));
    return;
  }
  objective_ = expression_of(*problem_, found.terms.front());
}

// After a mistake the next statements are looked at too, but a loop ends: it would repeat the mistake.
bool Compiler::state(const std::vector<Statement>& statements) {
  bool good = true;
  for (const Statement& statement : statements) {
    if (diagnostics_.count() >= kMostMistakes) return false;
    good = state(statement) && good;
  }
  return good;
}

bool Compiler::state(const Statement& statement) {
  if (const auto* loop = std::get_if<Loop>(&statement.content)) {
    return evaluator_.for_each(*loop->first, *loop->last, loop->iterator, [&] { return state(loop->body); });
  }
  if (const auto* integrality = std::get_if<Integrality>(&statement.content))
    return state_whole(statement, *integrality->argument);
  const Relation& relation = std::get<Relation>(statement.content);
  if (relation.op == Operator::in) return state_membership(statement, relation);
  return is_definition(relation) ? define(relation) : state_relation(statement, relation);
}

// A new name on the left is one for what is on the right.
bool Compiler::is_definition(const Relation& relation) {
  return relation.op == Operator::equal && relation.left->kind == Kind::name && relation.left->text != "pi" &&
         evaluator_.scope().find(relation.left->text) == nullptr;
}

bool Compiler::define(const Relation& relation) {
  Tensor value = evaluator_.value(*relation.right);
  const bool good = !value.failed();
  evaluator_.scope().names.emplace(relation.left->text, Binding{std::move(value), {}});
  return good;
}

// Component by component; a number on one side is compared with every component of the other.
bool Compiler::state_relation(const Statement& statement, const Relation& relation) {
  const Tensor a = evaluator_.value(*relation.left);
  const Tensor b = a.failed() ? Tensor() : evaluator_.value(*relation.right);
  if (b.failed()) return false;
  if (!a.has_shape_of(b) && !a.is_scalar() && !b.is_scalar()) {
    diagnostics_.report(Code::sizes_differ, statement.range, describe(a), describe(b));
    return false;
  }
  const std::size_t count = std::max(a.terms.size(), b.terms.size());
  if (!evaluator_.take_steps(*relation.left, kStepsOfAConstraint * count)) return false;
  for (std::size_t i = 0; i < count; ++i)
    state_truth(statement, relation.op, a.terms[a.is_scalar() ? 0 : i], b.terms[b.is_scalar() ? 0 : i]);
  return true;
}

bool Compiler::state_membership(const Statement& statement, const Relation& relation) {
  const Tensor left = evaluator_.value(*relation.left);
  const auto bounds = left.failed() ? std::nullopt : evaluator_.bounds(*relation.right);
  if (!bounds || !evaluator_.take_steps(*relation.left, kStepsOfAConstraint * left.terms.size()))
    return false;
  const bool is_point =
      bounds->lo && bounds->hi && known_relation(Operator::equal, *bounds->lo, *bounds->hi).value_or(false);
  for (const Term& term : left.terms) {
    if (is_point) {
      state_truth(statement, Operator::equal, term, *bounds->lo);
      continue;
    }
    if (bounds->lo) state_truth(statement, Operator::greater_equal, term, *bounds->lo);
    if (bounds->hi) state_truth(statement, Operator::less_equal, term, *bounds->hi);
  }
  return true;
}

bool Compiler::state_whole(const Statement& statement, const Expr& argument) {
  const Tensor found = evaluator_.value(argument);
  if (!evaluator_.take_steps(argument, kStepsOfAConstraint * found.terms.size())) return false;
  for (const Term& term : found.terms) {
    const auto* expr = std::get_if<hcsp::Expr>(&term);
    if (expr != nullptr && whole_nodes_.contains(expr->node())) continue;
    state_truth(statement, Operator::equal, term, scalar_function(BuiltIn::floor, term));
  }
  return !found.failed();
}

void Compiler::state_truth(const Statement& statement, Operator op, const Term& a, const Term& b) {
  if (known_relation(op, a, b).value_or(false)) return;
  problem_->constrain(next_name(statement),
                      compare(op, expression_of(*problem_, a), expression_of(*problem_, b)));
}

// By the line, and from the second one on it by a number.
std::string Compiler::next_name(const Statement& statement) {
  const std::size_t line = statement.range.source->position(statement.range.begin).line;
  const std::size_t count = ++named_[line];
  return count == 1 ? fmt::format("line {}", line) : fmt::format("line {}.{}", line, count);
}

}  // namespace hcsp::lang::minibex
