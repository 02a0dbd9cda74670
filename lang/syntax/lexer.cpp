// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "lang/syntax/token.h"

namespace hcsp::lang {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_word(char c) { return is_letter(c) || is_digit(c); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

struct Punctuation {
  std::string_view text;
  TokenKind kind;
};
// Longer ones before their prefixes.
constexpr std::array<Punctuation, 27> kPunctuation{{
    {"..", TokenKind::range},       {"+-", TokenKind::plus_minus},   {"==", TokenKind::equal},
    {"!=", TokenKind::not_equal},   {"<=", TokenKind::less_equal},   {">=", TokenKind::greater_equal},
    {";", TokenKind::semicolon},    {":", TokenKind::colon},         {",", TokenKind::comma},
    {".", TokenKind::dot},          {"(", TokenKind::left_paren},    {")", TokenKind::right_paren},
    {"[", TokenKind::left_bracket}, {"]", TokenKind::right_bracket}, {"{", TokenKind::left_brace},
    {"}", TokenKind::right_brace},  {"|", TokenKind::bar},           {"=", TokenKind::assign},
    {"+", TokenKind::plus},         {"-", TokenKind::minus},         {"*", TokenKind::star},
    {"/", TokenKind::slash},        {"^", TokenKind::caret},         {"\\", TokenKind::backslash},
    {"<", TokenKind::less},         {">", TokenKind::greater},       {"'", TokenKind::apostrophe},
}};

bool is_of(Dialect dialect, TokenKind kind) {
  if (kind == TokenKind::apostrophe) return dialect == Dialect::minibex;
  return dialect == Dialect::hcsp || (kind != TokenKind::range && kind != TokenKind::plus_minus);
}

class Lexer {
 public:
  Lexer(const Source& source, Diagnostics& diagnostics, Dialect dialect)
      : source_(source), text_(source.text()), diagnostics_(diagnostics), dialect_(dialect) {}

  std::vector<Token> run() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark says nothing in UTF-8
    while (at_ < text_.size()) step();
    tokens_.push_back({TokenKind::end, range(text_.size(), text_.size())});
    return std::move(tokens_);
  }

