// SPDX-License-Identifier: Apache-2.0
#include "tests/verifier/tree.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace hcsp::verifier {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The length of the number at a place; `1..n` starts with the number 1.
std::size_t number_length(const std::string& text, std::size_t at) {
  std::size_t end = at;
  const auto digits = [&] {
    while (end < text.size() && is_digit(text[end])) ++end;
  };
  digits();
  if (end < text.size() && text[end] == '.' && text.compare(end, 2, "..") != 0) {
    ++end;
    digits();
  }
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) {
      end = exponent;
      digits();
    }
  }
  return end - at;
}

std::size_t sign_length(const std::string& text, std::size_t at) {
  static const std::array<std::string, 6> kLong = {"==", "<=", ">=", "!=", "..", "+-"};
  return std::any_of(kLong.begin(), kLong.end(),
                     [&](const std::string& sign) { return text.compare(at, 2, sign) == 0; })
             ? 2
             : 1;
}

/// From the loosest to the tightest, what binds to the left.
const std::vector<std::vector<std::string>> kLevels = {
    {"or"}, {"and"}, {"==", "=", "!=", "<=", ">=", "<", ">", "in"}, {"..", "+-"}, {"+", "-"}, {"*", "/"}};

}  // namespace

std::vector<Token> tokens_of(const std::string& text) {
  std::vector<Token> tokens;
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 1;
    if (text.compare(at, 2, "//") == 0) {
      length = std::min(text.find('\n', at), text.size()) - at;
    } else if (text.compare(at, 2, "/*") == 0) {
      length = std::min(text.find("*/", at + 2), text.size() - 2) + 2 - at;
    } else if (is_letter(text[at])) {
      while (at + length < text.size() && (is_letter(text[at + length]) || is_digit(text[at + length])))
        ++length;
      tokens.push_back({Token::Kind::name, text.substr(at, length), line});
    } else if (is_digit(text[at])) {
      length = number_length(text, at);
      tokens.push_back({Token::Kind::number, text.substr(at, length), line});
    } else if (std::isspace(static_cast<unsigned char>(text[at])) == 0) {
      length = sign_length(text, at);
      tokens.push_back({Token::Kind::sign, text.substr(at, length), line});
    }
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(at);
    line += static_cast<int>(std::count(begin, begin + static_cast<std::ptrdiff_t>(length), '\n'));
    at += length;
  }
  tokens.push_back({Token::Kind::end, "", line});
  return tokens;
}

const Token& Reader::token(std::size_t ahead) const {
  return tokens_[std::min(next_ + ahead, tokens_.size() - 1)];
}

bool Reader::take(const std::string& text) {
  if (!sees(text)) return false;
  ++next_;
  return true;
}

void Reader::expect(const std::string& text) {
  if (!take(text)) throw Unreadable(token().line, "expected " + text + ", found " + token().text);
}

std::string Reader::name() {
  if (token().kind != Token::Kind::name)
    throw Unreadable(token().line, "expected a name, found " + token().text);
  return tokens_[next_++].text;
}

std::vector<Tree> Reader::list(const std::string& close) {
  std::vector<Tree> parts;
  do parts.push_back(expression());
  while (take(","));
  expect(close);
  return parts;
}

Tree Reader::operators(std::size_t level) {
  if (level == kLevels.size()) return prefixed();
  Tree left = operators(level + 1);
  for (;;) {
    const auto& here = kLevels[level];
    if (token().kind == Token::Kind::end || std::find(here.begin(), here.end(), token().text) == here.end())
      return left;
    const Token sign = tokens_[next_++];
    left = {sign.text, "", sign.line, {left, operators(level + 1)}};
  }
}

Tree Reader::prefixed() {
  const int line = token().line;
  if (take("-")) return {"negate", "", line, {prefixed()}};
  if (take("+")) return prefixed();
  if (take("not")) return {"not", "", line, {prefixed()}};
  return power();
}

Tree Reader::power() {
  Tree base = postfixed();
  const int line = token().line;
  if (!take("^")) return base;
  return {"^", "", line, {base, prefixed()}};
}

Tree Reader::postfixed() {
  Tree tree = primary();
  for (;;) {
    const int line = token().line;
    if (take("[")) {
      tree = {"index", "", line, {tree}};
      for (Tree& part : list("]")) tree.parts.push_back(std::move(part));
    } else if (tree.head == "name" && take("(")) {
      tree = {"call", tree.text, line, list(")")};
    } else {
      return tree;
    }
  }
}

bool Reader::sees_bounds() const {
  return token(0).text == "(" && token(1).kind == Token::Kind::name && token(2).text == "in";
}

std::vector<Tree> Reader::bounds() {
  std::vector<Tree> bounds;
  do {
    const int line = token().line;
    const std::string bound = name();
    expect("in");
    bounds.push_back({"bound", bound, line, {operators(3)}});
  } while (take(","));
  return bounds;
}

Tree Reader::binder() {
  const Token word = tokens_[next_++];
  expect("(");
  Tree tree{word.text, "", word.line, bounds()};
  expect(")");
  if (word.text == "forall") {
    tree.parts.push_back(expression());
  } else {
    expect("(");
    tree.parts.push_back(expression());
    expect(")");
  }
  return tree;
}

Tree Reader::choice() {
  Tree tree{"if", "", token().line, {expression()}};
  expect("then");
  tree.parts.push_back(expression());
  expect("else");
  tree.parts.push_back(expression());
  expect("endif");
  return tree;
}

Tree Reader::parenthesised() {
  const int line = token().line;
  Tree first = expression();
  if (take("|")) {
    Tree tree{"each", "", line, bounds()};
    tree.parts.push_back(std::move(first));
    expect(")");
    return tree;
  }
  if (take(")")) return first;
  expect(",");
  Tree tree{"vector", "", line, {std::move(first)}};
  for (Tree& part : list(")")) tree.parts.push_back(std::move(part));
  return tree;
}

Tree Reader::primary() {
  const Token here = token();
  if (take("(")) return parenthesised();
  if (take("[")) return {"interval", "", here.line, list("]")};
  if (take("if")) return choice();
  if ((here.text == "sum" || here.text == "prod" || here.text == "forall")) {
    ++next_;
    const bool binds = sees_bounds();
    --next_;
    if (binds) return binder();
  }
  if (here.kind == Token::Kind::number) {
    ++next_;
    return {"number", here.text, here.line, {}};
  }
  return {"name", name(), here.line, {}};
}

}  // namespace hcsp::verifier
