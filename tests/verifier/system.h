// SPDX-License-Identifier: Apache-2.0
// What is verified: unknowns, and relations between expressions of them, evaluated with their derivatives.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/verifier/precise.h"

namespace hcsp::verifier {

using Place = std::vector<Precise>;  ///< an interval for each unknown

enum class Operation {
  constant,
  unknown,
  add,
  subtract,
  multiply,
  divide,
  power,
  sqrt,
  exp,
  log,
  sin,
  cos,
  atan
};

/// An operation on nodes that were made before it.
struct Node {
  Operation operation;
  std::size_t left = 0, right = 0;  ///< nodes; `left` of an unknown is its number
  long exponent = 0;
  Precise value;  ///< of a constant
};

/// Expressions; what is said of constants only is a constant.
class Expressions {
 public:
  std::size_t constant(Precise value);
  std::size_t unknown(std::size_t number);
  /// `right` is of no account where the operation takes one operand.
  std::size_t apply(Operation operation, std::size_t left, std::size_t right = 0);
  std::size_t power(std::size_t base, long exponent);
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

 private:
  std::size_t add(Node node);
  std::vector<Node> nodes_;
};

/// An expression that is 0, at most 0 or less than 0.
struct Relation {
  enum class Kind { zero, at_most_zero, negative } kind;
  std::size_t expression;
};

/// Unknowns by the name that they were declared with, so many of them, each in a domain.
struct Declaration {
  std::string name;
  std::vector<Precise> domains;
};

struct System {
  Expressions expressions;
  std::vector<Declaration> declarations;
  std::vector<Relation> relations;

  [[nodiscard]] std::vector<Precise> domains() const;
  [[nodiscard]] std::vector<std::size_t> equations() const;
};

/// The values of all expressions over a place, and their derivatives backwards from any of them.
class Evaluation {
 public:
  using Gradient = std::vector<std::pair<std::size_t, Precise>>;  ///< by unknown; others have no part in it

  Evaluation(const Expressions& expressions, const Place& place);
  [[nodiscard]] const Precise& value(std::size_t node) const { return values_[node]; }
  [[nodiscard]] Gradient gradient(std::size_t root) const;

 private:
  [[nodiscard]] std::vector<std::size_t> parts_of(std::size_t root) const;

  const std::vector<Node>& nodes_;
  std::vector<Precise> values_;
};

}  // namespace hcsp::verifier
