// SPDX-License-Identifier: Apache-2.0
// Random polynomials of degree 1 to 3 on phases under random bounds: whether "for every t" holds, decided by
// a compiled problem, against the values at gates and at extrema in quadruple precision; and the tube that
// comes back against values at many instants. HCSP_FULL=1 takes a hundred times as many.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "solver/online/compiled_problem.h"
#include "tests/support/oracle.h"

namespace hcsp {
namespace {

__extension__ using Real = __float128;
using Coefficients = std::array<Real, 4>;  // of s^k/k!
using Numbers = std::vector<double>;

Real root(Real x) {
  if (x <= 0) return 0;
  Real y = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 3; ++i) y = (y + x / y) / 2;
  return y;
}

Real at(const Coefficients& c, Real s) { return c[0] + s * (c[1] + s * (c[2] / 2 + s * c[3] / 6)); }

// By its values at the ends, and where its slope is 0.
Real greatest(const Coefficients& c, Real duration) {
  Real most = std::max(at(c, 0), at(c, duration));
  const auto look_at = [&](Real s) {
    if (s > 0 && s < duration) most = std::max(most, at(c, s));
  };
  const Real discriminant = c[2] * c[2] - 2 * c[1] * c[3];
  if (c[3] == 0) {
    if (c[2] != 0) look_at(-c[1] / c[2]);
  } else if (discriminant >= 0) {
    look_at((-c[2] - root(discriminant)) / c[3]);
    look_at((-c[2] + root(discriminant)) / c[3]);
  }
  return most;
}

// What the numbers of a motion make of it: x' = v, v' = a, a' = j for degree 3; y' = m.
struct Motion {
  Numbers durations, jerks, slopes;
  double x0, v0, a0, y0;

  [[nodiscard]] std::vector<Coefficients> x(int degree) const {
    std::vector<Coefficients> all;
    Real x = x0, v = v0, a = a0;
    for (std::size_t i = 0; i < durations.size(); ++i) {
      const Real j = jerks[i], s = durations[i];
      const Coefficients own = degree == 1   ? Coefficients{x, j, 0, 0}
                               : degree == 2 ? Coefficients{x, v, j, 0}
                                             : Coefficients{x, v, a, j};
      all.push_back(own);
      x = at(own, s);
      v = at({own[1], own[2], own[3], 0}, s);
      a = at({own[2], own[3], 0, 0}, s);
    }
    return all;
  }
  [[nodiscard]] std::vector<Coefficients> y() const {
    std::vector<Coefficients> all;
    Real y = y0;
    for (std::size_t i = 0; i < durations.size(); ++i) {
      all.push_back({y, slopes[i], 0, 0});
      y += slopes[i] * static_cast<Real>(durations[i]);
    }
    return all;
  }
};

// x <= y, x < y, y <= x or y < x, or that this is not so, during phases.
struct Asked {
  int degree;
  bool strict, turned, negated;
  std::size_t phases, from, to;

  explicit Asked(oracle::Dice& dice)
      : degree(1 + dice.below(3)),
        strict(dice.below(2) == 0),
        turned(dice.below(2) == 0),
        negated(dice.below(3) == 0),
        phases(static_cast<std::size_t>(1 + dice.below(4))),
        from(0),
        to(phases) {
    if (dice.below(2) == 0) from = static_cast<std::size_t>(dice.below(static_cast<int>(phases)));
    if (dice.below(2) == 0) to = from + 1;
  }

  // The greatest value of the lesser side minus the other: the relation holds where it is negative.
  [[nodiscard]] Real greatest_difference(const Motion& motion) const {
    const auto x = motion.x(degree), y = motion.y();
    Real most = -1e300;
    for (std::size_t i = from; i < to; ++i) {
      Coefficients d{};
      for (std::size_t k = 0; k < d.size(); ++k) d[k] = turned ? y[i][k] - x[i][k] : x[i][k] - y[i][k];
      most = std::max(most, greatest(d, motion.durations[i]));
    }
    return most;
  }

