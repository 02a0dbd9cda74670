// SPDX-License-Identifier: Apache-2.0
// The trace of a propagation as JSON: what each contractor removed in each pass (Jaulin 2011, Fig. 10).
#pragma once

#include <string>

#include "solver/result.h"

namespace hcsp {

/// { "hcsp", "model", "trace": [ { "pass", "contractor", "variable", "before", "after",
///   "changes": [ { "time": [t0, t1], "before": [[lo, hi], ...], "after": [[lo, hi], ...] } ] } ] }
/// where "before" and "after" of an entry are the measures of the variable's domain (a width, a volume), and
/// a change lists the components of one gate or slice; an empty bound is null.
std::string trace_json(const Result& result);

}  // namespace hcsp
