// SPDX-License-Identifier: Apache-2.0
// The operators of expressions: one operator, one struct, and one table of them all. A struct tells
//   forward    an enclosure of the values on a box of operands (upward rounding: interval/kernel.h);
//   row        forward on n boxes side by side, where a batch form is faster (interval/batch.h);
//   defined    whether the operator is defined on all of that box (`def` of IEEE 1788-2015, 11.2);
//   continuous whether it is Lipschitz continuous there too, where that says more than `defined`;
//   backward   contracts the operands to the part from which a value in y can come (HC4-revise);
//   partial    the derivative with regard to operand k, as a node.
// On tubes every operator acts pointwise, item by item: program.h runs it over ranges of items.
// Booleans are the non-empty subsets of {0, 1} as intervals. Relations and connectives are total.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <type_traits>

#include "domains/check.h"
#include "domains/interval/arcs.h"
#include "domains/interval/atan2.h"
#include "domains/interval/batch.h"
#include "domains/interval/exp_log.h"
#include "domains/interval/functions.h"
#include "domains/interval/kernel.h"
#include "domains/interval/pown.h"
#include "domains/interval/reverse.h"
#include "domains/interval/sin_cos.h"
#include "solver/expression/dag.h"

namespace hcsp {

inline constexpr Interval kTrue = Interval::raw(1.0, 1.0);
inline constexpr Interval kFalse = Interval::raw(0.0, 0.0);
inline constexpr Interval kEither = Interval::raw(0.0, 1.0);

/// What the graph and its printers need to know of an operator.
struct OperatorEntry {
  std::string_view name;
  int arity;
  /// The derivative of node y = op(operands) with regard to operand k; throws std::invalid_argument where the
  /// operator has none (relations, connectives, a choice's condition).
  NodeId (*partial)(Dag& dag, NodeId y, int k);
};

const OperatorEntry& operator_entry(Op op);

namespace operators {

using I = Interval;

/// Defaults of an operator that is total on the reals.
struct Total {
  static bool defined(const I&, const I&, const I&) { return true; }
};

/// Each bound of the value is a monotone function of bounds of the operands: the same formulas serve improper
/// intervals, lo > hi (Kaucher arithmetic).
struct Boundwise : Total {};

struct Neg : Boundwise {
  static I forward(const I& a, const I&, const I&) { return -a; }
  static void row(std::size_t n, const I* a, const I*, I* y) { batch::neg(n, a, y); }
  static void backward(const I& y, I& a, I&, I&) { a = meet(a, -y); }
};

struct Add : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return up::add(a, b); }
  static void row(std::size_t n, const I* a, const I* b, I* y) { batch::add(n, a, b, y); }
  static void backward(const I& y, I& a, I& b, I&) {
    a = meet(a, up::sub(y, b));
    b = meet(b, up::sub(y, a));
  }
};

struct Sub : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return up::sub(a, b); }
  static void row(std::size_t n, const I* a, const I* b, I* y) { batch::sub(n, a, b, y); }
  static void backward(const I& y, I& a, I& b, I&) {
    a = meet(a, up::add(y, b));
    b = meet(b, up::sub(a, y));
  }
};

struct Mul : Total {
  static I forward(const I& a, const I& b, const I&) { return up::mul(a, b); }
  static void row(std::size_t n, const I* a, const I* b, I* y) { batch::mul(n, a, b, y); }
  static void backward(const I& y, I& a, I& b, I&) {
    a = up::mul_rev(b, y, a);
    b = up::mul_rev(a, y, b);
  }
};

struct Div {
  static bool defined(const I&, const I& b, const I&) { return (b.lo() > 0) | (b.hi() < 0); }
  static I forward(const I& a, const I& b, const I&) { return up::div(a, b); }
  static void row(std::size_t n, const I* a, const I* b, I* y) { batch::div(n, a, b, y); }
  static void backward(const I& y, I& a, I& b, I&) {
    a = meet(a, up::mul(y, b));
    b = up::mul_rev(y, a, b);
  }
};

struct Sqr : Total {
  static I forward(const I& a, const I&, const I&) { return up::sqr(a); }
  static void row(std::size_t n, const I* a, const I*, I* y) { batch::sqr(n, a, y); }
  static void backward(const I& y, I& a, I&, I&) { a = up::sqr_rev(y, a); }
};

