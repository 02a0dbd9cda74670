// SPDX-License-Identifier: Apache-2.0
// The grammar's two entries, over tokens. grammar.cpp alone sees Spirit.
#pragma once

#include <string>
#include <vector>

#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

namespace hcsp::lang {

/// Where the grammar stopped, and what it expected there.
struct SyntaxError {
  enum class Kind : std::uint8_t { expected, too_deep, does_not_chain };
  Kind kind = Kind::expected;
  const Token* where = nullptr;
  std::string expected;
};

/// Reads one item, or one expression, from `at`, which moves behind it.
std::optional<SyntaxError> read_item(const Token*& at, const Token* end, SyntaxTree& tree, Item& item);
std::optional<SyntaxError> read_expression(const Token*& at, const Token* end, SyntaxTree& tree, Expr*& expr);

}  // namespace hcsp::lang
