// SPDX-License-Identifier: Apache-2.0
// What trees of expressions mean: nodes of a System.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/verifier/system.h"
#include "tests/verifier/tree.h"

namespace hcsp::verifier {

/// A number, a vector or array of values, relations that hold together, or a relation of constants.
struct Value {
  enum class Kind { number, vector, relations, truth } kind = Kind::number;
  std::size_t node = 0;
  std::vector<Value> parts;
  long first = 1;  ///< index of the first part
  std::vector<Relation> relations;
  bool truth = false;
};

using Names = std::map<std::string, Value>;

/// `function name(parameters) = value where locals`.
struct Function {
  std::vector<std::string> parameters;
  Tree value;
  std::vector<std::pair<std::string, Tree>> locals;
};

class Interpreter {
 public:
  explicit Interpreter(System& system) : system_(system) {}

  /// Makes unknowns: a number, or for each size a vector of what comes after it.
  void declare(const std::string& name, const std::vector<std::pair<long, long>>& ranges, const Tree& domain);
  void name(const std::string& name, Value value) { globals_[name] = std::move(value); }
  void define(const std::string& name, Function function) { functions_[name] = std::move(function); }
  /// Adds what a tree says to the system's relations.
  void constrain(const Tree& tree);

  Value value(const Tree& tree) { return value(tree, globals_); }
  long whole(const Tree& tree) { return whole(tree, globals_); }

 private:
  Value value(const Tree& tree, const Names& names);
  Value call(const Tree& tree, const Names& names);
  Value built_in(const Tree& tree, const std::vector<Value>& arguments);
  Value element(Value of, const Tree& tree, const Names& names);
  Value arithmetic(const Tree& tree, const Value& a, const Value& b);
  Value product(const Tree& tree, const Value& a, const Value& b);
  Value relation(const Tree& tree, const Names& names);
  Value compared(const Tree& tree, const std::string& sign, const Value& a, const Value& b);
  Value both(const Tree& tree, const Value& a, const Value& b) const;
  Value over_bounds(const Tree& tree, const Names& names);
  long whole(const Tree& tree, const Names& names);
  [[nodiscard]] std::pair<long, long> range(const Tree& tree, const Names& names);
  std::vector<std::pair<Value, Value>> domain(const Tree& tree, std::size_t count);

  Value known(Precise constant);
  Value number(std::size_t node) const;
  [[nodiscard]] const Precise* constant(const Value& value) const;

  System& system_;
  Names globals_;
  std::map<std::string, Function> functions_;
};

}  // namespace hcsp::verifier