 private:
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  [[nodiscard]] bool sees(std::string_view text) const { return text_.substr(at_, text.size()) == text; }
  [[nodiscard]] SourceRange range(std::size_t begin, std::size_t end) const {
    return {&source_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
  void emit(TokenKind kind, std::size_t begin) { tokens_.push_back({kind, range(begin, at_)}); }

  void step() {
    const char c = peek();
    if (is_space(c)) {
      ++at_;
    } else if (sees("//")) {
      skip_to(std::min(text_.find_first_of(dialect_ == Dialect::minibex ? "\n\r" : "\n", at_), text_.size()));
    } else if (sees("/*")) {
      block_comment();
    } else if (is_letter(c)) {
      word();
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      number();
    } else if (c == '"') {
      string();
    } else if (c == '#' && dialect_ == Dialect::minibex) {
      bits();
    } else {
      punctuation();
    }
  }

  // Comments may hold any text, but an .hcsp file is UTF-8 throughout.
  void skip_to(std::size_t end) {
    if (dialect_ == Dialect::minibex) at_ = end;
    while (at_ < end) {
      const std::size_t length = code_point_length(text_, at_);
      if (length == 0) report_broken_utf8(at_);
      at_ += std::max<std::size_t>(length, 1);
    }
  }

  void report_broken_utf8(std::size_t at) {
    if (!utf8_reported_) diagnostics_.report(Code::broken_utf8, range(at, at + 1));
    utf8_reported_ = true;
  }

  void block_comment() {
    const std::size_t close = text_.find("*/", at_ + 2);
    if (close == std::string_view::npos) {
      diagnostics_.report(Code::unterminated_comment, range(at_, at_ + 2));
      at_ = text_.size();
    } else {
      skip_to(close + 2);
    }
  }

  void word() {
    const std::size_t begin = at_;
    while (is_word(peek())) ++at_;
    if (dialect_ == Dialect::minibex) return emit(TokenKind::identifier, begin);
    const std::string_view text = text_.substr(begin, at_ - begin);
    const auto& all = keywords();
    const auto found = std::lower_bound(all.begin(), all.end(), text);
    const bool after_dot = !tokens_.empty() && tokens_.back().kind == TokenKind::dot;
    if (after_dot || found == all.end() || *found != text) return emit(TokenKind::identifier, begin);
    emit(static_cast<TokenKind>(static_cast<std::ptrdiff_t>(TokenKind::kw_all) + (found - all.begin())),
         begin);
  }

  void digits() {
    while (is_digit(peek())) ++at_;
  }

  void number() {
    const std::size_t begin = at_;
    digits();
    // The dots of 1..3 are a range.
    if (peek() == '.' && (peek(1) != '.' || dialect_ == Dialect::minibex)) {
      ++at_;
      digits();
    }
    const bool is_exponent = (peek() == 'e' || peek() == 'E') &&
                             (is_digit(peek(1)) || ((peek(1) == '+' || peek(1) == '-') && is_digit(peek(2))));
    if (is_exponent) {
      at_ += 2;
      digits();
    }
    const bool runs_on = is_word(peek()) || (peek() == '.' && is_digit(peek(1)));
    if (runs_on) {
      while (is_word(peek()) || (peek() == '.' && is_digit(peek(1)))) ++at_;
      const std::string_view text = text_.substr(begin, std::min<std::size_t>(at_ - begin, 40));
      diagnostics_.report(Code::malformed_number, range(begin, at_), text);
    }
    emit(TokenKind::number, begin);
  }

  // A double by its bits.
  void bits() {
    const std::size_t begin = at_++;
    while (is_word(peek())) ++at_;
    emit(TokenKind::number, begin);
  }

  // The text up to the next quote, on one line; there are no escapes.
  void string() {
    const std::size_t begin = at_;
    const std::size_t close = text_.find_first_of("\"\n", at_ + 1);
    if (close == std::string_view::npos || text_[close] == '\n') {
      diagnostics_.report(Code::unterminated_string, range(begin, begin + 1));
      skip_to(std::min(close, text_.size()));
    } else {
      skip_to(close + 1);
    }
    emit(TokenKind::string, begin);
  }

  void punctuation() {
    for (const Punctuation& candidate : kPunctuation) {
      if (candidate.text.front() == peek() && sees(candidate.text) && is_of(dialect_, candidate.kind)) {
        const std::size_t begin = at_;
        at_ += candidate.text.size();
        return emit(candidate.kind, begin);
      }
    }
    const std::size_t begin = at_;
    const std::size_t length = code_point_length(text_, at_);
    at_ += std::max<std::size_t>(length, 1);
    const bool continues_a_run = begin == bad_until_;
    bad_until_ = at_;
    if (continues_a_run) return;
    if (length == 0) return report_broken_utf8(begin);
    const auto byte = static_cast<unsigned char>(text_[begin]);
    const std::string shown = byte < 0x20 || byte == 0x7F ? fmt::format("with code {}", byte)
                                                          : fmt::format("`{}`", text_.substr(begin, length));
    auto& diagnostic = diagnostics_.report(Code::bad_character, range(begin, at_), shown);
    if (dialect_ == Dialect::minibex) return;
    if (byte == '&') diagnostic.note("the word for it is `and`");
    if (byte == '!') diagnostic.note("the word for it is `not`");
  }

  const Source& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  Dialect dialect_;
  std::size_t at_ = 0;
  std::size_t bad_until_ = static_cast<std::size_t>(-1);
  bool utf8_reported_ = false;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokenize(const Source& source, Diagnostics& diagnostics, Dialect dialect) {
  return Lexer(source, diagnostics, dialect).run();
}

}  // namespace hcsp::lang
