// SPDX-License-Identifier: Apache-2.0
#include "solver/report/trace.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/solver/report/sample_result.h"

namespace hcsp {
namespace {

using nlohmann::json;

TEST(Trace, SaysWhatEachContractorRemoved) {
  Result result = sample::result();
  result.trace = {
      {1,
       "evolution",
       "x",
       kInfinity,
       0.5,
       {{{0.0, 0.1}, {Interval(), Interval(0.0, 1.0)}, {Interval(-1.0, 1.0), Interval::empty()}}}},
      {2, sample::kHostile, "M", 3.0, 2.5, {}}};
  const json file = json::parse(trace_json(result));
  EXPECT_EQ(file.at("model"), "sample");
  ASSERT_EQ(file.at("trace").size(), 2U);
  EXPECT_EQ(file.at("trace").at(0), json::parse(R"({"pass": 1, "contractor": "evolution", "variable": "x",
      "before": "oo", "after": 0.5,
      "changes": [{"time": [0, 0.1], "before": [["-oo", "oo"], [0, 1]], "after": [[-1, 1], null]}]})"));
  EXPECT_EQ(file.at("trace").at(1).at("changes"), json::array());
}

TEST(Trace, OfNothing) { EXPECT_EQ(json::parse(trace_json(Result{})).at("trace"), json::array()); }

}  // namespace
}  // namespace hcsp
