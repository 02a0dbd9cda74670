// SPDX-License-Identifier: Apache-2.0
// Results as comma-separated values, for spreadsheets and plotting programs.
//
// The first line names the columns:  t_lo,t_hi,x[1].lo,x[1].hi,x[2].lo,x[2].hi,z.lo,z.hi,T.lo,T.hi
// One row a gate (t_lo = t_hi, the instant) and one a slice (the bounds over the open interval t_lo to t_hi),
// in the order of time. Every tube, vector and real has a pair of columns a component: of a tube its bounds
// then, of a constant the same bounds in every row. Without a tube there is one row and no column of time.
// With tubes on phases the table is that of their motion polynomials, see segments.h.
// Infinite bounds are oo and -oo; the cells of an empty domain are blank. Sets have no column: the JSON file
// holds them.
#pragma once

#include <string>

#include "solver/result.h"

namespace hcsp {

std::string to_csv(const Result& result);

}  // namespace hcsp
