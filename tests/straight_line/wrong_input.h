// SPDX-License-Identifier: Apache-2.0
// Numbers that make no sense, set in a control loop.
#pragma once

#include "tests/straight_line/library.h"

namespace hcsp::straight_line {

/// Whatever is wrong is told by the status and named, and what was right before is solved again afterwards.
void expect_told(Library& library, const Move& good);

}  // namespace hcsp::straight_line
