// SPDX-License-Identifier: Apache-2.0
// Evaluates checked expressions: folds constants, inlines functions and lets, and builds expressions of a
// Problem for the rest. Without one of the model it evaluates what is known now, which is all that the
// checker asks for.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "domains/box.h"
#include "lang/evaluate/terms.h"
#include "lang/model/model.h"
#include "solver/problem.h"

namespace hcsp::lang {

/// A Boolean constant.
Term boolean(bool truth);

/// So long ago, seen from the time at hand.
struct Delay {
  double duration;
};
/// The instant at which tubes are taken: the one at hand, a known one, one to be found, or an earlier one.
using Instant = std::variant<std::monostate, double, hcsp::Expr, Delay>;

/// The unknowns of a Problem by the symbol that they were declared as.
struct Unknowns {
  using Handle =
      std::variant<RealVariable, IntegerVariable, BooleanVariable, VectorVariable, TubeVariable, SetVariable>;
  Problem& problem;
  /// One; of an array one an element, the last index fastest.
  std::unordered_map<const Symbol*, std::vector<Handle>> handles;

  /// The i-th component, of a tube at an instant or at the time at hand; none of a set.
  [[nodiscard]] std::optional<hcsp::Expr> component(const Handle& handle, std::size_t i,
                                                    const Instant& instant) const;
};

class Evaluator {
 public:
  explicit Evaluator(Model& model);
  /// `truth_of` gives a relation that is stated as a constraint a value; none after a report.
  Evaluator(Model& model, Unknowns& unknowns, std::function<Value(const Expr&)> truth_of)
      : model_(model), unknowns_(&unknowns), truth_of_(std::move(truth_of)) {}

  // Constants; what is not one is a mistake of the caller.
  std::optional<Number> number(const Expr& expr);
  /// A whole number; anything else is reported.
  std::optional<int> whole(const Expr& expr);
  /// Whether all components are whole numbers; the first that is none is reported.
  bool all_whole(const Expr& expr);
  /// The whole numbers of `a..b`, none of them where b is below a.
  std::optional<Extent> range(const Expr& expr);
  /// Runs body() for every value of the whole numbers that an expression binds, the last name fastest, until
  /// it gives false; false then, and after a report. The values are those of `at` meanwhile.
  bool for_each(const Expr& expr, const std::function<bool(const std::vector<int>& at)>& body);
  /// A domain or a value, as a box of its components.
  std::optional<Box> box(const Expr& expr);
  /// The points that certainly belong to it: no end is rounded outward. May be empty.
  std::optional<Box> certain_box(const Expr& expr);

  /// Reals, vectors and relations, at the time at hand.
  Value value(const Expr& expr);
  DomainValue domain(const Expr& expr);
  /// The columns of data that a column or a vector of columns stands for.
  std::optional<std::vector<Column>> columns(const Expr& expr);

  /// Evaluates a definition ahead of its uses.
  void define(const Symbol& symbol, const Expr& definition) {
    definitions_.emplace(key_of(symbol), value(definition));
  }
  /// The set unknown that an expression names; none where it names none, or after a report.
  std::optional<SetVariable> set(const Expr& expr);
  /// A tube unknown, one of an array, or a component of one: `dim` components from `first` on.
  struct TubeComponents {
    TubeVariable tube;
    std::size_t first;
    std::size_t dim;
  };
  std::optional<TubeComponents> tube(const Expr& expr);
  /// Binds the parameters and locals of a function as a call of it says; false after a report.
  bool bind_arguments(const Expr& call, const Symbol& function);
  /// Binds the whole numbers of an expression to some values.
  void bind_numbers(const Expr& expr, const std::vector<int>& at);
  /// Runs body() with tubes taken at an instant.
  template <class Body>
  void at(const Instant& instant, Body body) {
    const Instant outer = std::exchange(instant_, instant);
    body();
    instant_ = outer;
  }
  /// Whether the value of an expression varies with the time at hand.
  [[nodiscard]] bool varies(const Expr& expr) const { return model_.type(expr).tube && moves_with_time(); }
  /// Whether an integral was evaluated since the last call.
  bool take_integrals() { return std::exchange(takes_integrals_, false); }
  /// The instants to be found that tubes were taken at since the last call.
  std::vector<hcsp::Expr> take_instants_to_find() { return std::exchange(instants_to_find_, {}); }
  /// Known instants that tubes were taken at and that are none of the time line, but lie on it.
  [[nodiscard]] const std::vector<double>& missing_instants() const { return missing_instants_; }
  /// Binds the point of a set builder, or of a minimum over a set.
  void bind(std::uint32_t local, Value value);
  /// The truth of a relation between constants.
  static std::optional<bool> truth(const Term& term);

