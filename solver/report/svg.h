// SPDX-License-Identifier: Apache-2.0
// A static picture of a result: the sets of the plane with the trajectories over them, then each tube against
// time.
#pragma once

#include <string>

#include "solver/report/presentation.h"
#include "solver/result.h"

namespace hcsp {

std::string to_svg(const Result& result, const Presentation& presentation);

}  // namespace hcsp
