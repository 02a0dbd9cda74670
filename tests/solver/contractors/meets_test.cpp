// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/meets.h"

#include <gtest/gtest.h>

#include "tests/support/cells.h"
#include "tests/support/pointwise.h"

namespace hcsp {
namespace {

using oracle::Answer;
using oracle::Dice;
using oracle::expect_below;
using oracle::expect_same;
using oracle::for_seeds;
using oracle::NamedZone;

constexpr double kPrecision = 0.5;
constexpr std::int64_t kWorld = 9;

struct Instance {
  std::vector<Interval> domains;
  std::vector<std::array<double, 4>> discs;  // what is dug out of the map: center and radius
};

Instance random_instance(Dice& dice) {
  Instance made;
  for (int i = 0; i < 4; ++i) {
    const double middle = i == 3 ? oracle::dyadic(dice, 0.5, 3, 4) : oracle::dyadic(dice, -3, 3, 4);
    made.domains.emplace_back(middle - oracle::dyadic(dice, 0, 1, 4), middle + oracle::dyadic(dice, 0, 1, 4));
  }
  for (int k = dice.below(4); k > 0; --k) {
    made.discs.push_back({oracle::dyadic(dice, -3, 3), oracle::dyadic(dice, -3, 3),
                          oracle::dyadic(dice, -3, 3), oracle::dyadic(dice, 0.5, 2.5)});
  }
  return made;
}

// M, framed or not, without the discs: each a set D_k that equals its disc and is disjoint from M.
SetVariable post_map(Problem& p, const Instance& instance, std::size_t dim, bool framed) {
  std::optional<Box> frame;
  if (framed) frame.emplace(IntervalVector::Constant(static_cast<Eigen::Index>(dim), Interval(-3.75, 3.75)));
  const auto map = p.set("M", dim, kPrecision, frame);
  const VectorExpr a = p.point(dim);
  for (std::size_t k = 0; k < instance.discs.size(); ++k) {
    VectorExpr from;
    for (std::size_t c = 0; c < dim; ++c) from.push_back(a[c] - instance.discs[k][c]);
    const auto dug = p.set("D" + std::to_string(k), dim, kPrecision);
    p.constrain_union("dug" + std::to_string(k), dug, {dim, dot(from, from) < instance.discs[k][3]});
    p.constrain_disjoint("free" + std::to_string(k), dug, map);
  }
  return map;
}

oracle::Build posted(const NamedZone& zone, const Instance& instance, bool framed, bool fast) {
  return [&zone, &instance, framed, fast](Problem& p) {
    p.use_fast_paths(fast);
    std::vector<Expr> x;
    for (std::size_t i = 0; i < 4; ++i) x.push_back(p(p.real("x" + std::to_string(i), instance.domains[i])));
    const auto map = post_map(p, instance, zone.dim, framed);
    p.constrain_meets("meets", {zone.dim, zone.make(p.point(zone.dim), x)}, map);
  };
}

class MeetsOf : public ::testing::TestWithParam<NamedZone> {
 protected:
  const NamedZone zone = GetParam();
  [[nodiscard]] int trials(int count) const { return zone.dim == 3 ? count / 4 : count; }
};

// The fixed point by hand: the hull, over every cell of M+ one by one, of one HC4-revise; again until nothing
// moves.
TEST_P(MeetsOf, IsExactlyTheHullOverAllCells) {
  int contracted = 0;
  for_seeds(trials(60), [&](Dice& dice) {
    const Instance instance = random_instance(dice);
    const Result result = oracle::solve(posted(zone, instance, true, true));
    const auto& map = std::get<SetInterval>(result["M"]);
    ASSERT_FALSE(map.is_empty());
    Dag dag;
    std::vector<Expr> x;
    VectorExpr a;
    for (VariableId v = 0; v < 4; ++v) x.emplace_back(dag, dag.input({Input::Kind::real, v, 0, 0}));
    for (std::uint32_t c = 0; c < zone.dim; ++c)
      a.emplace_back(dag, dag.input({Input::Kind::point, 0, c, 0}));
    oracle::ZoneProbe probe(dag, zone.make(a, x).node());
    std::vector<CellIndex> cells;
    oracle::for_cells(zone.dim, kWorld, [&](const CellIndex& cell) {
      if (map.at_cell(cell) != CellState::outside) cells.push_back(cell);
    });
    std::vector<Interval> expected = instance.domains;
    bool empty = false;
    for (bool moved = true; moved && !empty;) {
      std::vector<Interval> hull(4, Interval::empty()), support;
      for (const CellIndex& cell : cells) {
        if (!probe.support(map.grid(), cell, expected, support)) continue;
        for (std::size_t i = 0; i < 4; ++i) hull[i] = join(hull[i], support[i]);
      }
      moved = hull != expected;
      expected = hull;
      empty = hull[0].is_empty();
    }
    ASSERT_EQ(result.status, empty ? Status::infeasible : Status::contracted);
    if (empty) return;
    contracted += expected == instance.domains ? 0 : 1;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(std::get<Interval>(result.variables[i].domain), expected[i]) << "x" << i;
    }
  });
  EXPECT_TRUE(contracted > 0 || ::testing::GTEST_FLAG(random_seed) > 0 || HasFailure());
}

TEST_P(MeetsOf, TheFastPathChangesNoBitAndNeitherDoesTheOrder) {
  for_seeds(trials(60), [&](Dice& dice) {
    const Instance instance = random_instance(dice);
    const bool framed = dice.below(2) == 0;
    expect_same(oracle::solve(posted(zone, instance, framed, true)),
                oracle::solve(posted(zone, instance, framed, false)), "fast and general");
    oracle::expect_order_independent(posted(zone, instance, framed, true));
  });
}

// A point of the zone that M may hold, wherever it is, keeps its x.
TEST_P(MeetsOf, LosesNoSolution) {
  int tried = 0;
  for_seeds(trials(400), [&](Dice& dice) {
    Instance instance = random_instance(dice);
    const bool framed = dice.below(2) == 0;
    std::vector<double> truth, at;
    for (const Interval& domain : instance.domains)
      truth.push_back(oracle::dyadic(dice, domain.lo(), domain.hi(), 4));
    for (std::size_t c = 0; c < zone.dim; ++c) at.push_back(oracle::dyadic(dice, -6, 6, 4));
    const int where = dice.below(3);  // anywhere, near the center, or on the ring exactly: along one axis
    for (std::size_t c = 0; where > 0 && c < zone.dim; ++c) {
      at[c] = truth[c] + (where == 1 ? oracle::dyadic(dice, -1, 1, 4) : (c == 0 ? truth[3] : 0.0));
    }
    Dag dag;
    std::vector<Expr> x;
    VectorExpr a;
    std::map<Input, double> point;
    for (VariableId v = 0; v < 4; ++v) {
      x.emplace_back(dag, dag.input({Input::Kind::real, v, 0, 0}));
      point[{Input::Kind::real, v, 0, 0}] = truth[v];
    }
    for (std::uint32_t c = 0; c < zone.dim; ++c) {
      a.emplace_back(dag, dag.input({Input::Kind::point, 0, c, 0}));
      point[{Input::Kind::point, 0, c, 0}] = at[c];
    }
    if (oracle::Pointwise(dag, point).holds(zone.make(a, x).node()) != Answer::yes) return;
    const Result result = oracle::solve(posted(zone, instance, framed, true));
    const auto& map = std::get<SetInterval>(result["M"]);
    if (map.is_empty() || map.at(at.data()) == CellState::outside) return;
    ++tried;
    ASSERT_EQ(result.status, Status::contracted);
    for (std::size_t v = 0; v < 4; ++v) {
      EXPECT_TRUE(std::get<Interval>(result.variables[v].domain).contains(truth[v])) << "lost x" << v;
    }
    Instance smaller = instance;
    for (Interval& domain : smaller.domains) domain = dice.within(domain);
    expect_below(oracle::solve(posted(zone, smaller, framed, true)), result, "isotonicity");
  });
  EXPECT_TRUE(tried > 0 || ::testing::GTEST_FLAG(random_seed) > 0 || HasFailure());
}

std::string name_of(const ::testing::TestParamInfo<NamedZone>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Zones, MeetsOf, ::testing::ValuesIn(oracle::zones()), name_of);

Result ring_around(const Interval& x, const Interval& z, double frame, bool framed, bool with_far_set) {
  Problem p("ring");
  const auto xs = p.real("x", x), zs = p.real("z", z);
  std::optional<Box> box;
  if (framed) box = Box{{-frame, frame}, {-frame, frame}};
  const auto map = p.set("M", 2, kPrecision, box);
  if (with_far_set) {  // says nothing of M but makes its tree taller
    const auto far = p.set("F", 2, kPrecision);
    p.constrain_union("far", far, {2, norm(p.point(2) - VectorExpr{p.constant(200), p.constant(0)}) < 1.0});
    p.constrain_disjoint("apart", far, map);
  }
  p.constrain_meets("meets", {2, norm(p.point(2) - VectorExpr{p(xs), p.constant(0)}) == p(zs)}, map);
  return p.propagate();
}

TEST(MeetsContractor, SpaceBeyondTheFrameSupportsNothing) {
  const Result result = ring_around({0, 100}, {1, 2}, 3.75, true, false);
  const Interval x = std::get<Interval>(result["x"]);
  EXPECT_EQ(x.lo(), 0.0);
  EXPECT_GE(x.hi(), 5.75);
  EXPECT_LE(x.hi(), 6.0 + 1e-9) << "the cell that the frame's face lies in ends at 4";
}

TEST(MeetsContractor, AnUnboundedSetSupportsEverythingAroundIt) {
  const Result result = ring_around({0, 1e6}, {1, 2}, 0, false, false);
  EXPECT_EQ(std::get<Interval>(result["x"]), Interval(0, 1e6));
  EXPECT_EQ(std::get<Interval>(result["z"]), Interval(1, 2));
}

TEST(MeetsContractor, HowFarTheTreeReachesDoesNotShow) {
  for_seeds(60, [](Dice& dice) {
    const double x = oracle::dyadic(dice, -150, 150), z = oracle::dyadic(dice, 0.5, 40);
    const Interval xs(x, x + oracle::dyadic(dice, 0, 3)), zs(z, z + oracle::dyadic(dice, 0, 3));
    const Result plain = ring_around(xs, zs, 0, false, false), taller = ring_around(xs, zs, 0, false, true);
    EXPECT_EQ(std::get<Interval>(plain["x"]), std::get<Interval>(taller["x"]));
    EXPECT_EQ(std::get<Interval>(plain["z"]), std::get<Interval>(taller["z"]));
  });
}

TEST(MeetsContractor, FailsWhereNothingIsLeft) {
  Problem p("none");
  p.set_time_line(TimeLine({0.0, 1.0, 2.0}));
  Tube far(p.time_line(), 2);
  for (std::size_t item = 0; item < far.items(); ++item) {
    const double reach = item == 3 ? 50.0 : 1.0;
    for (std::size_t c = 0; c < 2; ++c) far.set(c, item, Interval(reach, reach + 1));
  }
  const auto x = p.tube("x", far);
  const auto map = p.set("M", 2, kPrecision, Box{{-3, 3}, {-3, 3}});
  p.constrain_meets("impact", {2, norm(p.point(2) - p(x)) <= 1.0}, map);
  const Result result = p.propagate();
  ASSERT_EQ(result.status, Status::infeasible);
  EXPECT_EQ(result.explanation->constraint, "impact");
  EXPECT_EQ(result.explanation->variable, "x");
  EXPECT_EQ(result.explanation->time, (std::array{1.0, 2.0}));
}

TEST(MeetsContractor, LearnsNothingWhereThereIsNoReading) {
  Problem p("blank");
  p.set_time_line(TimeLine({0.0, 1.0, 2.0}));
  const auto z = p.tube("z", sampled(p.time_line(), {0.0, 2.0}, {Box{{1, 2}}, Box{{1, 2}}}));
  p.set_readings(z, {{0, "first"}, {2, "second"}});
  Tube wide(p.time_line(), 2);
  for (std::size_t item = 0; item < wide.items(); ++item) {
    for (std::size_t c = 0; c < 2; ++c) wide.set(c, item, Interval(-100, 100));
  }
  const auto x = p.tube("x", wide);
  const auto map = p.set("M", 2, kPrecision, Box{{-3.75, 3.75}, {-3.75, 3.75}});
  p.constrain_meets("impact", {2, norm(p.point(2) - p(x)) == p(z)[0]}, map);
  const Tube left = std::get<Tube>(p.propagate()["x"]);
  for (std::size_t item = 0; item < left.items(); ++item) {
    const bool reading = item == 0 || item == 4;
    EXPECT_EQ(left.at(0, item).hi() < 100, reading) << item;
    EXPECT_TRUE(leq(Interval(-5.75, 5.75), left.at(1, item)));
  }
}

}  // namespace
}  // namespace hcsp
