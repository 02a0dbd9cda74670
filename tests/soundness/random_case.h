// SPDX-License-Identifier: Apache-2.0
// What the tests on random relations share: domains around a known solution, and looks at the answer.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <string>

#include "solver/problem.h"
#include "tests/soundness/random_relation.h"

namespace hcsp::soundness {

inline int instances(int by_default) {
  const char* value = std::getenv("HCSP_FULL");
  return value != nullptr && std::string(value) == "1" ? 20 * by_default : by_default;
}

// An interval around x: now a point, now with x as a bound, now wide.
inline Interval around(slam_simulator::Random& random, double x) {
  const double below = random.chance(0.3) ? 0 : random.in(0, 1.5),
               above = random.chance(0.3) ? 0 : random.in(0, 1.5);
  if (random.chance(0.03)) return Interval::entire();
  return {x - below, x + above};
}

// Propagates, a twentieth of a second at most: fixed points like that of x == sin(x) are approached for ever.
// What is left then is guaranteed all the same.
inline Result propagate(Problem& problem) {
  PropagationOptions options;
  options.time_limit = 0.05;
  Result result = problem.propagate(options);
  EXPECT_NE(result.status, Status::infeasible);
  return result;
}

inline double some_number(slam_simulator::Random& random) {
  return random.chance(0.2) ? random.integer(-2, 2) : random.in(-3, 3);
}

// |a1| <= 3 and |a2| <= 3.
inline Relation in_box(const VectorExpr& a) {
  return {abs(a[0]) <= Interval(3.0) && abs(a[1]) <= Interval(3.0), [](const Place& place) {
            const bool in = abs(place.a[0]).hi() <= 3 && abs(place.a[1]).hi() <= 3;
            return in ? Truth::yes : Truth::no;
          }};
}

inline Truth unite(Truth a, Truth b) { return !(!a && !b); }

inline void expect_set(const SetInterval& set, slam_simulator::Random& random,
                       const std::function<Truth(const Interval&, const Interval&)>& holds) {
  for (int i = 0; i < 200; ++i) {
    const double point[2] = {random.chance(0.2) ? random.integer(-8, 8) * 0.5 : random.in(-4, 4),
                             random.chance(0.2) ? random.integer(-8, 8) * 0.5 : random.in(-4, 4)};
    const Truth in = holds(point[0], point[1]);
    const CellState state = set.at(point);
    if (in == Truth::yes) {
      ASSERT_TRUE(state == CellState::unknown || state == CellState::inside) << point[0] << ", " << point[1];
    }
    if (in == Truth::no) {
      ASSERT_TRUE(state == CellState::unknown || state == CellState::outside) << point[0] << ", " << point[1];
    }
  }
}

}  // namespace hcsp::soundness
