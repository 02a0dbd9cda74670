// SPDX-License-Identifier: Apache-2.0
// Oracle-driven tests of contractors, after Gecode's: the author gives a pointwise predicate and posts the
// constraint; the harness puts random boxes around known solutions and checks what every contractor promises.
// Containment is exact, without tolerance. A failing trial prints its seed and how to run it alone.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "solver/problem.h"
#include "tests/support/truth.h"

namespace hcsp::oracle {

/// Runs trial(dice) with the seeds 1, ..., count until one fails, or with --gtest_random_seed alone where it
/// is given.
template <class Trial>
void for_seeds(int count, const Trial& trial) {
  const int asked = ::testing::GTEST_FLAG(random_seed);
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  for (int seed = asked > 0 ? asked : 1; seed <= (asked > 0 ? asked : count); ++seed) {
    SCOPED_TRACE(::testing::Message()
                 << "seed " << seed << "; rerun with --gtest_filter=" << info->test_suite_name() << '.'
                 << info->name() << " --gtest_random_seed=" << seed);
    Dice dice(Dice::kSeed + static_cast<std::uint64_t>(seed));
    trial(dice);
    if (::testing::Test::HasFailure()) return;
  }
}

/// A multiple of 2^-places in [lo, hi]: sums, products and squares of a few are exact.
inline double dyadic(Dice& dice, double lo, double hi, int places = 3) {
  const double scale = std::ldexp(1.0, places);
  const int steps = static_cast<int>((hi - lo) * scale);
  return lo + dice.below(steps + 1) / scale;
}

/// A random interval around a point: tight, one-sided, wide or unbounded.
inline Interval around(Dice& dice, double x) {
  const auto reach = [&] {
    switch (dice.below(8)) {
      case 0:
        return 0.0;
      case 1:
        return kInfinity;
      default:
        return dyadic(dice, 0.0, dice.below(2) == 0 ? 0.5 : 6.0);
    }
  };
  const double below = reach(), above = reach();
  return Interval::raw(x - below, x + above);
}

/// What an interval evaluation can tell of a predicate at a point.
enum class Answer : std::uint8_t { no, unsure, yes };
using Point = std::vector<double>;

/// Builds a problem from scratch: solved twice it is posted twice, so that no state is carried over.
using Build = std::function<void(Problem&)>;

inline Result solve(const Build& build, Order order = Order::declared, std::uint64_t seed = 0) {
  Problem problem("test");
  build(problem);
  PropagationOptions options;
  options.order = order;
  options.seed = seed;
  options.explain = false;
  return problem.propagate(options);
}

/// Every variable of `a` has the same domain in `b`, bit for bit; empty problems are equal whatever is left
/// in them.
inline void expect_same(const Result& a, const Result& b, const std::string& what) {
  ASSERT_EQ(a.status, b.status) << what;
  if (a.status == Status::infeasible) return;
  for (std::size_t v = 0; v < a.variables.size(); ++v) {
    EXPECT_TRUE(a.variables[v].domain == b.variables[v].domain)
        << what << ": " << a.variables[v].name << " differs";
  }
}

/// Every domain of `a` is within that of `b`, bit for bit.
inline void expect_below(const Result& a, const Result& b, const std::string& what) {
  if (a.status == Status::infeasible) return;
  ASSERT_NE(b.status, Status::infeasible) << what;
  for (std::size_t v = 0; v < a.variables.size(); ++v) {
    const bool below = std::visit(
        [&](const auto& mine) {
          return leq(mine, std::get<std::decay_t<decltype(mine)>>(b.variables[v].domain));
        },
        a.variables[v].domain);
    EXPECT_TRUE(below) << what << ": " << a.variables[v].name << " is not below";
  }
}

/// The fixed point is the same, bit for bit, in every order of the contractors.
inline void expect_order_independent(const Build& build) {
  const Result declared = solve(build);
  expect_same(declared, solve(build, Order::reversed), "reversed");
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expect_same(declared, solve(build, Order::shuffled, seed), "shuffled");
}

/// A constraint between reals, as its author sees it.
struct ConstraintCase {
  std::size_t dim;
  /// The predicate at a point. `yes` and `no` must be true of the real numbers that the doubles are.
  std::function<Answer(const Point&)> holds;
  /// Posts the constraint, by one contractor or several.
  std::function<void(Problem&, const std::vector<RealVariable>&)> post;
  /// Where to look for solutions.
  std::function<Point(Dice&)> candidate;
};

inline Build build_on(const ConstraintCase& constraint, const Box& box) {
  return [&constraint, box](Problem& problem) {
    std::vector<RealVariable> variables;
    for (std::size_t i = 0; i < constraint.dim; ++i) {
      variables.push_back(problem.real("x" + std::to_string(i), box[static_cast<Eigen::Index>(i)]));
    }
    constraint.post(problem, variables);
  };
}

inline bool is_within(const Point& point, const Box& box) {
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (!box[static_cast<Eigen::Index>(i)].contains(point[i])) return false;
  }
  return true;
}

inline Box box_of(const Result& result) {
  Box box(static_cast<Eigen::Index>(result.variables.size()));
  for (std::size_t i = 0; i < result.variables.size(); ++i) {
    box[static_cast<Eigen::Index>(i)] = std::get<Interval>(result.variables[i].domain);
  }
  return box;
}

/// No known solution is lost, the box only shrinks, a smaller box gives a smaller result, and the order of
/// contractors does not show.
inline void check_constraint(const ConstraintCase& constraint, int trials = 200) {
  for_seeds(trials, [&](Dice& dice) {
    std::vector<Point> solutions;
    for (int tries = 0; tries < 400 && solutions.size() < 8; ++tries) {
      Point candidate = constraint.candidate(dice);
      if (constraint.holds(candidate) == Answer::yes) solutions.push_back(std::move(candidate));
    }
    const auto dim = static_cast<Eigen::Index>(constraint.dim);
    Box box(dim), smaller(dim);
    const Point centre = solutions.empty() ? constraint.candidate(dice) : solutions.front();
    for (Eigen::Index i = 0; i < dim; ++i) {
      box[i] = around(dice, centre[static_cast<std::size_t>(i)]);
      smaller[i] = dice.within(box[i]);
    }
    const Result result = solve(build_on(constraint, box));
    const Box contracted = box_of(result);
    for (const Point& solution : solutions) {
      if (!is_within(solution, box)) continue;
      ASSERT_EQ(result.status, Status::contracted) << "a solution was in " << to_string(box);
      EXPECT_TRUE(is_within(solution, contracted))
          << to_string(box) << " lost a solution: " << to_string(contracted);
    }
    EXPECT_TRUE(result.status == Status::infeasible || leq(contracted, box)) << "contractance";
    expect_below(solve(build_on(constraint, smaller)), result, "isotonicity");
    expect_order_independent(build_on(constraint, box));
  });
}

}  // namespace hcsp::oracle
