// SPDX-License-Identifier: Apache-2.0
// The verifier verified: it confirms what is so, and nothing that is not.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verifier/certificates.h"
#include "tests/verifier/reader.h"
#include "tests/verifier/tree.h"

namespace hcsp::verifier {
namespace {

const std::string kCircles =
    "model circles;\n"
    "param r : real = 2; // a radius\n"
    "var x : real[2] in [-10, 10]^2;\n"
    "function square(v : real[2]) : real = s where s = sum(i in 1..2) (v[i]^2);\n"
    "constraint first: square(x) == r^2;\n"
    "constraint square(x - (1, 1)) == 1;\n"
    "solve all precision 1e-8;\n";

/// The two solutions: 2 (x + y) == 5 and x^2 + y^2 == 4.
const double kLess = (5 - std::sqrt(7)) / 4, kMore = (5 + std::sqrt(7)) / 4;

Place around(std::initializer_list<double> point, double margin) {
  Place box;
  for (const double x : point) box.emplace_back(x - margin, x + margin);
  return box;
}

std::vector<std::string> complaints(const std::string& model, const std::vector<Claim>& claims) {
  return unconfirmed(read_hcsp(model), claims);
}

std::string model_of(const std::string& items) { return "model m;\n" + items + "\nsolve all;\n"; }

TEST(Verifier, ConfirmsUniqueSolutions) {
  for (const double margin : {1e-15, 1e-8, 1e-3}) {
    const std::vector<Claim> both = {{"unique", around({kLess, kMore}, margin)},
                                     {"unique", around({kMore, kLess}, margin)}};
    EXPECT_TRUE(complaints(kCircles, both).empty()) << margin;
  }
  EXPECT_TRUE(complaints(kCircles, {{"none", around({0, 0}, 1)}}).empty());
}

TEST(Verifier, RefusesABoxWithoutASolution) {
  for (const double shift : {1e-14, 1e-9, 1e-3, 1.0}) {
    EXPECT_EQ(complaints(kCircles, {{"unique", around({kLess + shift, kMore}, 0.1 * shift)}}).size(), 1U)
        << shift;
  }
}

TEST(Verifier, RefusesABoxWithTwoSolutionsAndASolutionInTwoBoxes) {
  EXPECT_EQ(complaints(kCircles, {{"unique", around({1.25, 1.25}, 1)}}).size(), 1U);
  const Claim claim{"unique", around({kLess, kMore}, 1e-8)}, again{"unique", around({kLess, kMore}, 1e-3)};
  EXPECT_EQ(complaints(kCircles, {claim, again}).size(), 1U);
}

TEST(Verifier, RefusesASolutionOutsideOfTheDomainOrOfAnInequality) {
  const Claim claim{"unique", around({std::sqrt(2.0)}, 1e-9)};
  EXPECT_EQ(complaints(model_of("var x : real in [0, 2];\nconstraint x^2 == 2;"), {claim}).size(), 0U);
  EXPECT_EQ(complaints(model_of("var x : real in [0, 1];\nconstraint x^2 == 2;"), {claim}).size(), 1U);
  EXPECT_EQ(complaints(model_of("var x : real in [0, 2];\nconstraint x^2 == 2 and x < 1;"), {claim}).size(),
            1U);
}

TEST(Verifier, RefusesAMultipleRoot) {
  const std::string model = model_of("var x : real in [-1, 1];\nconstraint x^2 == 0;");
  EXPECT_EQ(complaints(model, {{"unique", around({0}, 1e-9)}}).size(), 1U);
}

TEST(Verifier, ConfirmsExistenceForEveryParameter) {
  const std::string circle = model_of("var x, y : real in [-2, 2];\nconstraint x^2 + y^2 == 1;");
  const Place crossing = {Precise(-0.05, 0.05), Precise(0.99, 1.01)};
  EXPECT_TRUE(complaints(circle, {{"exists", crossing}}).empty());
  const Place beside = {Precise(-0.05, 0.05), Precise(1.01, 1.03)};
  EXPECT_EQ(complaints(circle, {{"exists", beside}}).size(), 1U);
  EXPECT_EQ(complaints(circle, {{"unique", crossing}}).size(), 1U);
}

TEST(Verifier, ConfirmsInnerBoxes) {
  const std::string disc = model_of("var x, y : real in [-2, 2];\nconstraint x^2 + y^2 <= 1;");
  EXPECT_TRUE(complaints(disc, {{"inner", around({0, 0}, 0.7)}}).empty());
  EXPECT_EQ(complaints(disc, {{"inner", around({0, 0}, 0.71)}}).size(), 1U);
  EXPECT_EQ(
      complaints(model_of("var x : real in [-4, 4];\nconstraint sqrt(x) < 3;"), {{"inner", around({1}, 2)}})
          .size(),
      1U);
}

TEST(Verifier, ReadsMinibex) {
  const System system = read_minibex(
      "Constants\n r = 2;\nVariables\n x[2] in [-10, 10];\nConstraints\n x(1)^2 + x(2)^2 = r^2;\n"
      "(x(1) - 1)^2 + (x(2) - 1)^2 = 1; // the second\nend\n");
  EXPECT_TRUE(unconfirmed(system, {{"unique", around({kLess, kMore}, 1e-8)}}).empty());
  EXPECT_EQ(unconfirmed(system, {{"unique", around({kLess, kLess}, 1e-8)}}).size(), 1U);
}

TEST(Verifier, ReadsResultFiles) {
  const System system =
      read_hcsp(model_of("var a : array[1..2] of real in [0, 1];\nvar b : real in [0, 1];"));
  const auto claims = claims_of(system, R"({"solutions": [{"certificate": "none", "variables": {
    "b": {"kind": "real", "lo": 0.5, "hi": "oo"},
    "a": {"kind": "array", "items": [{"kind": "real", "lo": 0, "hi": 1}, {"kind": "real", "lo": 2, "hi": 3}]}}}]})");
  ASSERT_EQ(claims.size(), 1U);
  ASSERT_EQ(claims[0].box.size(), 3U);
  EXPECT_TRUE(Precise(2, 3).lies_in(claims[0].box[1]));
  EXPECT_TRUE(Precise(0.5, 1e300).lies_in(claims[0].box[2]));
}

