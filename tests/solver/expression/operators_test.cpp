// SPDX-License-Identifier: Apache-2.0
// Every operator of the table against MPFR: forward encloses, backward loses no solution, contracts and is
// isotone, `defined` is true only where it is so, and the partial derivatives enclose difference quotients.
#include "solver/expression/operators.h"

#include <gtest/gtest.h>

#include "domains/rounding.h"
#include "solver/expression/program.h"
#include "tests/support/oracle.h"

namespace hcsp {
namespace {

using oracle::Dice;
using oracle::for_seeds;

struct Tested {
  Op op;
  int arity;
  Interval (*forward)(const Interval&, const Interval&, const Interval&);
  bool (*defined)(const Interval&, const Interval&, const Interval&);
  void (*backward)(const Interval&, Interval&, Interval&, Interval&);
};

const Tested kTable[] = {
#define HCSP_TESTED(name, type, text, arity) \
  {Op::name, arity, operators::type::forward, operators::type::defined, operators::type::backward},
    HCSP_OPERATORS(HCSP_TESTED)
#undef HCSP_TESTED
};

using Operands = std::array<double, 3>;
using OperandBox = std::array<Interval, 3>;

bool takes_booleans(Op op, int k) {
  return is_boolean(op) ? !is_relation(op) : op == Op::if_then_else && k == 0;
}

Interval boolean(bool value) { return value ? kTrue : kFalse; }

// The tightest enclosure of the operator's value at a point; empty where it has none.
Interval truth_at(Op op, const Operands& x) {
  const double a = x[0], b = x[1];
  const auto square = [](mpfr_ptr r, mpfr_srcptr v, mpfr_rnd_t mode) { return mpfr_sqr(r, v, mode); };
  switch (op) {
    case Op::neg:
      return Interval(-a);
    case Op::add:
      return oracle::truth(mpfr_add, a, b);
    case Op::sub:
      return oracle::truth(mpfr_sub, a, b);
    case Op::mul:
      return oracle::truth(mpfr_mul, a, b);
    case Op::div:
      return b == 0 ? Interval::empty() : oracle::truth(mpfr_div, a, b);
    case Op::sqr:
      return oracle::truth(+square, a);
    case Op::sqrt:
      return a < 0 ? Interval::empty() : oracle::truth(mpfr_sqrt, a);
    case Op::abs:
      return Interval(std::abs(a));
    case Op::min:
      return Interval(std::min(a, b));
    case Op::max:
      return Interval(std::max(a, b));
    case Op::sin:
      return oracle::truth(mpfr_sin, a);
    case Op::cos:
      return oracle::truth(mpfr_cos, a);
    case Op::atan2:
      return a == 0 && b == 0 ? Interval::empty()
                              : oracle::truth(mpfr_atan2, a == 0 ? 0.0 : a, b == 0 ? 0.0 : b);
    case Op::exp:
      return oracle::truth(mpfr_exp, a);
    case Op::log:
      return a <= 0 ? Interval::empty() : oracle::truth(mpfr_log, a);
    case Op::tan:
      return oracle::truth(mpfr_tan, a);
    case Op::asin:
      return std::abs(a) > 1 ? Interval::empty() : oracle::truth(mpfr_asin, a);
    case Op::acos:
      return std::abs(a) > 1 ? Interval::empty() : oracle::truth(mpfr_acos, a);
    case Op::atan:
      return oracle::truth(mpfr_atan, a);
    case Op::sinh:
      return oracle::truth(mpfr_sinh, a);
    case Op::cosh:
      return oracle::truth(mpfr_cosh, a);
    case Op::tanh:
      return oracle::truth(mpfr_tanh, a);
    case Op::floor:
      return Interval(std::floor(a));
    case Op::ceil:
      return Interval(std::ceil(a));
    case Op::sign:
      return Interval(a > 0 ? 1.0 : (a < 0 ? -1.0 : 0.0));
    case Op::pown:
      return a == 0 && b < 0 ? Interval::empty() : oracle::truth(mpfr_pow, a, b);
    case Op::pow:
      return a < 0 || (a == 0 && b <= 0) ? Interval::empty() : oracle::truth(mpfr_pow, a == 0 ? 0.0 : a, b);
    case Op::root: {
      if (a < 0 && std::fmod(b, 2.0) == 0) return Interval::empty();
      const auto rooted = [](mpfr_ptr r, mpfr_srcptr v, mpfr_srcptr n, mpfr_rnd_t mode) {
        return mpfr_rootn_ui(r, v, mpfr_get_ui(n, MPFR_RNDN), mode);
      };
      return oracle::truth(+rooted, a, b);
    }
    case Op::less:
      return boolean(a < b);
    case Op::less_equal:
      return boolean(a <= b);
    case Op::equal:
      return boolean(a == b);
    case Op::not_equal:
      return boolean(a != b);
    case Op::logical_and:
      return boolean(a != 0 && b != 0);
    case Op::logical_or:
      return boolean(a != 0 || b != 0);
    case Op::for_every:
    case Op::for_some:
      return boolean(b != 0);
    case Op::logical_not:
      return boolean(a == 0);
    default:
      return Interval(a != 0 ? b : x[2]);
  }
}

/// The exponent of a power, the degree of a root.
bool takes_whole_constant(Op op, int k) { return k == 1 && (op == Op::pown || op == Op::root); }

Interval random_operand(Dice& dice, Op op, int k) {
  if (takes_whole_constant(op, k)) return Interval(op == Op::root ? 1 + dice.below(9) : dice.below(15) - 5);
  if (!takes_booleans(op, k))
    return dice.below(3) == 0 ? oracle::around(dice, oracle::dyadic(dice, -4, 4)) : dice.interval();
  return std::array{kTrue, kFalse, kEither}[static_cast<std::size_t>(dice.below(3))];
}

double random_point(Dice& dice, const Interval& a, bool boolean) {
  return boolean ? (dice.below(2) == 0 ? a.lo() : a.hi()) : dice.in(a);
}

Interval random_part(Dice& dice, const Interval& a, bool boolean) {
  if (!boolean) return dice.within(a);
  const double value = random_point(dice, a, true);
  return dice.below(2) == 0 ? a : Interval(value);
}

// A wanted value around a true one.
Interval wanted_around(Dice& dice, Op op, const Interval& value) {
  if (is_boolean(op)) return dice.below(3) == 0 ? kEither : value;
  const Interval about = dice.below(3) == 0 ? dice.interval() : value;
  return join(value, about);
}

class EveryOperator : public ::testing::TestWithParam<Tested> {
 protected:
  OperandBox random_box(Dice& dice) const {
    OperandBox box;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      box[i] = k < at.arity ? random_operand(dice, at.op, k) : box[0];
    }
    return box;
  }
  OperandBox part_of(Dice& dice, const OperandBox& box) const {
    OperandBox part;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      part[i] = k < at.arity ? random_part(dice, box[i], takes_booleans(at.op, k)) : part[0];
    }
    return part;
  }
  Operands point_in(Dice& dice, const OperandBox& box) const {
    Operands point{};
    for (int k = 0; k < at.arity; ++k) {
      const auto i = static_cast<std::size_t>(k);
      point[i] = random_point(dice, box[i], takes_booleans(at.op, k));
    }
    return point;
  }
  const Tested at = GetParam();
};

