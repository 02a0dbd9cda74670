// SPDX-License-Identifier: Apache-2.0
#include "solver/report/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solver/report/svg_parts.h"
#include "tests/solver/report/sample_result.h"
#include "tests/solver/report/well_formed.h"

namespace hcsp {
namespace {

using testing::HasSubstr;
using testing::Not;

void expect_sound(const std::string& svg) {
  EXPECT_EQ(sample::xml_error(svg), "");
  EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 "));
  for (const char* text : {"nan", "inf", "NaN"}) EXPECT_THAT(svg, Not(HasSubstr(std::string(" ") + text)));
}

TEST(Svg, ShowsSetsTubesAndTruth) {
  Presentation presentation{{"x", "D", "M"}, Truth{{0.0, 1.0}, {{"x", {{0.0, 0.0}, {1.0, -1.0}}}}}};
  const std::string svg = to_svg(sample::result(), presentation);
  expect_sound(svg);
  for (const char* text : {"D inside", "M inside", "M unknown", "true x", "width of x", "x[2]", "sample"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(svg, Not(HasSubstr("width of z")));
}

TEST(Svg, ShowsEverythingWhenNothingIsNamed) {
  const std::string svg = to_svg(sample::result(), {});
  expect_sound(svg);
  EXPECT_THAT(svg, HasSubstr("width of z"));
}

TEST(Svg, StaysFiniteWithoutBounds) {
  Result result = sample::result();
  result.variables = {{"x", top(std::get<Tube>(result["x"]))}, {"D", SetInterval(2, 0.5)}};
  result.snapshots.clear();
  expect_sound(to_svg(result, {}));
}

TEST(Svg, OfAResultWithNothingToDraw) {
  Result result;
  expect_sound(to_svg(result, {}));
  result = sample::result();
  result.status = Status::infeasible;
  result.explanation = Explanation{"impact", "x", std::array{3.4, 3.5}, {}, true};
  result.variables = {{"x", bottom(std::get<Tube>(result["x"]))}, {"M", bottom(sample::bounded_set())}};
  const std::string svg = to_svg(result, {});
  expect_sound(svg);
  EXPECT_THAT(svg, HasSubstr("constraint impact leaves no value for x"));
}

TEST(Svg, HostileNamesAreEscaped) {
  Result result = sample::result();
  result.model = sample::kHostile;
  for (ResultVariable& variable : result.variables) variable.name += sample::kHostile;
  const std::string svg = to_svg(result, {});
  expect_sound(svg);
  EXPECT_THAT(svg, Not(HasSubstr("</script>")));
}

TEST(Svg, TicksAreRoundAndInRange) {
  EXPECT_THAT(report::ticks(0.0, 10.0, 5), testing::ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  EXPECT_THAT(report::ticks(-0.3, 0.6, 4),
              testing::ElementsAre(testing::DoubleNear(-0.2, 1e-12), 0.0, testing::DoubleNear(0.2, 1e-12),
                                   testing::DoubleNear(0.4, 1e-12), testing::DoubleNear(0.6, 1e-12)));
  EXPECT_FALSE(std::signbit(report::ticks(0.0, 1.0, 5).front()));
  EXPECT_TRUE(report::ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(report::ticks(0.0, kInfinity, 5).empty());
}

}  // namespace
}  // namespace hcsp
