// SPDX-License-Identifier: Apache-2.0
// The canonical layout of a model: an item a line where it fits, its continuation indented, operators spaced
// alike. Only white space changes: tokens and comments stay as they are, in their order.
#pragma once

#include <optional>
#include <string>

#include "lang/diagnostics.h"
#include "lang/source.h"

namespace hcsp::lang {

/// None after a report: what cannot be read is not laid out. format(format(x)) == format(x).
std::optional<std::string> format(const Source& source, Diagnostics& diagnostics);

}  // namespace hcsp::lang
