// SPDX-License-Identifier: Apache-2.0
// From the syntax tree of a Minibex file to a Problem: its constants and variables (compiler.cpp), its goal
// and its constraints (constraints.cpp).
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_set>

#include "lang/minibex/evaluator.h"

namespace hcsp::lang::minibex {

class Compiler {
 public:
  Compiler(const Program& program, std::string name, Diagnostics& diagnostics)
      : program_(program),
        diagnostics_(diagnostics),
        problem_(std::make_unique<Problem>(std::move(name))),
        evaluator_(program, *problem_, diagnostics),
        variables_{&evaluator_.constants()} {}

  /// Null after a report.
  std::unique_ptr<Problem> run();
  [[nodiscard]] const std::optional<hcsp::Expr>& objective() const { return objective_; }
  /// A line a name, in their order: `x : real[2]`.
  [[nodiscard]] const std::string& types() const { return types_; }

 private:
  using Shape = std::pair<std::size_t, std::size_t>;

  bool is_new(const Name& name);
  bool has_room(const Declaration& declaration, const Shape& shape);
  void add_type(const Name& name, const Shape& shape, std::string_view what);
  void constant(const Declaration& declaration);
  void variable(const Declaration& declaration);
  std::optional<Box> domain(const Declaration& declaration, const Shape& shape);
  Tensor spread(const Declaration& declaration, const Shape& shape, const Tensor& value);
  Tensor make(const Declaration& declaration, const Shape& shape, const Box& domain);
  Tensor make_numbers(const Declaration& declaration, const Shape& shape, const Box& domain);

  // Whole numbers: the components of variables that integer() names.
  void number_components();
  bool find_whole(const std::vector<Statement>& statements);
  [[nodiscard]] bool has_integrality(const Loop& loop) const;
  [[nodiscard]] const Name* variable_in(const Expr& expr) const;
  [[nodiscard]] bool is_whole(const Declaration& variable, std::size_t component) const;

  // The goal, and the constraints: false after a report.
  void goal();
  bool state(const std::vector<Statement>& statements);
  bool state(const Statement& statement);
  bool is_definition(const Relation& relation);
  bool define(const Relation& relation);
  bool state_relation(const Statement& statement, const Relation& relation);
  bool state_membership(const Statement& statement, const Relation& relation);
  bool state_whole(const Statement& statement, const Expr& argument);
  void state_truth(const Statement& statement, Operator op, const Term& a, const Term& b);
  std::string next_name(const Statement& statement);

  const Program& program_;
  Diagnostics& diagnostics_;
  std::unique_ptr<Problem> problem_;
  Evaluator evaluator_;
  Scope variables_;
  std::unordered_set<std::string_view> declared_;
  std::map<std::string_view, Shape> shapes_;                  // of variables
  std::set<std::pair<std::string_view, std::size_t>> whole_;  // components of variables
  std::set<NodeId> whole_nodes_;
  std::optional<hcsp::Expr> objective_;
  std::string types_;
  std::size_t components_ = 0;
  std::map<std::size_t, std::size_t> named_;  // by line: how many constraints it has so far
};

}  // namespace hcsp::lang::minibex
