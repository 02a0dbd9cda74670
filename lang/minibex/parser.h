// SPDX-License-Identifier: Apache-2.0
// From text to the syntax tree of Minibex, as IBEX 2.8 and 2.9 read it. A parser by hand: in that language a
// sign takes all that binds tighter than a sum, wherever it stands (x^-2*y is x^(-(2*y))), which is a matter
// of operator precedence and not of a grammar's alternatives.
#pragma once

#include "lang/diagnostics.h"
#include "lang/minibex/ast.h"
#include "lang/syntax/token.h"

namespace hcsp::lang::minibex {

/// Reads a source; after a mistake reading goes on behind the next semicolon. The source outlives the
/// program.
Program parse(const Source& source, Diagnostics& diagnostics);

/// A text that is one expression, into the arena of a program. Null after a diagnostic.
const Expr* parse_expression(const Source& source, Program& program, Diagnostics& diagnostics);

}  // namespace hcsp::lang::minibex
