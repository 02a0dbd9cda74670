// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/program.h"

#include <gtest/gtest.h>

#include "domains/rounding.h"
#include "tests/support/pointwise.h"

namespace hcsp {
namespace {

using oracle::Answer;
using oracle::Dice;
using oracle::for_seeds;

struct System {
  Dag dag;
  std::vector<Expr> leaves;
  explicit System(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) leaves.emplace_back(dag, dag.input(input(i)));
  }
  static Input input(std::size_t i) { return {Input::Kind::real, static_cast<VariableId>(i), 0, 0}; }
};

void load(Evaluation& evaluation, const std::vector<Interval>& box, std::size_t lane = 0) {
  const auto& inputs = evaluation.program().inputs();
  for (std::uint32_t i = 0; i < inputs.size(); ++i) evaluation.set(i, box[inputs[i].variable], lane);
}

Interval truth_of(Expr relation, const Interval& x) {
  const Program program(relation.dag(), {relation.node()});
  Evaluation evaluation(program);
  RoundUpward guard;
  load(evaluation, {x});
  evaluation.forward();
  return evaluation.get(program.root());
}

// One HC4-revise of a relation in one unknown.
Interval contracted(Expr relation, const Interval& x, const Interval& wanted = kTrue) {
  const Program program(relation.dag(), {relation.node()});
  Evaluation evaluation(program);
  RoundUpward guard;
  load(evaluation, {x});
  evaluation.forward();
  return evaluation.backward(wanted) ? evaluation.get(0) : Interval::empty();
}

TEST(Program, KeepsOnlyWhatItsRootsNeed) {
  System s(3);
  const Expr a = s.leaves[0], b = s.leaves[1];
  static_cast<void>(sin(s.leaves[2]));
  const Program program(s.dag, {(a + b).node(), ((a + b) * 2.0).node()});
  EXPECT_EQ(program.inputs().size(), 2U);
  EXPECT_EQ(program.code().size(), 2U) << "the sum is evaluated once";
  EXPECT_EQ(program.constants().size(), 1U);
  EXPECT_EQ(program.roots(), 2U);
  EXPECT_EQ(program.register_of((a + b).node()), program.root(0));
  EXPECT_TRUE(program.is_constant(2));
}

TEST(Program, WhatNeedsNoBoundPointComesFirst) {
  System s(2);
  const Expr p{s.dag, s.dag.input({Input::Kind::point, 0, 0, 0})};
  const Expr root = sqrt(p * s.leaves[0]) + sin(s.leaves[1]) * 2.0 < cos(s.leaves[0]);
  const Program program(s.dag, {root.node()});
  EXPECT_EQ(program.point_code(), 3U);
  Evaluation whole(program), halves(program);
  RoundUpward guard;
  for (Evaluation* evaluation : {&whole, &halves}) {
    for (std::uint32_t i = 0; i < program.inputs().size(); ++i) evaluation->set(i, Interval(0.5, 1 + i));
  }
  whole.forward();
  halves.forward_before_point();
  halves.forward_from_point();
  for (std::uint32_t r = 0; r < program.registers(); ++r) {
    EXPECT_EQ(whole.get(r), halves.get(r));
    EXPECT_EQ(whole.defined(r), halves.defined(r));
  }
}

std::vector<Interval> random_box(Dice& dice, const oracle::Point& centre) {
  std::vector<Interval> box;
  for (const double x : centre) box.push_back(oracle::around(dice, x));
  return box;
}

oracle::Point random_point(Dice& dice, std::size_t dim) {
  oracle::Point point;
  for (std::size_t i = 0; i < dim; ++i) point.push_back(oracle::dyadic(dice, -3, 3, 1));
  return point;
}

std::map<Input, double> as_inputs(const oracle::Point& point) {
  std::map<Input, double> inputs;
  for (std::size_t i = 0; i < point.size(); ++i) inputs[System::input(i)] = point[i];
  return inputs;
}

oracle::Point point_within(Dice& dice, const std::vector<Interval>& box) {
  oracle::Point point;
  for (const Interval& side : box) point.push_back(dice.in(side));
  return point;
}

// What the forward sweep says of a box is true of its points: values, definedness, certainty.
TEST(Program, ForwardIsTrueOfEveryPoint) {
  for_seeds(1500, [](Dice& dice) {
    System s(3);
    const Expr relation = oracle::random_relation(dice, s.leaves, 4);
    const Program program(s.dag, {relation.node()});
    Evaluation evaluation(program);
    const auto box = random_box(dice, random_point(dice, 3));
    {
      RoundUpward guard;
      load(evaluation, box);
      evaluation.forward();
    }
    const Interval holds = evaluation.get(program.root());
    EXPECT_TRUE(holds == kTrue || holds == kFalse || holds == kEither);
    for (int k = 0; k < 10; ++k) {
      const oracle::Pointwise at(s.dag, as_inputs(point_within(dice, box)));
      const Answer answer = at.holds(relation.node());
      EXPECT_FALSE(answer == Answer::no && holds == kTrue) << "certain, but not so at a point";
      EXPECT_FALSE(answer == Answer::yes && holds == kFalse) << "impossible, but so at a point";
      for (NodeId id = 0; id < s.dag.size(); ++id) {
        const bool is_term = !is_boolean(s.dag[id].op);
        if (!is_term || program.code().empty()) continue;
        try {
          const std::uint32_t reg = program.register_of(id);
          const auto term = at.term(id);
          EXPECT_FALSE(term.defined == Answer::no && evaluation.defined(reg)) << "said to be defined";
          if (term.defined == Answer::yes) {
            EXPECT_FALSE(meet(term.value, evaluation.get(reg)).is_empty());
          }
        } catch (const std::out_of_range&) {  // a node that the root does not need
        }
      }
    }
  });
}

// HC4 on random expressions loses no solution, of the relation or of its negation; it contracts, and is
// isotone.
TEST(Program, BackwardLosesNoSolutionOfARandomRelation) {
  int tried = 0;
  for_seeds(4000, [&](Dice& dice) {
    System s(3);
    const Expr relation = oracle::random_relation(dice, s.leaves, 1 + dice.below(4));
    const oracle::Point point = random_point(dice, 3);
    const Answer answer = oracle::Pointwise(s.dag, as_inputs(point)).holds(relation.node());
    const auto box = random_box(dice, point);
    std::vector<Interval> smaller;
    for (const Interval& side : box) smaller.push_back(dice.within(side));
    const Program program(s.dag, {relation.node()});
    Evaluation evaluation(program), on_smaller(program);
    RoundUpward guard;
    for (const Interval& wanted : {kTrue, kFalse}) {
      load(evaluation, box);
      load(on_smaller, smaller);
      evaluation.forward();
      on_smaller.forward();
      const bool alive = evaluation.backward(wanted), smaller_alive = on_smaller.backward(wanted);
      EXPECT_TRUE(alive || !smaller_alive) << "isotone";
      if (answer == (wanted == kTrue ? Answer::yes : Answer::no)) {
        ++tried;
        ASSERT_TRUE(alive) << "a solution was within";
      }
      for (std::uint32_t i = 0; alive && i < program.inputs().size(); ++i) {
        const VariableId v = program.inputs()[i].variable;
        EXPECT_TRUE(leq(evaluation.get(i), box[v]));
        if (answer == (wanted == kTrue ? Answer::yes : Answer::no)) {
          EXPECT_TRUE(evaluation.get(i).contains(point[v])) << "variable " << v << " lost " << point[v];
        }
        EXPECT_TRUE(!smaller_alive || leq(on_smaller.get(i), evaluation.get(i))) << "isotone";
      }
    }
  });
  EXPECT_TRUE(tried > 2000 || ::testing::GTEST_FLAG(random_seed) > 0 || HasFailure());
}

TEST(Program, LanesGiveTheBitsOfOneLane) {
  for_seeds(300, [](Dice& dice) {
    System s(3);
    const Expr relation = oracle::random_relation(dice, s.leaves, 4);
    const Program program(s.dag, {relation.node()});
    constexpr std::size_t kLanes = 13;
    const std::size_t used = 1 + static_cast<std::size_t>(dice.below(kLanes));
    Evaluation many(program, kLanes), one(program);
    std::vector<std::vector<Interval>> boxes;
    for (std::size_t lane = 0; lane < used; ++lane) {
      boxes.push_back(random_box(dice, random_point(dice, 3)));
      load(many, boxes.back(), lane);
    }
    RoundUpward guard;
    many.forward(used);
    std::vector<bool> alive;
    std::vector<std::vector<Interval>> registers;
    for (std::size_t lane = 0; lane < used; ++lane) {
      load(one, boxes[lane]);
      one.forward();
      for (std::uint32_t r = 0; r < program.registers(); ++r) {
        EXPECT_EQ(many.get(r, lane), one.get(r));
        EXPECT_EQ(many.defined(r, lane), one.defined(r));
      }
      alive.push_back(one.backward(kTrue));
      registers.emplace_back();
      for (std::uint32_t r = 0; r < program.registers(); ++r) registers.back().push_back(one.get(r));
    }
    const bool all_alive = std::all_of(alive.begin(), alive.end(), [](bool yes) { return yes; });
    EXPECT_EQ(many.backward(kTrue, 0, used), all_alive);
    if (!all_alive) {
      ASSERT_LT(many.failed_lane(), used);
      EXPECT_FALSE(alive[many.failed_lane()]) << "the lane that failed fails alone";
    }
    for (std::size_t lane = 0; all_alive && lane < used; ++lane) {
      for (std::uint32_t r = 0; r < program.registers(); ++r)
        EXPECT_EQ(many.get(r, lane), registers[lane][r]);
    }
  });
}

TEST(Program, CertaintyNeedsDefinedness) {
  System s(1);
  const Expr x = s.leaves[0];
  EXPECT_EQ(truth_of(sqrt(x) < 3.0, Interval(-1, 4)), kEither) << "sqrt is not defined on all of [-1, 4]";
  EXPECT_EQ(truth_of(sqrt(x) < 3.0, Interval(0, 4)), kTrue);
  EXPECT_EQ(truth_of(sqrt(x) < 3.0, Interval(-2, -1)), kFalse) << "false where undefined";
  EXPECT_EQ(truth_of(!(sqrt(x) < 3.0), Interval(-2, -1)), kTrue);
  EXPECT_EQ(truth_of(!(sqrt(x) < 3.0), Interval(-1, 4)), kEither);
  EXPECT_EQ(truth_of(1.0 / x != 0.0, Interval(-1, 1)), kEither);
  EXPECT_EQ(truth_of(1.0 / x == 1.0 / x, Interval(0)), kFalse);
}

TEST(Program, TheNegationHoldsWhereATermIsUndefined) {
  System s(1);
  const Expr x = s.leaves[0];
  EXPECT_EQ(contracted(sqrt(x) < 3.0, Interval(-4, 20)), Interval(0, 9));
  EXPECT_EQ(contracted(!(sqrt(x) < 3.0), Interval(-4, 20)), Interval(-4, 20))
      << "it holds on [-4, 0) and [9, 20]";
  EXPECT_EQ(contracted(!(sqrt(x) < 3.0), Interval(0, 20)), Interval(9, 20));
  EXPECT_EQ(contracted(sqrt(x) < 3.0, Interval(-4, 20), kFalse), Interval(-4, 20));
}

TEST(Program, AnUndefinedBranchOfOrDoesNotCut) {
  System s(1);
  const Expr x = s.leaves[0];
  const Expr either = (sqrt(x) < 2.0) || (x == -1.0);
  EXPECT_TRUE(contracted(either, Interval(-1, 10)).contains(-1));
  EXPECT_EQ(contracted(either, Interval(-1)), Interval(-1));
  EXPECT_TRUE(contracted((1.0 / x > 2.0) || (x == 0.0), Interval(0, 1)).contains(0));
  EXPECT_EQ(truth_of((sqrt(x) < 3.0) || (x < 0.0), Interval(-1)), kTrue);
}

TEST(Program, AnUndefinedBranchThatIsNotTakenDoesNotMatter) {
  System s(1);
  const Expr x = s.leaves[0];
  const Expr guarded = if_then_else(x < 0.0, -x, sqrt(x));
  EXPECT_EQ(truth_of(guarded <= 1.0, Interval(-1, -0.5)), kTrue);
  EXPECT_EQ(truth_of(guarded <= 1.0, Interval(0.5, 1)), kTrue);
  EXPECT_EQ(truth_of(guarded <= 1.0, Interval(-1, 1)), kEither)
      << "undecided: sqrt is not defined on all of it";
  EXPECT_TRUE(leq(Interval(-1, 1), contracted(guarded <= 1.0, Interval(-5, 5))));
  EXPECT_EQ(contracted(guarded <= 1.0, Interval(-5, -0.5)), Interval(-1, -0.5));
  EXPECT_EQ(contracted(guarded <= 1.0, Interval(0, 5)), Interval(0, 1));
}

TEST(Program, AConstantIsOneUnknownWhereverItStands) {
  System s(1);
  const Expr x = s.leaves[0], k{s.dag, s.dag.constant(Interval(1, 2))};
  EXPECT_EQ(contracted(x == k, Interval(0, 5)), Interval(1, 2));
  EXPECT_EQ(contracted(x == k * k, Interval(0, 5)), Interval(1, 4));
  EXPECT_EQ(contracted(x == k, Interval(0, 5)), Interval(1, 2)) << "a constant is not contracted";
}

}  // namespace
}  // namespace hcsp
