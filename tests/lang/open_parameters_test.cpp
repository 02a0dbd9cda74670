// SPDX-License-Identifier: Apache-2.0
// Parameters that stay open when a model is compiled, and those that its structure keeps closed.
#include <gtest/gtest.h>

#include "corpus.h"
#include "lang/check/structure.h"

namespace hcsp::lang {
namespace {

Compilation compiled(const std::string& items) {
  CompileOptions options;
  options.open_parameters = true;
  return compile_as("open.hcsp", whole_model(items), options);
}

std::set<std::string> open_in(const std::string& items) {
  const Compilation compilation = compiled(items);
  EXPECT_EQ(compilation.diagnostics.text(), "");
  std::set<std::string> names;
  for (const std::string_view name : parameters_without_structure(*compilation.tree)) names.emplace(name);
  return names;
}

TEST(OpenParameters, AreThoseThatStructureDoesNotNeed) {
  const std::set<std::string> open = open_in(R"(
    param n : int = 2;
    param size = 3;
    param twice = 2*size;
    param power = 2;
    param span = 5;
    param way : real[n] = (1, 2);
    param high : real[n] = 2*way;
    param low : real[n] = -high;
    param truth : bool = true;
    param matrix : real[2, 2] = ((1, 2), (3, 4));
    param fine = 0.01;
    param which = 1;
    param free = 4;
    function scaled(x : real, k : real) : real = sum(i in 1..k) (i*x);
    var x : real[twice] in [-span, span]^twice;
    constraint forall(k in 1..n) low[k] <= x[k] and x[k]^power <= high[k] + way[which]*free;
    constraint scaled(x[1], size) >= 0;
    constraint matrix[1, 1]*x[1] >= fine;)");
  EXPECT_EQ(open, (std::set<std::string>{"way", "high", "low", "fine", "free"}));
}

TEST(OpenParameters, HaveValuesAndFollowOthers) {
  Compilation compilation = compiled(R"(
    param high = 4;
    param low = -high;
    param point : real[2] = (high, 0.5);
    var x : real in [-100, 100];
    constraint low <= x and x <= high;
    constraint x*x == point[1] and x >= 0;)");
  ASSERT_EQ(compilation.diagnostics.text(), "");
  const Result result = compilation.model->problem->solve_all();
  ASSERT_EQ(result.search->solutions.size(), 1U);
  EXPECT_EQ(result.search->solutions[0].certificate, Certificate::unique);
  EXPECT_TRUE(std::get<Interval>(result["x"]).contains(2.0));
  EXPECT_EQ(std::get<Interval>(result["low"]), Interval(-4.0));
  EXPECT_EQ(std::get<Box>(result["point"])[0], Interval(4.0));
}

TEST(OpenParameters, FollowNoUnknowns) {
  const Compilation compilation =
      compiled("var x : real in [0, 1];\nparam twice = 2*x;\nconstraint twice >= 1;");
  EXPECT_NE(compilation.diagnostics.text().find("error[E114]"), std::string::npos);
}

}  // namespace
}  // namespace hcsp::lang
