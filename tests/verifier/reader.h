// SPDX-License-Identifier: Apache-2.0
// Systems from the text of their models, read and interpreted without the library: of the .hcsp language and
// of Minibex what models of reals and vectors use.
#pragma once

#include <string>

#include "tests/verifier/system.h"

namespace hcsp::verifier {

/// Reals, vectors and arrays with their domains, parameters, `let`, functions, relations with `forall` and
/// `and`, conditions on constants. Throws Unreadable at anything else.
System read_hcsp(const std::string& text);

/// Constants, variables and constraints, IBEX's input language without its loops and functions. Throws
/// Unreadable at anything else.
System read_minibex(const std::string& text);

}  // namespace hcsp::verifier
