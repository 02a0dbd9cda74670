// SPDX-License-Identifier: Apache-2.0
// The arithmetic is that of kernel.h for one interval a lane: plain code without branches, which the compiler
// turns into vector code, once for each generation of registers that the machine may have.
#include "domains/interval/batch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "domains/interval/atan2.h"
#include "domains/interval/cube.h"
#include "domains/interval/exp_log.h"
#include "domains/interval/kernel.h"
#include "domains/interval/pown.h"
#include "domains/interval/sin_cos.h"
#include "domains/rounding.h"

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define HCSP_CLONES [[gnu::target_clones("default", "avx2", "avx512f")]]
#else
#define HCSP_CLONES
#endif

namespace hcsp::batch {

namespace {

/// The bounds (-lo, hi): both are rounded upward (interval.h).
struct Outward {
  double minus_lo, hi;
};

constexpr Outward kEmpty{-kInfinity, -kInfinity};

double lesser(double x, double y) { return x < y ? x : y; }
double greater(double x, double y) { return x > y ? x : y; }
double zero_for_nan(double x) { return x == x ? x : 0.0; }
bool is_any_empty(const Outward& a, const Outward& b) { return lesser(a.hi, b.hi) == -kInfinity; }
Outward select(bool condition, const Outward& a, const Outward& b) {
  return {condition ? a.minus_lo : b.minus_lo, condition ? a.hi : b.hi};
}

Outward neg(const Outward& a) { return {a.hi, a.minus_lo}; }

Outward add(const Outward& a, const Outward& b) {
  return {greater(a.minus_lo + b.minus_lo, -kInfinity), greater(a.hi + b.hi, -kInfinity)};
}

Outward sub(const Outward& a, const Outward& b) { return add(a, neg(b)); }

double greatest_product(double x0, double x1, double y0, double y1) {
  return greater(greater(zero_for_nan(x0 * y0), zero_for_nan(x0 * y1)),
                 greater(zero_for_nan(x1 * y0), zero_for_nan(x1 * y1)));
}

Outward mul(const Outward& a, const Outward& b) {
  const Outward product{greatest_product(a.minus_lo, -a.hi, -b.minus_lo, b.hi),
                        greatest_product(-a.minus_lo, a.hi, -b.minus_lo, b.hi)};
  return select(is_any_empty(a, b), kEmpty, product);
}

Outward div(const Outward& a, const Outward& b) {
  const bool is_negative = b.hi <= 0;
  const Outward x = select(is_negative, neg(a), a), y = select(is_negative, neg(b), b);
  const double near = 0.0 - y.minus_lo;
  const Outward quotient{x.minus_lo / (x.minus_lo > 0 ? near : y.hi), x.hi / (x.hi > 0 ? near : y.hi)};
  const bool is_around_zero = (b.minus_lo > 0) & (b.hi > 0);
  const bool is_zero = (a.minus_lo == 0) & (a.hi == 0), by_zero = (b.minus_lo == 0) & (b.hi == 0);
  const Outward image = select(is_zero, a, select(is_around_zero, {kInfinity, kInfinity}, quotient));
  return select(is_any_empty(a, b) | by_zero, kEmpty, image);
}

Outward sqr(const Outward& a) {
  const double mag = greater(a.minus_lo, a.hi), minus_mig = lesser(lesser(a.minus_lo, a.hi), 0.0);
  return select(a.hi == -kInfinity, kEmpty, {minus_mig * -minus_mig, mag * mag});
}

Outward sqrt(const Outward& a) {
  const Outward root{-up::sqrt_down(greater(-a.minus_lo, 0.0)), std::sqrt(greater(a.hi, 0.0))};
  return select(a.hi < 0, kEmpty, root);
}

Outward abs(const Outward& a) {
  return select(a.hi == -kInfinity, kEmpty,
                {lesser(lesser(a.minus_lo, a.hi), 0.0), greater(a.minus_lo, a.hi)});
}

Outward max(const Outward& a, const Outward& b) {
  return select(is_any_empty(a, b), kEmpty, {lesser(a.minus_lo, b.minus_lo), greater(a.hi, b.hi)});
}

Outward min(const Outward& a, const Outward& b) { return neg(max(neg(a), neg(b))); }

Outward meet(const Outward& a, const Outward& b) {
  const Outward met{lesser(a.minus_lo, b.minus_lo), lesser(a.hi, b.hi)};
  return select(-met.minus_lo > met.hi, kEmpty, met);
}

Outward join(const Outward& a, const Outward& b) {
  return {greater(a.minus_lo, b.minus_lo), greater(a.hi, b.hi)};
}

Outward loaded(Intervals a, std::size_t i) { return {-a.lo[i], a.hi[i]}; }
void store(Results result, std::size_t i, const Outward& value) {
  result.lo[i] = -value.minus_lo;
  result.hi[i] = value.hi;
}

// As arrays of doubles, which the compiler turns into vectors: an interval is its two bounds.
static_assert(sizeof(Interval) == 2 * sizeof(double));
Outward loaded(const Interval* a, std::size_t i) {
  const auto* bounds = reinterpret_cast<const double*>(a);
  return {bounds[2 * i], bounds[2 * i + 1]};
}
void store(Interval* result, std::size_t i, const Outward& value) {
  auto* bounds = reinterpret_cast<double*>(result);
  bounds[2 * i] = value.minus_lo;
  bounds[2 * i + 1] = value.hi;
}

Interval interval(Intervals a, std::size_t i) { return Interval::raw(a.lo[i], a.hi[i]); }
void store(Results result, std::size_t i, const Interval& value) {
  result.lo[i] = value.lo();
  result.hi[i] = value.hi();
}

}  // namespace

// The loops stand in the cloned functions themselves, where they are compiled for each machine; ivdep,
// because arrays are the same or apart.
#define HCSP_UNARY_ON(name, Operand, Result)                                                       \
  HCSP_CLONES void name(std::size_t n, Operand a, Result result) {                                 \
    const RoundUpward guard;                                                                       \
    _Pragma("GCC ivdep") for (std::size_t i = 0; i < n; ++i) store(result, i, name(loaded(a, i))); \
  }
#define HCSP_BINARY_ON(name, Operand, Result)                                 \
  HCSP_CLONES void name(std::size_t n, Operand a, Operand b, Result result) { \
    const RoundUpward guard;                                                  \
    _Pragma("GCC ivdep") for (std::size_t i = 0; i < n; ++i)                  \
        store(result, i, name(loaded(a, i), loaded(b, i)));                   \
  }
#define HCSP_UNARY(name)                  \
  HCSP_UNARY_ON(name, Intervals, Results) \
  HCSP_UNARY_ON(name, const Interval*, Interval*)
#define HCSP_BINARY(name)                  \
  HCSP_BINARY_ON(name, Intervals, Results) \
  HCSP_BINARY_ON(name, const Interval*, Interval*)
// These have two lanes of their own.
#define HCSP_ELEMENTARY(name)                                                       \
  void name(std::size_t n, Intervals a, Results result) {                           \
    const RoundUpward guard;                                                        \
    for (std::size_t i = 0; i < n; ++i) store(result, i, up::name(interval(a, i))); \
  }

HCSP_UNARY(neg)
HCSP_BINARY(add)
HCSP_BINARY(sub)
HCSP_BINARY(mul)
HCSP_BINARY(div)
HCSP_UNARY(sqr)
HCSP_UNARY(sqrt)
HCSP_UNARY(abs)
HCSP_BINARY(min)
HCSP_BINARY(max)
HCSP_BINARY(meet)
HCSP_BINARY(join)
HCSP_ELEMENTARY(exp)
HCSP_ELEMENTARY(log)
HCSP_ELEMENTARY(sin)
HCSP_ELEMENTARY(cos)

namespace {

/// By blocks, because where a cube is not sure the operand is asked again, and the result may be in its
/// place.
HCSP_CLONES void cube(std::size_t n, Intervals a, Results result) {
  constexpr std::size_t kBlock = 64;
  for (std::size_t begin = 0; begin < n; begin += kBlock) {
    const std::size_t size = std::min(kBlock, n - begin);
    const Intervals block{a.lo + begin, a.hi + begin};
    double lo[kBlock], hi[kBlock];
    for (std::size_t i = 0; i < size; ++i) {
      lo[i] = -up::cube_or_nan<std::int64_t>(-block.lo[i]);
      hi[i] = up::cube_or_nan<std::int64_t>(block.hi[i]);
    }
    for (std::size_t i = 0; i < size; ++i) {
      const bool is_sure = lo[i] == lo[i] && hi[i] == hi[i];
      store(result, begin + i, is_sure ? Interval::raw(lo[i], hi[i]) : up::cube(interval(block, i)));
    }
  }
}

}  // namespace

void pown(std::size_t n, Intervals a, int exponent, Results result) {
  const RoundUpward guard;
  if (exponent == 3) return cube(n, a, result);
  for (std::size_t i = 0; i < n; ++i) store(result, i, up::pown(interval(a, i), exponent));
}

void atan2(std::size_t n, Intervals y, Intervals x, Results result) {
  const RoundUpward guard;
  for (std::size_t i = 0; i < n; ++i) store(result, i, up::atan2(interval(y, i), interval(x, i)));
}

#undef HCSP_UNARY
#undef HCSP_BINARY
#undef HCSP_UNARY_ON
#undef HCSP_BINARY_ON
#undef HCSP_ELEMENTARY

}  // namespace hcsp::batch
