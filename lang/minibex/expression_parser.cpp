// SPDX-License-Identifier: Apache-2.0
#include "lang/minibex/expression_parser.h"

#include <array>

#include "lang/syntax/parser.h"

namespace hcsp::lang::minibex {

namespace {

struct Word {
  std::string_view text;
  Keyword keyword;
};
constexpr std::array<Word, 11> kWords{{{"constants", Keyword::constants},
                                       {"variables", Keyword::variables},
                                       {"parameters", Keyword::parameters},
                                       {"function", Keyword::function},
                                       {"minimize", Keyword::minimize},
                                       {"constraints", Keyword::constraints},
                                       {"begin", Keyword::begin},
                                       {"end", Keyword::end},
                                       {"for", Keyword::for_loop},
                                       {"return", Keyword::return_result},
                                       {"in", Keyword::in}}};

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

// word, Word or WORD.
bool is_spelt(std::string_view text, const Word& word) {
  if (text.size() != word.text.size()) return false;
  if (text == word.text) return true;
  if (word.keyword == Keyword::in || text[0] != upper(word.text[0])) return false;
  const bool capitals = text[1] == upper(word.text[1]);
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] != (capitals ? upper(word.text[i]) : word.text[i])) return false;
  }
  return true;
}

bool is_comparison(TokenKind kind) {
  return kind == TokenKind::assign || kind == TokenKind::less_equal || kind == TokenKind::greater_equal ||
         kind == TokenKind::less || kind == TokenKind::greater;
}

// How tight operators bind.
constexpr int kSum = 1;
constexpr int kProduct = 2;
constexpr int kPower = 3;
constexpr int kIndex = 4;

struct Infix {
  int level = 0;  // of what is no operator
  Operator op = Operator::add;
  bool is_suffix = false;
};

Infix infix_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::plus:
      return {kSum, Operator::add};
    case TokenKind::minus:
      return {kSum, Operator::subtract};
    case TokenKind::star:
      return {kProduct, Operator::multiply};
    case TokenKind::slash:
      return {kProduct, Operator::divide};
    case TokenKind::caret:
      return {kPower, Operator::power};
    case TokenKind::apostrophe:
      return {kPower, {}, true};
    case TokenKind::left_paren:
    case TokenKind::left_bracket:
      return {kIndex, {}, true};
    default:
      return {};
  }
}

bool ends_an_operand(const Token& token) {
  switch (token.kind) {
    case TokenKind::identifier:
      return keyword(token) == Keyword::none;
    case TokenKind::number:
    case TokenKind::right_paren:
    case TokenKind::right_bracket:
    case TokenKind::apostrophe:
      return true;
    default:
      return false;
  }
}

}  // namespace

Keyword keyword(const Token& token) {
  if (token.kind != TokenKind::identifier) return Keyword::none;
  const std::string_view text = token.text();
  constexpr std::size_t kShortest = 2, kLongest = 11;
  if (text.size() < kShortest || text.size() > kLongest) return Keyword::none;
  for (const Word& word : kWords) {
    if (is_spelt(text, word)) return word.keyword;
  }
  return Keyword::none;
}

// ---- Tokens.

void ExpressionParser::unexpected(std::string_view wanted) {
  diagnostics_.report(Code::unexpected, peek().range, wanted, describe(peek()));
}

bool ExpressionParser::expect(TokenKind kind) {
  if (accept(kind)) return true;
  unexpected(describe(kind));
  return false;
}

bool ExpressionParser::expect(Keyword word, std::string_view spelt) {
  if (accept(word)) return true;
  unexpected(fmt::format("`{}`", spelt));
  return false;
}

Name ExpressionParser::name() {
  if (sees_name()) {
    const Token& token = next();
    return {token.text(), token.range};
  }
  if (sees(TokenKind::identifier)) {
    diagnostics_.report(Code::reserved_word, peek().range, peek().text());
  } else {
    unexpected("a name");
  }
  return {};
}

// `<` behind an operator is the start of a ball, which the next `>` ends.
bool ExpressionParser::sees_relation_in_parentheses() const {
  std::size_t leading = 0;  // ((a = b)) is one, too
  while (peek(leading).kind == TokenKind::left_paren) ++leading;
  std::size_t depth = 0;
  bool in_ball = false;
  for (std::size_t at = at_; at < tokens_.size(); ++at) {
    const Token& token = tokens_[at];
    if (token.kind == TokenKind::left_paren || token.kind == TokenKind::left_bracket) ++depth;
    if (token.kind == TokenKind::right_paren || token.kind == TokenKind::right_bracket) --depth;
    if (depth == 0 || token.kind == TokenKind::semicolon) return false;
    if (depth > leading) continue;
    if (keyword(token) == Keyword::in) return true;
    if (!is_comparison(token.kind)) continue;
    const bool opens = token.kind == TokenKind::less && !ends_an_operand(tokens_[at - 1]);
    if (!opens && !(in_ball && token.kind == TokenKind::greater)) return true;
    in_ball = opens;
  }
  return false;
}

// ---- Expressions.

Expr& ExpressionParser::make(Kind kind, const SourceRange& range) {
  Expr& expr = program_.expressions.emplace_back();
  expr.kind = kind;
  expr.range = range;
  return expr;
}

bool ExpressionParser::deepen() {
  if (++depth_ <= kDeepestNesting) return true;
  diagnostics_.report(Code::too_deep, peek().range, kDeepestNesting, kDeepestTree);
  return false;
}

const Expr* ExpressionParser::expression() {
  const std::uint32_t outer = depth_;
  const Expr* found = climb(kSum);
  depth_ = outer;
  return found;
}

