// SPDX-License-Identifier: Apache-2.0
// What ranges over whole numbers: its body is put in place for every value.
#include "lang/evaluate/evaluator.h"

namespace hcsp::lang {

std::optional<Extent> Evaluator::range(const Expr& expr) {
  const auto first = whole(*expr.operands[0]);
  const auto last = first ? whole(*expr.operands[1]) : std::nullopt;
  if (!last) return {};
  return Extent{*first, *last};
}

bool Evaluator::for_each(const Expr& expr, const std::function<bool(const std::vector<int>& at)>& body) {
  std::vector<int> at;
  const std::function<bool(std::size_t)> bind_from = [&](std::size_t k) {
    if (k == expr.bindings.size()) return body(at);
    const Expr& written = *expr.bindings[k].domain;
    const auto extent = range(written);
    if (!extent || !take_steps(written, std::int64_t{extent->last} - extent->first)) return false;
    at.push_back(0);
    for (std::int64_t i = extent->first; i <= extent->last; ++i) {
      if (!take_step(written)) return false;
      at.back() = static_cast<int>(i);
      bind_number(written, at.back());
      if (!bind_from(k + 1)) return false;
    }
    at.pop_back();
    return true;
  };
  return bind_from(0);
}

void Evaluator::bind_number(const Expr& range, int value) {
  bind(model_.reference(range).local, {*Number::parse(std::to_string(value))});
}

void Evaluator::bind_numbers(const Expr& expr, const std::vector<int>& at) {
  for (std::size_t k = 0; k < at.size(); ++k) bind_number(*expr.bindings[k].domain, at[k]);
}

Value Evaluator::over_range(const Expr& expr) {
  std::vector<Value> values;
  const bool done = for_each(expr, [&](const std::vector<int>&) {
    values.push_back(value(*expr.operands[0]));
    return !values.back().empty();
  });
  return done ? combined(expr, values) : Value{};
}

// forall(p in [a, b]) and exists(p in [a, b]): the body once, with an unknown of its own for every component.
Value Evaluator::over_reals(const Expr& expr) {
  struct Component {
    std::string name;
    std::uint32_t local;
    Interval domain, certain;
  };
  std::vector<Component> components;
  for (const Binding& bound : expr.bindings) {
    const auto domain = box(*bound.domain);
    const auto certain = domain ? certain_box(*bound.domain) : std::nullopt;
    if (!certain) return {};
    const std::uint32_t local = model_.reference(*bound.domain).local;
    bind(local, {});
    for (Eigen::Index i = 0; i < domain->dim(); ++i) {
      const std::string text(bound.name.text);
      components.push_back({domain->dim() == 1 ? text : fmt::format("{}[{}]", text, i + 1), local,
                            (*domain)[i], (*certain)[i]});
    }
  }
  Value body;
  const std::function<hcsp::Expr(std::size_t)> quantify = [&](std::size_t k) -> hcsp::Expr {
    if (k == components.size()) {
      body = value(*expr.operands[0]);
      const auto known = body.empty() ? std::optional(false) : truth(body.front());
      if (!known) return std::get<hcsp::Expr>(body.front());
      return expression(boolean(*known)) == Interval(1.0);
    }
    const auto relation = [&](hcsp::Expr real) {
      locals_[components[k].local].emplace_back(real);
      return quantify(k + 1);
    };
    Problem& problem = unknowns_->problem;
    const auto& [name, local, domain, certain] = components[k];
    return expr.quantifier == Quantifier::forall ? problem.for_every(name, domain, relation, certain)
                                                 : problem.for_some(name, domain, relation, certain);
  };
  const hcsp::Expr relation = quantify(0);
  return body.empty() ? Value{} : Value{relation};
}

// What a quantifier makes of the values of its body.
Value Evaluator::combined(const Expr& expr, const std::vector<Value>& values) {
  const auto joined = [&](Operator op, bool neutral) {
    Term all = boolean(neutral);
    for (const Value& one : values) all = connect(op, all, one.front());
    return Value{all};
  };
  switch (expr.quantifier) {
    case Quantifier::forall:
      return joined(Operator::logical_and, true);
    case Quantifier::exists:
      return joined(Operator::logical_or, false);
    case Quantifier::at_least: {
      const auto count = whole(*expr.operands[1]);
      Value relations;
      for (const Value& one : values) relations.push_back(one.front());
      return count ? at_least(*count, relations) : Value{};
    }
    case Quantifier::sum: {
      Value total(model_.type(expr).terms(), *Number::parse("0"));
      for (const Value& one : values) {
        for (std::size_t i = 0; i < total.size(); ++i)
          total[i] = &one == values.data() ? one[i] : operate(Operator::add, total[i], one[i]);
      }
      return defined(expr, std::move(total));
    }
    default:
      break;
  }
  Value terms;
  for (const Value& one : values) terms.push_back(one.front());
  if (expr.quantifier == Quantifier::product) return defined(expr, {product_of(terms)});
  if (terms.empty()) {
    model_.diagnostics()
        .report(Code::undefined_constant, expr.range)
        .note(fmt::format("there is no value to take the {}imum of",
                          expr.quantifier == Quantifier::minimum ? "min" : "max"));
    return {};
  }
  return {extremum(expr.quantifier == Quantifier::minimum ? BuiltIn::min : BuiltIn::max, terms)};
}

Value Evaluator::at_least(int count, const Value& relations) {
  std::vector<hcsp::Expr> open;
  for (const Term& relation : relations) {
    const auto known = truth(relation);
    if (!known) open.push_back(std::get<hcsp::Expr>(relation));
    count -= known.value_or(false) ? 1 : 0;
  }
  if (count <= 0) return {boolean(true)};
  if (static_cast<std::size_t>(count) > open.size()) return {boolean(false)};
  return {hcsp::at_least(static_cast<std::size_t>(count), open)};
}

Value Evaluator::comprehension(const Expr& expr) {
  Value all;
  const bool done = for_each(expr, [&](const std::vector<int>&) {
    const Value found = value(*expr.operands[0]);
    all.insert(all.end(), found.begin(), found.end());
    return !found.empty();
  });
  return done ? all : Value{};
}

}  // namespace hcsp::lang
