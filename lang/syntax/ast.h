// SPDX-License-Identifier: Apache-2.0
// The syntax tree of a model. Nodes live in the tree's arena and point at each other; every node knows its
// range in the source. Names are unresolved: that is the checker's work (lang/check).
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lang/source.h"

namespace hcsp::lang {

struct Name {
  std::string_view text;
  SourceRange range;
};

enum class Operator : std::uint8_t {
  iff,
  implies,
  logical_or,
  logical_xor,
  logical_and,
  logical_not,
  equal,
  not_equal,
  less,
  less_equal,
  greater,
  greater_equal,
  in,
  subset,
  range,
  plus_minus,
  set_union,
  set_symdiff,
  set_minus,
  set_inter,
  add,
  subtract,
  multiply,
  divide,
  negate,
  power,
};
std::string_view spelling(Operator op);
inline bool is_logical(Operator op) { return op <= Operator::logical_not; }
inline bool is_comparison(Operator op) { return op >= Operator::equal && op <= Operator::greater_equal; }

enum class Quantifier : std::uint8_t {
  forall,
  exists,
  at_least,
  sum,
  product,
  minimum,
  maximum,
  set_union,
  set_inter
};
std::string_view spelling(Quantifier quantifier);

enum class ExprKind : std::uint8_t {
  number,         // text
  string,         // text, without the quotes
  infinity,       // oo
  boolean,        // text: true or false
  name,           // text
  member,         // operands[0].text, or operands[0]."text"
  index,          // operands[0][operands[1], ...]
  call,           // operands[0](operands[1], ...)
  unary,          // op operands[0]
  binary,         // operands[0] op operands[1]
  tuple,          // (operands[0], operands[1], ...)
  interval,       // [operands[0], operands[1]]
  builder,        // { bindings[0] | operands[0] }
  quantified,     // quantifier(bindings) operands[0]; atleast(operands[1], bindings) operands[0]
  conditional,    // if operands[0] then operands[1] else operands[2] endif
  comprehension,  // (operands[0] | bindings)
};

struct Expr;

/// real[2], tube real, set real[2], array[1..3] of int.
struct TypeExpr {
  enum class Base : std::uint8_t { boolean, integer, real };
  Base base = Base::real;
  bool tube = false;
  bool set = false;
  std::vector<Expr*> sizes;
  std::vector<Expr*> arrays;  ///< the index ranges, outermost first
  SourceRange range;
};

/// A name that a quantifier or a set builder binds: `t`, `i in 1..n`, `a : real[2]`.
struct Binding {
  Name name;
  TypeExpr* type = nullptr;
  Expr* domain = nullptr;
};

struct Expr {
  ExprKind kind = ExprKind::number;
  Operator op = Operator::add;
  Quantifier quantifier = Quantifier::forall;
  std::uint32_t id = 0;     ///< its place in the arena, for side tables
  std::uint32_t depth = 1;  ///< of the tree below
  SourceRange range;
  SourceRange token;  ///< the operator, the name after a dot
  std::string_view text;
  std::vector<Expr*> operands;
  std::vector<Binding> bindings;
};

struct Parameter {
  Name name;
  TypeExpr* type = nullptr;
};
struct Local {
  Name name;
  Expr* value = nullptr;
};

struct ModelItem {
  Name name;
};
struct IncludeItem {
  Name path;
};
struct ParamItem {
  Name name;
  TypeExpr* type = nullptr;
  Expr* value = nullptr;
};
struct DataItem {
  Name name;
  Name reader;
  Name path;
};
struct TimeItem {
  Name name;
  Expr* span = nullptr;  // in span step step | in span phases phases
  Expr* step = nullptr;
  Expr* phases = nullptr;
  Expr* stamps = nullptr;  // at stamps
};
struct FunctionItem {
  Name name;
  std::vector<Parameter> parameters;
  TypeExpr* type = nullptr;
  Expr* body = nullptr;
  std::vector<Local> locals;
};
struct GivenItem {
  Name name;
  TypeExpr* type = nullptr;
  Expr* value = nullptr;
};
struct VarItem {
  std::vector<Name> names;
  TypeExpr* type = nullptr;
  Expr* domain = nullptr;
  Expr* precision = nullptr;
};
struct LetItem {
  Name name;
  TypeExpr* type = nullptr;
  Expr* value = nullptr;
};
struct ConstraintItem {
  std::optional<Name> name;
  Expr* relation = nullptr;
  bool is_implied = false;    // `implied`: it follows, or may be assumed
  bool is_of_family = false;  // `family`: what is looked for obeys it, other solutions may not
};
struct SolveItem {
  enum class Goal : std::uint8_t { propagate, all, pave, minimize, maximize };
  Goal goal = Goal::propagate;
  std::vector<Expr*> arguments;
  Expr* precision = nullptr;
};
inline bool is_optimisation(SolveItem::Goal goal) {
  return goal == SolveItem::Goal::minimize || goal == SolveItem::Goal::maximize;
}
struct ShowItem {
  std::vector<Expr*> shown;
};

struct Item {
  std::variant<std::monostate, ModelItem, IncludeItem, ParamItem, DataItem, TimeItem, FunctionItem, GivenItem,
               VarItem, LetItem, ConstraintItem, SolveItem, ShowItem>
      content;
  SourceRange range;
};

/// A parsed model: its items in the order of the text (an included file's in the place of the include), and
/// what they point at.
class SyntaxTree {
 public:
  SyntaxTree() = default;
  SyntaxTree(const SyntaxTree&) = delete;
  SyntaxTree& operator=(const SyntaxTree&) = delete;

  std::deque<Item> items;

  Expr* make(Expr expr);
  TypeExpr* make(TypeExpr type);
  const Source& add_source(std::string name, std::string text);
  /// The number of expressions made: ids are below it.
  [[nodiscard]] std::size_t expressions() const { return expressions_.size(); }

 private:
  std::deque<Expr> expressions_;
  std::deque<TypeExpr> types_;
  std::deque<std::unique_ptr<Source>> sources_;
};

/// The tree as text, one node a line, for --dump ast and for tests.
std::string dump(const SyntaxTree& tree);
/// An expression on one line, fully parenthesised: (+ a (* 2 b)).
std::string dump(const Expr& expr);

}  // namespace hcsp::lang