struct Sqrt {
  static bool defined(const I& a, const I&, const I&) { return a.lo() >= 0; }
  static I forward(const I& a, const I&, const I&) { return up::sqrt(a); }
  static void row(std::size_t n, const I* a, const I*, I* y) { batch::sqrt(n, a, y); }
  static void backward(const I& y, I& a, I&, I&) { a = up::sqrt_rev(y, a); }
};

struct Abs : Total {
  static I forward(const I& a, const I&, const I&) { return up::abs(a); }
  static void row(std::size_t n, const I* a, const I*, I* y) { batch::abs(n, a, y); }
  static void backward(const I& y, I& a, I&, I&) { a = up::abs_rev(y, a); }
};

struct Min : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return up::min(a, b); }
  static void row(std::size_t n, const I* a, const I* b, I* y) { batch::min(n, a, b, y); }
  static void backward(const I& y, I& a, I& b, I&) {
    a = up::min_rev(b, y, a);
    b = up::min_rev(a, y, b);
  }
};

struct Max : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return up::max(a, b); }
  static void row(std::size_t n, const I* a, const I* b, I* y) { batch::max(n, a, b, y); }
  static void backward(const I& y, I& a, I& b, I&) {
    a = up::max_rev(b, y, a);
    b = up::max_rev(a, y, b);
  }
};

struct Sin : Total {
  static I forward(const I& a, const I&, const I&) { return up::sin(a); }
  static void backward(const I& y, I& a, I&, I&) { a = sin_rev(y, a); }
};

struct Cos : Total {
  static I forward(const I& a, const I&, const I&) { return up::cos(a); }
  static void backward(const I& y, I& a, I&, I&) { a = cos_rev(y, a); }
};

struct Atan2 {
  static bool defined(const I& y, const I& x, const I&) { return !(y.contains(0.0) && x.contains(0.0)); }
  /// Off the cut along the negative axis.
  static bool continuous(const I& y, const I& x) { return x.lo() > 0 || y.lo() > 0 || y.hi() < 0; }
  static I forward(const I& y, const I& x, const I&) { return up::atan2(y, x); }
  static void backward(const I& angle, I& y, I& x, I&) {
    if (!atan2_rev(angle, y, x)) y = x = I::empty();
  }
};

struct Exp : Total {
  static I forward(const I& a, const I&, const I&) { return up::exp(a); }
  static void backward(const I& y, I& a, I&, I&) { a = meet(a, up::log(y)); }
};

struct Log {
  static bool defined(const I& a, const I&, const I&) { return a.lo() > 0; }
  static I forward(const I& a, const I&, const I&) { return up::log(a); }
  static void backward(const I& y, I& a, I&, I&) { a = meet(a, up::exp(y)); }
};

struct Tan {
  static bool defined(const I& a, const I&, const I&) { return hcsp::tan(a).is_bounded(); }
  static I forward(const I& a, const I&, const I&) { return hcsp::tan(a); }
  static void backward(const I& y, I& a, I&, I&) { a = tan_rev(y, a); }
};

struct Asin {
  static bool defined(const I& a, const I&, const I&) { return a.mag() <= 1; }
  static I forward(const I& a, const I&, const I&) { return hcsp::asin(a); }
  static void backward(const I& y, I& a, I&, I&) {
    a = meet(a, up::sin(meet(y, I::raw(-kHalfPiBounds.hi(), kHalfPiBounds.hi()))));
  }
};

struct Acos {
  static bool defined(const I& a, const I&, const I&) { return a.mag() <= 1; }
  static I forward(const I& a, const I&, const I&) { return hcsp::acos(a); }
  static void backward(const I& y, I& a, I&, I&) {
    a = meet(a, up::cos(meet(y, I::raw(0.0, kPiBounds.hi()))));
  }
};

struct Atan : Total {
  static I forward(const I& a, const I&, const I&) { return up::atan(a); }
  static void backward(const I& y, I& a, I&, I&) {
    const I known = meet(y, I::raw(-kHalfPiBounds.hi(), kHalfPiBounds.hi()));
    a = known.is_empty() ? known : meet(a, I::raw(least_tangent(known.lo()), -least_tangent(-known.hi())));
  }
  /// A lower bound of the tangents of the angles from here to pi/2, which is above the last double that
  /// counts.
  static double least_tangent(double angle) {
    const double inner = std::min(angle, kHalfPiBounds.lo());
    return inner < -kHalfPiBounds.lo() ? -kInfinity : hcsp::tan(I::raw(inner, inner)).lo();
  }
};

