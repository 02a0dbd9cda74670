// SPDX-License-Identifier: Apache-2.0
// A time line with phases: its durations are unknowns before there are tubes, and what was stated of the
// tubes becomes polynomials when all is stated.
#include "lang/compile/compiler.h"

namespace hcsp::lang {

// What has no tube in it comes first: the durations are made of it.
bool Compiler::make_phases() {
  const TimeItem& item = *model_.time->as<TimeItem>();
  for (const Symbol& symbol : model_.symbols) {
    if (is_unknown(symbol) && !symbol.type.tube && !symbol.open) make_unknown(symbol);
  }
  if (model_.diagnostics().any()) return false;
  const Value end = evaluator_.value(*item.span->operands[1]), durations = evaluator_.value(*item.phases);
  if (end.empty() || durations.empty()) return false;
  VectorExpr phases;
  for (const Term& duration : durations) phases.push_back(expression_of(*problem_, duration));
  guarded(item.phases->range, [&] { problem_->set_phases(expression_of(*problem_, end.front()), phases); });
  places_["phases"] = item.phases->range;
  return !model_.diagnostics().any();
}

// Whether it is the vector of the durations, which are not negative.
bool Compiler::is_duration(const Symbol& symbol) const {
  if (!model_.has_phases()) return false;
  const Expr& durations = *model_.time->as<TimeItem>()->phases;
  return durations.kind == ExprKind::name && model_.reference(durations).symbol == &symbol;
}

std::optional<std::size_t> Compiler::gate_in(const Expr& expr) {
  const Value instant = evaluator_.value(expr);
  if (instant.empty()) return {};
  const auto gate = problem_->gate_at(expression_of(*problem_, instant.front()));
  if (!gate) model_.diagnostics().report(Code::no_gate, expr.range, "an instant is 0, T or `gate(k)`");
  return gate;
}

// forall(t in [gate(i), gate(j)]), or forall(t) of what has no value as a relation.
void Compiler::state_over_phases(const Expr& expr, bool wanted) {
  if (!wanted)
    return not_supported(expr.range, "that this does not hold at all times on a time line with phases");
  const Expr* span = expr.bindings[0].domain;
  if (span == nullptr) return state(*expr.operands[0], true);
  const auto from = gate_in(*span->operands[0]), to = gate_in(*span->operands[1]);
  if (!from || !to) return;
  if (*from >= *to) {
    model_.diagnostics().report(Code::empty_interval, span->range);
    return;
  }
  guarded(expr.range, [&] { problem_->during_phases(*from, *to, [&] { state(*expr.operands[0], true); }); });
}

void Compiler::define_phases() {
  try {
    problem_->define_phases();
  } catch (const PhaseError& error) {
    report(error);
  }
}

void Compiler::report(const PhaseError& error) {
  if (!error.tube) {
    const auto place = places_.find(error.constraint);
    const SourceRange range = place == places_.end() ? model_.time->name.range : place->second;
    model_.diagnostics().report(Code::no_polynomial, range, error.what());
    return;
  }
  for (const auto& [symbol, handles] : unknowns_.handles) {
    for (const Unknowns::Handle& handle : handles) {
      const auto* tube = std::get_if<TubeVariable>(&handle);
      if (tube == nullptr || tube->id != *error.tube) continue;
      model_.diagnostics().report(Code::undefined_tube, symbol->name.range, symbol->name.text);
      return;
    }
  }
}

}  // namespace hcsp::lang
