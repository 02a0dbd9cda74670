// SPDX-License-Identifier: Apache-2.0
// Double-double arithmetic for the elementary functions: a value is the unevaluated sum hi + lo with |lo| <=
// ulp(hi)/2. PRECONDITION of everything here: round to nearest, gradual underflow, and no overflow or
// underflow of the operands' products (the callers bound their arguments). No FMA is assumed. With u = 2^-53
// the relative errors are those of Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic
// building blocks of double-word arithmetic", ACM TOMS 44(2), 2017; the number of the algorithm there stands
// beside each function.
#pragma once

#include <cmath>

namespace hcsp {

/// 1 / n as a constant: written as a quotient, it would be divided anew each time, in the thread's rounding
/// mode (-frounding-math).
template <int n>
inline constexpr double kInverse = 1.0 / n;

/// T is double, or Bounds for two at once.
template <class T>
struct Doubled {
  T hi, lo;
};
using DoubleDouble = Doubled<double>;

/// The exact sum of a and b (Fast2Sum, algorithm 1), for |a| >= |b| or a == 0.
template <class T>
Doubled<T> fast_two_sum(T a, T b) {
  const T sum = a + b;
  return {sum, b - (sum - a)};
}

/// The exact sum of a and b (2Sum, algorithm 2).
template <class T>
Doubled<T> two_sum(T a, T b) {
  const T sum = a + b;
  const T of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// a as the exact sum of two numbers of at most 26 bits (Veltkamp), for |a| < 2^995.
template <class T>
Doubled<T> split(T a) {
  constexpr double kSplitter = 0x1p27 + 1;
  const T scaled = kSplitter * a;
  const T high = scaled - (scaled - a);
  return {high, a - high};
}

/// The exact product of a and b (Dekker), where neither a b overflows nor its error underflows.
template <class T>
Doubled<T> two_product(T a, T b) {
  const T product = a * b;
  const Doubled<T> x = split(a), y = split(b);
  return {product, x.lo * y.lo - (((product - x.hi * y.hi) - x.lo * y.hi) - x.hi * y.lo)};
}

inline DoubleDouble negate(DoubleDouble a) { return {-a.hi, -a.lo}; }

/// a + b within 3 u^2 + 13 u^3 (AccurateDWPlusDW, algorithm 6).
inline DoubleDouble add(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo);
  const DoubleDouble v = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(v.hi, t.lo + v.lo);
}

/// a b within 7 u^2 (DWTimesDW1, algorithm 10).
inline DoubleDouble multiply(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble c = two_product(a.hi, b.hi);
  return fast_two_sum(c.hi, c.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// a b within 3/2 u^2 + 4 u^3 (DWTimesFP1, algorithm 7).
inline DoubleDouble multiply(DoubleDouble a, double b) {
  const DoubleDouble c = two_product(a.hi, b);
  const DoubleDouble t = fast_two_sum(c.hi, a.lo * b);
  return fast_two_sum(t.hi, t.lo + c.lo);
}

/// a / b within 15 u^2 + 56 u^3 (DWDivDW2, algorithm 17), for b != 0.
inline DoubleDouble divide(DoubleDouble a, DoubleDouble b) {
  const double quotient = a.hi / b.hi;
  const DoubleDouble back = multiply(b, quotient);
  const double remainder = (a.hi - back.hi) + (a.lo - back.lo);
  return fast_two_sum(quotient, remainder / b.hi);
}

/// sqrt(a) within 25/8 u^2 (SQRTDWtoDW: Lefevre, Louvet, Muller, Picot, Rideau, ACM TOMS 49(1), 2023), for a
/// > 0.
inline DoubleDouble square_root(DoubleDouble a) {
  const double root = std::sqrt(a.hi);
  const DoubleDouble square = two_product(root, root);
  const double remainder = ((a.hi - square.hi) - square.lo) + a.lo;
  return fast_two_sum(root, remainder / (2.0 * root));
}

}  // namespace hcsp
