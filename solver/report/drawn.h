// SPDX-License-Identifier: Apache-2.0
// Tubes on a time line with phases as pictures show them: against known instants.
#pragma once

#include <optional>

#include "solver/result.h"

namespace hcsp::report {

/// The result with tubes of known instants in the place of those on phases, enclosing the same functions;
/// none where it has none. Of a search it tells what told_variables() does.
std::optional<Result> drawn(const Result& result);

}  // namespace hcsp::report