const Expr* ExpressionParser::climb(int least) {
  const std::uint32_t outer = depth_;
  const Expr* left = operand();
  while (left != nullptr) {
    const Infix infix = infix_of(peek().kind);
    if (infix.level < least) break;
    if (infix.is_suffix) {
      // A tree is as deep as its suffixes are many.
      if (!deepen()) return nullptr;
      left = sees(TokenKind::apostrophe) ? transposed(left) : apply(left);
      continue;
    }
    const SourceRange sign = next().range;
    const Expr* right = climb(infix.level + 1);
    if (right == nullptr) return nullptr;
    Expr& binary = make(Kind::binary, left->range.to(right->range));
    binary.op = infix.op;
    binary.token = sign;
    binary.operands = {left, right};
    left = &binary;
  }
  depth_ = outer;
  return left;
}

const Expr* ExpressionParser::transposed(const Expr* base) {
  Expr& transpose = make(Kind::transpose, base->range.to(next().range));
  transpose.operands = {base};
  return &transpose;
}

const Expr* ExpressionParser::operand() {
  const Token& token = peek();
  switch (token.kind) {
    case TokenKind::number:
    case TokenKind::identifier: {
      if (keyword(token) != Keyword::none) break;
      if (starts_over_range()) return over_range(token.text() == "sum" ? Kind::sum : Kind::product);
      Expr& leaf = make(token.kind == TokenKind::number ? Kind::number : Kind::name, next().range);
      leaf.text = token.text();
      return &leaf;
    }
    case TokenKind::plus:
    case TokenKind::minus:
    case TokenKind::left_paren:
    case TokenKind::left_bracket:
    case TokenKind::less: {
      if (!deepen()) return nullptr;
      const Expr* found = token.kind == TokenKind::left_paren ? parenthesised()
                          : token.kind == TokenKind::left_bracket
                              ? pair(Kind::interval, TokenKind::right_bracket)
                          : token.kind == TokenKind::less ? pair(Kind::ball, TokenKind::greater)
                                                          : sign();
      --depth_;
      return found;
    }
    default:
      break;
  }
  unexpected("an expression");
  return nullptr;
}

// A sign binds like a sum, so its operand is a whole product.
const Expr* ExpressionParser::sign() {
  const Token& token = next();
  const Expr* signed_part = climb(kProduct);
  if (signed_part == nullptr || token.kind == TokenKind::plus) return signed_part;
  Expr& negated = make(Kind::negate, token.range.to(signed_part->range));
  negated.operands = {signed_part};
  return &negated;
}

const Expr* ExpressionParser::pair(Kind kind, TokenKind close) {
  const SourceRange open = next().range;
  const Expr* first = expression();
  if (first == nullptr || !expect(TokenKind::comma)) return nullptr;
  const Expr* second = expression();
  if (second == nullptr || !expect(close)) return nullptr;
  Expr& found = make(kind, since(open));
  found.operands = {first, second};
  return &found;
}

// (a), the row (a, b), or the column (a; b).
const Expr* ExpressionParser::parenthesised() {
  const SourceRange open = next().range;
  std::vector<const Expr*> parts{expression()};
  const TokenKind between = peek().kind;
  if (between == TokenKind::comma || between == TokenKind::semicolon) {
    while (parts.back() != nullptr && accept(between)) parts.push_back(expression());
  }
  if (parts.back() == nullptr || !expect(TokenKind::right_paren)) return nullptr;
  if (parts.size() == 1) return parts.front();
  Expr& vector = make(between == TokenKind::comma ? Kind::row : Kind::column, since(open));
  vector.operands = std::move(parts);
  return &vector;
}

// An index, or an argument of a call.
const Expr* ExpressionParser::argument() {
  if (sees(TokenKind::colon)) return &make(Kind::all, next().range);
  const Expr* first = expression();
  if (first == nullptr || !accept(TokenKind::colon)) return first;
  const Expr* last = expression();
  if (last == nullptr) return nullptr;
  Expr& span = make(Kind::span, first->range.to(last->range));
  span.operands = {first, last};
  return &span;
}

const Expr* ExpressionParser::apply(const Expr* base) {
  const bool brackets = next().kind == TokenKind::left_bracket;
  if (!deepen()) return nullptr;
  std::vector<const Expr*> operands{base};
  do {
    operands.push_back(argument());
    if (operands.back() == nullptr) return nullptr;
  } while (!brackets && accept(TokenKind::comma));
  if (!expect(brackets ? TokenKind::right_bracket : TokenKind::right_paren)) return nullptr;
  --depth_;
  Expr& applied = make(Kind::apply, since(base->range));
  applied.brackets = brackets;
  applied.operands = std::move(operands);
  return &applied;
}

// sum(i = 1:n, ...), prod(i = 1:n, ...).
bool ExpressionParser::starts_over_range() const {
  return (peek().text() == "sum" || peek().text() == "prod") && peek(1).kind == TokenKind::left_paren &&
         peek(2).kind == TokenKind::identifier && peek(3).kind == TokenKind::assign;
}

const Expr* ExpressionParser::over_range(Kind kind) {
  const SourceRange word = next().range;
  next();
  if (!deepen()) return nullptr;
  const Name iterator = name();
  if (iterator.text.empty() || !expect(TokenKind::assign)) return nullptr;
  const Expr* first = expression();
  if (first == nullptr || !expect(TokenKind::colon)) return nullptr;
  const Expr* last = expression();
  if (last == nullptr || !expect(TokenKind::comma)) return nullptr;
  const Expr* body = expression();
  if (body == nullptr || !expect(TokenKind::right_paren)) return nullptr;
  --depth_;
  Expr& found = make(kind, since(word));
  found.text = iterator.text;
  found.token = iterator.range;
  found.operands = {first, last, body};
  return &found;
}

}  // namespace hcsp::lang::minibex
