// SPDX-License-Identifier: Apache-2.0
// The tokens of a Minibex source, read one after another, and its expressions by precedence climbing (Pratt,
// Top down operator precedence, POPL 1973).
#pragma once

#include <vector>

#include "lang/diagnostics.h"
#include "lang/minibex/ast.h"
#include "lang/syntax/token.h"

namespace hcsp::lang::minibex {

/// The words that are no names, in lower case, capitalised or in capitals; `in` in lower case only.
enum class Keyword : std::uint8_t {
  none,
  constants,
  variables,
  parameters,
  function,
  minimize,
  constraints,
  begin,
  end,
  for_loop,
  return_result,
  in,
};
Keyword keyword(const Token& token);

class ExpressionParser {
 public:
  ExpressionParser(const Source& source, Program& program, Diagnostics& diagnostics)
      : program_(program),
        diagnostics_(diagnostics),
        tokens_(tokenize(source, diagnostics, Dialect::minibex)) {}

  // Null after a report, here and below.
  const Expr* expression();

  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  [[nodiscard]] bool sees(TokenKind kind) const { return peek().kind == kind; }
  [[nodiscard]] bool sees(Keyword word) const { return keyword(peek()) == word; }
  [[nodiscard]] bool sees_name() const {
    return sees(TokenKind::identifier) && keyword(peek()) == Keyword::none;
  }
  const Token& next() { return at_ + 1 < tokens_.size() ? tokens_[at_++] : tokens_.back(); }
  bool accept(TokenKind kind) {
    const bool seen = sees(kind);
    if (seen) next();
    return seen;
  }
  bool accept(Keyword word) {
    const bool seen = sees(word);
    if (seen) next();
    return seen;
  }
  /// Reports what is there instead; false then.
  bool expect(TokenKind kind);
  bool expect(Keyword word, std::string_view spelt);
  void unexpected(std::string_view wanted);
  /// A name that is no keyword; without a text after a report.
  Name name();
  /// Whether a parenthesis here is around a constraint: a comparison stands in it outside further brackets.
  [[nodiscard]] bool sees_relation_in_parentheses() const;

 protected:
  [[nodiscard]] Program& program() { return program_; }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  /// From there to the last token that was read.
  [[nodiscard]] SourceRange since(const SourceRange& first) const {
    return at_ == 0 ? first : first.to(tokens_[at_ - 1].range);
  }

 private:
  const Expr* climb(int least);
  const Expr* operand();
  const Expr* sign();
  const Expr* parenthesised();
  const Expr* pair(Kind kind, TokenKind close);
  const Expr* apply(const Expr* base);
  const Expr* transposed(const Expr* base);
  const Expr* argument();
  const Expr* over_range(Kind kind);
  [[nodiscard]] bool starts_over_range() const;
  bool deepen();
  Expr& make(Kind kind, const SourceRange& range);

  Program& program_;
  Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::uint32_t depth_ = 0;
};

}  // namespace hcsp::lang::minibex
