// SPDX-License-Identifier: Apache-2.0
// Connectives and quantifiers of relations that are constraints themselves: a conjunction is stated part by
// part, everything else as alternatives. Negations go down to the relations; a relation that varies with time
// is one truth, "at every instant", so that not to hold is not to hold at some instant.
#include <algorithm>

#include "lang/compile/compiler.h"

namespace hcsp::lang {

namespace {

// Lets in lets, each used twice, double at each level: a model must not be able to fill the memory.
constexpr std::uint32_t kMostAlternatives = 20'000;

}  // namespace

bool Compiler::connects(const Expr& expr) const {
  switch (expr.kind) {
    case ExprKind::unary:
    case ExprKind::quantified:
    case ExprKind::conditional:
      return true;
    case ExprKind::call:
      return calls(expr, BuiltIn::at_least);
    case ExprKind::binary:
      return is_logical(expr.op) ||
             (is_comparison(expr.op) && model_.type(*expr.operands[0]).is(Type::Kind::boolean));
    default:
      return false;
  }
}

void Compiler::state(const Expr& written, bool wanted) {
  const Expr& expr = model_.unfold(written);
  const bool is_conjunction = expr.kind == ExprKind::binary && expr.op == Operator::logical_and;
  const bool is_for_each =
      expr.kind == ExprKind::quantified && expr.quantifier == Quantifier::forall && ranges_over_numbers(expr);
  if (is_for_each && wanted) return state_for_each(expr, true);
  // Of what holds one by one at every instant, not all hold when one of them fails at some instant.
  const bool one_truth = evaluator_.varies(expr) && of_time_ == OfTime::one_truth;
  if (!model_.is_stated(expr) && (wanted || !one_truth)) return state_relation(expr, wanted);
  if (connects(expr) || is_conjunction) return state_logic(expr, wanted);
  if (!wanted && one_truth) {
    if (model_.is_stated(expr)) return guarded(expr.range, [&] { state_at_an_instant(expr, false); });
    if (const auto relation = relation_of(expr, false))
      guarded(expr.range,
              [&] { problem_->constrain_sometime(next_name(), expression_of(*problem_, *relation)); });
    return;
  }
  const Symbol* callee = expr.kind == ExprKind::call ? model_.reference(*expr.operands[0]).symbol : nullptr;
  if (callee != nullptr && callee->states) return state_call(expr, *callee, wanted);
  const Type side = expr.operands.size() > 1 ? model_.type(*expr.operands[1]) : Type{};
  const bool of_sets = calls(expr, BuiltIn::disjoint) || calls(expr, BuiltIn::meets) ||
                       calls(expr, BuiltIn::subset) || side.is(Type::Kind::set);
  if (of_sets && expr.kind != ExprKind::quantified && !calls(expr, BuiltIn::distance))
    return state_set_relation(expr, wanted);
  if (state_equality(expr)) {
    if (!wanted) not_supported(expr.range, "that this relation does not hold");
    return;
  }
  if (wanted) return state_relation(expr, true);
  state_failure_at_instants(expr);
}

// A relation between reals at instants to be found does not hold, or there is no such instant.
void Compiler::state_failure_at_instants(const Expr& expr) {
  const TimeLine& line = *problem_->time_line();
  std::vector<hcsp::Expr> instants;
  const auto fails = [&] {
    evaluator_.take_instants_to_find();
    evaluator_.take_integrals();
    state_relation(expr, false);
    instants = evaluator_.take_instants_to_find();
    // The integrand may be undefined somewhere, and the relation fail for that.
    if (evaluator_.take_integrals())
      not_supported(expr.range, "that a relation of an integral does not hold");
  };
  const auto is_off_the_line = [&] {
    std::optional<hcsp::Expr> any;
    for (const hcsp::Expr& s : instants) {
      const hcsp::Expr one = s < Interval(line.start()) || s > Interval(line.end());
      any = any ? *any || one : one;
    }
    state_truth(any ? Term(*any) : boolean(false));
  };
  guarded(expr.range, [&] { problem_->constrain_at_least(next_name(), 1, {fails, is_off_the_line}); });
}

// Whether a choice may fall differently at different instants: it may not where the condition is always the
// same, or all relations but one are.
bool Compiler::chooses_anew(const Expr& expr) const {
  if (expr.kind == ExprKind::conditional) return evaluator_.varies(*expr.operands[0]);
  const bool is_count = expr.kind == ExprKind::call;
  const std::vector<Expr*>& relations = is_count ? expr.operands[2]->operands : expr.operands;
  return std::count_if(relations.begin(), relations.end(),
                       [&](const Expr* relation) { return evaluator_.varies(*relation); }) > 1;
}

void Compiler::state_logic(const Expr& expr, bool wanted) {
  if (expr.kind == ExprKind::quantified) return state_quantified(expr, wanted);
  if (expr.kind == ExprKind::unary) return state(*expr.operands[0], !wanted);
  const bool is_conjunction = expr.op == (wanted ? Operator::logical_and : Operator::logical_or);
  if (of_time_ == OfTime::every_instant && !is_conjunction && chooses_anew(expr))
    return state_at_each_instant(expr, wanted);
  if (expr.kind == ExprKind::call) {
    const auto least = evaluator_.whole(*expr.operands[1]);
    std::vector<Alternative> alternatives;
    for (const Expr* relation : expr.operands[2]->operands) alternatives.push_back({{{relation, wanted}}});
    const int count = static_cast<int>(alternatives.size());
    if (least) state_at_least(expr, wanted ? *least : count - *least + 1, std::move(alternatives));
    return;
  }
  const Expr &a = *expr.operands[0], &b = *expr.operands[1];
  if (expr.kind == ExprKind::conditional) {
    const Claim then{&b, wanted}, otherwise{expr.operands[2], wanted};
    return state_at_least(expr, 1, {{{{&a, true}, then}}, {{{&a, false}, otherwise}}});
  }
  const bool is_equivalence = expr.op == Operator::iff || expr.op == Operator::equal;
  switch (expr.op) {
    case Operator::logical_and:
    case Operator::logical_or:
      if ((expr.op == Operator::logical_and) == wanted) {
        state(a, wanted);
        state(b, wanted);
        return;
      }
      return state_at_least(expr, 1, {{{{&a, wanted}}}, {{{&b, wanted}}}});
    case Operator::implies:
      if (wanted) return state_at_least(expr, 1, {{{{&a, false}}}, {{{&b, true}}}});
      state(a, true);
      return state(b, false);
    default:
      return state_at_least(
          expr, 1,
          {{{{&a, true}, {&b, is_equivalence == wanted}}}, {{{&a, false}, {&b, is_equivalence != wanted}}}});
  }
}

void Compiler::state_quantified(const Expr& expr, bool wanted) {
  if (!ranges_over_numbers(expr)) return state_over_time(expr, wanted);
  if (expr.quantifier == Quantifier::forall && wanted) return state_for_each(expr, true);
  if (expr.quantifier == Quantifier::exists && !wanted) return state_for_each(expr, false);
  std::vector<Alternative> alternatives;
  const bool bound = evaluator_.for_each(expr, [&](const std::vector<int>& at) {
    alternatives.push_back({{{expr.operands[0], wanted}}, at});
    return true;
  });
  if (!bound) return;
  if (of_time_ == OfTime::every_instant && evaluator_.varies(*expr.operands[0]) && alternatives.size() > 1)
    return state_at_each_instant(expr, wanted);
  int least = 1;
  if (expr.quantifier == Quantifier::at_least) {
    const auto count = evaluator_.whole(*expr.operands[1]);
    if (!count) return;
    least = wanted ? *count : static_cast<int>(alternatives.size()) - *count + 1;
  }
  state_at_least(expr, least, std::move(alternatives));
}

// One constraint a value, called name[1, 2].
void Compiler::state_for_each(const Expr& expr, bool wanted) {
  const std::string outer = constraint_;
  evaluator_.for_each(expr, [&](const std::vector<int>& at) {
    constraint_ = fmt::format("{}[{}]", outer, fmt::join(at, ", "));
    state(*expr.operands[0], wanted);
    return !model_.diagnostics().any();
  });
  constraint_ = outer;
}

void Compiler::state_at_least(const Expr& expr, int count, std::vector<Alternative> alternatives) {
  if (count <= 0) return;
  if (static_cast<std::size_t>(count) > alternatives.size()) return state_truth(boolean(false));
  std::vector<std::function<void()>> stated;
  for (const Alternative& alternative : alternatives) {
    stated.emplace_back([this, &expr, &alternative] {
      if (model_.diagnostics().any()) return;
      if (++alternatives_ > kMostAlternatives) {
        model_.diagnostics().report(Code::too_large, expr.range, kMostAlternatives);
        return;
      }
      if (!alternative.at.empty()) evaluator_.bind_numbers(expr, alternative.at);
      for (const Claim& claim : alternative.claims) state(*claim.relation, claim.wanted);
    });
  }
  guarded(expr.range,
          [&] { problem_->constrain_at_least(next_name(), static_cast<std::size_t>(count), stated); });
}

// ---- Time.

std::optional<Window> Compiler::window_of(const Expr& expr) {
  const Expr* domain = expr.bindings[0].domain;
  if (domain == nullptr) return {};
  const auto from = evaluator_.number(*domain->operands[0]), to = evaluator_.number(*domain->operands[1]);
  if (!from || !to) return {};
  if (from->nearest() > to->nearest()) model_.diagnostics().report(Code::empty_interval, domain->range);
  return Window{from->nearest(), to->nearest()};
}

// The quantifier binds t anew, whatever instant stands around it.
void Compiler::state_over_time(const Expr& expr, bool wanted) {
  if (model_.has_phases()) return state_over_phases(expr, wanted);
  if (of_time_ == OfTime::this_instant)
    return not_supported(expr.range, "a quantifier over time within a choice at every instant");
  const std::size_t before = model_.diagnostics().count();
  const std::optional<Window> window = window_of(expr);
  if (model_.diagnostics().count() != before) return;
  const bool always = (expr.quantifier == Quantifier::forall) == wanted;
  const auto state_body = [&] {
    const Expr& body = model_.unfold(*expr.operands[0]);
    always ? state_always(body, wanted) : state_sometime(body, wanted);
  };
  guarded(expr.range, [&] { problem_->during(window, [&] { evaluator_.at({}, state_body); }); });
}

void Compiler::state_always(const Expr& body, bool wanted) {
  const OfTime outer = std::exchange(of_time_, OfTime::every_instant);
  state(body, wanted);
  of_time_ = outer;
}

void Compiler::state_sometime(const Expr& body, bool wanted) {
  if (model_.is_stated(body)) return state_at_an_instant(body, wanted);
  const auto relation = relation_of(body, wanted);
  if (!relation) return;
  if (Evaluator::truth(*relation)) return state_truth(*relation);
  problem_->constrain_sometime(next_name(), expression_of(*problem_, *relation));
}

// The relation holds, or does not, at an instant that is an unknown of its own.
void Compiler::state_at_an_instant(const Expr& expr, bool wanted) {
  const hcsp::Expr instant = problem_->instant(constraint_ + " instant");
  evaluator_.at(instant, [&] { state(expr, wanted); });
}

// The relation holds, or does not, at each instant by itself: the general way, where no contractor speaks of
// all instants at once.
void Compiler::state_at_each_instant(const Expr& expr, bool wanted) {
  guarded(expr.range, [&] {
    problem_->at_each_instant(next_name(), [&] {
      const OfTime outer = std::exchange(of_time_, OfTime::this_instant);
      state(expr, wanted);
      of_time_ = outer;
    });
  });
}

// ---- Functions, and relations as values.

// At a call the arguments are taken at one instant: the body does not tell which of them vary.
void Compiler::state_call(const Expr& expr, const Symbol& function, bool wanted) {
  if (of_time_ != OfTime::this_instant && evaluator_.varies(expr)) return state_at_each_instant(expr, wanted);
  if (evaluator_.bind_arguments(expr, function)) state(*function.as<FunctionItem>()->body, wanted);
}

// A Boolean unknown that is true where the relation holds, and false where it does not.
Value Compiler::truth_of(const Expr& expr) {
  const bool at_one_instant = !evaluator_.varies(expr) || of_time_ == OfTime::this_instant;
  if (in_zone_ || !at_one_instant) {
    not_supported(expr.range, in_zone_ ? "this relation within a zone" : "this relation within another");
    return {};
  }
  Value truth;
  guarded(expr.range, [&] {
    const hcsp::Expr holds = (*problem_)(problem_->hidden_boolean(constraint_ + " truth"));
    const auto alternative = [&](bool wanted) {
      return [&, wanted] {
        problem_->constrain(next_name(), wanted ? holds : !holds);
        state(expr, wanted);
      };
    };
    problem_->constrain_at_least(next_name(), 1, {alternative(true), alternative(false)});
    truth = {holds};
  });
  return truth;
}

}  // namespace hcsp::lang
