// SPDX-License-Identifier: Apache-2.0
#include "lang/syntax/token.h"

#include <algorithm>
#include <array>

namespace hcsp::lang {

namespace {

constexpr std::array<std::string_view, 31> kPunctuation{"the end of the file",
                                                        "a name",
                                                        "a number",
                                                        "a string",
                                                        "`;`",
                                                        "`:`",
                                                        "`,`",
                                                        "`.`",
                                                        "`..`",
                                                        "`(`",
                                                        "`)`",
                                                        "`[`",
                                                        "`]`",
                                                        "`{`",
                                                        "`}`",
                                                        "`|`",
                                                        "`=`",
                                                        "`+`",
                                                        "`-`",
                                                        "`+-`",
                                                        "`*`",
                                                        "`/`",
                                                        "`^`",
                                                        "`\\`",
                                                        "`'`",
                                                        "`==`",
                                                        "`!=`",
                                                        "`<`",
                                                        "`<=`",
                                                        "`>`",
                                                        "`>=`"};

}  // namespace

const std::vector<std::string>& keywords() {
  static const std::vector<std::string> all{
      "all",   "and",      "array",   "at",       "bool",      "constraint", "data",      "else",
      "endif", "exists",   "false",   "family",   "forall",    "function",   "given",     "if",
      "iff",   "implied",  "implies", "in",       "include",   "int",        "inter",     "let",
      "max",   "maximize", "min",     "minimize", "model",     "not",        "of",        "oo",
      "or",    "param",    "pave",    "phases",   "precision", "prod",       "propagate", "real",
      "set",   "show",     "solve",   "step",     "subset",    "sum",        "symdiff",   "then",
      "time",  "true",     "tube",    "union",    "var",       "where",      "xor"};
  return all;
}

std::string describe(TokenKind kind) {
  if (is_keyword(kind)) {
    const auto index = static_cast<std::size_t>(kind) - static_cast<std::size_t>(TokenKind::kw_all);
    return fmt::format("`{}`", keywords()[index]);
  }
  return std::string(kPunctuation[static_cast<std::size_t>(kind)]);
}

std::string describe(const Token& token) {
  constexpr std::size_t kLongest = 40;
  if (token.kind == TokenKind::end) return describe(token.kind);
  if (token.text().size() > kLongest) return describe(token.kind);
  return fmt::format("`{}`", token.text());
}

}  // namespace hcsp::lang