struct Sinh : Total {
  static I forward(const I& a, const I&, const I&) { return hcsp::sinh(a); }
  static void backward(const I& y, I& a, I&, I&) { a = meet(a, hcsp::asinh(y)); }
};

struct Cosh : Total {
  static I forward(const I& a, const I&, const I&) { return hcsp::cosh(a); }
  static void backward(const I& y, I& a, I&, I&) { a = cosh_rev(y, a); }
};

struct Tanh : Total {
  static I forward(const I& a, const I&, const I&) { return hcsp::tanh(a); }
  static void backward(const I& y, I& a, I&, I&) { a = meet(a, hcsp::atanh(y)); }
};

struct Floor : Total {
  static I forward(const I& a, const I&, const I&) { return hcsp::floor(a); }
  static void backward(const I& y, I& a, I&, I&) {
    const I whole = whole_part(y);
    a = whole.is_empty() ? whole : meet(a, I::raw(whole.lo(), whole.hi() + 1.0));
  }
  /// From the least to the greatest whole number in y.
  static I whole_part(const I& y) {
    const double lo = std::ceil(y.lo()), hi = std::floor(y.hi());
    return lo <= hi ? I::raw(lo, hi) : I::empty();
  }
};

struct Ceil : Total {
  static I forward(const I& a, const I&, const I&) { return hcsp::ceil(a); }
  static void backward(const I& y, I& a, I&, I&) {
    const I whole = Floor::whole_part(y);
    a = whole.is_empty() ? whole : meet(a, I::raw(up::sub_down(whole.lo(), 1.0), whole.hi()));
  }
};

struct Sign : Total {
  static I forward(const I& a, const I&, const I&) { return hcsp::sign(a); }
  static void backward(const I& y, I& a, I&, I&) {
    I possible = I::empty();
    if (y.contains(-1.0)) possible = join(possible, I::raw(-kInfinity, 0.0));
    if (y.contains(0.0)) possible = join(possible, I::raw(0.0, 0.0));
    if (y.contains(1.0)) possible = join(possible, I::raw(0.0, kInfinity));
    a = meet(a, possible);
  }
};

/// a^n for a constant whole n.
struct Pown {
  static int exponent(const I& n) { return static_cast<int>(n.lo()); }
  static bool defined(const I& a, const I& n, const I&) { return n.lo() >= 0 || (a.lo() > 0) | (a.hi() < 0); }
  static I forward(const I& a, const I& n, const I&) { return up::pown(a, exponent(n)); }
  static void backward(const I& y, I& a, I& n, I&) { a = pown_rev(y, a, exponent(n)); }
};

/// a^b = exp(b log a), 0 for a == 0 < b.
struct Pow {
  static bool defined(const I& a, const I& b, const I&) { return a.lo() > 0 || (a.lo() >= 0 && b.lo() > 0); }
  static I forward(const I& a, const I& b, const I&) { return hcsp::pow(a, b); }
  static void backward(const I& y, I& a, I& b, I&) {
    a = pow_rev1(b, y, a);
    b = pow_rev2(a, y, b);
  }
};

/// The real n-th root for a constant whole n >= 1; of a negative number for odd n only.
struct Root {
  static bool is_odd(const I& n) { return Pown::exponent(n) % 2 != 0; }
  static bool defined(const I& a, const I& n, const I&) { return is_odd(n) || a.lo() >= 0; }
  static I forward(const I& a, const I& n, const I&) { return up::rootn(a, Pown::exponent(n)); }
  static void backward(const I& y, I& a, I& n, I&) {
    const I possible = is_odd(n) ? y : meet(y, I::raw(0.0, kInfinity));
    a = meet(a, up::pown(possible, Pown::exponent(n)));
  }
};

// Relations: {1} only where certain for all operands in the box, {0} only where certain for none. Asked to be
// true they contract; asked to be false they contract by the negation (the program sees to it that the
// operands are defined).

inline I from_bounds(bool always, bool never) { return always ? kTrue : (never ? kFalse : kEither); }

