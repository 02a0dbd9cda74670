// SPDX-License-Identifier: Apache-2.0
// What the reports make of a paving.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "solver/problem.h"
#include "solver/report/csv.h"
#include "solver/report/html.h"
#include "solver/report/json.h"
#include "solver/report/paving_map.h"
#include "solver/report/svg.h"
#include "tests/solver/report/well_formed.h"

namespace hcsp {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// The disc of radius 1 by its first `dim` coordinates.
Result paved(std::size_t dim, double time_limit = 0) {
  Problem problem("disc <&>");
  Box domain(static_cast<Eigen::Index>(dim));
  for (Eigen::Index i = 0; i < domain.dim(); ++i) domain[i] = Interval(-2, 2);
  const auto x = problem.vector("x", domain);
  Expr square = sqr(problem.component(x, 0));
  for (std::size_t i = 1; i < dim; ++i) square = square + sqr(problem.component(x, i));
  problem.constrain("disc", square <= Interval(1.0));
  SearchOptions options;
  options.precision = 0.25;
  options.time_limit = time_limit;
  double now = 0;
  options.clock = [&now] { return now += 1; };
  return problem.pave(problem(x), options);
}

TEST(PavingReport, JsonHasFlatBoxes) {
  const Result result = paved(2);
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["status"], "solved");
  const auto& paving = json["paving"];
  EXPECT_EQ(paving["names"], (std::vector<std::string>{"x[1]", "x[2]"}));
  std::size_t boxes = 0;
  double area = 0;
  for (const char* kind : {"inside", "boundary", "outside"}) {
    for (const auto& box : paving[kind]) {
      ASSERT_EQ(box.size(), 4U);
      area += (box[1].get<double>() - box[0].get<double>()) * (box[3].get<double>() - box[2].get<double>());
      ++boxes;
    }
  }
  EXPECT_NEAR(area, 16.0, 1e-9);
  EXPECT_EQ(
      boxes,
      (result.paving->inside.size() + result.paving->boundary.size() + result.paving->outside.size()) / 2);
  EXPECT_LE(paving["volume"]["inside"], 3.1416);
  EXPECT_TRUE(json["unexplored"].empty());
  EXPECT_GT(json["statistics"]["cells"], 10);
}

TEST(PavingReport, WhatALimitLeft) {
  const Result result = paved(2, 1.0);
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["status"], "limit");
  EXPECT_EQ(json["unexplored"], nlohmann::json::parse("[[-2.0, 2.0, -2.0, 2.0]]"));
  EXPECT_THAT(to_csv(result), HasSubstr("unexplored,-2,2,-2,2\n"));
}

TEST(PavingReport, CsvHasARowABox) {
  const std::string csv = to_csv(paved(2));
  EXPECT_THAT(csv, StartsWith("kind,x[1].lo,x[1].hi,x[2].lo,x[2].hi\ninside,"));
  EXPECT_THAT(csv, HasSubstr("\nboundary,"));
  EXPECT_THAT(csv, HasSubstr("\noutside,"));
}

TEST(PavingReport, PicturesOfAnyDimension) {
  for (const std::size_t dim : {1U, 2U, 3U}) {
    const Result result = paved(dim);
    const std::string svg = to_svg(result, {});
    EXPECT_EQ(sample::xml_error(svg), "") << dim;
    EXPECT_THAT(svg, HasSubstr("disc &lt;&amp;&gt;"));
    EXPECT_THAT(svg, HasSubstr("boundary at most"));
    EXPECT_THAT(to_html(result, {}), HasSubstr("\"paving\":{\"names\":[\"x[1]\""));
  }
}

// The rectangles that are drawn are the boxes, joined where they touch along a side.
TEST(PavingReport, JoinsWhatTouches) {
  Paving paving;
  paving.names = {"x", "y"};
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      paving.inside.emplace_back(x, x + 1);
      paving.inside.emplace_back(y, y + 1);
    }
  }
  paving.boundary = {Interval(3, 4), Interval(0, 1), Interval(5, 6), Interval(0, 1)};
  const report::PavingMap map = report::paving_map(paving);
  EXPECT_EQ(map.inside, (report::Rectangles{0, 2, 0, 2}));
  EXPECT_EQ(map.boundary.size(), 8U);
  for (const auto& [bound, wanted] : {std::pair(0, 0.0), {1, 6.0}, {2, 0.0}, {3, 2.0}})
    EXPECT_NEAR(map.frame[static_cast<std::size_t>(bound)], wanted, 1e-6);
}

}  // namespace
}  // namespace hcsp
