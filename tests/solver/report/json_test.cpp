// SPDX-License-Identifier: Apache-2.0
#include "solver/report/json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/solver/report/sample_result.h"

namespace hcsp {
namespace {

using nlohmann::json;

json parsed(const Result& result) { return json::parse(to_json(result)); }

TEST(Json, HeadAndStatistics) {
  const json file = parsed(sample::result());
  EXPECT_FALSE(file.at("hcsp").get<std::string>().empty());
  EXPECT_EQ(file.at("model"), "sample");
  EXPECT_EQ(file.at("status"), "contracted");
  EXPECT_FALSE(file.contains("explanation"));
  const json& statistics = file.at("statistics");
  EXPECT_EQ(statistics.at("seconds"), 0.25);
  EXPECT_EQ(statistics.at("passes"), 2);
  EXPECT_EQ(statistics.at("threads"), 1);
  EXPECT_EQ(
      statistics.at("contractors"),
      json::parse(
          R"({"evolution": {"calls": 3, "seconds": 0.125}, "impact": {"calls": 4, "seconds": 0.0625}})"));
}

TEST(Json, ContractorsOfOneNameAreOneEntry) {
  Result result = sample::result();
  result.statistics.contractors.push_back({"evolution", 2, 0.5});
  const json file = parsed(result);
  EXPECT_EQ(file.at("statistics").at("contractors").at("evolution"),
            json::parse(R"({"calls": 5, "seconds": 0.625})"));
}

TEST(Json, RealsVectorsAndEmptyDomains) {
  const json variables = parsed(sample::result()).at("variables");
  EXPECT_EQ(variables.size(), 7U);
  EXPECT_EQ(variables.at("T"), json::parse(R"({"kind": "real", "lo": 0.1, "hi": "oo"})"));
  EXPECT_EQ(variables.at("v"), json::parse(R"({"kind": "vector", "lo": [-1, "-oo"], "hi": [2, 1e300]})"));
  EXPECT_TRUE(variables.at("nothing").is_null());
}

TEST(Json, EveryKindOfEmptyDomainIsNull) {
  Result result = sample::result();
  result.variables = {{"a", Interval::empty()},
                      {"b", bottom(Box(2))},
                      {"x", bottom(std::get<Tube>(result["x"]))},
                      {"M", bottom(sample::bounded_set())}};
  const json variables = parsed(result).at("variables");
  for (const char* name : {"a", "b", "x", "M"}) EXPECT_TRUE(variables.at(name).is_null()) << name;
}

TEST(Json, TubesHaveGatesAndSlices) {
  const Result result = sample::result();
  const json file = parsed(result).at("variables");
  const json& x = file.at("x");
  const Tube& tube = std::get<Tube>(result["x"]);
  EXPECT_EQ(x.at("kind"), "tube");
  EXPECT_EQ(x.at("dim"), 2);
  EXPECT_EQ(x.at("time").get<std::vector<double>>(), tube.line().instants());
  ASSERT_EQ(x.at("gates").at("lo").size(), 4U);
  ASSERT_EQ(x.at("slices").at("hi").size(), 3U);
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(x.at("gates").at("lo").at(i).at(c), tube.gate(c, i).lo());
      EXPECT_EQ(x.at("gates").at("hi").at(i).at(c), tube.gate(c, i).hi());
    }
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(x.at("slices").at("lo").at(k).at(c), tube.slice(c, k).lo());
      EXPECT_EQ(x.at("slices").at("hi").at(k).at(c), tube.slice(c, k).hi());
    }
  }
  EXPECT_EQ(file.at("z").at("gates").at("lo"), json::parse(R"([["-oo"], [1.5], ["-oo"], ["-oo"]])"));
  EXPECT_EQ(file.at("z").at("slices").at("hi"), json::parse(R"([["oo"], ["oo"], ["oo"]])"));
}

// The area of a list of boxes.
double area(const json& boxes) {
  double sum = 0.0;
  for (const json& box : boxes) {
    sum += (box.at(1).get<double>() - box.at(0).get<double>()) *
           (box.at(3).get<double>() - box.at(2).get<double>());
  }
  return sum;
}