 private:
  Value value_of_kind(const Expr& expr);
  Value name(const Expr& expr);
  Value symbol(const Symbol& symbol);
  Value unknown(const Symbol& symbol);
  std::optional<std::pair<Unknowns::Handle, std::size_t>> handle(const Expr& expr);
  Value unknown_part(const Symbol& symbol, std::size_t first, std::size_t count);
  Value cell(const Column& column, std::size_t row);
  Value index(const Expr& expr);
  /// Components first..first + count - 1 of a value, without evaluating the others where that can be avoided.
  Value part(const Expr& expr, std::size_t first, std::size_t count);
  std::optional<std::size_t> offset(const Expr& written, const Type& base);
  Value over_range(const Expr& expr);
  Value over_reals(const Expr& expr);
  void bind_number(const Expr& range, int value);
  Value combined(const Expr& expr, const std::vector<Value>& values);
  Value comprehension(const Expr& expr);
  Value unary(const Expr& expr);
  Value binary(const Expr& expr);
  /// A connective; of constants a constant.
  Term connect(Operator op, const Term& a, const Term& b);
  /// At least `count` of the relations hold.
  Value at_least(int count, const Value& relations);
  Value arithmetic(const Expr& expr, const Value& a, const Value& b);
  Value product(const Expr& expr, const Value& a, const Value& b);
  Value matrix_function(const Expr& expr, BuiltIn function, const std::vector<Value>& arguments);
  Term determinant(const Value& a, std::size_t n);
  Value inverse(const Value& a, std::size_t n);
  Value rotation(const std::vector<Value>& arguments);
  Value power(const Expr& expr);
  Value relation(const Expr& expr, const Value& a, const Value& b);
  Value membership(const Expr& expr);
  Value membership_in_builder(const Expr& written, const Value& point);
  Value conditional(const Expr& expr);

  Value call(const Expr& expr);
  Value function_call(const Expr& expr, const Symbol& function);
  Value at_instant(const Expr& expr);
  Instant known_instant(const Expr& expr, const Number& written);
  Instant instant_of(const Expr& expr);
  Instant instant_of_phases(const Expr& expr, const hcsp::Expr& instant);
  Instant delayed(const Expr& instant);
  [[nodiscard]] bool moves_with_time() const {
    return std::holds_alternative<std::monostate>(instant_) || std::holds_alternative<Delay>(instant_);
  }
  Value integral(const Expr& expr);
  bool require_all_time(const Expr& expr, std::string_view what);
  Value built_in(const Expr& expr, BuiltIn function);
  Value data_value(const Expr& expr, BuiltIn function);
  Value gate(const Expr& expr);
  Value hold(const Expr& expr);

  std::optional<Column> member(const Expr& expr);
  std::optional<std::vector<Column>> column_arithmetic(const Expr& expr);
  CellValue combine(Operator op, const CellValue& a, const CellValue& b);

  hcsp::Expr expression(const Term& term) { return expression_of(unknowns_->problem, term); }
  /// The value, unless a component of it is a constant that does not exist (1/0).
  Value defined(const Expr& expr, Value value);
  bool take_step(const Expr& expr);
  /// Whether so many steps are left, which the caller is going to take.
  bool take_steps(const Expr& expr, std::int64_t count);
  [[nodiscard]] bool has_value(const Expr& expr) const;

  Model& model_;
  /// For constants that take an expression to tell, 3*sqrt(2) < 5 for one, where there is no other Problem.
  std::unique_ptr<Problem> scratch_;
  std::optional<Unknowns> none_;
  Unknowns* unknowns_ = nullptr;
  std::function<Value(const Expr&)> truth_of_;
  std::unordered_map<std::uint32_t, Value> locals_;
  /// A definition has a value an instant.
  using DefinitionKey = std::tuple<const Symbol*, std::size_t, double>;
  [[nodiscard]] DefinitionKey key_of(const Symbol& symbol) const;

  Instant instant_;
  std::vector<double> missing_instants_;
  std::vector<hcsp::Expr> instants_to_find_;
  bool takes_integrals_ = false;
  std::map<DefinitionKey, Value> definitions_;
  std::map<std::pair<const Table*, std::size_t>, std::optional<Column>> converted_;
  std::uint64_t steps_ = 0;
  std::uint32_t depth_ = 0;
};

}  // namespace hcsp::lang
