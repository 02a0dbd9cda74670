// SPDX-License-Identifier: Apache-2.0
#include "lang/syntax/format.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace {

constexpr std::size_t kWidth = 100;
constexpr std::string_view kIndent = "    ";
constexpr int kNoBreak = std::numeric_limits<int>::max();

// ---- White space between tokens.

bool ends_operand(TokenKind kind) {
  switch (kind) {
    case TokenKind::identifier:
    case TokenKind::number:
    case TokenKind::string:
    case TokenKind::right_paren:
    case TokenKind::right_bracket:
    case TokenKind::right_brace:
    case TokenKind::kw_oo:
    case TokenKind::kw_true:
    case TokenKind::kw_false:
    case TokenKind::kw_endif:
      return true;
    default:
      return false;
  }
}

bool is_tight(TokenKind kind) {
  return kind == TokenKind::star || kind == TokenKind::slash || kind == TokenKind::caret ||
         kind == TokenKind::range || kind == TokenKind::dot;
}

// How strongly a line holds together before or after a token; the less, the sooner it is broken.
int break_before(TokenKind kind) {
  switch (kind) {
    case TokenKind::kw_and:
    case TokenKind::kw_or:
    case TokenKind::kw_xor:
    case TokenKind::kw_implies:
    case TokenKind::kw_iff:
    case TokenKind::kw_where:
      return 0;
    case TokenKind::kw_then:
    case TokenKind::kw_else:
    case TokenKind::kw_union:
    case TokenKind::kw_inter:
    case TokenKind::kw_symdiff:
    case TokenKind::backslash:
      return 1;
    case TokenKind::equal:
    case TokenKind::less:
    case TokenKind::less_equal:
    case TokenKind::greater:
    case TokenKind::greater_equal:
    case TokenKind::not_equal:
    case TokenKind::kw_in:
    case TokenKind::kw_subset:
      return 3;
    case TokenKind::plus:
    case TokenKind::minus:
    case TokenKind::plus_minus:
      return 4;
    default:
      return kNoBreak;
  }
}

int break_after(TokenKind kind) {
  if (kind == TokenKind::comma) return 0;
  return kind == TokenKind::assign || kind == TokenKind::colon || kind == TokenKind::bar ? 2 : kNoBreak;
}

// A token or a comment of an item, with what stands before it.
struct Atom {
  std::string_view text;
  bool space = false;       // before it, on one line
  bool new_line = false;    // it starts a line whatever the width
  int strength = kNoBreak;  // of what holds it to the one before
  bool ends_line = false;   // a comment to the end of the line
};

// Walks the tokens of an item and says how they are spaced.
class Spacing {
 public:
  /// `token` stands in the list of all, which ends with TokenKind::end.
  Atom next(const Token& token) {
    Atom atom{token.text()};
    const bool is_first = count_ == 0;
    const bool operand_before = !is_first && ends_operand(last_) && !after_bindings_;
    const bool prefix =
        !operand_before && (token.kind == TokenKind::minus || is_word_of_quantifier(token.kind));
    atom.space = !is_first && wants_space(token.kind, operand_before);
    if (!is_first && atom.space) {
      const int strength = std::min(prefix ? kNoBreak : break_before(token.kind), break_after(last_));
      if (strength != kNoBreak) atom.strength = 10 * static_cast<int>(open_.size()) + strength;
    }
    move_to(token, prefix);
    return atom;
  }

 private:
  static bool is_word_of_quantifier(TokenKind kind) {
    return kind == TokenKind::kw_forall || kind == TokenKind::kw_exists || kind == TokenKind::kw_sum ||
           kind == TokenKind::kw_prod || kind == TokenKind::kw_min || kind == TokenKind::kw_max ||
           kind == TokenKind::kw_union || kind == TokenKind::kw_inter || kind == TokenKind::kw_subset ||
           kind == TokenKind::kw_pave;
  }

