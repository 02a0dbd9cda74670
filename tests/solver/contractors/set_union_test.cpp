// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/set_union.h"

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
using oracle::Point;

constexpr double kPrecision = 0.25;
constexpr std::int64_t kWorld = 26;

struct Instance {
  Point truth;
  std::vector<Interval> domains;
};

// Unknowns (center, angle or third coordinate, radius) around a true value.
Instance random_instance(Dice& dice, bool narrow) {
  Instance made;
  for (int i = 0; i < 4; ++i) {
    const double truth = i == 3 ? oracle::dyadic(dice, 0.5, 2.5, 4) : oracle::dyadic(dice, -1.5, 1.5, 4);
    const double room = narrow ? 0.25 : 1.5;
    made.truth.push_back(truth);
    made.domains.emplace_back(truth - oracle::dyadic(dice, 0, room, 4),
                              truth + oracle::dyadic(dice, 0, room, 4));
  }
  return made;
}

std::vector<Expr> unknowns(Problem& p, const Instance& instance) {
  std::vector<Expr> x;
  for (std::size_t i = 0; i < 4; ++i) x.push_back(p(p.real("x" + std::to_string(i), instance.domains[i])));
  return x;
}

oracle::Build posted(const NamedZone& zone, const Instance& instance, const std::optional<Box>& frame,
                     bool fast) {
  return [&zone, &instance, frame, fast](Problem& p) {
    p.use_fast_paths(fast);
    const auto x = unknowns(p, instance);
    const auto set = p.set("D", zone.dim, kPrecision, frame);
    p.constrain_union("union", set, {zone.dim, zone.make(p.point(zone.dim), x)});
  };
}

class UnionOf : public ::testing::TestWithParam<NamedZone> {
 protected:
  const NamedZone zone = GetParam();
  // 3-D worlds have many cells.
  [[nodiscard]] int trials(int count) const { return zone.dim == 3 ? count / 8 : count; }
};

// Without a frame nothing comes back to x: D is, cell by cell, what the relation says of the closed cell. D+
// leaves out the cells beyond the zone's hull too.
TEST_P(UnionOf, IsWhatBruteForceSays) {
  for_seeds(trials(40), [&](Dice& dice) {
    const Instance instance = random_instance(dice, true);
    const Result result = oracle::solve(posted(zone, instance, {}, true));
    ASSERT_EQ(result.status, Status::contracted);
    const auto& set = std::get<SetInterval>(result["D"]);
    Dag dag;
    std::vector<Expr> x;
    VectorExpr a;
    for (VariableId v = 0; v < 4; ++v) x.emplace_back(dag, dag.input({Input::Kind::real, v, 0, 0}));
    for (std::uint32_t c = 0; c < zone.dim; ++c)
      a.emplace_back(dag, dag.input({Input::Kind::point, 0, c, 0}));
    oracle::ZoneProbe probe(dag, zone.make(a, x).node());
    const std::vector<Interval> hull = probe.hull(zone.dim, instance.domains);
    oracle::for_cells(zone.dim, kWorld, [&](const CellIndex& cell) {
      const Interval holds = probe.holds(set.grid(), cell, instance.domains);
      const bool possible = holds != kFalse && oracle::meets(set.grid(), cell, hull);
      const CellState expected =
          holds == kTrue ? CellState::inside : (possible ? CellState::unknown : CellState::outside);
      ASSERT_EQ(set.at_cell(cell), expected) << "cell " << cell[0] << ' ' << cell[1] << ' ' << cell[2];
    });
  });
}

TEST_P(UnionOf, TheFastPathChangesNoBit) {
  for_seeds(trials(60), [&](Dice& dice) {
    const Instance instance = random_instance(dice, dice.below(2) == 0);
    std::optional<Box> frame;
    if (dice.below(2) == 0)
      frame.emplace(IntervalVector::Constant(static_cast<Eigen::Index>(zone.dim), Interval(-2, 2)));
    expect_same(oracle::solve(posted(zone, instance, frame, true)),
                oracle::solve(posted(zone, instance, frame, false)), "fast and general");
  });
}

