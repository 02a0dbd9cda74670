// SPDX-License-Identifier: Apache-2.0
#include "solver/report/html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "solver/report/binary.h"
#include "tests/solver/report/sample_result.h"

namespace hcsp {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string data_text(const std::string& page) {
  const std::string open = R"(<script type="application/json" id="data">)";
  const std::size_t from = page.find(open) + open.size();
  return page.substr(from, page.find("</script>", from) - from);
}

json data_of(const Result& result, const Presentation& presentation = {}) {
  return json::parse(data_text(to_html(result, presentation)));
}

template <class Number>
std::vector<Number> decoded(const std::string& base64) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = (bits << 6U) | static_cast<std::uint32_t>(kDigits.find(c));
    count += 6;
    if (count >= 8) bytes += static_cast<char>((bits >> (count -= 8)) & 0xffU);
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

TEST(Html, IsOnePageWithItsLibrary) {
  const std::string page = to_html(sample::result(), {});
  EXPECT_EQ(page.substr(0, 15), "<!DOCTYPE html>");
  EXPECT_THAT(page, HasSubstr("d3js.org"));  // the notice of the embedded library
  EXPECT_THAT(page, Not(HasSubstr("@SCRIPT@")));
  EXPECT_THAT(page, Not(HasSubstr("@DATA@")));
  for (const char* outside : {"<script src", "<link rel=\"stylesheet\"", "<img", "<iframe", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
}

TEST(Html, FramesArePassesAndTheResult) {
  const json data = data_of(sample::result(), {{"x", "M", "T"}, {}});
  ASSERT_EQ(data.at("frames").size(), 3U);  // the last snapshot is wider than the result
  EXPECT_EQ(data.at("frames").at(0).at("pass"), 0);
  EXPECT_EQ(data.at("frames").at(2).at("pass"), 2);
  EXPECT_EQ(
      data.at("variables").at(0),
      json::parse(
          R"({"name": "x", "kind": "tube", "dim": 2, "line": 0, "wide": false, "drawn": false, "degree": 0})"));
  EXPECT_EQ(data.at("frames").at(2).at("domains").at(1), 0);  // M as in the pass before
  EXPECT_EQ(data.at("frames").at(0).at("domains").at(2), json::parse(R"([[0.1, "oo"]])"));
  EXPECT_EQ(decoded<double>(data.at("lines").at(0)), (std::vector<double>{0.0, 0.1, 0.25, 1.0}));
}

TEST(Html, TubesInFloatStillEnclose) {
  const Result result = sample::result();
  const Tube& tube = std::get<Tube>(result["x"]);
  const json data = data_of(result, {{"x"}, {}});
  const auto values = decoded<float>(data.at("frames").at(2).at("domains").at(0));
  ASSERT_EQ(values.size(), 4 * tube.items());
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t item = 0; item < tube.items(); ++item) {
      const double lo = values[2 * c * tube.items() + item];
      const double hi = values[(2 * c + 1) * tube.items() + item];
      EXPECT_LE(lo, tube.at(c, item).lo());
      EXPECT_GE(hi, tube.at(c, item).hi());
      EXPECT_NEAR(lo, tube.at(c, item).lo(), 1e-6);
      EXPECT_NEAR(hi, tube.at(c, item).hi(), 1e-6);
    }
  }
}

TEST(Html, ThinTubesAreKeptInDouble) {
  Result result = sample::result();
  Tube tube(std::get<Tube>(result["x"]).shared_line(), 1);
  for (std::size_t item = 0; item < tube.items(); ++item) tube.set(0, item, Interval(1e3, 1e3 + 1e-9));
  result.variables = {{"x", tube}};
  result.snapshots.clear();
  const json data = data_of(result);
  EXPECT_TRUE(data.at("variables").at(0).at("wide"));
  EXPECT_EQ(decoded<double>(data.at("frames").at(0).at("domains").at(0)).at(7), 1e3 + 1e-9);
}

TEST(Html, SetsAreBoxesOfCells) {
  const json data = data_of(sample::result(), {{"D"}, {}});
  const json& domain = data.at("frames").at(0).at("domains").at(0);
  EXPECT_EQ(domain.at("background"), "unknown");
  EXPECT_FALSE(domain.at("inside").at("wide"));
  const auto boxes = decoded<std::int16_t>(domain.at("inside").at("boxes"));
  int cells = 0;
  for (std::size_t k = 0; k + 3 < boxes.size(); k += 4)
    cells += (boxes[k + 1] - boxes[k]) * (boxes[k + 3] - boxes[k + 2]);
  EXPECT_EQ(cells, 4);
}

TEST(Html, FloatsRoundOutward) {
  constexpr std::uint64_t kSeed = 20250103;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 100000; ++i) {
    const double value = i % 2 == 0 ? std::bit_cast<double>(random()) : static_cast<double>(random()) * 1e-15;
    if (std::isnan(value)) continue;
    const auto below = static_cast<double>(report::float_below(value));
    const auto above = static_cast<double>(report::float_above(value));
    ASSERT_LE(below, value) << "seed " << kSeed << ", number " << i;
    ASSERT_GE(above, value) << "seed " << kSeed << ", number " << i;
    if (static_cast<double>(static_cast<float>(value)) == value) {
      ASSERT_EQ(below, above);
    } else {
      ASSERT_EQ(std::nextafterf(static_cast<float>(below), static_cast<float>(kInfinity)),
                static_cast<float>(above));
    }
  }
  EXPECT_EQ(report::float_below(kInfinity), static_cast<float>(kInfinity));
  EXPECT_EQ(report::float_below(1e300), std::numeric_limits<float>::max());
  EXPECT_EQ(report::float_above(1e300), static_cast<float>(kInfinity));
}

TEST(Html, EmptyDomainsAndExplanation) {
  Result result = sample::result();
  result.status = Status::infeasible;
  result.explanation = Explanation{"impact", "x", {}, {{"z", 3.4, "room.csv:36"}}, true};
  for (ResultVariable& variable : result.variables) {
    if (variable.name == "x") variable.domain = bottom(std::get<Tube>(variable.domain));
  }
  const json data = data_of(result, {{"x"}, {}});
  EXPECT_TRUE(data.at("frames").at(2).at("domains").at(0).is_null());
  EXPECT_TRUE(data.at("explanation").at("time").is_null());
  EXPECT_EQ(data.at("explanation").at("readings").at(0), json::parse(R"(["z", 3.4, "room.csv:36"])"));
}

TEST(Html, HostileNamesStayData) {
  Result result = sample::result();
  result.model = sample::kHostile;
  for (ResultVariable& variable : result.variables) variable.name += sample::kHostile;
  result.snapshots.clear();
  const std::string page = to_html(result, {});
  EXPECT_THAT(data_text(page), Not(HasSubstr("<")));
  EXPECT_NO_THROW(static_cast<void>(json::parse(data_text(page))));
}

TEST(Html, TruthGoesAlong) {
  const json data = data_of(sample::result(), {{"x"}, Truth{{0.0, 1.0}, {{"x", {{0.0, 0.5}, {1.0, -1.0}}}}}});
  EXPECT_EQ(decoded<double>(data.at("truth").at("t")), (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(decoded<double>(data.at("truth").at("tubes").at("x")),
            (std::vector<double>{0.0, 0.5, 1.0, -1.0}));
}

}  // namespace
}  // namespace hcsp
