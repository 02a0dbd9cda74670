// SPDX-License-Identifier: Apache-2.0
// Interval operations over arrays of lower and of upper bounds, as tubes keep them: result[i] = f(a[i], b[i])
// for i < n, the same bits as the operation on single intervals (interval.h, functions.h), in the widest
// registers of the machine. Sound in any rounding mode of the caller, which is switched once a call. The
// result's arrays may be those of an operand; they may not overlap an operand's otherwise. Empty sets are
// [+oo, -oo], and in no other form.
#pragma once

#include <cstddef>

namespace hcsp::batch {

struct Intervals {
  const double* lo;
  const double* hi;
};

struct Results {
  double* lo;
  double* hi;
};

void neg(std::size_t n, Intervals a, Results result);
void add(std::size_t n, Intervals a, Intervals b, Results result);
void sub(std::size_t n, Intervals a, Intervals b, Results result);
void mul(std::size_t n, Intervals a, Intervals b, Results result);
void div(std::size_t n, Intervals a, Intervals b, Results result);
void sqr(std::size_t n, Intervals a, Results result);
void sqrt(std::size_t n, Intervals a, Results result);
void abs(std::size_t n, Intervals a, Results result);
void min(std::size_t n, Intervals a, Intervals b, Results result);
void max(std::size_t n, Intervals a, Intervals b, Results result);
void pown(std::size_t n, Intervals a, int exponent, Results result);
void exp(std::size_t n, Intervals a, Results result);
void log(std::size_t n, Intervals a, Results result);
void sin(std::size_t n, Intervals a, Results result);
void cos(std::size_t n, Intervals a, Results result);
void atan2(std::size_t n, Intervals y, Intervals x, Results result);

void meet(std::size_t n, Intervals a, Intervals b, Results result);
void join(std::size_t n, Intervals a, Intervals b, Results result);

}  // namespace hcsp::batch
