// SPDX-License-Identifier: Apache-2.0
// The syntax tree of a Minibex file, the input language of IBEX. Nodes live in the program's arena. Names are
// unresolved, and some decisions wait for what they stand for: x(1) is a component or a call, and `y = e` a
// constraint or, where y is a new name, the definition of a local one.
#pragma once

#include <deque>
#include <string_view>
#include <variant>
#include <vector>

#include "lang/syntax/ast.h"

namespace hcsp::lang::minibex {

enum class Kind : std::uint8_t {
  number,     // text
  name,       // text
  interval,   // [operands[0], operands[1]]
  ball,       // <operands[0], operands[1]>: a centre and a radius
  row,        // (operands[0], operands[1], ...)
  column,     // (operands[0]; operands[1]; ...)
  negate,     // -operands[0]
  transpose,  // operands[0]'
  binary,     // operands[0] op operands[1]
  apply,      // operands[0](operands[1], ...), or with brackets
  all,        // an index: `:`
  span,       // an index: operands[0]:operands[1]
  sum,        // sum(text = operands[0]:operands[1], operands[2])
  product,    // prod(...) likewise
};

struct Expr {
  Kind kind = Kind::number;
  Operator op = Operator::add;
  bool brackets = false;  ///< of apply: x[0], which counts from 0; x(1) counts from 1
  SourceRange range;
  SourceRange token;  ///< the operator, the name of sum and product
  std::string_view text;
  std::vector<const Expr*> operands;
};

/// name[rows][columns], and what follows `=` or `in`.
struct Declaration {
  Name name;
  std::vector<const Expr*> sizes;
  bool whole = false;
  const Expr* value = nullptr;
};

struct Definition {
  Name name;
  const Expr* value = nullptr;
};

struct Function {
  Name name;
  std::vector<Declaration> arguments;
  std::vector<Definition> definitions;
  const Expr* result = nullptr;
};

struct Statement;
/// left op right; `in` is an op too.
struct Relation {
  const Expr* left = nullptr;
  Operator op = Operator::equal;
  const Expr* right = nullptr;
};
/// integer(argument): a whole number.
struct Integrality {
  const Expr* argument = nullptr;
};
struct Loop {
  Name iterator;
  const Expr* first = nullptr;
  const Expr* last = nullptr;
  std::vector<Statement> body;
};
struct Statement {
  SourceRange range;
  std::variant<Relation, Integrality, Loop> content;
};

struct Program {
  std::vector<Declaration> constants;
  std::vector<Declaration> variables;
  std::deque<Function> functions;
  const Expr* goal = nullptr;
  std::vector<Statement> constraints;
  std::deque<Expr> expressions;  ///< the arena
};

}  // namespace hcsp::lang::minibex
