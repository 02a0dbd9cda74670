// SPDX-License-Identifier: Apache-2.0
// The result file: one JSON object with every variable, as docs/language.md documents it. Numbers are finite
// doubles in shortest round-trip form or the strings "oo" and "-oo"; a variable whose domain is empty is
// null.
#pragma once

#include <string>

#include "solver/result.h"

namespace hcsp {

std::string to_json(const Result& result);

}  // namespace hcsp
