// SPDX-License-Identifier: Apache-2.0
#include "lang/minibex/parser.h"

#include "lang/minibex/expression_parser.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang::minibex {

namespace {

class Parser : public ExpressionParser {
 public:
  using ExpressionParser::ExpressionParser;

  void read() {
    while (!sees(TokenKind::end) && diagnostics().count() < kMostMistakes) section();
  }
  const Expr* lone_expression() {
    const Expr* found = expression();
    return found != nullptr && expect(TokenKind::end) ? found : nullptr;
  }

 private:
  void section() {
    const Token& start = peek();
    switch (keyword(start)) {
      case Keyword::constants:
        once(has_constants_);
        return declarations(program().constants, &Parser::constant);
      case Keyword::variables:
        once(has_variables_);
        return declarations(program().variables, &Parser::variable);
      case Keyword::function:
        if (!function()) skip_to_section();
        return;
      case Keyword::minimize:
        once(has_goal_);
        program().goal = expression();
        if (program().goal == nullptr || !ends_section(accept(TokenKind::semicolon))) skip_to_section();
        return;
      case Keyword::constraints:
        once(has_constraints_);
        return constraints();
      case Keyword::parameters:
        diagnostics().report(Code::not_supported, start.range, "the section `Parameters`");
        next();
        return skip_to_section();
      default:
        unexpected(has_constraints_ ? "the end of the file" : "a section, such as `Variables`");
        skip_to_section();
    }
  }

  void once(bool& seen) {
    if (seen) diagnostics().report(Code::item_twice, peek().range, peek().text());
    seen = true;
    next();
  }

  [[nodiscard]] bool sees_section() const {
    switch (keyword(peek())) {
      case Keyword::constants:
      case Keyword::variables:
      case Keyword::parameters:
      case Keyword::function:
      case Keyword::minimize:
      case Keyword::constraints:
        return true;
      default:
        return sees(TokenKind::end);
    }
  }
  bool ends_section(bool has_semicolon) {
    if (has_semicolon || sees_section()) return true;
    unexpected("`;`");
    return false;
  }
  void skip_to_section() {
    while (!sees_section()) next();
  }
  /// Behind the next semicolon, or before what ends a section; for true there is more to read.
  void skip_statement() {
    while (!sees_section() && !sees(Keyword::end)) {
      if (next().kind == TokenKind::semicolon) return;
    }
  }
  [[nodiscard]] bool gives_up() { return diagnostics().count() >= kMostMistakes; }

  // Constants and variables: they end with a semicolon each, variables with a comma too.
  void declarations(std::vector<Declaration>& found, bool (Parser::*read)(Declaration&)) {
    while (!sees_section() && !gives_up()) {
      if (accept(TokenKind::semicolon)) continue;
      Declaration declaration;
      const bool good = (this->*read)(declaration);
      if (good) found.push_back(std::move(declaration));
      const bool goes_on = read == &Parser::variable && accept(TokenKind::comma);
      if (!good || (!goes_on && !accept(TokenKind::semicolon))) {
        if (good) unexpected("`;`");
        skip_statement();
        accept(Keyword::end);
      }
    }
  }

  bool name_and_sizes(Declaration& declaration) {
    declaration.name = name();
    if (declaration.name.text.empty()) return false;
    while (sees(TokenKind::left_bracket)) {
      next();
      const Expr* size = expression();
      if (size == nullptr || !expect(TokenKind::right_bracket)) return false;
      declaration.sizes.push_back(size);
    }
    return true;
  }

  // A star marks a constant that a program may change later: a constant here.
  bool constant(Declaration& declaration) {
    accept(TokenKind::star);
    if (!name_and_sizes(declaration)) return false;
    if (!accept(TokenKind::assign) && !accept(Keyword::in)) {
      unexpected("`=` or `in`");
      return false;
    }
    declaration.value = expression();
    return declaration.value != nullptr;
  }

  bool variable(Declaration& declaration) {
    if (!name_and_sizes(declaration)) return false;
    declaration.whole = peek().text() == "integer" || peek().text() == "int";
    if (declaration.whole) next();
    if (!accept(Keyword::in)) return !declaration.whole || expect(Keyword::in, "in");
    declaration.value = expression();
    return declaration.value != nullptr;
  }