  [[nodiscard]] bool wants_space(TokenKind kind, bool operand_before) const {
    switch (kind) {
      case TokenKind::comma:
      case TokenKind::semicolon:
      case TokenKind::right_paren:
      case TokenKind::right_bracket:
        return false;
      default:
        break;
    }
    if (last_ == TokenKind::left_paren || last_ == TokenKind::left_bracket || after_prefix_minus_)
      return false;
    if (last_ == TokenKind::number && kind == TokenKind::range) return last_text_.back() == '.';
    if (is_tight(kind) || is_tight(last_)) return false;
    if (after_bindings_) return true;
    if (kind == TokenKind::colon) return !is_label_;
    if (kind == TokenKind::left_paren)
      return !(last_ == TokenKind::identifier || last_ == TokenKind::right_paren ||
               last_ == TokenKind::right_bracket || after_quantifier_);
    if (kind == TokenKind::left_bracket)
      return !(operand_before || last_ == TokenKind::kw_array || last_ == TokenKind::kw_real ||
               last_ == TokenKind::kw_int || last_ == TokenKind::kw_bool) ||
             last_ == TokenKind::number;
    return true;
  }

  // sum(x) and min(a, b) are calls.
  [[nodiscard]] bool opens_bindings(const Token* open) const {
    const bool may_be_call = last_ == TokenKind::kw_sum || last_ == TokenKind::kw_prod ||
                             last_ == TokenKind::kw_min || last_ == TokenKind::kw_max;
    const bool binds = open[1].kind == TokenKind::identifier && open[2].kind == TokenKind::kw_in;
    return (after_quantifier_ && last_ != TokenKind::kw_subset && (binds || !may_be_call)) ||
           last_text_ == "atleast";
  }

  void move_to(const Token& token, bool prefix) {
    after_bindings_ = false;
    if (token.kind == TokenKind::left_paren || token.kind == TokenKind::left_bracket ||
        token.kind == TokenKind::left_brace) {
      open_.push_back(opens_bindings(&token));
    } else if ((token.kind == TokenKind::right_paren || token.kind == TokenKind::right_bracket ||
                token.kind == TokenKind::right_brace) &&
               !open_.empty()) {
      after_bindings_ = open_.back();
      open_.pop_back();
    }
    after_quantifier_ = prefix && token.kind != TokenKind::minus;
    after_prefix_minus_ = prefix && token.kind == TokenKind::minus;
    ++count_;
    is_label_ = count_ == 2 && (last_ == TokenKind::kw_constraint || last_ == TokenKind::kw_implied ||
                                last_ == TokenKind::kw_family);
    last_ = token.kind;
    last_text_ = token.text();
  }

  std::size_t count_ = 0;  // of the tokens so far
  TokenKind last_ = TokenKind::end;
  std::string_view last_text_;
  bool is_label_ = false;          // the last token may be the name of a constraint
  bool after_quantifier_ = false;  // the last token is the word of a quantifier or a reduction
  bool after_bindings_ = false;    // it closed what such a word opened
  bool after_prefix_minus_ = false;
  std::vector<bool> open_;  // brackets: whether a quantifier's
};

// ---- Comments.

struct Comment {
  std::string_view text;
  bool own_line = false;  // nothing stands before it on its line
  bool blank_before = false;
};

// What stands between two tokens: comments, and whether a blank line does.
struct Gap {
  std::vector<Comment> comments;
  bool blank_at_end = false;  // before the next token
};

Gap read_gap(std::string_view between, bool at_start) {
  Gap gap;
  std::size_t lines = at_start ? 1 : 0;  // line ends since the last token or comment
  for (std::size_t at = 0; at < between.size();) {
    if (between[at] == '\n') {
      ++lines;
      ++at;
    } else if (between[at] == '/' && at + 1 < between.size()) {
      const bool to_line_end = between[at + 1] == '/';
      const std::size_t end = to_line_end ? between.find('\n', at) : between.find("*/", at + 2) + 2;
      std::string_view text = between.substr(at, std::min(end, between.size()) - at);
      at += text.size();
      while (text.back() == ' ' || text.back() == '\t' || text.back() == '\r') text.remove_suffix(1);
      gap.comments.push_back({text, lines > 0, lines > 1 && !(at_start && gap.comments.empty())});
      lines = 0;
    } else {
      ++at;
    }
  }
  gap.blank_at_end = lines > 1;
  return gap;
}

bool ends_line(std::string_view comment) {
  return comment.starts_with("//") || comment.find('\n') != std::string_view::npos;
}

// ---- Lines.

