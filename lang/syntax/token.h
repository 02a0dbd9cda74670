// SPDX-License-Identifier: Apache-2.0
// Tokens of the .hcsp language, and of Minibex. Comments and white space stand between tokens and are none.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lang/diagnostics.h"
#include "lang/source.h"

namespace hcsp::lang {

enum class TokenKind : std::uint8_t {
  end,
  identifier,
  number,
  string,
  // Punctuation and operators.
  semicolon,
  colon,
  comma,
  dot,
  range,
  left_paren,
  right_paren,
  left_bracket,
  right_bracket,
  left_brace,
  right_brace,
  bar,
  assign,
  plus,
  minus,
  plus_minus,
  star,
  slash,
  caret,
  backslash,
  apostrophe,  // of Minibex alone
  equal,
  not_equal,
  less,
  less_equal,
  greater,
  greater_equal,
  // Keywords; kw_all must stay the first, kw_xor the last.
  kw_all,
  kw_and,
  kw_array,
  kw_at,
  kw_bool,
  kw_constraint,
  kw_data,
  kw_else,
  kw_endif,
  kw_exists,
  kw_false,
  kw_family,
  kw_forall,
  kw_function,
  kw_given,
  kw_if,
  kw_iff,
  kw_implied,
  kw_implies,
  kw_in,
  kw_include,
  kw_int,
  kw_inter,
  kw_let,
  kw_max,
  kw_maximize,
  kw_min,
  kw_minimize,
  kw_model,
  kw_not,
  kw_of,
  kw_oo,
  kw_or,
  kw_param,
  kw_pave,
  kw_phases,
  kw_precision,
  kw_prod,
  kw_propagate,
  kw_real,
  kw_set,
  kw_show,
  kw_solve,
  kw_step,
  kw_subset,
  kw_sum,
  kw_symdiff,
  kw_then,
  kw_time,
  kw_true,
  kw_tube,
  kw_union,
  kw_var,
  kw_where,
  kw_xor,
};

struct Token {
  TokenKind kind = TokenKind::end;
  SourceRange range;
  [[nodiscard]] std::string_view text() const { return range.text(); }
};

inline bool is_keyword(TokenKind kind) { return kind >= TokenKind::kw_all; }
/// How a message calls a kind: "`;`", "a name".
std::string describe(TokenKind kind);
/// How a message calls a token: "`foo`", "the end of the file".
std::string describe(const Token& token);
/// Every keyword, for suggestions.
const std::vector<std::string>& keywords();

/// Minibex has transposition, doubles by their bits (#3ff0000000000000) and comments of any bytes; it has
/// none of
/// `..` and `+-`, and its words are all identifiers: which of them are keywords is the parser's business.
enum class Dialect : std::uint8_t { hcsp, minibex };

/// The tokens of a source, with `end` last. What is no token is reported and skipped, one report a run of
/// such bytes.
std::vector<Token> tokenize(const Source& source, Diagnostics& diagnostics, Dialect dialect = Dialect::hcsp);

}  // namespace hcsp::lang