TEST_P(EveryOperator, ForwardEnclosesAndIsIsotone) {
  for_seeds(1000, [&](Dice& dice) {
    const OperandBox box = random_box(dice), part = part_of(dice, box);
    const Operands point = point_in(dice, box);
    const Interval truth = truth_at(at.op, point);
    RoundUpward guard;
    const Interval value = at.forward(box[0], box[1], box[2]);
    EXPECT_TRUE(leq(truth, value)) << "at " << point[0] << ", " << point[1];
    EXPECT_TRUE(leq(at.forward(part[0], part[1], part[2]), value)) << "isotone";
    const bool defined = at.defined(box[0], box[1], box[2]);
    EXPECT_TRUE(!defined || !truth.is_empty()) << "defined, but not at " << point[0] << ", " << point[1];
    EXPECT_TRUE(!defined || at.defined(part[0], part[1], part[2])) << "defined on a part";
  });
}

TEST_P(EveryOperator, BackwardLosesNothingContractsAndIsIsotone) {
  for_seeds(1000, [&](Dice& dice) {
    const OperandBox box = random_box(dice), part = part_of(dice, box);
    const Operands point = point_in(dice, box);
    const Interval truth = truth_at(at.op, point);
    const Interval wanted = truth.is_empty() ? dice.interval() : wanted_around(dice, at.op, truth);
    if (is_boolean(at.op) && truth.is_empty()) return;
    const Interval less_wanted = random_part(dice, wanted, is_boolean(at.op));
    OperandBox contracted = box, contracted_part = part;
    RoundUpward guard;
    at.backward(wanted, contracted[0], contracted[1], contracted[2]);
    at.backward(less_wanted, contracted_part[0], contracted_part[1], contracted_part[2]);
    bool lost_part = false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(at.arity); ++k) {
      EXPECT_TRUE(leq(contracted[k], box[k])) << "operand " << k << " grew";
      if (!truth.is_empty()) {
        EXPECT_TRUE(contracted[k].contains(point[k])) << "operand " << k << " lost " << point[k];
      }
      lost_part = lost_part || contracted_part[k].is_empty();
    }
    for (std::size_t k = 0; !lost_part && k < static_cast<std::size_t>(at.arity); ++k) {
      EXPECT_TRUE(leq(contracted_part[k], contracted[k])) << "operand " << k << " is not isotone";
    }
  });
}

TEST_P(EveryOperator, HasAnEntryInTheTable) {
  const OperatorEntry& entry = operator_entry(at.op);
  EXPECT_EQ(entry.arity, at.arity);
  EXPECT_FALSE(entry.name.empty());
  if (!is_boolean(at.op)) return;
  Dag dag;
  const NodeId x = dag.input({}), y = dag.input({Input::Kind::real, 1, 0, 0});
  const NodeId node = dag.apply(at.op, {x, y}, at.arity);
  EXPECT_THROW(entry.partial(dag, node, 0), std::invalid_argument) << "a relation has no derivative";
}