std::size_t width(std::string_view text) {
  const std::size_t line = text.rfind('\n');
  const std::string_view last = line == std::string_view::npos ? text : text.substr(line + 1);
  return static_cast<std::size_t>(
      std::count_if(last.begin(), last.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// The end of the line that starts at an atom: where it has to end, or where it is held together least among
// the places that fit.
std::size_t line_end(const std::vector<Atom>& atoms, std::size_t first, std::size_t indent) {
  std::size_t column = indent, best = atoms.size();
  int least = kNoBreak;
  for (std::size_t i = first; i < atoms.size(); ++i) {
    if (i > first) {
      if (atoms[i].new_line || atoms[i - 1].ends_line) return i;
      const bool breaks =
          atoms[i].strength != kNoBreak && (best == atoms.size() || atoms[i].strength <= least);
      // Beyond the width the first place is taken if there was none within.
      if (breaks && (column <= kWidth || best == atoms.size())) {
        best = i;
        least = atoms[i].strength;
      }
      column += atoms[i].space ? 1 : 0;
    }
    column += width(atoms[i].text);
    const bool is_comment = atoms[i].text.starts_with("//") || atoms[i].text.starts_with("/*");
    if (column > kWidth && !is_comment && best != atoms.size()) return best;
  }
  return column > kWidth ? best : atoms.size();
}

class Writer {
 public:
  void blank_line() {
    if (!lines_.empty() && !lines_.back().text.empty()) lines_.emplace_back();
  }
  void line(std::string line) { lines_.push_back({std::move(line), {}}); }
  /// A comment behind the line written last.
  void comment(std::string_view text) {
    std::string& comment = lines_.back().comment;
    comment.append(comment.empty() ? "" : "  ").append(text);
  }
  void item(const std::vector<Atom>& atoms) {
    for (std::size_t first = 0; first < atoms.size();) {
      const std::size_t indent = first == 0 ? 0 : kIndent.size();
      const std::size_t end = line_end(atoms, first, indent);
      std::string text(first == 0 ? "" : kIndent);
      for (std::size_t i = first; i < end; ++i) {
        if (i > first && atoms[i].space) text += ' ';
        text += atoms[i].text;
      }
      line(std::move(text));
      first = end;
    }
  }
  /// Comments behind lines that follow each other stand in one column.
  [[nodiscard]] std::string text() const {
    std::string all;
    for (std::size_t first = 0; first < lines_.size();) {
      std::size_t last = first, column = 0;
      for (; last < lines_.size() && !lines_[last].comment.empty(); ++last)
        column = std::max(column, width(lines_[last].text));
      for (std::size_t i = first; i < last; ++i) {
        const std::string gap(column - width(lines_[i].text) + 2, ' ');
        all.append(lines_[i].text).append(gap).append(lines_[i].comment).append("\n");
      }
      if (last == first) all.append(lines_[last++].text).append("\n");
      first = last;
    }
    return all;
  }

 private:
  struct Line {
    std::string text, comment;
  };
  std::vector<Line> lines_;
};

// The comments before an item, or after the last; the first few may go on behind the item before.
void write_comments(Writer& writer, const Gap& gap, bool after_item) {
  bool same_line = after_item;
  for (const Comment& comment : gap.comments) {
    same_line = same_line && !comment.own_line;
    if (same_line) {
      writer.comment(comment.text);
      continue;
    }
    if (comment.blank_before) writer.blank_line();
    writer.line(std::string(comment.text));
  }
}

}  // namespace

std::optional<std::string> format(const Source& source, Diagnostics& diagnostics) {
  SyntaxTree tree;
  const std::size_t before = diagnostics.count();
  parse_items(source, tree, diagnostics);
  if (diagnostics.count() != before) return {};
  const std::vector<Token> tokens = tokenize(source, diagnostics);
  Writer writer;
  std::vector<Atom> atoms;
  Spacing spacing;
  std::size_t end_of_last = 0;
  for (const Token& token : tokens) {
    const std::string_view between = source.text().substr(end_of_last, token.range.begin - end_of_last);
    const Gap gap = read_gap(between, end_of_last == 0);
    const bool between_items = atoms.empty();
    if (between_items) {
      write_comments(writer, gap, end_of_last != 0);
      if (gap.blank_at_end && token.kind != TokenKind::end) writer.blank_line();
    } else {
      for (const Comment& comment : gap.comments)
        atoms.push_back({comment.text, true, comment.own_line, kNoBreak, ends_line(comment.text)});
    }
    if (token.kind == TokenKind::end) break;
    atoms.push_back(spacing.next(token));
    end_of_last = token.range.end;
    if (token.kind != TokenKind::semicolon) continue;
    writer.item(atoms);
    atoms.clear();
    spacing = {};
  }
  return writer.text();
}

}  // namespace hcsp::lang