// The zone of the true x lies within the frame: x must survive, and with it the truth of every point.
TEST_P(UnionOf, LosesNoSolutionWithAFrame) {
  int tried = 0;
  for_seeds(trials(80), [&](Dice& dice) {
    const Instance instance = random_instance(dice, false);
    const double reach = oracle::dyadic(dice, 1.5, 5.0);
    Dag dag;
    std::vector<Expr> x;
    VectorExpr a;
    std::map<Input, double> point;
    for (VariableId v = 0; v < 4; ++v) {
      const Input input{Input::Kind::real, v, 0, 0};
      x.emplace_back(dag, dag.input(input));
      point[input] = instance.truth[v];
    }
    for (std::uint32_t c = 0; c < zone.dim; ++c)
      a.emplace_back(dag, dag.input({Input::Kind::point, 0, c, 0}));
    const NodeId relation = zone.make(a, x).node();
    oracle::ZoneProbe probe(dag, relation);
    std::vector<Interval> truth;
    for (const double value : instance.truth) truth.emplace_back(value);
    // Is the zone of the truth within the frame? Only if no cell beyond may hold any of it.
    const Grid grid(zone.dim, kPrecision);
    bool fits = true;
    oracle::for_cells(zone.dim, kWorld, [&](const CellIndex& cell) {
      bool framed = true;
      for (std::size_t axis = 0; axis < zone.dim; ++axis) {
        framed = framed && grid.line(cell[axis]) <= reach && grid.line(cell[axis] + 1) > -reach;
      }
      fits = fits && (framed || probe.holds(grid, cell, truth) == kFalse);
    });
    if (!fits) return;
    ++tried;
    const Box frame(IntervalVector::Constant(static_cast<Eigen::Index>(zone.dim), Interval(-reach, reach)));
    const oracle::Build build = posted(zone, instance, frame, true);
    const Result result = oracle::solve(build);
    ASSERT_EQ(result.status, Status::contracted);
    for (std::size_t v = 0; v < 4; ++v) {
      EXPECT_TRUE(std::get<Interval>(result.variables[v].domain).contains(instance.truth[v]))
          << "lost x" << v;
    }
    const auto& set = std::get<SetInterval>(result["D"]);
    for (int k = 0; k < 300; ++k) {
      Point at;
      for (std::uint32_t c = 0; c < zone.dim; ++c) {
        at.push_back(dice.uniform(-reach - 1, reach + 1));
        point[{Input::Kind::point, 0, c, 0}] = at.back();
      }
      const Answer in = oracle::Pointwise(dag, point).holds(relation);
      const CellState state = set.at(at.data());
      EXPECT_FALSE(in == Answer::yes && state == CellState::outside);
      EXPECT_FALSE(in == Answer::no && state == CellState::inside);
    }
    Instance smaller = instance;
    for (Interval& domain : smaller.domains) domain = dice.within(domain);
    expect_below(oracle::solve(posted(zone, smaller, frame, true)), result, "isotonicity");
  });
  EXPECT_TRUE(tried > 0 || ::testing::GTEST_FLAG(random_seed) > 0 || HasFailure());
}

std::string name_of(const ::testing::TestParamInfo<NamedZone>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Zones, UnionOf, ::testing::ValuesIn(oracle::zones()), name_of);

TEST(UnionContractor, AFrameBoundsTheRadius) {
  Problem p("frame");
  const auto z = p.real("z", {0, 10});
  const auto set = p.set("D", 2, 0.5, Box{{-2, 2}, {-2, 2}});
  p.constrain_union("union", set, {2, norm(p.point(2)) < p(z)});
  const Result result = p.propagate();
  const Interval left = std::get<Interval>(result["z"]);
  // The cell that the face at 2 touches is kept; below -2 the outside begins.
  EXPECT_GE(left.hi(), 2.0);
  EXPECT_LE(left.hi(), 2.0 + 1e-9);
}

