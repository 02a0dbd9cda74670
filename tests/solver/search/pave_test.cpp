// SPDX-License-Identifier: Apache-2.0
// Subpavings: every point of an inside box belongs, none of an outside box does, and the boxes cover the
// domain without overlap.
#include "solver/search/pave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/problem.h"

namespace hcsp {
namespace {

enum class Kind : std::uint8_t { inside, boundary, outside, unexplored };

const std::vector<Interval>& boxes_of(const Paving& paving, Kind kind) {
  switch (kind) {
    case Kind::inside:
      return paving.inside;
    case Kind::boundary:
      return paving.boundary;
    case Kind::outside:
      return paving.outside;
    default:
      return paving.unexplored;
  }
}

constexpr std::array kKinds{Kind::inside, Kind::boundary, Kind::outside, Kind::unexplored};

// f(kind, box) of all boxes.
template <class F>
void for_each_box(const Paving& paving, F f) {
  const std::size_t dim = paving.names.size();
  for (const Kind kind : kKinds) {
    const auto& boxes = boxes_of(paving, kind);
    for (std::size_t first = 0; first < boxes.size(); first += dim)
      f(kind, std::span<const Interval>(&boxes[first], dim));
  }
}

// The volumes add up to the domain's: boxes that cover it do not overlap then.
void expect_volume(const Paving& paving, double volume) {
  Interval sum(0.0);
  for_each_box(paving, [&](Kind, std::span<const Interval> box) {
    Interval product(1.0);
    for (const Interval& side : box) product *= Interval(side.hi()) - Interval(side.lo());
    sum += product;
  });
  EXPECT_TRUE(sum.contains(volume)) << to_string(sum);
  EXPECT_LT(sum.width(), 1e-6 * volume);
}

// `truth` of random points, which are short dyadic numbers: 1, 0, or -1 where it is not known.
template <class Truth>
void expect_truths(const Paving& paving, const std::vector<Interval>& domain, Truth truth, int points = 300) {
  std::mt19937_64 random(7);
  for (int k = 0; k < points; ++k) {
    std::vector<double> point;
    for (const Interval& side : domain) {
      std::uniform_real_distribution<double> in(side.lo(), side.hi());
      point.push_back(std::clamp(std::round(in(random)*4096.0) / 4096.0, side.lo(), side.hi()));
    }
    const int known = truth(point);
    bool is_covered = false;
    for_each_box(paving, [&](Kind kind, std::span<const Interval> box) {
      for (std::size_t v = 0; v < point.size(); ++v) {
        if (!box[v].contains(point[v])) return;
      }
      is_covered = true;
      EXPECT_FALSE(kind == Kind::inside && known == 0) << testing::PrintToString(point);
      EXPECT_FALSE(kind == Kind::outside && known == 1) << testing::PrintToString(point);
    });
    EXPECT_TRUE(is_covered) << testing::PrintToString(point);
  }
}

SearchOptions precision(double value, unsigned threads = 1) {
  SearchOptions options;
  options.precision = value;
  options.threads = threads;
  return options;
}

const Interval kSide(-3.0, 3.0);

struct Plane {
  Problem problem{"plane"};
  Expr x = problem(problem.real("x", kSide)), y = problem(problem.real("y", kSide));

