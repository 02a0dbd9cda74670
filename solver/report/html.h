// SPDX-License-Identifier: Apache-2.0
// One self-contained page that explores a result in a browser, offline: the map with the trajectory over it,
// widths and components against time, and a slider over the passes of the propagation when the result has
// snapshots.
#pragma once

#include <string>

#include "solver/report/presentation.h"
#include "solver/result.h"

namespace hcsp {

std::string to_html(const Result& result, const Presentation& presentation);

}  // namespace hcsp