TEST(UnionContractor, OverTimeIsTheUnionOverTheItems) {
  for_seeds(20, [](Dice& dice) {
    const auto line = std::make_shared<const TimeLine>(std::vector{0.0, 1.0, 2.0, 3.0});
    Tube x(line, 2), z(line, 1);
    for (std::size_t item = 0; item < 7; ++item) {
      for (std::size_t c = 0; c < 2; ++c) {
        const double middle = oracle::dyadic(dice, -2, 2);
        x.set(c, item, Interval(middle - 0.125, middle + 0.125));
      }
      const double radius = oracle::dyadic(dice, 0.5, 1.5);
      z.set(0, item, Interval(radius - 0.125, radius));
    }
    const bool blank = dice.below(2) == 0;  // readings at the gates alone
    for (std::size_t item = 1; blank && item < 7; item += 2) z.set(0, item, Interval());
    Problem p("over time");
    p.set_time_line(*line);
    const auto xs = p.tube("x", x), zs = p.tube("z", z);
    if (blank) p.set_readings(zs, {{0, ""}, {1, ""}, {2, ""}, {3, ""}});
    const auto set = p.set("D", 2, kPrecision);
    p.constrain_union("union", set, {2, norm(p.point(2) - p(xs)) < p(zs)[0]});
    const Result result = p.propagate();
    const auto& found = std::get<SetInterval>(result["D"]);
    Dag dag;
    std::vector<Expr> v;
    VectorExpr a;
    for (VariableId i = 0; i < 3; ++i) v.emplace_back(dag, dag.input({Input::Kind::real, i, 0, 0}));
    for (std::uint32_t c = 0; c < 2; ++c) a.emplace_back(dag, dag.input({Input::Kind::point, 0, c, 0}));
    oracle::ZoneProbe probe(dag, (norm(a - VectorExpr{v[0], v[1]}) < v[2]).node());
    oracle::for_cells(2, kWorld, [&](const CellIndex& cell) {
      bool lower = false, upper = blank;  // S+ shrinks only by what holds at every item
      for (std::size_t item = 0; item < 7; ++item) {
        if (blank && item % 2 == 1) continue;
        const Interval holds = probe.holds(found.grid(), cell, {x.at(0, item), x.at(1, item), z.at(0, item)});
        lower = lower || holds == kTrue;
        upper = upper || holds != kFalse;
      }
      ASSERT_EQ(found.at_cell(cell),
                lower ? CellState::inside : (upper ? CellState::unknown : CellState::outside));
    });
    EXPECT_EQ(found.background(), blank ? CellState::unknown : CellState::outside);
  });
}

TEST(UnionContractor, UnboundedZonesTerminateAndAreSound) {
  const auto half_plane = [](Problem& p, double x_lo, double x_hi) {
    const auto x = p.real("x", {x_lo, x_hi});
    const auto set = p.set("D", 2, 0.5);
    p.constrain_union("half plane", set, {2, p.point(2)[0] < p(x)});
    return p.propagate();
  };
  Problem p("half plane");
  const Result result = half_plane(p, 1.0, 3.0);
  ASSERT_EQ(result.status, Status::contracted);
  const auto& set = std::get<SetInterval>(result["D"]);
  for (std::int64_t i = -40; i < 40; ++i) {
    for (std::int64_t j = -40; j < 40; ++j) {
      const CellState state = set.at_cell({i, j, 0});
      EXPECT_EQ(state == CellState::inside, i < 1) << "the closed cell at 0.5 touches 1, where a < x fails";
      EXPECT_TRUE(i < 6 || state != CellState::inside);
    }
  }
  EXPECT_NE(set.background(), CellState::inside);
  EXPECT_EQ(std::get<Interval>(result["x"]), Interval(1, 3));
}

