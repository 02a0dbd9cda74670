// SPDX-License-Identifier: Apache-2.0
// Expressions in floating point: where to look, never what is so.
#include <cmath>

#include "solver/expression/operators.h"
#include "solver/online/machine.h"

namespace hcsp::online {

namespace {

template <Op kOp, class Operator>
double value_of(double a, double b, double c) {
  if constexpr (kOp == Op::neg) return -a;
  if constexpr (kOp == Op::add) return a + b;
  if constexpr (kOp == Op::sub) return a - b;
  if constexpr (kOp == Op::mul) return a * b;
  if constexpr (kOp == Op::div) return a / b;
  if constexpr (kOp == Op::sqr) return a * a;
  if constexpr (kOp == Op::sqrt) return std::sqrt(std::max(a, 0.0));
  if constexpr (kOp == Op::abs) return std::abs(a);
  if constexpr (kOp == Op::min || kOp == Op::logical_and) return std::min(a, b);
  if constexpr (kOp == Op::max || kOp == Op::logical_or) return std::max(a, b);
  if constexpr (kOp == Op::less) return a < b ? 1.0 : 0.0;
  if constexpr (kOp == Op::less_equal) return a <= b ? 1.0 : 0.0;
  if constexpr (kOp == Op::equal) return a == b ? 1.0 : 0.0;
  if constexpr (kOp == Op::not_equal) return a != b ? 1.0 : 0.0;
  if constexpr (kOp == Op::logical_not) return 1.0 - a;
  if constexpr (kOp == Op::if_then_else) return a != 0.0 ? b : c;
  if (!std::isfinite(a) || !std::isfinite(b)) return std::nan("");
  const Interval y = Operator::forward(Interval::raw(a, a), Interval::raw(b, b), Interval::raw(c, c));
  return 0.5 * y.lo() + 0.5 * y.hi();
}

}  // namespace

void Machine::run_real(std::span<const Instruction> code) {
  double* const reals = reals_.data();
  for (const Instruction *at = code.data(), *end = at + code.size(); at != end;) {
    with_operator(at->op, [&](auto known) {
      using Known = decltype(known);
      const Instruction* next = at;
      do {
        reals[next->y] =
            value_of<Known::op, typename Known::type>(reals[next->a], reals[next->b], reals[next->c]);
      } while (++next != end && next->op == Known::op);
      at = next;
    });
  }
}

void Machine::evaluate_real(const Code& code, std::span<const double> point, Code::Stage last) {
  std::copy(point.begin(), point.end(), reals_.begin() + code.first());
  run_real(std::span(code.values).first(code.ends[last].values));
}

template <ChainRule::Kind kKind>
void Machine::apply_real(const ChainRule& rule) {
  using Kind = ChainRule::Kind;
  const Lanes *a = real_slopes_of(rule.a), *b = real_slopes_of(rule.b), *c = real_slopes_of(rule.c);
  const double va = reals_[rule.a], vb = reals_[rule.b];
  Lanes* const y = &real_slopes_[(rule.y - first_ + 1) * real_lanes_];
  const auto write = [&](auto value_of) {
    for (std::size_t i = 0; i < real_lanes_; ++i) y[i] = value_of(i);
  };
  // What does not vary does not, though the root of 0 is infinitely steep.
  const auto product = [](double by, const Lanes& of) { return of == 0.0 ? Lanes{} : by * of; };
  const auto copy = [&](const Lanes* of) { write([&](std::size_t i) { return of[i]; }); };
  const auto negate = [&](const Lanes* of) { write([&](std::size_t i) { return -of[i]; }); };
  switch (kKind) {
    case Kind::copy:
      return copy(a);
    case Kind::negate:
      return negate(a);
    case Kind::add:
      return write([&](std::size_t i) { return a[i] + b[i]; });
    case Kind::sub:
      return write([&](std::size_t i) { return a[i] - b[i]; });
    case Kind::min:
      return copy(va <= vb ? a : b);
    case Kind::max:
      return copy(va >= vb ? a : b);
    case Kind::choice:
      return copy(va != 0.0 ? b : c);
    case Kind::abs:
      return va >= 0.0 ? copy(a) : negate(a);
    case Kind::constant:
      return write([](std::size_t) { return Lanes{}; });
    case Kind::root:
    case Kind::scale:
      return write([&, by = reals_[rule.sa]](std::size_t i) { return product(by, a[i]); });
    case Kind::scale_both:
      return write([&, by_a = reals_[rule.sa], by_b = reals_[rule.sb]](std::size_t i) {
        return product(by_a, a[i]) + product(by_b, b[i]);
      });
  }
}

void Machine::differentiate_real(const Code& code, std::uint64_t active, Code::Stage last) {
  run_real(std::span(code.slopes).first(code.ends[last].slopes));
  real_lanes_ = lanes(static_cast<std::size_t>(__builtin_popcountll(active)));
  std::fill_n(real_slopes_.begin(), (code.core() + 1) * real_lanes_, Lanes{});
  std::size_t k = 0;
  for (std::uint64_t left = active; left != 0; left &= left - 1, ++k) {
    const auto v = static_cast<std::size_t>(__builtin_ctzll(left));
    real_slopes_[(v + 1) * real_lanes_ + k / kLanes][k % kLanes] = 1.0;
  }
  for_each_rule(std::span(code.chain).first(code.ends[last].chain),
                [&](auto kind, const ChainRule& rule) { apply_real<kind()>(rule); });
}

}  // namespace hcsp::online