// Mean value theorem: on a box where the operator is defined, a difference quotient is a value of the
// derivative, and for a Lipschitz function lies in the hull of its one-sided derivatives.
class EveryFunction : public EveryOperator {
 protected:
  void expect_partials(Dag& dag, NodeId node, int count, int degree) const;
};

TEST_P(EveryFunction, PartialsEncloseDifferenceQuotients) {
  Dag dag;
  for (int degree = 1; degree <= 6; ++degree) {
    const NodeId x = dag.input({Input::Kind::real, 0, 0, 0});
    const bool is_constant = takes_whole_constant(at.op, 1);
    const NodeId y = is_constant ? dag.constant(Interval(degree)) : dag.input({Input::Kind::real, 1, 0, 0});
    expect_partials(dag, dag.apply(at.op, {x, y}, at.arity), is_constant ? 1 : at.arity, degree);
    if (!is_constant) break;
  }
}

// With regard to the first `count` operands of a node, of which the second may be the constant `degree`.
void EveryFunction::expect_partials(Dag& dag, NodeId node, int count, int degree) const {
  for (int k = 0; k < count; ++k) {
    const auto moved = static_cast<std::size_t>(k);
    const Program program(dag, {operator_entry(at.op).partial(dag, node, k)});
    for_seeds(500, [&](Dice& dice) {
      OperandBox box;
      for (Interval& side : box) {
        const double a = oracle::dyadic(dice, -6, 6), b = oracle::dyadic(dice, -6, 6);
        side = Interval(std::min(a, b), std::max(a, b));
      }
      if (count < at.arity) box[1] = Interval(degree);
      if (box[moved].is_point() || !at.defined(box[0], box[1], box[2])) return;
      if (at.op == Op::atan2 && box[0].contains(0) && box[1].lo() < 0) return;  // it jumps there
      Operands p = point_in(dice, box), q = p;
      q[moved] = dice.in(box[moved]);
      if (p[moved] == q[moved]) return;
      const Interval quotient =
          (truth_at(at.op, p) - truth_at(at.op, q)) / (Interval(p[moved]) - Interval(q[moved]));
      Evaluation evaluation(program);
      for (std::uint32_t i = 0; i < program.inputs().size(); ++i)
        evaluation.set(i, box[program.inputs()[i].variable]);
      RoundUpward guard;
      evaluation.forward();
      EXPECT_FALSE(meet(evaluation.get(program.root()), quotient).is_empty()) << "partial " << k;
    });
  }
}

std::string name_of(const ::testing::TestParamInfo<Tested>& info) {
  static const char* const kNames[] = {
#define HCSP_NAME(name, type, text, arity) #type,
      HCSP_OPERATORS(HCSP_NAME)
#undef HCSP_NAME
  };
  return kNames[info.index];
}

INSTANTIATE_TEST_SUITE_P(Table, EveryOperator, ::testing::ValuesIn(kTable), name_of);

// Those with values in the reals and a derivative.
std::vector<Tested> differentiable() {
  std::vector<Tested> all;
  for (const Tested& t : kTable) {
    const bool jumps = t.op == Op::floor || t.op == Op::ceil || t.op == Op::sign;
    if (!is_boolean(t.op) && !jumps && t.op != Op::if_then_else) all.push_back(t);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Table, EveryFunction, ::testing::ValuesIn(differentiable()),
                         [](const ::testing::TestParamInfo<Tested>& info) {
                           return fmt::format("Op{}", static_cast<int>(info.param.op));
                         });

TEST(IfThenElse, HasThePartialOfTheBranchThatIsTaken) {
  Dag dag;
  const NodeId c = dag.constant(Interval(0, 1)), x = dag.input({}),
               y = dag.input({Input::Kind::real, 1, 0, 0});
  const NodeId node = dag.apply(Op::if_then_else, {c, x, y}, 3);
  const OperatorEntry& entry = operator_entry(Op::if_then_else);
  EXPECT_THROW(entry.partial(dag, node, 0), std::invalid_argument);
  for (const int k : {1, 2}) {
    const Program program(dag, {entry.partial(dag, node, k)});
    Evaluation evaluation(program);
    RoundUpward guard;
    evaluation.forward();
    EXPECT_EQ(evaluation.get(program.root()), Interval(0, 1));
  }
}

TEST(Operators, AreUndefinedWhereTheyShouldBe) {
  const Interval zero(0), around(-1, 4), positive(1, 2);
  EXPECT_FALSE(operators::Div::defined(positive, around, zero));
  EXPECT_FALSE(operators::Sqrt::defined(around, zero, zero));
  EXPECT_FALSE(operators::Atan2::defined(around, around, zero));
  EXPECT_TRUE(operators::Atan2::defined(positive, around, zero));
  EXPECT_TRUE(operators::Sqrt::defined(zero, zero, zero));
}

}  // namespace
}  // namespace hcsp
