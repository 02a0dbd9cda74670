// SPDX-License-Identifier: Apache-2.0
// The search for all solutions on random systems built around a known one, and on systems that have none:
// what is known is in the answer, and nothing is certified that is not there. With HCSP_FULL=1, of more than
// 20,000 systems with a known solution; of more than 1,000 without one always.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/problem.h"
#include "tests/soundness/random_case.h"

namespace hcsp::soundness {

using slam_simulator::Random;

namespace {

SearchOptions a_moment() {
  SearchOptions options;
  options.precision = 0.01;
  options.time_limit = 0.05;
  return options;
}

bool holds(const std::vector<ResultVariable>& variables, const std::vector<double>& point) {
  const Box& box = std::get<Box>(variables.front().domain);
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (!box[static_cast<Eigen::Index>(i)].contains(point[i])) return false;
  }
  return true;
}

// A point and a box around it.
struct Known {
  std::vector<double> point;
  Box domain;

  Known(Random& random, int dim) : domain(dim) {
    for (int i = 0; i < dim; ++i) {
      point.push_back(some_number(random));
      domain[i] = around(random, point.back());
    }
  }
};

// Of two unknowns, or four: what random terms call x and a.
struct Unknowns {
  VectorVariable all;
  VectorExpr x, a;

  Unknowns(Problem& problem, const Known& known) : all(problem.vector("x", known.domain)) {
    for (std::size_t i = 0; i < all.dim; ++i) (i < 2 ? x : a).push_back(problem.component(all, i));
  }
};

Place place_of(const Known& known) {
  Place place;
  for (std::size_t i = 0; i < known.point.size(); ++i)
    (i < 2 ? place.x : place.a).emplace_back(known.point[i]);
  return place;
}

// A problem to be: a known point, unknowns around it, and terms and relations of them to come.
struct RandomSystem {
  Random random;
  int dim;
  Known known;
  Problem problem{"random"};
  Unknowns unknowns;
  RandomRelations make;
  Place place;

  RandomSystem(int seed, int first)
      : random(static_cast<std::uint64_t>(seed + first)),
        dim(random.chance(0.7) ? 2 : 4),
        known(random, dim),
        unknowns(problem, known),
        make(static_cast<std::uint64_t>(seed), unknowns.x, unknowns.a),
        place(place_of(known)) {}
};

}  // namespace

// Equations f(x) == c, c an enclosure of f at the known solution, with an inequality or a choice here and
// there; square systems, and ones with an equation too few or too many.
TEST(RandomSystems, KeepTheKnownSolution) {
  int tried = 0, certified = 0;
  for (int seed = 1; seed <= instances(1500); ++seed) {
    SCOPED_TRACE(seed);
    RandomSystem system(seed, 700000);
    auto& [random, dim, known, problem, unknowns, make, place] = system;
    bool is_true = true;
    const int equations = std::max(1, dim + (random.chance(0.3) ? random.integer(-1, 1) : 0));
    for (int e = 0; e < equations; ++e) {
      const Term term = make.term(random.integer(1, 3));
      const TermValue value = term.at(place);
      is_true = is_true && value.defined == Truth::yes && value.value.is_bounded();
      if (!is_true) break;
      const Expr line = problem.component(unknowns.all, static_cast<std::size_t>(e % dim)) * Interval(2.0);
      const Interval both = value.value + Interval(2.0 * known.point[static_cast<std::size_t>(e % dim)]);
      problem.constrain("f",
                        random.chance(0.5) ? term.expression == value.value : term.expression + line == both);
    }
    if (is_true && random.chance(0.4)) {
      const Relation relation = make.relation(2);
      const Truth truth = relation.at(place);
      is_true = truth != Truth::unsure;
      if (is_true) problem.constrain("c", truth == Truth::yes ? relation.expression : !relation.expression);
    }
    if (!is_true) continue;
    ++tried;
    const Result result = problem.solve_all(a_moment());
    const SolutionSet& search = *result.search;
    ASSERT_TRUE(
        std::any_of(search.solutions.begin(), search.solutions.end(),
                    [&](const Solution& solution) { return holds(solution.variables, known.point); }) ||
        std::any_of(search.unexplored.begin(), search.unexplored.end(),
                    [&](const auto& box) { return holds(box, known.point); }));
    const auto unique =
        std::count_if(search.solutions.begin(), search.solutions.end(), [&](const Solution& solution) {
          return solution.certificate == Certificate::unique && holds(solution.variables, known.point);
        });
    ASSERT_LE(unique, 1);
    certified += static_cast<int>(unique);
  }
  EXPECT_GT(tried, instances(1000));
  EXPECT_GT(certified, instances(60));
  RecordProperty("tried", tried);
  RecordProperty("certified", certified);
}

// An equation f^2 + e == 0, e > 0, among regular ones: nothing may be certified.
TEST(RandomSystems, CertifyNothingWhereThereIsNothing) {
  int tried = 0;
  for (int seed = 1; seed <= instances(1300); ++seed) {
    SCOPED_TRACE(seed);
    RandomSystem system(seed, 800000);
    auto& [random, dim, known, problem, unknowns, make, place] = system;
    bool is_true = true;
    for (int e = 0; e < dim && is_true; ++e) {
      const Term term = make.term(2);
      const TermValue value = term.at(place);
      is_true = value.defined == Truth::yes && value.value.is_bounded();
      if (!is_true) break;
      const double lift = e == 0 ? std::pow(10.0, -random.integer(0, 12)) : 0.0;
      const Expr f = term.expression - value.value;
      // Multiplied out, so that no single operation shows it.
      problem.constrain("f", e == 0 ? f * term.expression - value.value * f == Interval(-lift)
                                    : term.expression == value.value);
    }
    if (!is_true) continue;
    ++tried;
    const Result result = problem.solve_all(a_moment());
    for (const Solution& solution : result.search->solutions)
      ASSERT_EQ(solution.certificate, Certificate::none)
          << to_string(std::get<Box>(solution.variables[0].domain));
  }
  EXPECT_GT(tried, instances(1000));
  RecordProperty("tried", tried);
}

}  // namespace hcsp::soundness
