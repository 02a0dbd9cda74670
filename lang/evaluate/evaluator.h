// SPDX-License-Identifier: Apache-2.0
// Evaluates checked expressions: folds constants, inlines functions and lets, and builds expressions of a
// Problem for the rest. Without a Problem it evaluates what is known now, which is all that the checker asks
// for.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <unordered_map>

#include "domains/box.h"
#include "lang/evaluate/value.h"
#include "lang/model/model.h"
#include "solver/problem.h"

namespace hcsp::lang {

/// The unknowns of a Problem by the symbol that they were declared as.
struct Unknowns {
  using Handle = std::variant<RealVariable, VectorVariable, TubeVariable, SetVariable>;
  Problem& problem;
  std::unordered_map<const Symbol*, Handle> handles;
};

class Evaluator {
 public:
  explicit Evaluator(Model& model) : model_(model) {}
  Evaluator(Model& model, Unknowns& unknowns) : model_(model), unknowns_(&unknowns) {}

  // Constants; what is not one is a mistake of the caller.
  std::optional<Number> number(const Expr& expr);
  /// A whole number; anything else is reported.
  std::optional<int> whole(const Expr& expr);
  /// A domain or a value, as a box of its components.
  std::optional<Box> box(const Expr& expr);

  /// Reals, vectors and relations, at the time at hand.
  Value value(const Expr& expr);
  DomainValue domain(const Expr& expr);
  /// The columns of data that a column or a vector of columns stands for.
  std::optional<std::vector<Column>> columns(const Expr& expr);

  /// Evaluates a definition ahead of its uses.
  void define(const Symbol& symbol, const Expr& definition) {
    definitions_.emplace(std::pair(&symbol, instant_), value(definition));
  }
  /// Binds the point of a set builder, or of a minimum over a set.
  void bind(std::uint32_t local, Value value);
  static hcsp::Expr expression(Problem& problem, const Term& term);

 private:
  Value value_of_kind(const Expr& expr);
  Value name(const Expr& expr);
  Value symbol(const Symbol& symbol);
  Value unknown(const Symbol& symbol);
  Value index(const Expr& expr);
  Value unary(const Expr& expr);
  Value binary(const Expr& expr);
  Value arithmetic(const Expr& expr, const Value& a, const Value& b);
  Value power(const Expr& expr);
  Value relation(const Expr& expr, const Value& a, const Value& b);
  Value membership(const Expr& expr);
  Value conditional(const Expr& expr);

  Value call(const Expr& expr);
  Value function_call(const Expr& expr, const Symbol& function);
  Value at_instant(const Expr& expr);
  Value built_in(const Expr& expr, BuiltIn function);
  Value data_value(const Expr& expr, BuiltIn function);
  Term scalar_function(BuiltIn function, const Term& a);
  Term scalar_function(BuiltIn function, const Term& a, const Term& b);

  std::optional<Column> member(const Expr& expr);
  std::optional<std::vector<Column>> column_arithmetic(const Expr& expr);
  CellValue combine(Operator op, const CellValue& a, const CellValue& b);

  Term operate(Operator op, const Term& a, const Term& b);
  Term negate(const Term& a);
  hcsp::Expr expression(const Term& term) { return expression(unknowns_->problem, term); }
  /// The value, unless a component of it is a constant that does not exist (1/0).
  Value defined(const Expr& expr, Value value);
  bool take_step(const Expr& expr);

  Model& model_;
  Unknowns* unknowns_ = nullptr;
  std::unordered_map<std::uint32_t, Value> locals_;
  std::optional<double> instant_;  // the instant at which tubes are taken; the one at hand when none
  std::map<std::pair<const Symbol*, std::optional<double>>, Value> definitions_;
  std::map<std::pair<const Table*, std::size_t>, std::optional<Column>> converted_;
  std::uint64_t steps_ = 0;
  std::uint32_t depth_ = 0;
};

}  // namespace hcsp::lang
