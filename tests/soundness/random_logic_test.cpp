// SPDX-License-Identifier: Apache-2.0
// Alternatives, quantifiers over time and the algebra of sets on random relations with a known solution
// inside: it must still be inside afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/problem.h"
#include "tests/soundness/random_case.h"

namespace hcsp::soundness {

using slam_simulator::Random;

namespace {

// A motion that is constant over each item, the tube around it, and the truth of relations of both.
struct Motion {
  std::vector<std::array<double, 2>> at;  // by item

  Motion(Random& random, Tube& domain) {
    for (std::size_t item = 0; item < domain.items(); ++item) {
      at.push_back({some_number(random), some_number(random)});
      for (std::size_t c = 0; c < 2; ++c) domain.set(c, item, around(random, at.back()[c]));
    }
  }
  [[nodiscard]] Truth always(const Relation& relation, const std::array<double, 2>& p) const {
    Truth all = Truth::yes;
    for (const auto& x : at) all = all && relation.at({{x[0], x[1]}, {p[0], p[1]}});
    return all;
  }
};

}  // namespace

// At least so many of some relations, each at every instant, at some instant, or of a vector alone.
TEST(RandomLogic, AlternativesOverTime) {
  int tried = 0;
  for (int seed = 1; seed <= instances(1500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 300000);
    Problem problem("alternatives");
    problem.set_time_line(TimeLine({0, 1, 2}));
    Tube domain(problem.time_line(), 2);
    const Motion motion(random, domain);
    const auto x = problem.tube("x", domain);
    const std::array<double, 2> s = {some_number(random), some_number(random)};
    const auto p = problem.vector("p", Box{around(random, s[0]), around(random, s[1])});
    RandomRelations make(static_cast<std::uint64_t>(seed), problem(x), problem(p));
    std::vector<std::function<void()>> alternatives;
    std::size_t hold = 0;
    const int count = random.integer(2, 4);
    for (int k = 0; k < count; ++k) {
      const Relation relation = make.relation(2);
      const bool sometime = random.chance(0.5);
      const Truth truth = sometime ? !motion.always(!relation, s) : motion.always(relation, s);
      hold += truth == Truth::yes ? 1 : 0;
      alternatives.emplace_back([&problem, relation, sometime] {
        if (sometime) {
          problem.constrain_sometime("some", relation.expression);
        } else {
          problem.constrain("all", relation.expression);
        }
      });
    }
    if (hold == 0) continue;
    ++tried;
    problem.constrain_at_least("choice", hold, alternatives);
    const Result result = propagate(problem);
    const Box& box = std::get<Box>(result["p"]);
    ASSERT_TRUE(box[0].contains(s[0]) && box[1].contains(s[1])) << to_string(box);
    const Tube& left = std::get<Tube>(result["x"]);
    for (std::size_t item = 0; item < left.items(); ++item) {
      ASSERT_TRUE(left.at(0, item).contains(motion.at[item][0]) &&
                  left.at(1, item).contains(motion.at[item][1]))
          << "item " << item;
    }
  }
  EXPECT_GT(tried, instances(500));
}

// A Boolean that is told to be the truth of a relation: it keeps the truth that a solution gives it.
TEST(RandomLogic, NoFalseEntailment) {
  int decided = 0;
  for (int seed = 1; seed <= instances(4000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 600000);
    const double s[2] = {some_number(random), some_number(random)};
    Problem problem("entailment");
    const auto x = problem.vector("x", Box{around(random, s[0]), around(random, s[1])});
    const auto b = problem.boolean("b");
    RandomRelations make(static_cast<std::uint64_t>(seed) + 5, problem(x), {});
    const Relation relation =
        random.chance(0.3)
            ? count(random.integer(1, 3), {make.relation(1), make.relation(2), make.relation(1)})
            : make.relation(3);
    const Truth truth = relation.at({{s[0], s[1]}, {}});
    if (truth == Truth::unsure) continue;
    const Expr is_b = problem(b);
    problem.constrain("c", (is_b && relation.expression) || (!is_b && !relation.expression));
    const Result result = propagate(problem);
    const Interval& left = std::get<Interval>(result["b"]);
    ASSERT_TRUE(left.contains(truth == Truth::yes ? 1.0 : 0.0)) << to_string(left);
    decided += left.is_point() ? 1 : 0;
  }
  EXPECT_GT(decided, instances(200));
}

// Sets that are zones of a vector, and what is made of them, also on a finer grid.
TEST(RandomLogic, SetAlgebra) {
  for (int seed = 1; seed <= instances(120); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 400000);
    const double s[2] = {some_number(random), some_number(random)};
    Problem problem("sets");
    const auto x = problem.vector("x", Box{around(random, s[0]), around(random, s[1])});
    const auto set_s = problem.set("S", 2, 0.5), set_t = problem.set("T", 2, 0.5),
               both = problem.set("B", 2, 0.5), odd = problem.set("O", 2, 0.5),
               fine = problem.set("F", 2, 0.125), part = problem.set("P", 2, 0.125);
    RandomRelations make(static_cast<std::uint64_t>(seed), problem(x), problem.point(2));
    const Relation frame = in_box(problem.point(2)),
                   zone_s = random.chance(0.7) ? frame && make.relation(2) : make.relation(2),
                   zone_t = make.relation(2), zone_f = frame && make.relation(2);
    problem.constrain_union("s", set_s, {2, zone_s.expression});
    problem.constrain_union("t", set_t, {2, zone_t.expression});
    problem.constrain_union("f", fine, {2, zone_f.expression});
    const bool not_s = random.chance(0.5), not_t = random.chance(0.5), not_both = random.chance(0.5);
    problem.constrain_intersection("both", {both.id, not_both}, {set_s.id, not_s}, {set_t.id, not_t});
    problem.constrain_symmetric_difference("odd", {odd.id}, {set_s.id, not_s}, {set_t.id});
    problem.constrain_intersection("part", {part.id}, {fine.id}, {problem.refined(set_s, fine).id, not_s});
    problem.constrain_subset("sub", {part.id}, {fine.id});
    const Result result = propagate(problem);
    const Box& left = std::get<Box>(result["x"]);
    ASSERT_TRUE(left[0].contains(s[0]) && left[1].contains(s[1])) << to_string(left);
    const auto in = [&](const Relation& zone, const Interval& a1, const Interval& a2) {
      return zone.at({{s[0], s[1]}, {a1, a2}});
    };
    const auto flipped = [](Truth truth, bool flip) { return flip ? !truth : truth; };
    using Point = const Interval&;
    const auto truth_s = [&](Point a, Point b) { return in(zone_s, a, b); };
    const auto truth_t = [&](Point a, Point b) { return in(zone_t, a, b); };
    expect_set(std::get<SetInterval>(result["S"]), random, truth_s);
    expect_set(std::get<SetInterval>(result["T"]), random, truth_t);
    expect_set(std::get<SetInterval>(result["B"]), random, [&](Point a, Point b) {
      return flipped(flipped(truth_s(a, b), not_s) && flipped(truth_t(a, b), not_t), not_both);
    });
    expect_set(std::get<SetInterval>(result["O"]), random, [&](Point a, Point b) {
      const Truth p = flipped(truth_s(a, b), not_s), q = truth_t(a, b);
      return !(!(p && !q) && !(!p && q));
    });
    expect_set(std::get<SetInterval>(result["P"]), random,
               [&](Point a, Point b) { return in(zone_f, a, b) && flipped(truth_s(a, b), not_s); });
    if (HasFailure()) return;
  }
}

