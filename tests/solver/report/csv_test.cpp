// SPDX-License-Identifier: Apache-2.0
#include "solver/report/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/solver/report/sample_result.h"

namespace hcsp {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Csv, OneRowAGateAndASlice) {
  Result result = sample::result();
  result.variables = {result.variables[0], result.variables[2], result.variables[3],
                      result.variables[4]};  // T x z M
  const std::vector<std::string> lines = lines_of(to_csv(result));
  ASSERT_EQ(lines.size(), 1U + 7U);
  EXPECT_EQ(lines[0], "t_lo,t_hi,T.lo,T.hi,x[1].lo,x[1].hi,x[2].lo,x[2].hi,z.lo,z.hi");
  EXPECT_EQ(lines[1], "0,0,0.1,oo,-0.125,0.125,-0.125,0.125,-oo,oo");
  EXPECT_EQ(lines[2].substr(0, 6), "0,0.1,");
  EXPECT_EQ(lines[3].substr(0, 8), "0.1,0.1,");
  EXPECT_THAT(lines[3], testing::EndsWith(",1.5,1.75"));
  EXPECT_EQ(lines[7].substr(0, 4), "1,1,");
}

TEST(Csv, EmptyDomainsAreBlank) {
  Result result = sample::result();
  result.variables = {
      {"x", bottom(std::get<Tube>(result["x"]))}, {"a", Interval::empty()}, {"b", Interval(2.0)}};
  const std::vector<std::string> lines = lines_of(to_csv(result));
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[1], "0,0,,,,,,,2,2");
}

TEST(Csv, WithoutATubeThereIsOneRow) {
  Result result;
  result.variables = {{"v", Box{Interval(0.1, 0.2)}}, {"T", Interval(-1.0, kInfinity)}};
  EXPECT_EQ(to_csv(result), "v[1].lo,v[1].hi,T.lo,T.hi\n0.1,0.2,-1,oo\n");
}

}  // namespace
}  // namespace hcsp
