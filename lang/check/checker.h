// SPDX-License-Identifier: Apache-2.0
// The checker's state. Its functions are spread over items.cpp, expressions.cpp, calls.cpp, phases.cpp and
// sets.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lang/evaluate/evaluator.h"
#include "lang/model/model.h"

namespace hcsp::lang {

class Checker {
 public:
  Checker(Model& model, const std::map<std::string, std::string>& data_files)
      : model_(model), data_files_(data_files), constants_(model) {}

  void run();

 private:
  struct Visible {
    std::string_view name;
    std::uint32_t id;
    Type type;
  };

  // Items.
  void declare(const Item& item);
  Symbol* declare(const Name& name, decltype(Symbol::item) item);
  void ensure(Symbol& symbol);
  void check_symbol(Symbol& symbol);
  void check_parameter(Symbol& symbol, const ParamItem& item);
  void check_data(Symbol& symbol, const DataItem& item);
  void check_time(Symbol& symbol, const TimeItem& item);
  void check_phases(const TimeItem& item);
  void check_span_of_phases(const Expr& span);
  void check_function(Symbol& symbol, const FunctionItem& item);
  void check_given(Symbol& symbol, const GivenItem& item);
  void check_variable(Symbol& symbol, const VarItem& item);
  void check_let(Symbol& symbol, const LetItem& item);
  void check_constraint(const ConstraintItem& item);
  void check_solve(const SolveItem& item, const SourceRange& range);
  bool names_unknown(const Expr& expr) const;
  void check_paved(const Expr& expr);
  void check_show(const ShowItem& item);
  Type resolve(const TypeExpr& type);
  std::optional<std::uint32_t> size_of(const Expr& size);
  std::optional<Extent> extent_of(const Expr& range);
  /// Whether a value of type `found` may stand where `wanted` is declared; reports otherwise.
  bool require_domain(const Expr& value, const Type& found, const Type& wanted);
  bool require_constant(const Expr& expr, const Type& type);
  bool require_parameters(const Expr& expr);
  /// Known by the time the model is compiled: it may use parameters of functions and bound whole numbers.
  bool require_known(const Expr& expr, const Type& type);
  void require_stated(const Expr& expr, const Type& found);
  bool require_scalar(const Expr& expr, const Type& type);

  // Expressions. `expr` is typed, recorded and returned; an error has been reported.
  Type check(const Expr& expr);
  Type check_kind(const Expr& expr);
  Type check_name(const Expr& expr);
  Type check_member(const Expr& expr);
  Type check_index(const Expr& expr);
  Type check_unary(const Expr& expr);
  Type check_binary(const Expr& expr);
  Type check_arithmetic(const Expr& expr, const Type& a, const Type& b);
  Type check_power(const Expr& expr, const Type& base, const Type& exponent);
  Type check_tolerance(const Expr& expr, const Type& a, const Type& b);
  Type check_comparison(const Expr& expr, const Type& a, const Type& b);
  Type check_membership(const Expr& expr, const Type& a, const Type& b);
  Type check_logic(const Expr& expr, const Type& a, const Type& b);
  void lift(const Expr& expr, Type& type, bool conjunction);
  bool compares_truths(const Expr& expr);
  bool is_truth(const Expr& expr);
  bool names_truth(std::string_view name);
  bool check_place(const Expr& written, const Type& base);
  Type check_tuple(const Expr& expr);
  Type check_interval(const Expr& expr);
  Type check_conditional(const Expr& expr);
  Type wrong_operands(const Expr& expr, const Type& a, const Type& b);
  Type domain_in_expression(const Expr& expr);
  Type not_supported(const SourceRange& range, std::string_view what);

