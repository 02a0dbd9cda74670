// SPDX-License-Identifier: Apache-2.0
#include "lang/syntax/operators.h"

#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace {

enum class Chaining : std::uint8_t { left, right, none };

struct Precedence {
  Operator op;
  int level;  // the higher, the tighter
  Chaining chaining;
};

constexpr int kNotLevel = 5;
constexpr int kNegateLevel = 13;

// docs/language.md prints this table.
Precedence precedence(TokenKind kind) {
  using enum Chaining;
  switch (kind) {
    case TokenKind::kw_iff:
      return {Operator::iff, 1, none};
    case TokenKind::kw_implies:
      return {Operator::implies, 2, right};
    case TokenKind::kw_or:
      return {Operator::logical_or, 3, left};
    case TokenKind::kw_xor:
      return {Operator::logical_xor, 3, left};
    case TokenKind::kw_and:
      return {Operator::logical_and, 4, left};
    case TokenKind::equal:
      return {Operator::equal, 6, none};
    case TokenKind::not_equal:
      return {Operator::not_equal, 6, none};
    case TokenKind::less:
      return {Operator::less, 6, none};
    case TokenKind::less_equal:
      return {Operator::less_equal, 6, none};
    case TokenKind::greater:
      return {Operator::greater, 6, none};
    case TokenKind::greater_equal:
      return {Operator::greater_equal, 6, none};
    case TokenKind::kw_in:
      return {Operator::in, 6, none};
    case TokenKind::kw_subset:
      return {Operator::subset, 6, none};
    case TokenKind::range:
      return {Operator::range, 7, none};
    case TokenKind::plus_minus:
      return {Operator::plus_minus, 7, none};
    case TokenKind::kw_union:
      return {Operator::set_union, 8, left};
    case TokenKind::kw_symdiff:
      return {Operator::set_symdiff, 8, left};
    case TokenKind::backslash:
      return {Operator::set_minus, 9, left};
    case TokenKind::kw_inter:
      return {Operator::set_inter, 10, left};
    case TokenKind::plus:
      return {Operator::add, 11, left};
    case TokenKind::minus:
      return {Operator::subtract, 11, left};
    case TokenKind::star:
      return {Operator::multiply, 12, left};
    case TokenKind::slash:
      return {Operator::divide, 12, left};
    case TokenKind::caret:
      return {Operator::power, 14, right};
    default:
      return {Operator::add, 0, none};
  }
}

class ChainBuilder {
 public:
  ChainBuilder(const std::vector<ChainLink>& chain, SyntaxTree& tree) : chain_(chain), tree_(tree) {}

  // Precedence climbing: operators of at least `level`, from the link at hand.
  Expr* build(int level) {
    // 2^2^2^... climbs once an operator.
    if (++nesting_ > kDeepestNesting) return fail(SyntaxError::Kind::too_deep, chain_[at_ - 1].op);
    Expr* built = continued(prefixed(0), level);
    --nesting_;
    return built;
  }

  [[nodiscard]] const std::optional<SyntaxError>& error() const { return error_; }

 private:
  [[nodiscard]] Precedence next_operator() const {
    const Token* op = chain_[at_].op;
    return op == nullptr ? precedence(TokenKind::end) : precedence(op->kind);
  }

  // The operand at hand under its prefixes from `first`; a prefix takes what binds tighter than itself.
  Expr* prefixed(std::size_t first) {
    const ChainLink& link = chain_[at_];
    if (first == link.prefixes.size()) return link.operand;
    if (++nesting_ > kDeepestNesting) return fail(SyntaxError::Kind::too_deep, link.prefixes[first]);
    const Token* token = link.prefixes[first];
    const bool negates = token->kind == TokenKind::minus;
    Expr* operand = continued(prefixed(first + 1), negates ? kNegateLevel : kNotLevel);
    --nesting_;
    if (operand == nullptr) return nullptr;
    return make(ExprKind::unary, negates ? Operator::negate : Operator::logical_not, token, {operand},
                token->range.to(operand->range));
  }

  // `left` with the operators of at least `level` that follow it.
  Expr* continued(Expr* left, int level) {
    while (left != nullptr) {
      const Precedence next = next_operator();
      if (next.level == 0 || next.level < level) break;
      const Token* token = chain_[at_].op;
      ++at_;
      Expr* right = next.chaining == Chaining::right ? build(next.level) : build(next.level + 1);
      if (right == nullptr) return nullptr;
      if (next.chaining == Chaining::none && next_operator().level == next.level) {
        return fail(SyntaxError::Kind::does_not_chain, chain_[at_].op);
      }
      left = make(ExprKind::binary, next.op, token, {left, right}, left->range.to(right->range));
    }
    return left;
  }

  Expr* make(ExprKind kind, Operator op, const Token* token, std::vector<Expr*> operands, SourceRange range) {
    Expr expr;
    expr.kind = kind;
    expr.op = op;
    expr.range = range;
    expr.token = token->range;
    expr.operands = std::move(operands);
    Expr* made = tree_.make(std::move(expr));
    return made->depth > kDeepestTree ? fail(SyntaxError::Kind::too_deep, token) : made;
  }

  Expr* fail(SyntaxError::Kind kind, const Token* where) {
    if (!error_) error_ = SyntaxError{kind, where, {}};
    return nullptr;
  }

  const std::vector<ChainLink>& chain_;
  SyntaxTree& tree_;
  std::size_t at_ = 0;
  std::uint32_t nesting_ = 0;
  std::optional<SyntaxError> error_;
};

}  // namespace

Expr* build_chain(const std::vector<ChainLink>& chain, SyntaxTree& tree, std::optional<SyntaxError>& error) {
  ChainBuilder builder(chain, tree);
  Expr* expr = builder.build(1);
  error = builder.error();
  return expr;
}

}  // namespace hcsp::lang
