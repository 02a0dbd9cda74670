// SPDX-License-Identifier: Apache-2.0
// The verifier's own reading of expressions, by recursive descent; for models in .hcsp and in Minibex.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace hcsp::verifier {

/// A text that the verifier does not understand; the message names the line.
struct Unreadable : std::runtime_error {
  Unreadable(int line, const std::string& what)
      : std::runtime_error("line " + std::to_string(line) + ": " + what) {}
};

struct Token {
  enum class Kind { name, number, sign, end } kind;
  std::string text;
  int line;
};

/// Without comments (`//`, `/* */`).
std::vector<Token> tokens_of(const std::string& text);

/// What an expression is made of. Heads are operators ("+", "==", "in", ...) and "number", "name", "call",
/// "index", "vector", "interval", "if", "each" (a vector of values) and the names of what binds ("sum",
/// "prod", "forall"), whose last part is the body; the parts before it are "bound".
struct Tree {
  std::string head;
  std::string text;
  int line;
  std::vector<Tree> parts;
};

/// Reads token by token.
class Reader {
 public:
  explicit Reader(const std::string& text) : tokens_(tokens_of(text)) {}

  [[nodiscard]] const Token& token(std::size_t ahead = 0) const;
  [[nodiscard]] bool sees(const std::string& text) const { return token().text == text; }
  [[nodiscard]] bool at_end() const { return token().kind == Token::Kind::end; }
  bool take(const std::string& text);  ///< whether it came next
  void expect(const std::string& text);
  std::string name();
  Tree expression() { return operators(0); }
  std::vector<Tree> list(const std::string& close);

 private:
  Tree operators(std::size_t level);
  Tree prefixed();
  Tree power();
  Tree postfixed();
  Tree primary();
  Tree parenthesised();
  Tree binder();
  Tree choice();
  std::vector<Tree> bounds();
  [[nodiscard]] bool sees_bounds() const;

  std::vector<Token> tokens_;
  std::size_t next_ = 0;
};

}  // namespace hcsp::verifier