TEST(Verifier, SaysWhatItDoesNotUnderstand) {
  for (const char* items : {"var x : real in [0, 1];\nconstraint x == 0 or x == 1;",
                            "var x : real in [0, 1];\nconstraint gamma(x) == 0;", "time t in [0, 1] step 1;",
                            "var x : real in [0, 1];\nconstraint y == 0;"}) {
    EXPECT_THROW(static_cast<void>(read_hcsp(model_of(items))), Unreadable) << items;
  }
}

TEST(Precise, Encloses) {
  const Precise x(0.25, 0.5);
  for (const double at : {0.25, 0.3, 0.5}) {
    EXPECT_TRUE(Precise(1.0 / at).meets(Precise(1.0) / x));
    EXPECT_TRUE((sin(Precise(at)) * exp(Precise(at))).lies_in(sin(x) * exp(x)));
    EXPECT_TRUE(power(log(Precise(at)), 3).lies_in(power(log(x), 3)));
    EXPECT_TRUE(power(cos(Precise(at)) - 1.0, 2).lies_in(power(cos(x) - 1.0, 2)));
    EXPECT_TRUE((sqrt(Precise(at)) / atan(Precise(at))).lies_in(sqrt(x) / atan(x)));
  }
  EXPECT_TRUE(Precise::decimal("0.1").lies_in(Precise(0.1, std::nextafter(0.1, 1.0))) ||
              Precise::decimal("0.1").lies_in(Precise(std::nextafter(0.1, 0.0), 0.1)));
  EXPECT_FALSE(Precise::decimal("0.1").meets(0.1));
  EXPECT_THROW(Precise(1.0) / Precise(-1.0, 1.0), Undefined);
}

}  // namespace
}  // namespace hcsp::verifier
