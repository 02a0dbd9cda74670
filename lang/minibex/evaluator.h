// SPDX-License-Identifier: Apache-2.0
// Evaluates Minibex expressions: numbers for as long as everything is known, expressions of a Problem from
// then on; functions are put in place of their calls.
//
// An interval constant stands for any one of its values, so in an expression it is an unknown of its own: one
// each time that it is written, and one for a name, however often the name is used. Where a constant is asked
// for (a size, an index, a domain) it is the interval.
#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lang/diagnostics.h"
#include "lang/minibex/ast.h"
#include "lang/minibex/tensor.h"
#include "lang/minibex/words.h"
#include "solver/problem.h"

namespace hcsp::lang::minibex {

/// What a name stands for: of a constant that is an interval, the interval besides the unknown.
struct Binding {
  Tensor value;
  std::optional<Tensor> interval;
};

/// The names that can be seen at a place, its own and those around it.
struct Scope {
  const Scope* around = nullptr;
  std::unordered_map<std::string_view, Binding> names = {};

  [[nodiscard]] const Binding* find(std::string_view name) const;
};

/// The bounds of a set of values; none where it is infinite.
struct Bounds {
  std::optional<Number> lo;
  std::optional<Number> hi;
};

class Evaluator {
 public:
  Evaluator(const Program& program, Problem& problem, Diagnostics& diagnostics);

  // Without terms, or without a value, after a report.
  Tensor value(const Expr& expr);
  /// Of numbers alone; intervals are numbers that are not known better.
  Tensor constant(const Expr& expr);
  /// Whether the last constant() was made from an interval.
  [[nodiscard]] bool made_of_intervals() const { return made_of_intervals_; }
  /// A scalar's value, or the bounds of an interval as they are written.
  std::optional<Bounds> bounds(const Expr& expr);
  std::optional<int> whole(const Expr& expr);
  /// The rows and columns that a declaration says, 1 by 1 where it says nothing.
  std::optional<std::pair<std::size_t, std::size_t>> shape(const Declaration& declaration);
  /// Whether so many steps are left; the first time that they are not is reported.
  bool take_steps(const Expr& expr, std::uint64_t count);
  /// Runs body(), with a new name bound to each whole number of first:last, in a scope of its own, until it
  /// gives false; false then and after a report.
  template <class Body>
  bool for_each(const Expr& first, const Expr& last, const Name& name, Body body) {
    if (!is_new(name)) return false;
    const auto begin = whole(first);
    const auto end = begin ? whole(last) : std::nullopt;
    if (!end) return false;
    Scope* outer = scope_;
    bool good = true;
    for (std::int64_t i = *begin; good && i <= *end; ++i) {
      Scope inner{outer};
      inner.names.emplace(name.text, Binding{counted(static_cast<int>(i)), {}});
      scope_ = &inner;
      good = take_steps(first, 1) && body();
      scope_ = outer;
    }
    return good;
  }
  /// Runs body() in another scope.
  template <class Body>
  auto within(Scope& scope, Body body) {
    Scope* outer = std::exchange(scope_, &scope);
    auto result = body();
    scope_ = outer;
    return result;
  }
  [[nodiscard]] Scope& scope() { return *scope_; }
  /// The constants: all that a function sees besides its arguments.
  [[nodiscard]] Scope& constants() { return constants_; }
  static Tensor counted(int value);

 private:
  Tensor value_of_kind(const Expr& expr);
  Tensor number(const Expr& expr);
  Tensor name(const Expr& expr);
  Tensor vector(const Expr& expr);
  Tensor binary(const Expr& expr);
  Tensor interval(const Expr& expr);
  Tensor ball(const Expr& expr);
  Tensor interval_constant(const Interval& value);
  Tensor over_range(const Expr& expr);
  const Tensor* visible(const Expr& name);
  std::optional<Number> bound(const Expr& expr, bool& infinite, bool is_lower);

  // Components (indices.cpp).
  Tensor apply(const Expr& expr);
  Tensor indexed(const Tensor& base, const Expr& expr);
  std::optional<Extent> extent(const Expr& index, std::size_t size, bool from_zero);

  // Calls (calls.cpp).
  Tensor call(const Expr& expr);
  Tensor call_of(const Function& function, std::size_t position, const Expr& expr);
  Tensor built_in(const Expr& expr, std::string_view name);
  Tensor end_of_interval(std::string_view name, const Expr& argument);
  Tensor of_vectors(const Expr& expr, const Word& word, const std::vector<Tensor>& arguments);
  Term chosen(const Value& arguments);
  Term sinc(const Term& x);
  bool require_arguments(const Expr& expr, std::size_t fewest, std::size_t most, std::string_view what);

  bool is_new(const Name& name);
  void unknown_name(const Expr& name, Code code);
  Tensor defined(const Expr& expr, Tensor tensor);
  Tensor as_wanted(const Expr& expr, Tensor tensor);

  const Program& program_;
  Problem& problem_;
  Diagnostics& diagnostics_;
  Scope constants_;
  Scope* scope_ = &constants_;
  std::unordered_map<std::string_view, std::size_t> functions_;  // by place: those above can be called
  std::size_t callable_ = 0;
  bool wants_constants_ = false;
  bool made_of_intervals_ = false;
  std::uint64_t most_steps_;
  std::uint64_t steps_ = 0;
  std::uint32_t depth_ = 0;
};

}  // namespace hcsp::lang::minibex
