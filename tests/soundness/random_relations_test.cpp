// SPDX-License-Identifier: Apache-2.0
// Every contractor on random relations with a known solution inside: it must still be inside afterwards.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/soundness/random_case.h"

namespace hcsp::soundness {

using slam_simulator::Random;

// c(x): the solution stays.
TEST(RandomRelations, Relation) {
  int tried = 0;
  for (int seed = 1; seed <= instances(6000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const double s[2] = {some_number(random), some_number(random)};
    Problem problem("relation");
    const auto x = problem.vector("x", Box{around(random, s[0]), around(random, s[1])});
    RandomRelations make(static_cast<std::uint64_t>(seed) + 77, problem(x), {});
    Relation relation = make.relation(3);
    const Place place{{s[0], s[1]}, {}};
    Truth holds = relation.at(place);
    if (holds == Truth::no) relation = !relation, holds = Truth::yes;
    if (holds != Truth::yes) continue;
    ++tried;
    problem.constrain("c", relation.expression);
    // and an equation that holds there: some term equals what it is
    const Term term = make.term(3);
    if (const auto [value, defined] = term.at(place); defined == Truth::yes && value.is_bounded()) {
      problem.constrain("e", term.expression == problem.constant(value));
    }
    const Result result = propagate(problem);
    const Box& box = std::get<Box>(result["x"]);
    ASSERT_TRUE(box[0].contains(s[0]) && box[1].contains(s[1]))
        << to_string(box) << " for " << s[0] << ", " << s[1];
  }
  EXPECT_GT(tried, instances(4000));
}

// S == { a | c(x, a) }, T == { a | d(x, a) }, S and T disjoint: the sets of the solution x stay, and x stays.
TEST(RandomRelations, ZoneOfAVector) {
  for (int seed = 1; seed <= instances(1000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 100000);
    const double s[2] = {some_number(random), some_number(random)};
    Problem problem("zone");
    const auto x = problem.vector("x", Box{around(random, s[0]), around(random, s[1])});
    const double edge = random.chance(0.5) ? 0.5 : random.in(0.2, 0.7);
    const auto frame = random.chance(0.5) ? std::optional(Box{{-3, 3}, {-3, 3}}) : std::nullopt;
    const auto set_s = problem.set("S", 2, edge, frame), set_t = problem.set("T", 2, edge, frame);
    const VectorExpr a = problem.point(2);
    RandomRelations make(static_cast<std::uint64_t>(seed), problem(x), a);
    const Relation c = make.relation(2), box = in_box(a), zone_s = box && c,
                   zone_t = box && !c && make.relation(2);
    problem.constrain_union("s", set_s, {2, zone_s.expression});
    problem.constrain_union("t", set_t, {2, zone_t.expression});
    problem.constrain_disjoint("apart", set_s, set_t);
    const Result result = propagate(problem);
    const Box& left = std::get<Box>(result["x"]);
    ASSERT_TRUE(left[0].contains(s[0]) && left[1].contains(s[1]))
        << to_string(left) << " for " << s[0] << ", " << s[1];
    const auto at = [&](const Relation& zone) {
      return [&zone, &s](const Interval& a1, const Interval& a2) {
        return zone.at({{s[0], s[1]}, {a1, a2}});
      };
    };
    expect_set(std::get<SetInterval>(result["S"]), random, at(zone_s));
    expect_set(std::get<SetInterval>(result["T"]), random, at(zone_t));
    if (HasFailure()) return;
  }
}

// D == union over t of { a | c(x(t), a) }, and for every t { a | e(x(t), a) } meets M, with M and N disjoint
// and N a disc: a motion that satisfies all stays.
TEST(RandomRelations, ZonesOfATube) {
  int tried = 0;
  for (int seed = 1; seed <= instances(1000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed) + 200000);
    Problem problem("tube");
    problem.set_time_line(TimeLine({0, 1, 2, 3}));
    const auto line = problem.time_line();
    Tube domain(line, 2);
    std::vector<std::array<double, 2>> s(line->items());  // the motion: constant over each item
    for (std::size_t item = 0; item < line->items(); ++item) {
      for (std::size_t c = 0; c < 2; ++c) {
        s[item][c] = some_number(random);
        domain.set(c, item, around(random, s[item][c]));
      }
    }
    const auto x = problem.tube("x", domain);
    const double edge = random.chance(0.5) ? 0.5 : random.in(0.2, 0.7);
    const auto dug =
        problem.set("D", 2, edge, random.chance(0.5) ? std::optional(Box{{-3, 3}, {-3, 3}}) : std::nullopt);
    const auto map =
        problem.set("M", 2, edge, random.chance(0.7) ? std::optional(Box{{-4, 4}, {-4, 4}}) : std::nullopt);
    const auto disc = problem.set("N", 2, edge);
    const VectorExpr a = problem.point(2);
    RandomRelations make(static_cast<std::uint64_t>(seed), problem(x), a);
    const Relation zone = in_box(a) && make.relation(2), hit = make.relation(2);
    problem.constrain_union("dug", dug, {2, zone.expression});
    // Points of the map, one an item, that are hit for certain; the disc leaves them out.
    std::vector<std::array<double, 2>> points;
    for (std::size_t item = 0; item < line->items(); ++item) {
      for (int attempt = 0; attempt < 60; ++attempt) {
        const std::array<double, 2> p = {some_number(random), some_number(random)};
        if (hit.at({{s[item][0], s[item][1]}, {p[0], p[1]}}) != Truth::yes) continue;
        points.push_back(p);
        break;
      }
      if (points.size() != item + 1) break;
    }
    const bool meets = points.size() == line->items();
    const double centre[2] = {random.in(-3, 3), random.in(-3, 3)};
    if (meets) {
      ++tried;
      double radius = 3;
      for (const auto& p : points)
        radius = std::min(radius, 0.999 * std::hypot(p[0] - centre[0], p[1] - centre[1]));
      problem.constrain_union("disc", disc,
                              {2, norm(a - VectorExpr{problem.constant(centre[0]),
                                                      problem.constant(centre[1])}) < Interval(radius)});
      problem.constrain_disjoint("free", disc, map);
      problem.constrain_meets("hit", {2, hit.expression}, map);
    }
    const Result result = propagate(problem);
    const Tube& left = std::get<Tube>(result["x"]);
    for (std::size_t item = 0; item < line->items(); ++item) {
      ASSERT_TRUE(left.at(0, item).contains(s[item][0]) && left.at(1, item).contains(s[item][1]))
          << "item " << item;
    }
    expect_set(std::get<SetInterval>(result["D"]), random, [&](const Interval& a1, const Interval& a2) {
      Truth in = Truth::no;
      for (const auto& p : s) in = unite(in, zone.at({{p[0], p[1]}, {a1, a2}}));
      return in;
    });
    for (const auto& p : points) {
      ASSERT_TRUE(!meets || std::get<SetInterval>(result["M"]).at(p.data()) == CellState::unknown);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(tried, instances(100));
}

}  // namespace hcsp::soundness
