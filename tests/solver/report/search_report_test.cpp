// SPDX-License-Identifier: Apache-2.0
// What the reports make of a search for all solutions.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "solver/problem.h"
#include "solver/report/csv.h"
#include "solver/report/html.h"
#include "solver/report/json.h"
#include "solver/report/svg.h"

namespace hcsp {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Result searched(double time_limit = 0) {
  Problem problem("roots");
  const auto x = problem.vector("x", Box{Interval(-4, 4), Interval(-4, 4)});
  const auto n = problem.integer("n", {1, 3});
  problem.constrain("a", sqr(problem.component(x, 0)) == Interval(4.0));
  problem.constrain(
      "b", sqr(problem.component(x, 1) - Interval(1.0)) == Interval(0.0) && problem(n) == Interval(2.0));
  SearchOptions options;
  options.time_limit = time_limit;
  double now = 0;
  options.clock = [&now] { return now += 1; };
  return problem.solve_all(options);
}

TEST(SearchReport, JsonHasEveryBox) {
  const auto json = nlohmann::json::parse(to_json(searched()));
  EXPECT_EQ(json["status"], "solved");
  ASSERT_EQ(json["solutions"].size(), 2U);
  const auto& first = json["solutions"][0];
  EXPECT_EQ(first["certificate"], "none");
  EXPECT_EQ(first["reason"], "singular");
  EXPECT_EQ(first["variables"]["x"]["kind"], "vector");
  EXPECT_LE(first["variables"]["x"]["lo"][0], -2.0);
  EXPECT_EQ(first["variables"]["n"]["lo"], 2);
  EXPECT_TRUE(json["unexplored"].empty());
  EXPECT_LE(json["variables"]["x"]["lo"][0], -2.0);
  EXPECT_GE(json["variables"]["x"]["hi"][0], 2.0);
  EXPECT_GT(json["statistics"]["cells"], 1);
}

TEST(SearchReport, JsonHasWhatALimitLeft) {
  const auto json = nlohmann::json::parse(to_json(searched(1.0)));
  EXPECT_EQ(json["status"], "limit");
  ASSERT_EQ(json["unexplored"].size(), 1U);
  EXPECT_EQ(json["unexplored"][0]["variables"]["x"]["lo"][0], -4.0);
}

TEST(SearchReport, CsvHasARowABox) {
  const std::string csv = to_csv(searched());
  EXPECT_THAT(csv,
              StartsWith("certificate,reason,x[1].lo,x[1].hi,x[2].lo,x[2].hi,n.lo,n.hi\nnone,singular,-2"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_THAT(to_csv(searched(1.0)), HasSubstr("none,unexplored,-4,4"));
}

TEST(SearchReport, PagesTellOfTheBoxes) {
  EXPECT_THAT(to_html(searched(), {}),
              HasSubstr(R"("boxes":2,"unexplored":0,"solutions":[["none","singular",[[)"));
  EXPECT_THAT(to_svg(searched(), {}), HasSubstr("2 boxes, "));
}

}  // namespace
}  // namespace hcsp
