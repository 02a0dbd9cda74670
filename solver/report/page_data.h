// SPDX-License-Identifier: Apache-2.0
// What the page draws, as JSON: every shown variable's domain in every pass, compact. Read by page/data.js.
#pragma once

#include <string>

#include "solver/report/presentation.h"
#include "solver/result.h"

namespace hcsp::report {

/// { hcsp, model, status, seconds, passes, threads, contractors: [[name, calls, seconds], ...], explanation,
///   lines: [f64, ...]              the time lines, each the base64 of its instants
///   variables: [{ name, kind, and for a vector dim; for a tube dim, line, wide, drawn (from phases); for a
///   set dim, precision },
///   ...] frames: [{ pass, domains: [...] }, ...]    by variable: null empty, 0 as in the frame before, or
///     a real or a vector  [[lo, hi], ...]
///     a tube  the base64 of float, or of double if wide: by component, the lower and then the upper bounds
///     of all items a set   { volume: [lo, hi], background } and in the plane reach [lo1, hi1, lo2, hi2] and
///     inside, unknown: { wide, boxes }, the
///             base64 of boxes of cells, lo1 hi1 lo2 hi2, as 16-bit or, if wide, as 32-bit integers
///   paving: { names, cells, projected, strip, stretch, volume: [lo, hi], reach [lo1, hi1, lo2, hi2] and
///   inside,
///     boundary, unexplored: f64 } of rectangles lo1 hi1 lo2 hi2, see paving_map.h; or null
///   truth: { t: f64, tubes: { name: f64 } } }  or null
/// A bound in float is rounded outward: it still encloses.
std::string page_data(const Result& result, const Presentation& presentation);

/// The variables to show, in order.
std::vector<const ResultVariable*> shown_variables(const std::vector<ResultVariable>& variables,
                                                   const Presentation& presentation);

}  // namespace hcsp::report
