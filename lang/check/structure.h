// SPDX-License-Identifier: Apache-2.0
// Which parameters a model's structure needs: they say how much of something there is, where the instants or
// the cells are, which component is meant. The others may stay open when the model is compiled.
#pragma once

#include <set>
#include <string_view>

#include "lang/syntax/ast.h"

namespace hcsp::lang {

/// The names of those that are reals or vectors and that no size, range, index, count, exponent, domain of a
/// declaration, instant or precision depends on.
std::set<std::string_view> parameters_without_structure(const SyntaxTree& tree);

}  // namespace hcsp::lang