  CompiledProblem compiled() const {
    Problem problem("asked");
    const auto box = [&] { return Box(static_cast<Eigen::Index>(phases)); };
    const auto numbers = [&](const char* name) {
      Box value = box();
      for (Eigen::Index i = 0; i < value.dim(); ++i) value[i] = Interval(1.0);
      return problem(problem.parameter_vector(name, value));
    };
    const auto number = [&](const char* name) { return problem(problem.parameter(name, Interval(0.0))); };
    const VectorExpr durations = numbers("tau"), jerks = numbers("j"), slopes = numbers("m");
    const std::vector starts{number("x0"), number("v0"), number("a0")};
    problem.set_phases(problem(problem.real("T")), durations);
    const auto held = [&](const VectorExpr& values) {
      std::vector<VectorExpr> all;
      for (const Expr& value : values) all.push_back({value});
      return problem(problem.hold(all))[0];
    };
    Expr slope = held(jerks);
    TubeVariable x{};
    for (int k = degree - 1; k >= 0; --k) {
      x = problem.tube(k == 0 ? "x" : fmt::format("x{}", k), 1);
      problem.constrain_derivative("motion", x, {slope});
      problem.constrain("start", problem.at(x, 0.0)[0] == starts[static_cast<std::size_t>(k)]);
      slope = problem(x)[0];
    }
    const TubeVariable y = problem.tube("y", 1);
    problem.constrain_derivative("motion", y, {held(slopes)});
    problem.constrain("start", problem.at(y, 0.0)[0] == number("y0"));
    const Expr a = problem(turned ? y : x)[0], b = problem(turned ? x : y)[0];
    const Expr relation = strict ? a < b : a <= b;
    problem.during_phases(from, to, [&] { problem.constrain("asked", negated ? !relation : relation); });
    return compile(problem, {});
  }
};

// Numbers of which many meet exactly.
Motion random_motion(oracle::Dice& dice, std::size_t phases) {
  const auto number = [&] { return dice.below(4) == 0 ? 0.0 : (dice.below(17) - 8) / 4.0; };
  const auto numbers = [&] {
    Numbers all;
    for (std::size_t i = 0; i < phases; ++i) all.push_back(number());
    return all;
  };
  Motion motion{{}, numbers(), numbers(), number(), number(), number(), number()};
  if (dice.below(2) == 0) motion.slopes.assign(phases, 0.0);
  for (std::size_t i = 0; i < phases; ++i)
    motion.durations.push_back(dice.below(5) == 0 ? 0.0 : dice.below(9) / 4.0);
  return motion;
}

void give(CompiledProblem& compiled, const Motion& motion) {
  const auto set = [&](const char* name, const Numbers& values) {
    ASSERT_TRUE(compiled.set(compiled.parameter(name), std::span<const double>(values)));
  };
  set("tau", motion.durations);
  set("j", motion.jerks);
  set("m", motion.slopes);
  for (const auto& [name, value] :
       {std::pair("x0", motion.x0), {"v0", motion.v0}, {"a0", motion.a0}, {"y0", motion.y0}})
    ASSERT_TRUE(compiled.set(compiled.parameter(name), value));
}

void expect_within(Real value, const Interval& enclosure) {
  EXPECT_GE(static_cast<double>(value - static_cast<Real>(enclosure.lo())), -1e-25);
  EXPECT_GE(static_cast<double>(static_cast<Real>(enclosure.hi()) - value), -1e-25);
}

void check_tube(const PolynomialTube& tube, const std::vector<Coefficients>& pieces,
                const Numbers& durations) {
  Real begin = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    expect_within(at(pieces[i], 0), tube.gate(0, i));
    for (int k = 0; k <= 16; ++k) {
      const double s = durations[i] * k / 16;
      expect_within(at(pieces[i], s), tube.slice(0, i));
      expect_within(at(pieces[i], s), tube.at(0, Interval(static_cast<double>(begin) + s)));
    }
    begin += durations[i];
  }
}

TEST(ForAllTimeRandom, IsWhatItIsAtGatesAndExtrema) {
  const int problems = std::getenv("HCSP_FULL") != nullptr ? 20000 : 200;
  int decided = 0, all = 0, ties = 0;
  oracle::for_seeds(problems, [&](oracle::Dice& dice) {
    const Asked asked(dice);
    CompiledProblem compiled = asked.compiled();
    for (int draw = 0; draw < 20; ++draw) {
      Motion motion = random_motion(dice, asked.phases);
      const double before = static_cast<double>(asked.greatest_difference(motion));
      // Often the bound is moved next to the greatest value, or onto it.
      if (dice.below(2) == 0)
        motion.y0 += (asked.turned ? -1.0 : 1.0) * (before + (dice.below(3) - 1) * 1e-6);
      give(compiled, motion);
      const Real most = asked.greatest_difference(motion);
      constexpr double kTie = 1e-28;
      const bool is_tie = most < kTie && most > -kTie;
      const bool holds = (is_tie ? !asked.strict : most < 0) != asked.negated;
      const OnlineStatus status = compiled.solve();
      ++all;
      ties += is_tie ? 1 : 0;
      if (status == OnlineStatus::solved) {
        EXPECT_TRUE(holds) << static_cast<double>(most);
        check_tube(compiled.value(compiled.tube("x")), motion.x(asked.degree), motion.durations);
      } else if (status == OnlineStatus::infeasible) {
        EXPECT_FALSE(holds) << static_cast<double>(most);
      } else {
        EXPECT_LT(std::abs(static_cast<double>(most)), 1e-9) << "degree " << asked.degree;
      }
      decided += status != OnlineStatus::undecided ? 1 : 0;
    }
  });
  fmt::print("{} of {} decided, {} ties\n", decided, all, ties);
}

}  // namespace
}  // namespace hcsp
