// SPDX-License-Identifier: Apache-2.0
// The shipped models on what is known of them: optima from the literature, and with other numbers of joints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/straight_line/enumerator.h"
#include "tests/straight_line/library.h"
#include "tests/straight_line/random_move.h"

namespace hcsp::straight_line {
namespace {

Move first_case(int type) { return from_rest(type, {1, 2, 0.5}, {1, 1, 1}, {2, 2, 2}, {20, 20, 20}); }

void expect_optimum(Library& library, const Move& move, double T) {
  const Answer answer = library.solve(move);
  ASSERT_EQ(answer.status, "solved") << answer.reason;
  EXPECT_LE(answer.bracket.lo, T);
  EXPECT_GE(answer.bracket.hi, T);
  EXPECT_LE(answer.bracket.hi - answer.bracket.lo, 1e-9);
  EXPECT_THAT(faults(move, answer), ::testing::IsEmpty());
}

TEST(Shipped, KnownOptima) {
  for (int type = 1; type <= 5; ++type) {
    SCOPED_TRACE(type);
    Library three(type, 3);
    expect_optimum(three, first_case(type), type <= 2 ? 2.5 : 2.6);
  }
  Library two(3, 2);  // V = 1, J = 20; A is not reached
  expect_optimum(two, from_rest(3, {1, 1}, {1, 10}, {50, 50}, {1000, 20}), 1 + std::sqrt(0.2));
}

// One joint or many; what the others do is a multiple.
TEST(Shipped, AnyNumberOfJoints) {
  for (const std::size_t joints : {1U, 9U}) {
    Library library(4, joints);
    run_cases(20, 1000, [&](Draw& draw) {
      const KnownMove known = random_move(draw, 4, Kind::moving, joints);
      SCOPED_TRACE(known.move.text());
      const Answer answer = library.solve(known.move);
      ASSERT_EQ(answer.status, "solved") << answer.reason;
      EXPECT_THAT(faults(known.move, answer), ::testing::IsEmpty());
    });
  }
}

}  // namespace
}  // namespace hcsp::straight_line