TEST(Json, SetsHaveBoxesAndVolume) {
  const json variables = parsed(sample::result()).at("variables");
  const json& bounded = variables.at("M");
  EXPECT_EQ(bounded.at("kind"), "set");
  EXPECT_EQ(bounded.at("dim"), 2);
  EXPECT_EQ(bounded.at("precision"), 0.5);
  EXPECT_EQ(bounded.at("background"), "outside");
  EXPECT_EQ(area(bounded.at("inside")), 1.0);
  EXPECT_EQ(area(bounded.at("unknown")), 3.0);
  EXPECT_EQ(bounded.at("volume"), json::parse(R"({"lower": 1, "upper": 4})"));
  const json& unbounded = variables.at("D");
  EXPECT_EQ(unbounded.at("background"), "unknown");
  EXPECT_EQ(area(unbounded.at("inside")), 1.0);
  EXPECT_EQ(unbounded.at("volume"), json::parse(R"({"lower": 1, "upper": "oo"})"));
}

TEST(Json, ExplanationNamesInstantsInOrder) {
  Result result = sample::result();
  result.status = Status::infeasible;
  result.explanation = Explanation{"impact",
                                   "x",
                                   std::array{3.4, 3.5},
                                   {{"z", 3.4, "room.csv:36"}, {"z", 0.5, ""}, {"y", 3.4, ""}},
                                   false};
  const json file = parsed(result);
  EXPECT_EQ(file.at("status"), "infeasible");
  EXPECT_EQ(file.at("explanation"),
            json::parse(R"({"constraint": "impact", "variable": "x", "time": [3.4, 3.5],
      "support": [0.5, 3.4], "support_is_complete": false,
      "readings": [{"variable": "z", "time": 3.4, "source": "room.csv:36"}, {"variable": "z", "time": 0.5, "source": ""},
                   {"variable": "y", "time": 3.4, "source": ""}]})"));
  result.explanation->time.reset();
  EXPECT_FALSE(parsed(result).at("explanation").contains("time"));
}

TEST(Json, EveryDoubleReadsBackAsItself) {
  constexpr std::uint64_t kSeed = 20250101;
  std::mt19937_64 random(kSeed);
  const auto count = std::size_t{20000};
  Box box(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    double value = std::bit_cast<double>(random());
    if (i % 7 == 0) value = static_cast<double>(i) * 0.05;           // short decimals, again and again
    if (i % 7 == 1) value = std::bit_cast<double>(random() >> 12U);  // denormal
    box[static_cast<Eigen::Index>(i)] = Interval(std::isfinite(value) ? value : -0.0);
  }
  Result result;
  result.variables = {{"v", box}};
  const json lo = parsed(result).at("variables").at("v").at("lo");
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(lo.at(i).get<double>(), box[static_cast<Eigen::Index>(i)].lo())
        << "seed " << kSeed << ", number " << i;
  }
}

TEST(Json, LongArraysOfTubesReadBackToo) {
  constexpr std::uint64_t kSeed = 20250102;
  std::mt19937_64 random(kSeed);
  std::vector<double> instants;
  for (int i = 0; i <= 5000; ++i) instants.push_back(1.7e9 + 0.1 * i);
  Tube tube(std::make_shared<const TimeLine>(instants), 1);
  for (std::size_t item = 0; item < tube.items(); ++item) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) tube.set(0, item, Interval(value));
  }
  Result result;
  result.variables = {{"x", tube}};
  const json x = parsed(result).at("variables").at("x");
  EXPECT_EQ(x.at("time").get<std::vector<double>>(), instants);
  for (std::size_t k = 0; k < tube.line().slices(); ++k) {
    const json& lo = x.at("slices").at("lo").at(k).at(0);
    const double read = lo.is_string() ? -kInfinity : lo.get<double>();
    ASSERT_EQ(read, tube.slice(0, k).lo()) << "seed " << kSeed << ", slice " << k;
  }
}

TEST(Json, HostileNamesAreEscaped) {
  Result result = sample::result();
  result.model = sample::kHostile;
  result.variables = {{sample::kHostile, Interval(1.0)}};
  result.statistics.contractors = {{sample::kHostile, 1, 0.0}};
  const json file = parsed(result);
  const std::string expected = sample::kHostile.substr(0, sample::kHostile.size() - 1) + "\xef\xbf\xbd";
  EXPECT_EQ(file.at("model"), expected);
  EXPECT_TRUE(file.at("variables").contains(expected));
  EXPECT_TRUE(file.at("statistics").at("contractors").contains(expected));
}

TEST(Json, TextOfOtherLanguagesIsKept) {
  Result result;
  result.model = "carte \xc3\xa9t\xc3\xa9 \xe5\x9c\xb0\xe5\x9b\xb3 \xf0\x9f\xa4\x96";
  EXPECT_EQ(parsed(result).at("model"), result.model);
}

}  // namespace
}  // namespace hcsp