/// The truth of a <= b and of a < b, with no branch: with (-a.lo, a.hi) against (-b.hi, b.lo) one comparison
/// tells "never", the other "always".
template <bool kStrict>
inline I compare(const I& a, const I& b) {
  const Bounds x = a.bounds(), y = -swapped(b.bounds());
  const auto less = x < y, at_most = x <= y;
  const auto always = kStrict ? less : at_most, never = kStrict ? at_most : less;
  const Bounds bounds = __builtin_shufflevector(always, never, 1, 2) ? Bounds{-1.0, 0.0} : Bounds{0.0, 1.0};
  return I::of_bounds(bounds);
}
inline bool is_true(const I& y) { return y.lo() == 1.0; }
inline bool is_false(const I& y) { return y.hi() == 0.0; }

inline void at_most(I& a, I& b) {
  a = meet(a, I::raw(-kInfinity, b.hi()));
  b = meet(b, I::raw(a.lo(), kInfinity));
}
inline void equate(I& a, I& b) { a = b = meet(a, b); }

struct Less : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return compare<true>(a, b); }
  static void backward(const I& y, I& a, I& b, I&) {
    if (is_true(y)) at_most(a, b);  // the closure of <
    if (is_false(y)) at_most(b, a);
  }
};

struct LessEqual : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return compare<false>(a, b); }
  static void backward(const I& y, I& a, I& b, I&) {
    if (is_true(y)) at_most(a, b);
    if (is_false(y)) at_most(b, a);
  }
};

struct Equal : Total {
  static I forward(const I& a, const I& b, const I&) {
    return from_bounds(a.is_point() && a == b, meet(a, b).is_empty());
  }
  static void backward(const I& y, I& a, I& b, I&) {
    if (is_true(y)) equate(a, b);
  }
};

struct NotEqual : Total {
  static I forward(const I& a, const I& b, const I&) {
    return from_bounds(meet(a, b).is_empty(), a.is_point() && a == b);
  }
  static void backward(const I& y, I& a, I& b, I&) {
    if (is_false(y)) equate(a, b);
  }
};

struct And : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return up::min(a, b); }
  static void backward(const I& y, I& a, I& b, I&) {
    if (is_true(y)) {
      a = meet(a, kTrue);
      b = meet(b, kTrue);
    } else if (is_false(y)) {
      if (is_true(a)) b = meet(b, kFalse);
      if (is_true(b)) a = meet(a, kFalse);
    }
  }
};

struct Or : Boundwise {
  static I forward(const I& a, const I& b, const I&) { return up::max(a, b); }
  static void backward(const I& y, I& a, I& b, I&) {
    if (is_false(y)) {
      a = meet(a, kFalse);
      b = meet(b, kFalse);
    } else if (is_true(y)) {
      if (is_false(a)) b = meet(b, kTrue);
      if (is_false(b)) a = meet(a, kTrue);
    }
  }
};

/// Operands: the real that is bound, over its declared domain, and a relation. With the whole domain in the
/// bound operand the relation's own value encloses the quantifier's, and what contracts it contracts that:
/// what holds for every value holds for some. search/membership.h tells more.
struct ForEvery : Boundwise {
  static I forward(const I&, const I& b, const I&) { return b; }
  static void backward(const I& y, I&, I& b, I&) { b = meet(b, y); }
};
struct ForSome : ForEvery {};

struct Not : Boundwise {
  static I forward(const I& a, const I&, const I&) { return I::raw(1.0 - a.hi(), 1.0 - a.lo()); }
  static void backward(const I& y, I& a, I&, I&) { a = meet(a, I::raw(1.0 - y.hi(), 1.0 - y.lo())); }
};

/// Operands: condition, then, otherwise. Total: the program tells the definedness of the branch that is
/// taken.
struct IfThenElse : Total {
  static I forward(const I& condition, const I& a, const I& b) {
    return is_true(condition) ? a : (is_false(condition) ? b : join(a, b));
  }
  static void backward(const I& y, I& condition, I& a, I& b) {
    if (meet(y, a).is_empty()) condition = meet(condition, kFalse);
    if (meet(y, b).is_empty()) condition = meet(condition, kTrue);
    if (is_true(condition)) a = meet(a, y);
    if (is_false(condition)) b = meet(b, y);
  }
};

