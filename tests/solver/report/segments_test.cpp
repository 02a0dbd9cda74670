// SPDX-License-Identifier: Apache-2.0
// Motion polynomials in the result file and as a table, and pictures of tubes on phases.
#include "solver/report/segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "solver/problem.h"
#include "solver/report/csv.h"
#include "solver/report/html.h"
#include "solver/report/json.h"
#include "solver/report/svg.h"

namespace hcsp {
namespace {

using nlohmann::json;

// Two joints: 1 s at acceleration (2, 4), 1 s level.
Result motion() {
  Problem p("two joints");
  const RealVariable end = p.real("T", Interval(0.0, 10.0));
  const VectorVariable tau = p.vector("tau", Box{Interval(1.0), Interval(1.0)});
  p.set_phases(p(end), p(tau));
  const auto number = [&](double x) { return p.constant(Interval(x)); };
  const TubeVariable x = p.tube("x", 2), v = p.tube("v", 2), s = p.tube("s", 1);
  p.constrain_derivative("x'", x, p(v));
  p.constrain_derivative("v'", v, p(p.hold({{number(2), number(4)}, {number(0), number(0)}})));
  p.constrain("s", p(s)[0] == p(v)[0] + p(v)[1]);
  for (const std::size_t c : {0U, 1U})
    p.constrain("start", p.at(x, 0.0)[c] == number(1) && p.at(v, 0.0)[c] == number(0));
  return p.solve_all();
}

TEST(Segments, TheResultFileListsThem) {
  const json file = json::parse(to_json(motion()));
  const json& segments = file.at("segments");
  ASSERT_EQ(segments.size(), 4U);
  const json& last = segments[3];
  EXPECT_EQ(last.at("segment"), 2);
  EXPECT_EQ(last.at("joint"), 2);
  EXPECT_EQ(last.at("interval"), json({1, 2}));
  EXPECT_EQ(last.at("enclosure").at("lo"), json({1, 2}));
  EXPECT_EQ(last.at("coefficients").at("x"), json({{"lo", {3, 4}}, {"hi", {3, 4}}}));
  EXPECT_EQ(segments[0].at("coefficients").at("x").at("lo"), json({1, 0, 1}));  // 1 + t^2
  EXPECT_FALSE(last.at("coefficients").contains("s")) << "it has fewer components";
  const json& tube = file.at("variables").at("x");
  EXPECT_EQ(tube.at("kind"), "tube");
  EXPECT_EQ(tube.at("time"), json({0, 1, 2}));
  EXPECT_EQ(tube.at("instants").at("hi"), json({0, 1, 2}));
  EXPECT_EQ(tube.at("gates").at("lo"), json({{1, 1}, {2, 3}, {4, 7}}));
  EXPECT_EQ(tube.at("slices").at("hi"), json({{2, 3}, {4, 7}}));
  EXPECT_EQ(file.at("solutions")[0].at("variables").at("x"), tube);
}

TEST(Segments, ATableIsReadyToExecute) {
  std::istringstream lines(to_csv(motion()));
  std::string header, first;
  std::getline(lines, header);
  std::getline(lines, first);
  EXPECT_THAT(header, testing::StartsWith("segment,joint,start,end,x0,x1,x2,v0,v1,start.lo,start.hi,end.lo"));
  EXPECT_THAT(first, testing::StartsWith("1,1,0,1,1,0,1,0,2,0,0,1,1"));
  std::string rest;
  int rows = 1;
  while (std::getline(lines, rest)) ++rows;
  EXPECT_EQ(rows, 4);
}

TEST(Segments, ArePictured) {
  const std::string svg = to_svg(motion(), {});
  EXPECT_THAT(svg, testing::HasSubstr(">x[2]<"));
  EXPECT_THAT(svg, testing::HasSubstr("slices0"));
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr("width of x")));
  EXPECT_THAT(to_html(motion(), {}), testing::HasSubstr(R"("drawn":true)"));
}

// One phase of 2 s from (0, 0), accelerating: position and velocity begin and end at the same numbers.
Result from_rest(std::size_t joints) {
  Problem p("from rest");
  const RealVariable end = p.real("T", Interval(0.0, 10.0));
  const VectorVariable tau = p.vector("tau", Box{Interval(2.0)});
  p.set_phases(p(end), p(tau));
  const TubeVariable x = p.tube("x", joints), twin = p.tube("twin", joints), v = p.tube("v", joints);
  std::vector<Expr> push;
  for (std::size_t c = 0; c < joints; ++c) push.push_back(p.constant(Interval(1.0 + static_cast<double>(c))));
  p.constrain_derivative("x'", x, p(v));
  p.constrain_derivative("twin'", twin, p(v));
  p.constrain_derivative("v'", v, p(p.hold({push})));
  for (std::size_t c = 0; c < joints; ++c) {
    const Expr zero = p.constant(Interval(0.0));
    p.constrain("start", p.at(x, 0.0)[c] == zero && p.at(twin, 0.0)[c] == zero && p.at(v, 0.0)[c] == zero);
  }
  return p.solve_all();
}

// The map's legend lists the ways that it draws, time's plots every component.
TEST(Segments, ADerivativeIsNoOtherWay) {
  const std::string svg = to_svg(from_rest(2), {});
  EXPECT_THAT(svg, testing::HasSubstr(">twin<"));
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr(">v<")));
}

TEST(Segments, TwelveComponentsAreDrawn) {
  const std::string seven = to_svg(from_rest(7), {}), many = to_svg(from_rest(13), {});
  EXPECT_THAT(seven, testing::HasSubstr(">x[7]<"));
  EXPECT_THAT(many, testing::HasSubstr(">x[12] of 13<"));
  EXPECT_THAT(many, testing::Not(testing::HasSubstr(">x[13]<")));
}

TEST(Segments, AResultWithoutPhasesHasNone) {
  Problem p("plain");
  p.real("x", Interval(0.0, 1.0));
  EXPECT_FALSE(json::parse(to_json(p.propagate())).contains("segments"));
}

// Of no solution nothing is told.
TEST(Segments, AnInfeasibleMotionHasNone) {
  Problem p("never");
  const RealVariable end = p.real("T", Interval(5.0, 10.0));
  const VectorVariable tau = p.vector("tau", Box{Interval(0.0, 1.0), Interval(0.0, 1.0)});
  p.set_phases(p(end), p(tau));
  const TubeVariable x = p.tube("x", 1);
  p.constrain_derivative("x'", x, {p.constant(Interval(1.0))});
  const Result result = p.solve_all();
  EXPECT_EQ(result.status, Status::infeasible);
  const json file = json::parse(to_json(result));
  EXPECT_TRUE(file.at("segments").empty());
  EXPECT_TRUE(file.at("variables").at("x").is_null());
  EXPECT_FALSE(to_csv(result).empty() || to_svg(result, {}).empty());
}

}  // namespace
}  // namespace hcsp