  bool function() {
    next();
    Function found;
    found.name = name();
    if (found.name.text.empty() || !expect(TokenKind::left_paren)) return false;
    do {
      if (!name_and_sizes(found.arguments.emplace_back())) return false;
    } while (accept(TokenKind::comma));
    if (!expect(TokenKind::right_paren)) return false;
    while (!sees(Keyword::return_result)) {
      if (accept(TokenKind::semicolon)) continue;
      Definition& definition = found.definitions.emplace_back();
      if (!sees_name()) {
        unexpected("`return`");
        return false;
      }
      definition.name = name();
      if (!expect(TokenKind::assign)) return false;
      definition.value = expression();
      if (definition.value == nullptr || !expect(TokenKind::semicolon)) return false;
    }
    next();
    found.result = expression();
    if (found.result == nullptr) return false;
    accept(TokenKind::semicolon);
    if (!expect(Keyword::end, "end")) return false;
    accept(TokenKind::semicolon);
    program().functions.push_back(std::move(found));
    return true;
  }

  void constraints() {
    statements(program().constraints);
    if (expect(Keyword::end, "end")) accept(TokenKind::semicolon);
  }

  // Up to an `end`, or to what cannot be within: the caller expects the `end`.
  void statements(std::vector<Statement>& found) {
    while (!sees_section() && !sees(Keyword::end) && !gives_up()) {
      if (accept(TokenKind::semicolon)) continue;
      const std::size_t mistakes = diagnostics().count();
      const SourceRange start = peek().range;
      const std::uint32_t outer = loops_;
      const bool is_loop = sees(Keyword::for_loop);
      Statement statement;
      const bool good = is_loop ? loop(statement) : constraint(statement);
      statement.range = since(start);
      loops_ = outer;
      if (good) found.push_back(std::move(statement));
      if (good && (accept(TokenKind::semicolon) || is_loop || sees(Keyword::end))) continue;
      if (diagnostics().count() == mistakes) not_ended();
      skip_statement();
    }
  }

  void not_ended() {
    if (find_comparison()) {
      diagnostics().report(Code::does_not_chain, peek().range, peek().text());
    } else {
      unexpected("`;`");
    }
  }

  bool loop(Statement& statement) {
    next();
    if (!deepen_loops()) return false;
    Loop found;
    found.iterator = name();
    if (found.iterator.text.empty() || !expect(TokenKind::assign)) return false;
    found.first = expression();
    if (found.first == nullptr || !expect(TokenKind::colon)) return false;
    found.last = expression();
    if (found.last == nullptr || !expect(TokenKind::semicolon)) return false;
    statements(found.body);
    if (!expect(Keyword::end, "end")) return false;
    statement.content = std::move(found);
    return true;
  }

  bool deepen_loops() {
    if (++loops_ <= kDeepestNesting) return true;
    diagnostics().report(Code::too_deep, peek().range, kDeepestNesting, kDeepestTree);
    return false;
  }

  std::optional<Operator> find_comparison() {
    switch (peek().kind) {
      case TokenKind::assign:
        return Operator::equal;
      case TokenKind::less_equal:
        return Operator::less_equal;
      case TokenKind::greater_equal:
        return Operator::greater_equal;
      case TokenKind::less:
        return Operator::less;
      case TokenKind::greater:
        return Operator::greater;
      default:
        return sees(Keyword::in) ? std::optional(Operator::in) : std::nullopt;
    }
  }

  bool constraint(Statement& statement) {
    std::size_t around = 0;
    while (sees(TokenKind::left_paren) && sees_relation_in_parentheses() && around <= kDeepestNesting) {
      next();
      ++around;
    }
    const bool is_integrality = peek().text() == "integer" && peek(1).kind == TokenKind::left_paren;
    if (!(is_integrality ? integrality(statement) : relation(statement))) return false;
    for (; around > 0; --around) {
      if (!sees(TokenKind::right_paren)) not_ended();
      if (!accept(TokenKind::right_paren)) return false;
    }
    return true;
  }

  bool integrality(Statement& statement) {
    next();
    next();
    const Expr* argument = expression();
    if (argument == nullptr || !expect(TokenKind::right_paren)) return false;
    statement.content = Integrality{argument};
    return true;
  }

  bool relation(Statement& statement) {
    Relation found;
    found.left = expression();
    if (found.left == nullptr) return false;
    const auto op = find_comparison();
    if (!op) {
      unexpected("a comparison");
      return false;
    }
    next();
    found.op = *op;
    found.right = expression();
    statement.content = found;
    return found.right != nullptr;
  }

  bool has_constants_ = false;
  bool has_variables_ = false;
  bool has_goal_ = false;
  bool has_constraints_ = false;
  std::uint32_t loops_ = 0;
};

}  // namespace

Program parse(const Source& source, Diagnostics& diagnostics) {
  Program program;
  Parser(source, program, diagnostics).read();
  return program;
}

const Expr* parse_expression(const Source& source, Program& program, Diagnostics& diagnostics) {
  return Parser(source, program, diagnostics).lone_expression();
}

}  // namespace hcsp::lang::minibex