TEST(UnionContractor, AHalfPlaneFarAwayIsIsotone) {
  const auto solve_at = [](double lo, double hi) {
    return oracle::solve([=](Problem& p) {
      const auto x = p.real("x", {lo, hi});
      const auto set = p.set("D", 1, 0.5);
      p.constrain_union("half line", set, {1, p.point(1)[0] < p(x)});
    });
  };
  for (const double at : {-2000.0, -1000.0, -512.0, 0.0, 512.0, 1000.0, 2000.0}) {
    expect_below(solve_at(at + 50, at + 100), solve_at(at, at + 100),
                 "a half line from around " + std::to_string(at));
  }
}

TEST(UnionContractor, AZoneWithoutUnknownsIsPaintedOnce) {
  Problem p("constant");
  const auto set = p.set("D", 2, 0.25);
  p.constrain_union("disc", set, {2, norm(p.point(2)) < 1.0});
  const Result result = p.propagate();
  const double center[] = {0.0, 0.0}, far[] = {1.3, 0.0};
  EXPECT_EQ(std::get<SetInterval>(result["D"]).at(center), CellState::inside);
  EXPECT_EQ(std::get<SetInterval>(result["D"]).at(far), CellState::outside);
}

TEST(UnionContractor, AnImpossibleZoneMeansAnEmptySet) {
  Problem p("none");
  const auto set = p.set("D", 2, 0.25);
  p.constrain_union("nothing", set, {2, norm(p.point(2)) < -1.0});
  const Result result = p.propagate();
  EXPECT_EQ(result.status, Status::contracted) << "the empty set of points is a set";
  EXPECT_EQ(std::get<SetInterval>(result["D"]).upper_volume(), 0.0);
}

// What x learns from a frame must not depend on how far D's tree has grown meanwhile.
TEST(UnionContractor, TheOrderDoesNotShowWhereADomainShrinksMeanwhile) {
  for_seeds(20, [](Dice& dice) {
    const double far = oracle::dyadic(dice, 2, 8), radius = oracle::dyadic(dice, 1, 4);
    const Interval x0(-far, oracle::dyadic(dice, 0, 2)),
        x1(-oracle::dyadic(dice, 0, 8), oracle::dyadic(dice, 0, 2));
    const double side = oracle::dyadic(dice, 0.25, 3);
    const bool fast = dice.below(2) == 0;
    const oracle::Build build = [=](Problem& p) {
      p.use_fast_paths(fast);
      const auto x = p.vector("x", Box{x0, x1});
      const auto z = p.real("z", {0.25, radius});
      const auto dug = p.set("D", 2, 0.5, Box{{-side, side}, {-side, side}});
      const auto map = p.set("M", 2, 0.5, Box{{-1, 1}, {-1, 1}});
      const VectorExpr a = p.point(2);
      p.constrain_union("dug", dug, {2, norm(a - p(x)) < p(z)});
      p.constrain_meets("near", {2, norm(a - p(x)) <= 0.5}, map);
    };
    oracle::expect_order_independent(build);
  });
}

TEST(UnionContractor, AZoneFarFromTheFrameIsFelt) {
  for (const bool another : {false, true}) {
    const oracle::Build build = [=](Problem& p) {
      const auto y = p.real("y", {-100, 1}), r = p.real("r", {0.125, 1.5}), z = p.real("z", {0, 100});
      const auto dug = p.set("D", 2, 0.5, Box{{-1.9, 1.9}, {-1.9, 1.9}});
      const auto map = p.set("M", 2, 0.5, Box{{-1, 1}, {-1, 1}});
      const VectorExpr a = p.point(2), from_y = a - VectorExpr{p(y), p.constant(0)};
      p.use_fast_paths(false);
      if (another) p.constrain_union("disc", dug, {2, norm(from_y) < p(r)});
      p.constrain_meets("near", {2, norm(from_y) <= 0.5}, map);
      p.constrain_union("annulus", dug, {2, norm(a) >= 30.0 && norm(a) < p(z)});
    };
    oracle::expect_order_independent(build);
    const Interval z = std::get<Interval>(oracle::solve(build)["z"]);
    EXPECT_LT(z.hi(), 32.0) << "the annulus lies outside the frame as soon as it holds a point";
  }
}

}  // namespace
}  // namespace hcsp
