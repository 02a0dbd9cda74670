// SPDX-License-Identifier: Apache-2.0
// What a model means: the domains that its Problem propagates to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>

#include "corpus.h"

namespace hcsp::lang {
namespace {

Result solved(const std::string& items, const CompileOptions& options = {}) {
  Compilation compilation = compile_as("data/model.hcsp", whole_model(items), options);
  EXPECT_EQ(compilation.diagnostics.text(), "") << items;
  return compilation.model ? compilation.model->problem->propagate() : Result{};
}

const Interval& real(const Result& result, std::string_view name) { return std::get<Interval>(result[name]); }
const Tube& tube(const Result& result, std::string_view name) { return std::get<Tube>(result[name]); }

void expect_tight(const Interval& found, double value, double width = 1e-12) {
  EXPECT_TRUE(found.contains(value)) << to_string(found);
  EXPECT_LE(found.width(), width) << to_string(found);
}

TEST(Compile, EvaluatesExpressions) {
  const auto value = [](const std::string& expression) {
    return real(solved("var x : real;\nparam three = 3;\nfunction f(a : real, b : real) : real = a - b;\n"
                       "constraint x == " +
                       expression + ";"),
                "x");
  };
  expect_tight(value("1 + 2*three^2 - 4/8"), 18.5);
  expect_tight(value("f(1, 2) - -f(three, 1)"), 1);
  expect_tight(value("(1, 2, 3)[2] + dot((1, 2), (3, 4))"), 13);
  expect_tight(value("norm((3, 4)) + sum((1, 2)) + prod((2, 3)) + min(2, 1, 3) + max((1, 5))"),
               5 + 3 + 6 + 1 + 5);
  expect_tight(value("sqr(3) + sqrt(16) + abs(-2) + sin(0) + cos(0) + atan2(0, 1)"), 16);
  expect_tight(value("2^10 + 2^-1 + (-2)^3 + 5^0"), 1024 + 0.5 - 8 + 1);
  expect_tight(value("if 1 < 2 then 3 else 4 endif"), 3);
  expect_tight(value("pi"), 3.141592653589793);
}

// Literals are exact: one tenth is no double, and the sum of two of them is two tenths.
TEST(Compile, KeepsDecimalsExact) {
  const Interval tenths = real(solved("var x : real in [0.1, 0.1 + 0.2];"), "x");
  EXPECT_EQ(tenths.lo(), Interval::of_decimal("0.1").lo());
  EXPECT_EQ(tenths.hi(), Interval::of_decimal("0.3").hi());
}

TEST(Compile, PowersOfAnUnknownAreTight) {
  const Result result = solved(
      "var x : real in [-2, 1];\nvar y, z, w : real;\n"
      "constraint y == x^2;\nconstraint z == x^4;\nconstraint w == x^3;");
  EXPECT_EQ(real(result, "y"), Interval(0, 4));
  EXPECT_EQ(real(result, "z"), Interval(0, 16));
  EXPECT_LE(real(result, "w").lo(), -8);
  EXPECT_GE(real(result, "w").hi(), 1);
}

TEST(Compile, AParameterWithADomainIsOneUnknown) {
  const Result result =
      solved("param p = [1, 2];\nvar x : real;\nconstraint x == p - p;\nconstraint p >= 1.5;");
  EXPECT_TRUE(real(result, "x").contains(0));
  EXPECT_EQ(real(result, "p"), Interval(1.5, 2));
}

TEST(Compile, MembershipAndRelationsOfVectors) {
  const Result result =
      solved("var p : real[2];\nconstraint p in ([0, 1], 2 +- 0.5);\nconstraint p >= (0.5, 2);");
  const Box& p = std::get<Box>(result["p"]);
  EXPECT_EQ(p[0], Interval(0.5, 1));
  EXPECT_EQ(p[1], Interval(2, 2.5));
}

TEST(Compile, TheSidesOfAnEquationAreEqual) {
  const std::string head = "time t in [0, 1] step 0.25;\nvar x : tube real;\nconstraint x(0) == 1;\n";
  const Tube left = tube(solved(head + "constraint der(x) == -x;\nconstraint x in [0, 2];"), "x");
  const Tube right =
      tube(solved(head + "constraint -x == der(x);\nconstraint forall(t) (x in [0, 2]);"), "x");
  EXPECT_TRUE(left == right);
  EXPECT_TRUE(left.gate(0, 4).contains(0.36787944117144233));
  EXPECT_LT(left.gate(0, 4).width(), 1.5);
}

TEST(Compile, TimeAndInstants) {
  const Result result = solved(
      "time t in [0, 1] step 0.5;\nvar x, y : tube real;\nvar a : real;\n"
      "constraint x == 2*t;\nconstraint a == (x + 1)(0.3);\nconstraint y(0.3) == t(0.3);");
  expect_tight(real(result, "a"), 1.6);
  EXPECT_EQ(tube(result, "x").line().instants(), (std::vector<double>{0, 0.3, 0.5, 1}));
  expect_tight(tube(result, "y").gate(0, 1), 0.3);
  EXPECT_TRUE(tube(result, "y").gate(0, 2).is_entire());
}

TEST(Compile, SetsOfTheTwoForms) {
  const std::string head =
      "time t in [0, 1] step 0.5;\nvar x : tube real[2] in [-0.1, 0.1]^2;\n"
      "given z : tube real = 2 +- 0.1;\nvar M : set real[2] in [-5, 5]^2 precision 0.25;\n";
  const Result one = solved(head + "constraint z(t) == distance(x(t), M);");
  const Result other = solved(head + "constraint min(p in M) (norm(p - x(t))) == z(t);");
  const Result four = solved(head +
                             "var D : set real[2] precision 0.25;\n"
                             "constraint D == union(t) { a | norm(a - x(t)) < z(t) };\n"
                             "constraint disjoint(M, D);\n"
                             "constraint meets(M, { a | norm(a - x(t)) == z(t) });");
  const auto& set = [](const Result& result) { return std::get<SetInterval>(result["M"]); };
  EXPECT_LT(set(one).upper_volume(), 100);
  EXPECT_EQ(set(one).upper_volume(), set(other).upper_volume());
  EXPECT_EQ(set(one).boxes(CellState::unknown), set(four).boxes(CellState::unknown));
  EXPECT_TRUE(tube(one, "x") == tube(four, "x"));
}

TEST(Compile, NamesConstraints) {
  Compilation compilation = compile_as(
      "data/model.hcsp",
      "model m;\ntime t in [0, 1] step 0.5;\nvar x : tube real;\nvar a : real;\n"
      "constraint both: der(x) == 1 and x(0) == 0;\nconstraint a >= 0; constraint a <= 1;\nsolve propagate;");
  ASSERT_EQ(compilation.diagnostics.text(), "");
  std::vector<std::string> names;
  for (const auto& contractor : compilation.model->problem->propagate().statistics.contractors) {
    names.push_back(contractor.name);
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"both", "both.2", "line 6", "line 6:31"}));
}

TEST(Compile, DoesNotDependOnTheRoundingModeOfTheCaller) {
  const std::string items =
      "data log = csv(\"log.csv\");\ntime t in [0, last(log.t)] step 0.1;\n"
      "given z : tube real = sampled(log.t, 2*log.range/3) +- 0.1;";
  const Tube nearest = tube(solved(items), "z");
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const Tube other = tube(solved(items), "z");
    const int left = std::fegetround();
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(left, mode);
    EXPECT_TRUE(nearest.line().instants() == other.line().instants());
    for (std::size_t item = 0; item < nearest.items(); ++item)
      EXPECT_EQ(nearest.at(0, item), other.at(0, item));
  }
}

}  // namespace
}  // namespace hcsp::lang
