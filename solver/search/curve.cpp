// SPDX-License-Identifier: Apache-2.0
#include "solver/search/curve.h"

#include "domains/interval/functions.h"
#include "solver/expression/operators.h"

namespace hcsp {

namespace {

constexpr Interval kOne = Interval::raw(1.0, 1.0);
constexpr Interval kMinusOne = Interval::raw(-1.0, -1.0);

}  // namespace

bool is_curve(Op op) {
  switch (op) {
    case Op::sqr:
    case Op::sqrt:
    case Op::abs:
    case Op::sin:
    case Op::cos:
    case Op::exp:
    case Op::log:
    case Op::tan:
    case Op::asin:
    case Op::acos:
    case Op::atan:
    case Op::sinh:
    case Op::cosh:
    case Op::tanh:
    case Op::pown:
    case Op::pow:
    case Op::root:
    case Op::div:
      return true;
    default:
      return false;
  }
}

Interval Curve::value(const Interval& x) const {
  if (op == Op::div) return up::div(constant, x);
  return with_operator(op, [&](auto known) { return decltype(known)::type::forward(x, constant, constant); });
}

Interval Curve::slope(const Interval& x) const {
  switch (op) {
    case Op::sqr:
      return up::mul(Interval::raw(2.0, 2.0), x);
    case Op::sqrt:
      return up::div(Interval::raw(0.5, 0.5), up::sqrt(x));
    case Op::abs:
      return x.lo() >= 0 ? kOne : x.hi() <= 0 ? kMinusOne : Interval::raw(-1.0, 1.0);
    case Op::sin:
      return up::cos(x);
    case Op::cos:
      return -up::sin(x);
    case Op::exp:
      return up::exp(x);
    case Op::log:
      return up::div(kOne, x);
    case Op::tan:
      return up::add(kOne, up::sqr(hcsp::tan(x)));
    case Op::asin:
      return up::div(kOne, up::sqrt(up::sub(kOne, up::sqr(x))));
    case Op::acos:
      return up::div(kMinusOne, up::sqrt(up::sub(kOne, up::sqr(x))));
    case Op::atan:
      return up::div(kOne, up::add(kOne, up::sqr(x)));
    case Op::sinh:
      return hcsp::cosh(x);
    case Op::cosh:
      return hcsp::sinh(x);
    case Op::tanh:
      return up::sub(kOne, up::sqr(hcsp::tanh(x)));
    case Op::pown:
      return up::mul(constant, up::pown(x, static_cast<int>(constant.lo()) - 1));
    case Op::pow:
      return up::mul(constant, hcsp::pow(x, up::sub(constant, kOne)));
    case Op::root:
      return up::div(value(x), up::mul(constant, x));
    case Op::div:
      return up::div(-constant, up::sqr(x));
    default:
      return Interval::entire();
  }
}

Interval Curve::bend(const Interval& x) const {
  switch (op) {
    case Op::sqr:
    case Op::abs:
    case Op::exp:
    case Op::cosh:
      return kOne;
    case Op::sqrt:
    case Op::log:
      return kMinusOne;
    case Op::sin:
      return -up::sin(x);
    case Op::cos:
      return -up::cos(x);
    case Op::tan:
      return hcsp::tan(x);
    case Op::asin:
    case Op::sinh:
      return x;
    case Op::acos:
    case Op::atan:
    case Op::tanh:
      return -x;
    case Op::pown: {
      const int n = static_cast<int>(constant.lo());
      if (n == 0 || n == 1) return Interval::raw(0.0, 0.0);
      if (n < 0 && x.lo() < 0 && x.hi() > 0) return Interval::entire();  // across a pole
      return n % 2 == 0 ? kOne : n > 0 ? x : up::div(kOne, x);
    }
    case Op::pow:  // of x >= 0
      return up::mul(constant, up::sub(constant, kOne));
    case Op::root: {
      const int n = static_cast<int>(constant.lo());
      return n == 1 ? Interval::raw(0.0, 0.0) : n % 2 == 0 ? kMinusOne : -x;
    }
    case Op::div:
      return up::div(constant, x);
    default:
      return Interval::entire();
  }
}

}  // namespace hcsp
