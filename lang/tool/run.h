// SPDX-License-Identifier: Apache-2.0
// A run of hcsp-solve, from options to exit status.
#pragma once

#include "lang/tool/options.h"

namespace hcsp::tool {

// Exit statuses.
inline constexpr int kFinished = 0;
inline constexpr int kWrongInput = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kStopped = 3;

int run(const Options& options);

}  // namespace hcsp::tool
