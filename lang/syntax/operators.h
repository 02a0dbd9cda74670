// SPDX-License-Identifier: Apache-2.0
// Precedence: what the grammar reads as a flat chain of prefixes, operands and operators becomes a tree here.
#pragma once

#include <vector>

#include "lang/syntax/grammar.h"

namespace hcsp::lang {

/// One operand of a chain with the prefixes before it and the operator after it (an end token for the last).
struct ChainLink {
  std::vector<const Token*> prefixes;
  Expr* operand = nullptr;
  const Token* op = nullptr;
};

/// The tree of a chain. Null, with the error set, when an operator that does not chain does, or it gets too
/// deep.
Expr* build_chain(const std::vector<ChainLink>& chain, SyntaxTree& tree, std::optional<SyntaxError>& error);

}  // namespace hcsp::lang
