// SPDX-License-Identifier: Apache-2.0
// What a search may be told.
#pragma once

#include <atomic>

#include "solver/engine/propagation.h"

namespace hcsp {

struct SearchOptions {
  double precision = 1e-3;  ///< a box of which no side is wider is not cut any more
  unsigned threads = 1;
  double time_limit = 0.0;    ///< seconds; 0 is none
  double spent_before = 0.0;  ///< seconds that preparing the data took, for Statistics::seconds
  const std::atomic<bool>* cancel = nullptr;  ///< set it (Ctrl-C) to stop the search
  Clock clock = steady_clock();
};

}  // namespace hcsp
