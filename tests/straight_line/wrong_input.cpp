// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/wrong_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hcsp::straight_line {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInfinity = std::numeric_limits<double>::infinity();

class Wrong {
 public:
  Wrong(Library& library, const Move& good) : library_(library), good_(good) {}

  /// One parameter as given, the others good.
  void expect(const std::string& name, const Vector& values, OnlineStatus status, const std::string& reason) {
    SCOPED_TRACE(name + " = " + ::testing::PrintToString(values));
    EXPECT_EQ(library_.solve(good_).status, "solved");
    CompiledProblem& problem = library_.compiled();
    const bool fits = problem.set(problem.parameter(name), values);
    EXPECT_EQ(fits, status != OnlineStatus::invalid);
    EXPECT_EQ(problem.solve(), status);
    EXPECT_EQ(problem.status(), status);
    EXPECT_THAT(std::string(problem.reason()), ::testing::MatchesRegex(reason));
    EXPECT_FALSE(problem.has_solution());
  }
  void expect_invalid(const std::string& name) {
    const Vector* values = good_.parameter(name);
    for (const double x : {kNan, kInfinity, -kInfinity}) {
      Vector wrong = *values;
      wrong[1] = x;
      expect(name, wrong, OnlineStatus::invalid, name);
    }
    expect(name, {}, OnlineStatus::invalid, name);
    expect(name, {0, 0}, OnlineStatus::invalid, name);
    expect(name, {0, 0, 0, 0}, OnlineStatus::invalid, name);
  }
  void expect_infeasible(const std::string& name, const Vector& values, const std::string& reason) {
    if (good_.parameter(name) != nullptr) expect(name, values, OnlineStatus::infeasible, reason);
  }

 private:
  Library& library_;
  const Move& good_;
};

}  // namespace

void expect_told(Library& library, const Move& good) {
  Wrong wrong(library, good);
  for (const auto& names : {vectors_of(good.type), limits_of(good.type)}) {
    for (const std::string& name : names) wrong.expect_invalid(name);
  }
  wrong.expect("tol", {kNan}, OnlineStatus::invalid, "tol");
  wrong.expect("tol", {-1}, OnlineStatus::infeasible, "limits.*");
  wrong.expect("line", {1, 1, 1}, OnlineStatus::infeasible, "line_.*");
  wrong.expect_infeasible("vmax", {1, -1, 1}, "limits.*");
  wrong.expect_infeasible("vmin", {-1, -1, 0.5}, "limits.*");
  wrong.expect_infeasible("vmin", {-1, -1, 2}, "limits.*");  // above the maximum
  wrong.expect_infeasible("amax", {2, 2, -2}, "limits.*");
  wrong.expect_infeasible("amax", {2, 2, 0}, "limits.*");
  wrong.expect_infeasible("amin", {-2, 1, -2}, "limits.*");
  wrong.expect_infeasible("amin", {0, -2, -2}, "limits.*");
  wrong.expect_infeasible("jmax", {20, -20, 20}, "limits.*");
  wrong.expect_infeasible("jmax", {0, 20, 20}, "limits.*");
  wrong.expect_infeasible("jmin", {-20, -20, 0}, "limits.*");
  wrong.expect_infeasible("dmax", {1000, -1000, 1000}, "limits.*");
  wrong.expect_infeasible("dmax", {1000, 1000, 0}, "limits.*");
  wrong.expect_infeasible("v0", {0.1, 0.1, 0.1}, ".*v0.*[[][123], [123][]]");
  EXPECT_EQ(library.solve(good).status, "solved");
  CompiledProblem& problem = library.compiled();
  for (const double x : {1e300, 1e-300, -1e300}) {  // whatever comes of it
    problem.set(problem.parameter("p1"), Vector{x, -x / 2, x / 4});
    EXPECT_NE(problem.solve(), OnlineStatus::invalid);
  }
  EXPECT_EQ(library.solve(good).status, "solved");
}

}  // namespace hcsp::straight_line
