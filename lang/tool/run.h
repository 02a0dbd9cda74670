// SPDX-License-Identifier: Apache-2.0
// A run of hcsp-solve, from options to exit status.
#pragma once

#include "lang/tool/options.h"

namespace hcsp::tool {

enum ExitStatus : int { kFinished = 0, kWrongInput = 1, kWrongUsage = 2, kStopped = 3 };

int run(const Options& options);

}  // namespace hcsp::tool
