// SPDX-License-Identifier: Apache-2.0
// Subpavings of random relations, over partial functions and with quantifiers: no point of an inside box
// fails, no point of an outside box belongs.
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/problem.h"
#include "tests/soundness/random_case.h"

namespace hcsp::soundness {

using slam_simulator::Random;

namespace {

SearchOptions coarse() {
  SearchOptions options;
  options.precision = 0.06;
  options.time_limit = 0.05;
  return options;
}

const Interval kSide(-2.0, 2.0);

// f(is_inside, point) of random points of some boxes, their corners among them.
template <class F>
void for_points_of(Random& random, const std::vector<Interval>& boxes, bool is_inside, F f) {
  constexpr std::size_t kMost = 60;
  const std::size_t count = boxes.size() / 2;
  for (std::size_t k = 0; k < std::min(count, kMost); ++k) {
    const auto box = static_cast<std::size_t>(random.integer(0, static_cast<int>(count) - 1));
    std::array<double, 2> point;
    for (std::size_t v = 0; v < 2; ++v) {
      const Interval& side = boxes[2 * box + v];
      const int at = random.integer(0, 2);
      point[v] = at == 0   ? side.lo()
                 : at == 1 ? side.hi()
                           : std::clamp(random.in(side.lo(), side.hi()), side.lo(), side.hi());
    }
    f(is_inside, point);
  }
}

}  // namespace

TEST(Paving, OfRandomRelations) {
  int decided = 0;
  for (int seed = 1; seed <= instances(1200); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 900000);
    Problem problem("paving");
    const auto x = problem.vector("x", Box{kSide, kSide});
    RandomRelations make(static_cast<std::uint64_t>(seed) + 31, problem(x), {});
    Relation relation = random.chance(0.3) ? count(random.integer(1, 3),
                                                   {make.relation(1), make.relation(2), make.relation(1)})
                                           : make.relation(3);
    if (random.chance(0.3)) relation = !relation;
    problem.constrain("c", relation.expression);
    const Result result = problem.pave(problem(x), coarse());
    const auto check = [&](bool is_inside, const std::array<double, 2>& point) {
      const Truth truth = relation.at({{point[0], point[1]}, {}});
      ASSERT_FALSE(truth == (is_inside ? Truth::no : Truth::yes)) << point[0] << ", " << point[1];
      ++decided;
    };
    for_points_of(random, result.paving->inside, true, check);
    for_points_of(random, result.paving->outside, false, check);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(decided, instances(5000));
}

// Where for every value of a parameter, or for some, a random relation holds.
TEST(Paving, OfRandomRelationsWithQuantifiers) {
  int decided = 0;
  for (int seed = 1; seed <= instances(400); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 950000);
    Problem problem("quantified");
    const auto x = problem.vector("x", Box{kSide, kSide});
    const bool every = random.chance(0.5), negated = random.chance(0.3);
    const Interval values(-1.0, 1.0);
    std::optional<Relation> relation;
    const auto body = [&](Expr p) {
      RandomRelations make(static_cast<std::uint64_t>(seed) + 13, problem(x), {p, p});
      relation = make.relation(2);
      return relation->expression;
    };
    const Expr quantified =
        every ? problem.for_every("p", values, body) : problem.for_some("p", values, body);
    problem.constrain("c", negated ? !quantified : quantified);
    const Result result = problem.pave(problem(x), coarse());
    const auto check = [&](bool is_inside, const std::array<double, 2>& point) {
      const bool holds = is_inside != negated;
      if (holds != every) return;  // one value tells nothing
      for (int k = 0; k < 8; ++k) {
        const double p = random.in(values.lo(), values.hi());
        const Truth truth = relation->at({{point[0], point[1]}, {p, p}});
        ASSERT_FALSE(truth == (holds ? Truth::no : Truth::yes)) << point[0] << ", " << point[1] << ", " << p;
        ++decided;
      }
    };
    for_points_of(random, result.paving->inside, true, check);
    for_points_of(random, result.paving->outside, false, check);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(decided, instances(2000));
}

}  // namespace hcsp::soundness
