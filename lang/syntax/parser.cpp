// SPDX-License-Identifier: Apache-2.0
#include "lang/syntax/parser.h"

#include "lang/syntax/grammar.h"

namespace hcsp::lang {

namespace {

bool starts_item(TokenKind kind) {
  switch (kind) {
    case TokenKind::kw_model:
    case TokenKind::kw_include:
    case TokenKind::kw_param:
    case TokenKind::kw_data:
    case TokenKind::kw_time:
    case TokenKind::kw_function:
    case TokenKind::kw_given:
    case TokenKind::kw_var:
    case TokenKind::kw_let:
    case TokenKind::kw_constraint:
    case TokenKind::kw_implied:
    case TokenKind::kw_family:
    case TokenKind::kw_solve:
    case TokenKind::kw_show:
      return true;
    default:
      return false;
  }
}

const std::vector<std::string>& item_words() {
  static const std::vector<std::string> words{"model",    "include", "param", "data", "time",
                                              "function", "given",   "var",   "let",  "constraint",
                                              "implied",  "family",  "solve", "show"};
  return words;
}

// A thing that is missing at the end of a line is missed there, not where the next line starts.
SourceRange place_of(const SyntaxError& error, const Token* first) {
  const Token& found = *error.where;
  const bool at_token = error.kind != SyntaxError::Kind::expected || error.expected == "an item";
  if (&found == first || at_token) return found.range;
  const SourceRange& before = (&found - 1)->range;
  const std::string_view between =
      found.range.source->text().substr(before.end, found.range.begin - before.end);
  if (between.find('\n') == std::string_view::npos && found.kind != TokenKind::end) return found.range;
  return {before.source, before.end, before.end};
}

void report(const SyntaxError& error, const Token* first, Diagnostics& diagnostics) {
  const Token& found = *error.where;
  const SourceRange place = place_of(error, first);
  switch (error.kind) {
    case SyntaxError::Kind::too_deep:
      diagnostics.report(Code::too_deep, place, kDeepestNesting, kDeepestTree);
      return;
    case SyntaxError::Kind::does_not_chain:
      diagnostics.report(Code::does_not_chain, place, found.text())
          .note(found.kind == TokenKind::plus_minus || found.kind == TokenKind::range
                    ? "write parentheses around one of them"
                    : "write `a < b and b < c`");
      return;
    case SyntaxError::Kind::expected:
      break;
  }
  // In a list of parameters, what could also end it is what was expected.
  const bool declares = found.kind != TokenKind::end && (&found + 1)->kind == TokenKind::colon;
  if (is_keyword(found.kind) && (error.expected == "a name" || declares)) {
    diagnostics.report(Code::reserved_word, place, found.text());
    return;
  }
  auto& diagnostic = diagnostics.report(Code::unexpected, place, error.expected, describe(found));
  if (error.expected == "an item") {
    diagnostic.note(
        "an item starts with model, include, param, data, time, function, given, var, let, constraint, "
        "implied, family, solve or show");
    if (found.kind == TokenKind::identifier) diagnostic.did_you_mean(found.text(), item_words());
  }
  if (found.kind == TokenKind::assign && error.expected == "`;`") diagnostic.note("equality is written `==`");
}

// Behind the next `;`, or at the next word that starts an item on a line of its own.
const Token* recover(const Token* from, const Token* last) {
  for (const Token* at = from; at != last; ++at) {
    if (at->kind == TokenKind::semicolon) return at + 1;
    if (starts_item(at->kind) && at != from) return at;
  }
  return last;
}

}  // namespace

void parse_items(const Source& source, SyntaxTree& tree, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.count();
  const std::vector<Token> tokens = tokenize(source, diagnostics);
  const std::size_t after = diagnostics.count();
  // What follows from a character that was skipped is no second mistake.
  const auto is_told = [&](const Token& from, const Token& to) {
    for (std::size_t i = before; i < after; ++i) {
      const std::uint32_t at = diagnostics.all()[i].range.begin;
      if (from.range.begin <= at && at <= to.range.end) return true;
    }
    return false;
  };
  const Token* const last = &tokens.back();
  for (const Token* at = tokens.data(); at != last;) {
    const Token* const first = at;
    Item item;
    if (const auto error = read_item(at, last + 1, tree, item)) {
      if (!is_told(*first, *error->where)) report(*error, tokens.data(), diagnostics);
      const bool stands_at_item = starts_item(error->where->kind) && error->where != first;
      at = stands_at_item ? error->where : recover(error->where == last ? last : error->where, last);
      continue;
    }
    item.range = first->range.to((at - 1)->range);
    tree.items.push_back(std::move(item));
  }
}

Expr* parse_expression(const Source& source, SyntaxTree& tree, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.count();
  const std::vector<Token> tokens = tokenize(source, diagnostics);
  const Token* at = tokens.data();
  Expr* expr = nullptr;
  if (const auto error = read_expression(at, &tokens.back() + 1, tree, expr)) {
    report(*error, tokens.data(), diagnostics);
    return nullptr;
  }
  if (at->kind != TokenKind::end) {
    report({SyntaxError::Kind::expected, at, describe(TokenKind::end)}, tokens.data(), diagnostics);
    return nullptr;
  }
  return diagnostics.count() == before ? expr : nullptr;
}

}  // namespace hcsp::lang