// x of a moment ago, and of a moment to come: what either tube says of a motion holds of the other.
TEST(RandomLogic, Delays) {
  for (int seed = 1; seed <= instances(500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 500000);
    Problem problem("delay");
    std::vector<double> instants{0};
    while (instants.size() < 8)
      instants.push_back(instants.back() + (random.chance(0.5) ? 0.5 : random.in(0.1, 1)));
    problem.set_time_line(TimeLine(instants));
    const auto line = problem.time_line();
    Tube known(line, 2);
    const Motion motion(random, known);
    const double delay = random.chance(0.5) ? 0.5 * random.integer(-4, 4) : random.in(-2, 2);
    // Beside an instant it is that instant, by definition.
    const auto item_of = [&](double t) -> std::size_t {
      for (std::size_t k = 0; k < instants.size(); ++k) {
        if (std::abs(t - instants[k]) < 1e-14) return 2 * k;
      }
      for (std::size_t item = 0; item < line->items(); ++item) {
        const Interval span = line->span(item);
        if (item % 2 == 0 ? span.lo() == t : span.lo() < t && t < span.hi()) return item;
      }
      return line->items();
    };
    // The known tube is x, or else it is the delayed one.
    const bool of_x = random.chance(0.5);
    const auto x = of_x ? problem.tube("x", known) : problem.tube("x", 2);
    const VectorExpr earlier = problem.delayed(x, delay);
    const auto y = of_x ? problem.tube("y", 2) : problem.tube("y", known);
    problem.constrain("same", problem(y) == earlier);
    const Result result = propagate(problem);
    const Tube &known_then = std::get<Tube>(result[of_x ? "x" : "y"]),
               &made = std::get<Tube>(result[of_x ? "y" : "x"]);
    const double shift = of_x ? -delay : delay;
    for (std::size_t item = 0; item < line->items(); ++item) {
      ASSERT_TRUE(known_then.at(0, item).contains(motion.at[item][0])) << "item " << item;
      const Interval span = line->span(item);
      for (const double t : {span.lo() + 0.25 * span.width(), span.mid(), span.hi() - 0.125 * span.width()}) {
        const std::size_t from = item_of(t + shift);
        if (from == line->items()) continue;
        ASSERT_TRUE(made.at(1, item).contains(motion.at[from][1])) << t << " by " << shift;
      }
    }
  }
}

}  // namespace hcsp::soundness
