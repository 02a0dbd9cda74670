// SPDX-License-Identifier: Apache-2.0
// Functions of doubles by MPFR, rounded in a given direction. For source files only. An MPFR result is
// rounded to 53 bits with its own, vast range of exponents and then to a double in the same direction: twice
// in one direction is the same as once, so subnormal results and overflow are right too.
#pragma once

#include "domains/interval/mpfr_scope.h"

namespace hcsp {

using Function = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using BinaryFunction = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// f(x) rounded down (MPFR_RNDD) or up (MPFR_RNDU). PRECONDITION: round to nearest; an MpfrScope is alive.
inline double rounded(Function f, double x, mpfr_rnd_t direction) {
  Number argument(x), result(mpfr_prec_t{53});
  f(result.get(), argument.get(), direction);
  return mpfr_get_d(result.get(), direction);
}

inline double rounded(BinaryFunction f, double x, double y, mpfr_rnd_t direction) {
  Number first(x), second(y), result(mpfr_prec_t{53});
  f(result.get(), first.get(), second.get(), direction);
  return mpfr_get_d(result.get(), direction);
}

}  // namespace hcsp
