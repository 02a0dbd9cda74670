// SPDX-License-Identifier: Apache-2.0
// From text to syntax tree. Syntax errors are diagnostics; after one, reading goes on at the next item.
#pragma once

#include "lang/diagnostics.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

namespace hcsp::lang {

/// Appends the items of a source to the tree. The source belongs to the tree.
void parse_items(const Source& source, SyntaxTree& tree, Diagnostics& diagnostics);

/// A text that is one expression: a VALUE of the command line. Null after a diagnostic.
Expr* parse_expression(const Source& source, SyntaxTree& tree, Diagnostics& diagnostics);

/// How deep brackets, quantifiers and conditionals may nest, and how deep a tree of operators may be.
inline constexpr std::uint32_t kDeepestNesting = 100;
inline constexpr std::uint32_t kDeepestTree = 1000;

}  // namespace hcsp::lang
