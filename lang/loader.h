// SPDX-License-Identifier: Apache-2.0
// A model and the files that it includes, as one tree.
#pragma once

#include "lang/diagnostics.h"
#include "lang/syntax/ast.h"

namespace hcsp::lang {

/// Appends the items of a source to the tree, an included file's in the place of its include. A file that is
/// included twice counts once; one that includes itself, through others or not, is reported.
void load(const Source& source, SyntaxTree& tree, const std::vector<std::string>& library,
          Diagnostics& diagnostics);

}  // namespace hcsp::lang
