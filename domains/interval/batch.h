// SPDX-License-Identifier: Apache-2.0
// Interval operations over arrays: result[i] = f(a[i], b[i]) for i < n, the same bits as the operation on
// single intervals (interval.h, functions.h), in the widest registers of the machine. Operands and result are
// arrays of lower and of upper bounds or, for the cheaper operations, arrays of intervals. Sound in any
// rounding mode of the caller, which is switched once a call. The result's arrays may be those of an operand;
// they may not overlap an operand's otherwise. Empty sets are [+oo, -oo], and in no other form.
#pragma once

#include <cstddef>

#include "domains/interval/interval.h"

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

void neg(std::size_t n, const Interval* a, Interval* result);
void add(std::size_t n, const Interval* a, const Interval* b, Interval* result);
void sub(std::size_t n, const Interval* a, const Interval* b, Interval* result);
void mul(std::size_t n, const Interval* a, const Interval* b, Interval* result);
void div(std::size_t n, const Interval* a, const Interval* b, Interval* result);
void sqr(std::size_t n, const Interval* a, Interval* result);
void sqrt(std::size_t n, const Interval* a, Interval* result);
void abs(std::size_t n, const Interval* a, Interval* result);
void min(std::size_t n, const Interval* a, const Interval* b, Interval* result);
void max(std::size_t n, const Interval* a, const Interval* b, Interval* result);
void meet(std::size_t n, const Interval* a, const Interval* b, Interval* result);
void join(std::size_t n, const Interval* a, const Interval* b, Interval* result);

}  // namespace hcsp::batch
