// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/curvature.h"

namespace hcsp {

namespace {

int sign_of(const Interval& x) { return x.lo() >= 0 ? 1 : x.hi() <= 0 ? -1 : 0; }

}  // namespace

// The signs of the second derivatives.
int curvature(Op op, const Interval& a, const Interval& n, const Interval& y) {
  switch (op) {
    case Op::sqr:
    case Op::abs:
    case Op::exp:
    case Op::cosh:
      return 1;
    case Op::sqrt:
    case Op::log:
      return -1;
    case Op::sinh:
    case Op::asin:
      return sign_of(a);
    case Op::tanh:
    case Op::atan:
    case Op::acos:
      return -sign_of(a);
    case Op::sin:
    case Op::cos:
      return -sign_of(y);
    case Op::tan:
      return sign_of(y);
    case Op::pown:
      return static_cast<int>(n.lo()) % 2 == 0 ? 1 : sign_of(a);
    case Op::root:
      return -sign_of(a);
    default:
      return 0;
  }
}

}  // namespace hcsp
