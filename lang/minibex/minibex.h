// SPDX-License-Identifier: Apache-2.0
// Minibex, the input language of IBEX: from a file to the Problem that it states (docs/minibex.md).
#pragma once

#include "lang/lang.h"

namespace hcsp::lang::minibex {

/// Whether a path names a Minibex file: its ending is .bch, .mbx or .txt.
bool is_minibex(const std::string& path);

/// Reads and compiles a source of the compilation's tree: its model, or diagnostics.
void compile(const Source& source, const CompileOptions& options, Compilation& compilation);

}  // namespace hcsp::lang::minibex
