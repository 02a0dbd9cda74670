// SPDX-License-Identifier: Apache-2.0
#include "lang/syntax/ast.h"

#include <algorithm>
#include <array>

namespace hcsp::lang {

std::string_view spelling(Operator op) {
  constexpr std::array<std::string_view, 26> kSpelling{
      "iff",    "implies", "or", "xor",   "and",     "not", "==",    "!=", "<", "<=", ">", ">=", "in",
      "subset", "..",      "+-", "union", "symdiff", "\\",  "inter", "+",  "-", "*",  "/", "-",  "^"};
  return kSpelling[static_cast<std::size_t>(op)];
}

std::string_view spelling(Quantifier quantifier) {
  constexpr std::array<std::string_view, 9> kSpelling{"forall", "exists", "atleast", "sum",  "prod",
                                                      "min",    "max",    "union",   "inter"};
  return kSpelling[static_cast<std::size_t>(quantifier)];
}

Expr* SyntaxTree::make(Expr expr) {
  expr.id = static_cast<std::uint32_t>(expressions_.size());
  const auto deepen = [&](const Expr* below) {
    if (below != nullptr) expr.depth = std::max(expr.depth, below->depth + 1);
  };
  for (const Expr* operand : expr.operands) deepen(operand);
  for (const Binding& binding : expr.bindings) deepen(binding.domain);
  return &expressions_.emplace_back(std::move(expr));
}

TypeExpr* SyntaxTree::make(TypeExpr type) { return &types_.emplace_back(std::move(type)); }

const Source& SyntaxTree::add_source(std::string name, std::string text) {
  return *sources_.emplace_back(std::make_unique<Source>(std::move(name), std::move(text)));
}

}  // namespace hcsp::lang
