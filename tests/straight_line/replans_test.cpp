// SPDX-License-Identifier: Apache-2.0
// Plans made again on the way, as a control loop does: each begins on a limit, or at the end of a phase, as
// often as not, and is as little work as the first.
#include <gtest/gtest.h>

#include "tests/straight_line/library.h"
#include "tests/straight_line/random_move.h"

namespace hcsp::straight_line {
namespace {

// Where the motion is at an instant, to the same target, on the same line.
Move on_from(const Library& library, const Answer& answer, const Move& move, double time) {
  Move next = move;
  const State now = library.state_at(time);
  next.p0 = library.positions_at(time);
  next.line.clear();
  for (std::size_t k = 0; k < move.joints(); ++k) {
    next.line.push_back(answer.rho[k].middle());
    next.v0[k] = next.line[k] * static_cast<double>(now.w);
    next.a0[k] = next.line[k] * static_cast<double>(now.b);
  }
  return next;
}

class Replans : public ::testing::TestWithParam<int> {};

TEST_P(Replans, AlongAMotionTakeFewBoxes) {
  constexpr unsigned kMoves = 12;
  constexpr int kInstants = 16;
  constexpr std::size_t kFew = 40;
  Library library(GetParam());
  for (unsigned seed = 1; seed <= kMoves; ++seed) {
    Draw draw(seed);
    const Move move = random_move(draw, GetParam(), Kind::moving).move;
    for (int instant = 1; instant < kInstants; ++instant) {
      library.compiled().forget();
      const Answer answer = library.solve(move);
      ASSERT_EQ(answer.status, "solved") << move.text();
      const Move next = on_from(library, answer, move, answer.T.lo * instant / kInstants);
      ASSERT_EQ(library.solve(next).status, "solved") << next.text();
      EXPECT_LE(library.compiled().boxes(), kFew) << next.text();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Types, Replans, ::testing::Values(3, 4, 5));

}  // namespace
}  // namespace hcsp::straight_line