/// The value's core on cores of the operands (Evaluation::core_over_children). Where all are proper, forward
/// gives it, by inclusion isotonicity; the empty set's bounds [+oo, -oo] say nothing.
template <class Operator>
I core(const I& a, const I& b, const I& c) {
  if constexpr (std::is_base_of_v<Boundwise, Operator>) return Operator::forward(a, b, c);
  if constexpr (std::is_same_v<Operator, IfThenElse>) return I::of_bounds(least(b.bounds(), c.bounds()));
  return a.is_empty() || b.is_empty() || c.is_empty() ? I::empty() : Operator::forward(a, b, c);
}

/// Whether an operator is defined and Lipschitz continuous on all of a box; steps are left to the caller.
template <class Operator>
bool is_continuous(const I& a, const I& b) {
  if constexpr (requires { Operator::continuous(a, b); }) return Operator::continuous(a, b);
  return Operator::defined(a, b, b);
}

/// Defined, and learning of its operands from its value alone, everywhere.
template <class Operator>
inline constexpr bool is_total = std::is_base_of_v<Total, Operator> && !std::is_same_v<Operator, IfThenElse>;

}  // namespace operators

/// Every operator: its Op, its struct, its name in the language and its number of operands.
// clang-format off
#define HCSP_OPERATORS(X)              \
  X(neg, Neg, "-", 1)                  \
  X(add, Add, "+", 2)                  \
  X(sub, Sub, "-", 2)                  \
  X(mul, Mul, "*", 2)                  \
  X(div, Div, "/", 2)                  \
  X(sqr, Sqr, "sqr", 1)                \
  X(sqrt, Sqrt, "sqrt", 1)             \
  X(abs, Abs, "abs", 1)                \
  X(min, Min, "min", 2)                \
  X(max, Max, "max", 2)                \
  X(sin, Sin, "sin", 1)                \
  X(cos, Cos, "cos", 1)                \
  X(atan2, Atan2, "atan2", 2)          \
  X(exp, Exp, "exp", 1)                \
  X(log, Log, "log", 1)                \
  X(tan, Tan, "tan", 1)                \
  X(asin, Asin, "asin", 1)             \
  X(acos, Acos, "acos", 1)             \
  X(atan, Atan, "atan", 1)             \
  X(sinh, Sinh, "sinh", 1)             \
  X(cosh, Cosh, "cosh", 1)             \
  X(tanh, Tanh, "tanh", 1)             \
  X(floor, Floor, "floor", 1)          \
  X(ceil, Ceil, "ceil", 1)             \
  X(sign, Sign, "sign", 1)             \
  X(pown, Pown, "^", 2)                \
  X(pow, Pow, "^", 2)                  \
  X(root, Root, "root", 2)             \
  X(less, Less, "<", 2)                \
  X(less_equal, LessEqual, "<=", 2)    \
  X(equal, Equal, "==", 2)             \
  X(not_equal, NotEqual, "!=", 2)      \
  X(logical_and, And, "and", 2)        \
  X(logical_or, Or, "or", 2)           \
  X(for_every, ForEvery, "forall", 2)  \
  X(for_some, ForSome, "exists", 2)    \
  X(logical_not, Not, "not", 1)        \
  X(if_then_else, IfThenElse, "if", 3)
// clang-format on

/// An operator, known to the compiler.
template <Op kOp, class Operator>
struct Known {
  static constexpr Op op = kOp;
  using type = Operator;
};

/// f(Known<op, its struct>{}) of an operator that is not a leaf.
template <class F>
decltype(auto) with_operator(Op op, F&& f) {
  switch (op) {
#define HCSP_KNOWN(name, type, text, arity) \
  case Op::name:                            \
    return f(Known<Op::name, operators::type>{});
    HCSP_OPERATORS(HCSP_KNOWN)
#undef HCSP_KNOWN
    default:
      HCSP_ASSERT(false);
      __builtin_unreachable();
  }
}

constexpr bool is_relation(Op op) { return op >= Op::less && op <= Op::not_equal; }
constexpr bool is_quantifier(Op op) { return op == Op::for_every || op == Op::for_some; }
constexpr bool is_boolean(Op op) { return op >= Op::less && op <= Op::logical_not; }

}  // namespace hcsp
