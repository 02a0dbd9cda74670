// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/derivative.h"

#include <gtest/gtest.h>

#include "tests/support/oracle.h"

namespace hcsp {
namespace {

using oracle::Dice;
using oracle::dyadic;
using oracle::expect_below;
using oracle::expect_same;
using oracle::for_seeds;
using oracle::solve;

// A continuous function, linear between instants that are finer than the time line: all its values at
// multiples of 1/64 are exact doubles.
struct Polyline {
  std::vector<double> slopes;  // by sixteenths of a second
  std::vector<double> values;
  Polyline(Dice& dice, int sixteenths) : values{dyadic(dice, -4, 4)} {
    for (int i = 0; i < sixteenths; ++i) {
      slopes.push_back(dyadic(dice, -2, 2));
      values.push_back(values.back() + slopes.back() / 16);
    }
  }
  [[nodiscard]] double at(double t) const {
    const auto piece = std::min(static_cast<std::size_t>(t * 16), slopes.size() - 1);
    return values[piece] + slopes[piece] * (t - static_cast<double>(piece) / 16);
  }
  [[nodiscard]] Interval slopes_within(const Interval& span) const {
    Interval hull = Interval::empty();
    for (auto i = static_cast<std::size_t>(span.lo() * 16); static_cast<double>(i) / 16 < span.hi(); ++i) {
      hull = join(hull, Interval(slopes[i]));
    }
    return hull;
  }
};

struct Case {
  std::shared_ptr<const TimeLine> line;
  std::vector<Polyline> truth;  // by component
  Tube v, x;
};

Case random_case(Dice& dice, std::size_t dim) {
  std::vector<double> instants{0.0};
  while (instants.back() < 4) instants.push_back(instants.back() + (1 + dice.below(8)) / 16.0);
  const auto line = std::make_shared<const TimeLine>(instants);
  Case made{line, {}, Tube(line, dim), Tube(line, dim)};
  for (std::size_t c = 0; c < dim; ++c) {
    made.truth.emplace_back(dice, 16 * 6);
    for (std::size_t k = 0; k < line->slices(); ++k) {
      const Interval slopes = made.truth[c].slopes_within(line->span(2 * k + 1));
      if (dice.below(10) != 0)
        made.v.set(c, 2 * k + 1, slopes + Interval(-dyadic(dice, 0, 0.5), dyadic(dice, 0, 0.5)));
    }
    for (std::size_t i = 0; i <= line->slices(); ++i) {
      if (dice.below(4) != 0) continue;
      const double value = made.truth[c].at(instants[i]);
      made.x.set(c, 2 * i, Interval(value - dyadic(dice, 0, 0.25), value + dyadic(dice, 0, 0.25)));
    }
  }
  return made;
}

oracle::Build posted(const Case& made) {
  return [&made](Problem& problem) {
    problem.set_time_line(*made.line);
    const auto v = problem.tube("v", made.v), x = problem.tube("x", made.x);
    problem.constrain_derivative("der", x, problem(v));
  };
}

TEST(DerivativeContractor, NeverLosesTheTruth) {
  for_seeds(150, [](Dice& dice) {
    const Case made = random_case(dice, 2);
    const Result result = solve(posted(made));
    ASSERT_EQ(result.status, Status::contracted);
    const Tube& x = std::get<Tube>(result["x"]);
    for (std::size_t item = 0; item < x.items(); ++item) {
      const Interval span = made.line->span(item);
      for (double t = span.lo(); t <= span.hi(); t += 1.0 / 64) {
        for (std::size_t c = 0; c < 2; ++c)
          EXPECT_TRUE(x.at(c, item).contains(made.truth[c].at(t))) << "at " << t;
      }
    }
    EXPECT_TRUE(leq(x, made.x)) << "contractance";
  });
}

TEST(DerivativeContractor, IsIsotoneAndIdempotent) {
  for_seeds(150, [](Dice& dice) {
    const Case made = random_case(dice, 1);
    Case smaller = made;
    for (std::size_t item = 0; item < made.x.items(); ++item) {
      smaller.x.set(0, item, dice.within(made.x.at(0, item)));
      if (item % 2 == 1) smaller.v.set(0, item, dice.within(made.v.at(0, item)));
    }
    const Result result = solve(posted(made));
    expect_below(solve(posted(smaller)), result, "a smaller box");
    Case again = made;
    again.x = std::get<Tube>(result["x"]);
    expect_same(solve(posted(again)), result, "again");
  });
}

// The last bits count: bounds that differ by an ulp must not turn the order around.
// In the gates; a slope narrower by an ulp may give a slice that is wider by a rounding error of the peak.
TEST(DerivativeContractor, IsIsotoneInItsGatesToTheLastBit) {
  for_seeds(3000, [](Dice& dice) {
    const auto line = std::make_shared<const TimeLine>(std::vector{0.0, dice.uniform(0.01, 2)});
    Case made{line, {}, Tube(line, 1), Tube(line, 1)};
    for (const std::size_t gate : {0U, 2U}) {
      const double middle = dice.uniform(-1, 1);
      made.x.set(0, gate, Interval(middle - dice.uniform(0, 1), middle + dice.uniform(0, 1)));
    }
    made.v.set(0, 1, Interval(-dice.uniform(0, 2), dice.uniform(0, 2)));
    Case smaller = made;
    const auto shave = [&](const Interval& a) {
      const double lo = dice.below(2) == 0 ? std::nextafter(a.lo(), kInfinity) : a.lo();
      return Interval(lo, dice.below(2) == 0 ? std::nextafter(a.hi(), -kInfinity) : a.hi());
    };
    for (const std::size_t gate : {0U, 2U}) {
      if (dice.below(2) == 0) smaller.x.set(0, gate, shave(made.x.at(0, gate)));
    }
    expect_below(solve(posted(smaller)), solve(posted(made)), "a box smaller by an ulp");
  });
}

// With one constant bound of the slope the best bounds are known: the gates are those of every pair, a
// slice's upper bound is where the line up from its start meets the line up, backward, from its end.
TEST(DerivativeContractor, IsAsTightAsCanBe) {
  for_seeds(150, [](Dice& dice) {
    Case made = random_case(dice, 1);
    const Interval v(-2 - dyadic(dice, 0, 1), 2 + dyadic(dice, 0, 1));
    for (std::size_t k = 0; k < made.line->slices(); ++k) made.v.set(0, 2 * k + 1, v);
    const Result result = solve(posted(made));
    const Tube& x = std::get<Tube>(result["x"]);
    const std::vector<double>& t = made.line->instants();
    for (std::size_t i = 0; i < t.size(); ++i) {
      Interval best;
      for (std::size_t j = 0; j < t.size(); ++j) {
        const double dt = std::abs(t[i] - t[j]);
        const Interval slope = i >= j ? v : -v;
        best = meet(best, made.x.gate(0, j) + slope * Interval(dt));
      }
      EXPECT_TRUE(leq(best, x.gate(0, i)) || x.gate(0, i) == best);
      if (best.is_bounded()) {
        EXPECT_NEAR(x.gate(0, i).lo(), best.lo(), 1e-12);
        EXPECT_NEAR(x.gate(0, i).hi(), best.hi(), 1e-12);
      }
    }
    const auto crossing = [](double x0, double x1, double rise, double fall, double dt) {
      const double at = std::clamp((x1 - x0 + fall * dt) / (rise + fall), 0.0, dt);
      return std::min(x0 + rise * at, x1 + fall * (dt - at));
    };
    for (std::size_t k = 0; k + 1 < t.size(); ++k) {
      const Interval a = x.gate(0, k), b = x.gate(0, k + 1), slice = x.slice(0, k);
      if (!a.is_bounded() || !b.is_bounded()) continue;
      const double dt = t[k + 1] - t[k];
      EXPECT_NEAR(slice.hi(), crossing(a.hi(), b.hi(), v.hi(), -v.lo(), dt), 1e-12);
      EXPECT_NEAR(slice.lo(), -crossing(-a.lo(), -b.lo(), -v.lo(), v.hi(), dt), 1e-12);
    }
  });
}

Result solve_line(const std::function<void(Problem&, TubeVariable, TubeVariable)>& state, const Interval& v) {
  Problem problem("der");
  problem.set_time_line(TimeLine({0.0, 1.0, 2.0, 3.0}));
  Tube slope(problem.time_line(), 1);
  for (std::size_t item = 0; item < slope.items(); ++item) slope.set(0, item, v);
  const auto x = problem.tube("x", 1), u = problem.tube("u", slope);
  state(problem, x, u);
  return problem.propagate();
}

TEST(DerivativeContractor, WorksBackwardInTime) {
  const Result result = solve_line(
      [](Problem& p, TubeVariable x, TubeVariable u) {
        p.constrain_derivative("der", x, p(u));
        p.constrain("end", p.at(x, 3.0)[0] == 10.0);
      },
      {1, 2});
  const Tube& x = std::get<Tube>(result["x"]);
  EXPECT_EQ(x.gate(0, 0), Interval(4, 7));
  EXPECT_EQ(x.gate(0, 2), Interval(8, 9));
  EXPECT_EQ(x.slice(0, 2), Interval(8, 10));
}

TEST(DerivativeContractor, MakesGatesAndSlicesAgree) {
  Tube known(std::make_shared<const TimeLine>(std::vector{0.0, 1.0, 2.0}), 1);
  known.set(0, 1, Interval(0, 1));
  known.set(0, 3, Interval(1, 2));
  for (const bool continuous : {false, true}) {
    Problem problem("der");
    problem.set_time_line(known.line());
    const auto x = problem.tube("x", known);
    const auto v = problem.tube("v", 1);
    if (continuous) problem.constrain_derivative("der", x, problem(v));
    const Tube tube = std::get<Tube>(problem.propagate()["x"]);
    EXPECT_EQ(tube.gate(0, 1), continuous ? Interval(1) : Interval::entire());
    EXPECT_EQ(tube.gate(0, 0), continuous ? Interval(0, 1) : Interval::entire());
    EXPECT_EQ(tube.slice(0, 0), Interval(0, 1));
  }
}

TEST(DerivativeContractor, AcceptsAFunctionWithoutTime) {
  Problem problem("der");
  problem.set_time_line(TimeLine({0.0, 1.0, 2.0}));
  const auto x = problem.tube("x", 1);
  const auto k = problem.real("k", {1, 3});
  problem.constrain_derivative("der", x, {2.0 * problem(k)});
  problem.constrain("start", problem.at(x, 0.0)[0] == 0.0);
  problem.constrain("k", problem(k) <= 2.0);
  const Tube tube = std::get<Tube>(problem.propagate()["x"]);
  EXPECT_EQ(tube.gate(0, 2), Interval(4, 8));
}

TEST(DerivativeContractor, FollowsAFunctionOfXItself) {
  Problem problem("der");
  problem.set_time_line(TimeLine::grid(0, 1, 0.125));
  Tube domain(problem.time_line(), 1);
  for (std::size_t item = 0; item < domain.items(); ++item) domain.set(0, item, Interval(0, 1));
  const auto x = problem.tube("x", domain);
  problem.constrain_derivative("decay", x, {-problem(x)[0]});
  problem.constrain("start", problem.at(x, 0.0)[0] == 1.0);
  const Tube tube = std::get<Tube>(problem.propagate()["x"]);
  EXPECT_TRUE(tube.gate(0, 8).contains(std::exp(-1.0)));
  EXPECT_LT(tube.gate(0, 8).width(), 0.5);
}

TEST(DerivativeContractor, TellsWhenThereIsNoFunction) {
  const Result result = solve_line(
      [](Problem& p, TubeVariable x, TubeVariable u) {
        p.constrain_derivative("der", x, p(u));
        p.constrain("start", p.at(x, 0.0)[0] == 0.0);
        p.constrain("end", p.at(x, 3.0)[0] == 10.0);
      },
      {-1, 1});
  ASSERT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.explanation->constraint, "der");
  EXPECT_EQ(result.explanation->variable, "x");
  EXPECT_TRUE(result.explanation->time.has_value());
}

}  // namespace
}  // namespace hcsp
