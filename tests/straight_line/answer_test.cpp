// SPDX-License-Identifier: Apache-2.0
// The checks of answers, on answers that the oracle makes: nothing is wrong with them, and something is as
// soon as a number of theirs is.
#include "tests/straight_line/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/straight_line/collinear.h"
#include "tests/straight_line/enumerator.h"
#include "tests/straight_line/random_move.h"

namespace hcsp::straight_line {
namespace {

std::size_t braking_phases(const KnownMove& known) {
  const Limits l = limits_on(known.line.rho, known.move);
  if (known.move.type <= 2) return known.line.from.w < l.wl || known.line.from.w > l.wh ? 1 : 0;
  return braking(known.line.from, l).phases.size();
}

TEST(Answer, OfTheOracleIsRight) {
  run_cases(5, 500, [](Draw& draw) {
    for (int type = 1; type <= 5; ++type) {
      for (const Kind kind : kKinds) {
        const KnownMove known = random_move(draw, type, kind);
        SCOPED_TRACE(to_string(kind) + " " + known.move.text());
        const std::optional<Profile> profile = fastest_along(known.line, known.move);
        ASSERT_TRUE(profile);
        if (profile->phases.empty()) continue;
        Answer answer = answer_of(known.move, known.line, *profile);
        answer.braking = braking_phases(known);
        EXPECT_THAT(faults(known.move, answer), ::testing::IsEmpty()) << profile->word;
      }
    }
  });
}

void spoil(Span& span) {
  const double by = 1e-5 * std::max(0.1, std::abs(span.middle()));
  span.lo += by;
  span.hi += by;
}

// Re-planning in mid-motion: from there to the old target takes what was left, and to a new one there is a
// way.
TEST(Answer, AfterAReplanIsRight) {
  run_cases(30, 3000, [](Draw& draw) {
    const KnownMove known = random_move(draw, draw.integer(3, 5), kKinds[draw.integer(0, 3)]);
    SCOPED_TRACE(known.move.text());
    const Profile profile = fastest_along(known.line, known.move).value();
    const Number time = profile.duration() * draw.in(0, 1);
    const State now = profile.at(known.line.from, time);
    // On the way to a target that cannot stop the motion may be unable to stop, too: it would brake first.
    if (!can_stop(now, limits_on(known.line.rho, known.move))) return;
    const Line rest{known.line.rho, now, known.line.to};
    EXPECT_NEAR(
        (fastest_along(rest, known.move)->duration() + time - profile.duration()).convert_to<double>(), 0,
        1e-12);
    const KnownMove next = replanned(draw, known, now);
    const std::optional<Profile> onward = fastest_along(next.line, next.move);
    ASSERT_TRUE(onward);
    if (onward->phases.empty()) return;
    EXPECT_THAT(faults(next.move, answer_of(next.move, next.line, *onward)), ::testing::IsEmpty());
  });
}

TEST(Answer, ThatIsWrongAnywhereIsFound) {
  run_cases(100, 2000, [](Draw& draw) {
    const KnownMove known = random_move(draw, draw.integer(1, 5), Kind::moving);
    const std::optional<Profile> profile = fastest_along(known.line, known.move);
    ASSERT_TRUE(profile && !profile->phases.empty());
    Answer answer = answer_of(known.move, known.line, *profile);
    SCOPED_TRACE(known.move.text());
    const auto any = [&](std::size_t size) {
      return static_cast<std::size_t>(draw.integer(0, static_cast<int>(size) - 1));
    };
    Segment& segment = answer.segments[any(answer.segments.size())];
    const std::size_t orders = known.move.type <= 2 ? 3 : 4;
    if (draw.chance(0.2)) {
      spoil(segment.duration);
    } else {
      spoil(segment.joints[any(segment.joints.size())][any(orders)]);
    }
    EXPECT_THAT(faults(known.move, answer), ::testing::Not(::testing::IsEmpty()));
  });
}

TEST(Collinear, WithinTheToleranceAndOut) {
  int refuted = 0, off = 0;
  run_cases(200, 10000, [&](Draw& draw) {
    const Kind kind = random_kind(draw);
    const KnownMove known = random_move(draw, draw.integer(1, 9), kind);
    EXPECT_FALSE(refutation(known.move)) << known.move.text();
    EXPECT_FALSE(refutation(shaken(draw, known.move, 0.9 * known.move.tol))) << known.move.text();
    ++off;
    refuted += refutation(crooked(draw, known.move)) ? 1 : 0;
  });
  if (std::getenv("HCSP_SEED") != nullptr) return;
  EXPECT_TRUE(refuted > off / 4 && refuted < off) << refuted << " of " << off;
}

// A motion of constant jerk is a known function; a line has no freedom but that of its start.
TEST(Answer, KnowsItsLine) {
  Draw draw(1);
  const KnownMove known = random_move(draw, 5, Kind::moving);
  const Line line =
      line_of(known.move, answer_of(known.move, known.line, fastest_along(known.line, known.move).value()));
  EXPECT_NEAR(line.to.q.convert_to<double>(),
              abs(known.line.to.q).convert_to<double>() * (line.to.q < 0 ? -1 : 1), 1e-12);
}

}  // namespace
}  // namespace hcsp::straight_line