  Paving pave(double width) { return *problem.pave({x, y}, precision(width)).paving; }
};

TEST(Pave, ARing) {
  Plane plane;
  const Expr r = sqr(plane.x) + sqr(plane.y);
  plane.problem.constrain("ring", Interval(1.0) <= r && r <= Interval(4.0));
  const Result result = plane.problem.pave({plane.x, plane.y}, precision(0.05));
  EXPECT_EQ(result.status, Status::solved);
  const Paving& paving = *result.paving;
  EXPECT_EQ(paving.names, (std::vector<std::string>{"x", "y"}));
  const double area = 3.0 * std::acos(-1.0);
  EXPECT_LE(paving.inside_volume, area);
  EXPECT_GE(paving.inside_volume + paving.boundary_volume, area);
  EXPECT_LE(paving.boundary_volume, 24 * 0.05);
  expect_volume(paving, 36.0);
  expect_truths(paving, {kSide, kSide}, [](const std::vector<double>& p) {
    const double square = p[0] * p[0] + p[1] * p[1];  // exact
    return 1.0 <= square && square <= 4.0 ? 1 : 0;
  });
  for_each_box(paving, [](Kind kind, std::span<const Interval> box) {
    const Interval square = sqr(box[0]) + sqr(box[1]);  // its ends are attained, but for rounding
    if (kind == Kind::inside) {
      EXPECT_TRUE(square.lo() >= 1.0 && square.hi() <= 4.0);
    }
    if (kind == Kind::outside) {
      EXPECT_TRUE(square.hi() < 1.0 || square.lo() > 4.0);
    }
    if (kind == Kind::boundary) {
      EXPECT_TRUE(box[0].hi() - box[0].lo() <= 0.05 && box[1].hi() - box[1].lo() <= 0.05);
    }
  });
}

TEST(Pave, Connectives) {
  struct Case {
    const char* name;
    Expr (*relation)(const Expr& x, const Expr& y);
    bool (*truth)(double x, double y);
  };
  const Case cases[] = {
      {"not", [](const Expr& x, const Expr& y) { return !(x * y < Interval(1.0)); },
       [](double x, double y) { return x * y >= 1; }},
      {"or", [](const Expr& x, const Expr& y) { return x > Interval(1.0) || sqr(y) < x; },
       [](double x, double y) { return x > 1 || y * y < x; }},
      {"exclusive or", [](const Expr& x, const Expr& y) { return (x > y) != (x * y > Interval(0.0)); },
       [](double x, double y) { return (x > y) != (x * y > 0); }},
      {"two of three",
       [](const Expr& x, const Expr& y) {
         return at_least(2, {x > Interval(0.0), y > Interval(0.0), x + y > Interval(1.0)});
       },
       [](double x, double y) { return (x > 0) + (y > 0) + (x + y > 1) >= 2; }},
      {"a choice",
       [](const Expr& x, const Expr& y) {
         return if_then_else(x < Interval(0.0), sqr(y), y) <= Interval(1.0);
       },
       [](double x, double y) { return (x < 0 ? y * y : y) <= 1; }},
      {"a root", [](const Expr& x, const Expr& y) { return sqrt(x) <= y; },
       [](double x, double y) { return x >= 0 && y >= 0 && x <= y * y; }},
      {"no root", [](const Expr& x, const Expr& y) { return !(sqrt(x) <= y); },
       [](double x, double y) { return !(x >= 0 && y >= 0 && x <= y * y); }},
      {"a quotient", [](const Expr& x, const Expr& y) { return Interval(1.0) / x > y; },
       [](double x, double y) { return x > 0 ? 1 > x * y : x < 0 && 1 < x * y; }},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    Plane plane;
    plane.problem.constrain("c", one.relation(plane.x, plane.y));
    const Paving paving = plane.pave(0.1);
    expect_volume(paving, 36.0);
    EXPECT_GT(paving.inside_volume, 1.0);
    EXPECT_LT(paving.boundary_volume, 5.0);
    expect_truths(paving, {kSide, kSide},
                  [&](const std::vector<double>& p) { return one.truth(p[0], p[1]) ? 1 : 0; });
  }
}

TEST(Pave, AnEquationHasABoundaryOnly) {
  Plane plane;
  plane.problem.constrain("circle", sqr(plane.x) + sqr(plane.y) == Interval(4.0));
  const Paving paving = plane.pave(0.02);
  EXPECT_TRUE(paving.inside.empty());
  EXPECT_LT(paving.boundary_volume, 0.5);
  expect_volume(paving, 36.0);
}

TEST(Pave, NothingAndEverything) {
  Plane nothing;
  nothing.problem.constrain("c", sqr(nothing.x) + Interval(1.0) < Interval(0.0));
  const Result result = nothing.problem.pave({nothing.x}, precision(0.1));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_TRUE(result.paving->boundary.empty());
  Plane everything;
  const Paving all = everything.pave(0.1);
  EXPECT_EQ(all.inside_volume, 36.0);
  EXPECT_EQ(all.boundary_volume, 0.0);
}

// Far out separators cut off what bisection would never reach.
TEST(Pave, UnboundedDomains) {
  Problem problem("disc");
  const Expr x = problem(problem.real("x")), y = problem(problem.real("y"));
  problem.constrain("disc", sqr(x) + sqr(y) <= Interval(1.0));
  const Paving paving = *problem.pave({x, y}, precision(0.05)).paving;
  EXPECT_GT(paving.inside_volume, 3.0);
  EXPECT_LT(paving.boundary_volume, 0.5);
}

TEST(Pave, WholeNumbers) {
  Problem problem("whole");
  const Expr n = problem(problem.integer("n", Interval(-5.0, 5.0)));
  const Expr x = problem(problem.real("x", Interval(0.0, 4.0)));
  problem.constrain("c", n * x >= Interval(4.0));
  const Paving paving = *problem.pave({n, x}, precision(0.01)).paving;
  double truth = 0.0;
  for (int k = 1; k <= 5; ++k) truth += 4.0 - 4.0 / k;
  EXPECT_LE(paving.inside_volume, truth);
  EXPECT_GE(paving.inside_volume + paving.boundary_volume, truth);
  EXPECT_LT(paving.boundary_volume, 0.06);
}

// A domain's whole numbers are those that count, whether the unknown is paved, a parameter or in no relation.
TEST(Pave, TheBoundsOfWholeNumbersAreRounded) {
  const auto paved = [](const Interval& domain, bool is_related) {
    Problem problem("whole");
    const Expr x = problem(problem.real("x", Interval(0.0, 10.0)));
    const Expr k = problem(problem.integer("k", domain));
    problem.constrain("c", is_related ? x >= Interval(3.0) * k : x >= Interval(6.0));
    return problem.pave({x}, precision(0.1));
  };
  const Result one = paved({1.5, 2.5}, true);
  EXPECT_LE(one.paving->inside_volume, 4.0);
  EXPECT_GT(one.paving->inside_volume, 3.9);
  EXPECT_EQ(std::get<Interval>(one["k"]), Interval(2.0));
  for (const bool is_related : {false, true})
    EXPECT_EQ(paved({2.2, 2.8}, is_related).status, Status::infeasible) << is_related;
}

// Beyond 2^53 doubles leave whole numbers out: none of these is lost, and none taken for another.
TEST(Pave, WholeNumbersThatDoublesLeaveOut) {
  const auto paved = [](const Interval& domain, const auto& relation) {
    Problem problem("far");
    const Expr n = problem(problem.integer("n", domain));
    problem.constrain("c", relation(n));
    return *problem.pave({n}, precision(0.1)).paving;
  };
  const Interval half(5e16);
  const auto above = [&](const Expr& n) { return n >= half; };
  const auto below = [&](const Expr& n) { return n < -half; };
  const auto near = [](const Expr& n) { return sin(n) > Interval(2.0) || abs(n) <= Interval(3.0); };
  for (const Paving& paving : {paved({0.0, 1e17}, above), paved({-1e17, 0.0}, below), paved({}, near)}) {
    double last = 0.0;
    std::vector<Interval> sides;
    for_each_box(paving, [&](Kind, std::span<const Interval> box) { sides.push_back(box[0]); });
    std::sort(sides.begin(), sides.end(),
              [](const Interval& a, const Interval& b) { return a.lo() < b.lo(); });
    for (const Interval& side : sides) {
      EXPECT_LT(side.lo(), kInfinity);
      EXPECT_GT(side.hi(), -kInfinity);
      if (&side != &sides.front()) EXPECT_EQ(side.lo() - last, 1.0) << to_string(side);
      last = side.hi();
    }
  }
  EXPECT_EQ(paved({}, near).inside_volume, 7.0);
}

// {x in [0, 1] : there is p with p^2 + x p + y == 0}, the half plane below the parabola.
TEST(Pave, ForSomeByAnEquation) {
  Plane plane;
  const Expr p = plane.problem(plane.problem.real("p", Interval(-4.0, 4.0)));
  plane.problem.constrain("root", sqr(p) + plane.x * p + plane.y == Interval(0.0));
  const Paving paving = plane.pave(0.1);
  expect_volume(paving, 36.0);
  EXPECT_GT(paving.inside_volume, 15.0);
  EXPECT_LT(paving.boundary_volume, 3.5);
  expect_truths(paving, {kSide, kSide}, [](const std::vector<double>& at) {
    const double square = at[0] * at[0] - 4.0 * at[1];  // exact; the roots are within 4
    if (square < 0.0) return 0;
    const double root = std::sqrt(square);
    const double small = std::min(std::abs(root - at[0]), std::abs(root + at[0]));
    return small < 7.99 ? 1 : -1;
  });
}

// {(x, y) : for every q in [-1, 1], x q <= y}: |x| <= y.
TEST(Pave, ForEvery) {
  Plane plane;
  plane.problem.constrain("all", plane.problem.for_every("q", Interval(-1.0, 1.0), [&](Expr q) {
    return plane.x * q + sqr(q) - sqr(q) <= plane.y;
  }));
  const Paving paving = plane.pave(0.1);
  expect_volume(paving, 36.0);
  EXPECT_LE(paving.inside_volume, 9.0);
  EXPECT_GT(paving.inside_volume, 8.0);
  EXPECT_LT(paving.boundary_volume, 2.0);
  expect_truths(paving, {kSide, kSide},
                [](const std::vector<double>& p) { return std::abs(p[0]) <= p[1] ? 1 : 0; });
}

// For every q in [0, 1] some p in [0, 1] has x q + y - 1/2 <= p <= x q + y + 1/2.
TEST(Pave, OneQuantifierBelowAnother) {
  Plane plane;
  Problem& problem = plane.problem;
  problem.constrain("both", problem.for_every("q", Interval(0.0, 1.0), [&](Expr q) {
    return problem.for_some("p", Interval(0.0, 1.0),
                            [&](Expr p) { return abs(plane.x * q + plane.y - p) <= Interval(0.5); });
  }));
  const Paving paving = plane.pave(0.2);
  expect_volume(paving, 36.0);
  EXPECT_GT(paving.inside_volume, 2.0);
  EXPECT_LT(paving.boundary_volume, 4.0);
  expect_truths(paving, {kSide, kSide}, [](const std::vector<double>& p) {
    const auto fits = [](double middle) { return -0.5 <= middle && middle <= 1.5; };
    return fits(p[1]) && fits(p[0] + p[1]) ? 1 : 0;
  });
}

// A quantifier below `not`, and beside what has none.
TEST(Pave, QuantifiersWithinConnectives) {
  Plane plane;
  Problem& problem = plane.problem;
  const Expr above = problem.for_some("p", Interval(0.0, 1.0),
                                      [&](Expr p) { return plane.y - p > Interval(0.0) && plane.x > p; });
  problem.constrain("c", !above && (plane.x > Interval(-1.0) || above));
  problem.constrain("d", above == (plane.x > Interval(0.0) && plane.y > Interval(0.0)));  // always
  const Paving paving = plane.pave(0.1);
  expect_volume(paving, 36.0);
  EXPECT_GT(paving.inside_volume, 10.0);
  expect_truths(paving, {kSide, kSide}, [](const std::vector<double>& p) {
    const bool above_it = p[1] > 0 && p[0] > 0;
    return !above_it && p[0] > -1 ? 1 : 0;
  });
}

// Of a domain whose ends are enclosed, what it may lack settles nothing: [0, e] with e in [1, 1.25], and {e}.
TEST(Pave, EndsOfDomainsThatAreEnclosed) {
  const Interval end(1.25);
  const auto paved = [&](const Interval& domain, const Interval& certain, bool every) {
    Problem problem("ends");
    const Expr x = problem(problem.real("x", Interval(0.0, 1.0)));
    const auto beside = [&](Expr q) { return every ? x + q < Interval(-1.0) : x + q >= Interval(0.0); };
    const auto body = [&](Expr p) {
      const auto within = [&](Expr q) { return every ? p < end || beside(q) : p >= end && beside(q); };
      return every ? problem.for_every("q", Interval(0.0, 1.0), within)
                   : problem.for_some("q", Interval(0.0, 1.0), within);
    };
    problem.constrain("c", every ? problem.for_every("p", domain, body, certain)
                                 : problem.for_some("p", domain, body, certain));
    return *problem.pave({x}, precision(0.1)).paving;
  };
  for (const bool every : {false, true}) {
    for (const Interval& domain : {Interval(0.0, 1.25), Interval(1.0, 1.25)}) {
      const Interval certain = domain.lo() == 0.0 ? Interval(0.0, 1.0) : Interval::empty();
      const Paving open = paved(domain, certain, every), decided = paved(domain, domain, every);
      EXPECT_TRUE(open.inside.empty() && open.outside.empty()) << every << to_string(domain);
      EXPECT_EQ((every ? decided.outside : decided.inside).size(), 1U) << every << to_string(domain);
    }
  }
  Problem problem("parameter");
  const Expr x = problem(problem.real("x", Interval(0.0, 1.0)));
  const RealVariable p = problem.real("p", Interval(1.0, 1.25));
  problem.set_certain_domain(p.id, Interval::empty());
  problem.constrain("c", x < problem(p));
  EXPECT_TRUE(problem.pave({x}, precision(0.1)).paving->outside.empty());
}

TEST(Pave, TheSameForAnyNumberOfThreads) {
  std::vector<Result> results;
  for (const unsigned threads : {1U, 2U, 5U}) {
    Problem problem("waves");
    const Expr x = problem(problem.real("x", Interval(-10.0, 10.0)));
    const Expr y = problem(problem.real("y", Interval(-10.0, 10.0)));
    const Expr f = sin(x + y) - Interval(0.125) * x * y;
    problem.constrain("waves", Interval(0.0) <= f && f <= Interval(2.0));
    results.push_back(problem.pave({x, y}, precision(0.1, threads)));
  }
  const auto expect_same = [](const std::vector<Interval>& a, const std::vector<Interval>& b) {
    EXPECT_TRUE(a == b);
  };
  for (const Result& result : results) {
    expect_same(result.paving->inside, results.front().paving->inside);
    expect_same(result.paving->boundary, results.front().paving->boundary);
    expect_same(result.paving->outside, results.front().paving->outside);
    EXPECT_EQ(result.paving->cells, results.front().paving->cells);
  }
}

TEST(Pave, WhatALimitLeftIsTold) {
  Plane plane;
  plane.problem.constrain("disc", sqr(plane.x) + sqr(plane.y) <= Interval(4.0));
  SearchOptions options = precision(1e-9);
  double now = 0.0;
  options.clock = [&] { return now += 1e-3; };
  options.time_limit = 0.2;
  const Result result = plane.problem.pave({plane.x, plane.y}, options);
  EXPECT_EQ(result.status, Status::limit);
  EXPECT_FALSE(result.paving->unexplored.empty());
  expect_volume(*result.paving, 36.0);
  const double area = 4.0 * std::acos(-1.0);
  EXPECT_LE(result.paving->inside_volume, area);
  EXPECT_GE(result.paving->inside_volume + result.paving->boundary_volume, area);
}

TEST(Pave, GoesOnFromEveryCheckpoint) {
  const auto paved = [](const SearchOptions& options) {
    Plane plane;
    const Expr f = plane.x * sin(plane.y) + sqr(plane.x);
    plane.problem.constrain("c", f <= Interval(1.0));
    return *plane.problem.pave({plane.x, plane.y}, options).paving;
  };
  std::vector<std::string> states;
  SearchOptions options = precision(0.02, 2);
  options.checkpoint_period = 1e-4;
  options.checkpoint = [&](const std::string& state) { states.push_back(state); };
  const Paving whole = paved(options);
  ASSERT_FALSE(states.empty());
  for (std::size_t k = 0; k < states.size(); k += 1 + states.size() / 10) {
    SearchOptions again = precision(0.02);
    again.resume = states[k];
    const Paving resumed = paved(again);
    EXPECT_TRUE(resumed.inside == whole.inside && resumed.boundary == whole.boundary &&
                resumed.outside == whole.outside);
    EXPECT_EQ(resumed.cells, whole.cells);
  }
  SearchOptions other = precision(0.01);
  other.resume = states.back();
  EXPECT_THROW(paved(other), std::invalid_argument);
  SearchOptions swapped = precision(0.02);
  swapped.resume = states.back();
  Plane plane;
  const Expr f = plane.x * sin(plane.y) + sqr(plane.x);
  plane.problem.constrain("c", f <= Interval(1.0));
  EXPECT_THROW(plane.problem.pave({plane.y, plane.x}, swapped), std::invalid_argument);
}

TEST(Pave, WrongUseOfIt) {
  Plane plane;
  EXPECT_THROW(plane.problem.pave({}, precision(0.1)), std::invalid_argument);
  EXPECT_THROW(plane.problem.pave({plane.x + plane.y}, precision(0.1)), std::invalid_argument);
  EXPECT_THROW(plane.problem.pave({plane.x, plane.x}, precision(0.1)), std::invalid_argument);
  EXPECT_THROW(plane.problem.pave({plane.x}, precision(0.0)), std::invalid_argument);
  Plane other;
  EXPECT_THROW(plane.problem.pave({other.x}, precision(0.1)), std::invalid_argument);
  other.problem.constrain("c", other.problem.for_every("p", kSide, [&](Expr p) { return p < other.x; }));
  EXPECT_FALSE(other.problem.is_system());
  EXPECT_THROW(other.problem.solve_all(precision(0.1)), std::invalid_argument);
}

}  // namespace
}  // namespace hcsp
