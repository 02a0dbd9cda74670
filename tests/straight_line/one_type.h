// SPDX-License-Identifier: Apache-2.0
// A type, compiled for three joints, and what is expected of its answers.
#pragma once

#include <gtest/gtest.h>

#include "tests/straight_line/library.h"

namespace hcsp::straight_line {

/// A state of the reference, jerk included.
struct Motion {
  double q = 0, w = 0, b = 0, u = 0;
};

/// Of three joints, along rho, with the limits 1, 2, 20 (and 1000); of both states what the type has.
Move on_line(int type, const Motion& from, const Motion& to,
             const std::vector<Number>& rho = {1, -0.5, 0.25});

class OneType : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static int type() { return GetParam(); }
  static bool has(const std::string& vector);
  static Library& library();

  /// Solved, and right: `braking` segments may be beyond the limits, as many as the type brakes in if 0. What
  /// types VI to IX leave open need not be solved.
  static Answer expect_solved(const std::string& name, const Move& move, bool from_within = true,
                              std::size_t braking = 0);
  static void expect_time(const std::string& name, const Move& move, double T);
  /// Refuted, by relations of that name.
  static void expect_infeasible(const std::string& name, const Move& move, const std::string& reason);
};

}  // namespace hcsp::straight_line
