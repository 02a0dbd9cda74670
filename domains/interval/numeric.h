// SPDX-License-Identifier: Apache-2.0
// Numbers of intervals, and comparisons (IEEE 1788-2015, 9.2 to 9.5, 10.5.9, 10.6, 12.12.9).
#pragma once

#include <cstdint>
#include <span>

#include "domains/interval/interval.h"

namespace hcsp {

// Numeric functions. Of the empty set: inf is +oo, sup is -oo, the others NaN.
double inf(const Interval& a);
double sup(const Interval& a);
/// A double inside, the nearest to the midpoint: 0 for the whole line, the largest double of its sign for a
/// half-line.
double mid(const Interval& a);
/// The width, rounded up.
double wid(const Interval& a);
/// The least double r with a within [m - r, m + r], m = mid(a).
double rad(const Interval& a);
/// The largest and the least absolute value.
double mag(const Interval& a);
double mig(const Interval& a);

// Comparisons.
bool equal(const Interval& a, const Interval& b);
bool subset(const Interval& a, const Interval& b);
/// a is within the topological inside of b.
bool interior(const Interval& a, const Interval& b);
/// For every a there is a greater or equal b, and for every b a less or equal a; strict_less: greater, less.
bool less(const Interval& a, const Interval& b);
bool strict_less(const Interval& a, const Interval& b);
/// No a is greater than any b; strict: nor equal.
bool precedes(const Interval& a, const Interval& b);
bool strict_precedes(const Interval& a, const Interval& b);
bool disjoint(const Interval& a, const Interval& b);
/// x is a real number, and in a.
bool is_member(double x, const Interval& a);
/// Not empty, and bounded.
bool is_common(const Interval& a);

/// How two intervals lie to each other: exactly one of sixteen (IEEE 1788-2015, table 10.7).
enum class Overlap : std::uint8_t {
  both_empty,
  first_empty,
  second_empty,
  before,
  meets,
  overlaps,
  starts,
  contained_by,
  finishes,
  equals,
  finished_by,
  contains,
  started_by,
  overlapped_by,
  met_by,
  after
};
Overlap overlap(const Interval& a, const Interval& b);

// Reductions (IEEE 1788-2015, 12.12.12), correctly rounded to nearest.
double sum_nearest(std::span<const double> x);
double sum_abs_nearest(std::span<const double> x);
double sum_sqr_nearest(std::span<const double> x);
/// Both of one length.
double dot_nearest(std::span<const double> x, std::span<const double> y);

}  // namespace hcsp