  // Calls.
  Type check_call(const Expr& expr);
  Type check_function_call(const Expr& expr, const Symbol& function);
  Type check_instant(const Expr& expr, const Type& callee);
  Type check_built_in(const Expr& expr, const BuiltInFunction& function);
  Type check_scalar_function(const Expr& expr, const BuiltInFunction& function,
                             const std::vector<Type>& arguments);
  Type check_at_least(const Expr& expr);
  Type check_root(const Expr& expr, const Type& type);
  Type check_vector_function(const Expr& expr, const BuiltInFunction& function,
                             const std::vector<Type>& arguments);
  Type check_matrix_function(const Expr& expr, const BuiltInFunction& function,
                             const std::vector<Type>& arguments);
  Type check_data_function(const Expr& expr, const BuiltInFunction& function,
                           const std::vector<Type>& arguments);
  Type check_given_function(const Expr& expr, const BuiltInFunction& function,
                            const std::vector<Type>& arguments);
  Type check_der(const Expr& expr);
  Type check_hold_in_phases(const Expr& expr, const Type& values);
  Type check_gate(const Expr& expr, const Type& count);
  [[nodiscard]] bool holds_pointwise(const Expr& relation) const;
  Type check_integral(const Expr& expr);
  [[nodiscard]] const Expr* delay_of(const Expr& instant) const;
  void take_instant(const Expr& instant, const Type& type);
  bool check_count(const Expr& expr, std::string_view name, std::size_t fewest, std::size_t most);

  // Sets and quantifiers.
  Type check_builder(const Expr& expr, std::uint32_t dim);
  Type check_set(const Expr& expr, std::uint32_t dim);
  /// Two operands of which a set builder may take its dimension from the other.
  std::pair<Type, Type> check_pair(const Expr& a, const Expr& b);
  /// Both are sets of one dimension; reports otherwise.
  bool require_sets(const Expr& expr, const Expr& a, const Expr& b);
  Type check_set_relation(const Expr& expr, const Expr& a, const Expr& b);
  Type check_set_equality(const Expr& expr, const Type& a, const Type& b);
  Type check_set_operation(const Expr& expr, const Type& a, const Type& b);
  Type check_complement(const Expr& expr, std::uint32_t dim);
  Type check_point_in_set(const Expr& expr, const Type& point, const Type& set);
  Type check_distance(const Expr& expr);
  Type check_quantified(const Expr& expr, std::uint32_t dim);
  Type check_over_time(const Expr& expr);
  Type check_over_reals(const Expr& expr);
  [[nodiscard]] bool ranges_over_reals(const Expr& expr) const;
  Type check_union(const Expr& expr, std::uint32_t dim);
  // Bound whole numbers (ranges.cpp).
  Type check_range(const Expr& expr, const Type& a, const Type& b);
  Type check_over_range(const Expr& expr);
  Type check_comprehension(const Expr& expr);
  bool bind_ranges(const Expr& expr);
  Type unbound(const Expr& expr, Type type);
  Type check_minimum(const Expr& expr);
  bool binds_time(const Expr& expr);
  [[nodiscard]] bool is_stated_side(const Expr& expr) const {
    return std::find(sides_.begin(), sides_.end(), &expr) != sides_.end();
  }

  std::uint32_t bind(std::string_view name, const Type& type);
  [[nodiscard]] std::vector<std::string> visible_names() const;
  Diagnostics& diagnostics() { return model_.diagnostics(); }

  Model& model_;
  const std::map<std::string, std::string>& data_files_;
  Evaluator constants_;
  std::vector<Visible> locals_;  // those in sight, the innermost last
  std::uint32_t next_local_ = 0;
  bool pointwise_ = false;              // within what holds or is taken at one instant
  std::vector<const Expr*> sides_;      // of the == at hand, which may be der or distance
  std::uint32_t instants_to_find_ = 0;  // how many were seen: tubes at unknown instants
  std::uint32_t ranges_ = 0;            // how many bindings to whole numbers are open
  std::uint32_t depth_ = 0;
  bool solve_seen_ = false;
  bool model_seen_ = false;
};

/// The type of a scalar or vector made of both: it varies if one does, and is known when both are.
inline Type combined(Type::Kind kind, std::uint32_t dim, const Type& a, const Type& b) {
  return {kind, a.tube || b.tube, dim, std::min(a.known, b.known), nullptr};
}
/// The type of what is made of both and has the shape of `shape`, one of them.
inline Type combined_as(const Type& shape, const Type& a, const Type& b) {
  Type type = shape;
  type.tube = a.tube || b.tube;
  type.known = std::min(a.known, b.known);
  type.whole = a.whole && b.whole;
  return type;
}

}  // namespace hcsp::lang
