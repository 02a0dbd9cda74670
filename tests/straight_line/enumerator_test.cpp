// SPDX-License-Identifier: Apache-2.0
// The oracle, and the theory of docs/straight_line.md, on themselves: the enumerator, which knows structures
// but not which one wins; the range of displacements, which the theory gives; and a lattice of motions, which
// knows nothing.
#include "tests/straight_line/enumerator.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/straight_line/campaign.h"
#include "tests/straight_line/lattice.h"
#include "tests/straight_line/reach.h"

namespace hcsp::straight_line {
namespace {

double seconds(const std::optional<Profile>& profile) {
  return profile ? profile->duration().convert_to<double>() : std::numeric_limits<double>::quiet_NaN();
}

TEST(Enumerator, KnownOptima) {
  EXPECT_NEAR(seconds(fastest({}, {2, 0, 0}, {-1, 1, -2, 2, -20, 20})), 2.6, 1e-15);
  EXPECT_NEAR(seconds(fastest({}, {1, 0, 0}, {-1, 1, -50, 50, -20, 20})), 1.4472135954999579, 1e-15);
  EXPECT_NEAR(seconds(fastest_without_jerk({}, {2, 0, 0}, {-1, 1, -2, 2, 0, 0})), 2.5, 1e-15);
  EXPECT_EQ(seconds(fastest({0, 1, 0}, {0, 1, 0}, {-1, 1, -2, 2, -20, 20})), 0);
}

TEST(Enumerator, TriesTheSixteenWords) {
  const std::vector<std::string> found = words();
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()).size(), 16U);
}

// An early way without a peak, and then none for a while: b stays below zero throughout.
TEST(Enumerator, FindsTheEarlyWayBeforeAGap) {
  const Limits limits{-10, 10, -4, 4, -1, 1};
  const State from{0, 5, -2};
  State to = from;
  for (const Number& jerk : {Number(1), Number(-1)}) to = after(to, Number(1) / 2, jerk);
  EXPECT_NEAR(seconds(fastest(from, to, limits)), 1, 1e-15);
  to.q += Number(1) / 1000;
  EXPECT_GT(seconds(fastest(from, to, limits)), 4);
}

// States and limits between which a lattice can move.
struct LatticeCase {
  LatticeLimits whole;
  Limits limits;

  explicit LatticeCase(Draw& draw)
      : whole{-draw.integer(5, 80), draw.integer(5, 80), -draw.integer(2, 14),
              draw.integer(2, 14),  -draw.integer(1, 3), draw.integer(1, 3)},
        limits{whole.wl, whole.wh, whole.bl, whole.bh, whole.ul, whole.uh} {}
  [[nodiscard]] LatticeState draw_state(Draw& draw) const {
    return {draw.integer(2 * whole.wl, 2 * whole.wh), draw.integer(whole.bl, whole.bh)};
  }
};

State state_of(const LatticeState& s, int sixths = 0) {
  return {Number(sixths) / 6, Number(s.twice_w) / 2, s.b};
}

struct Target {
  LatticeState lattice;
  int sixths;
  State state;
  double fastest;
};

Target draw_target(Draw& draw, const LatticeCase& world, const State& from) {
  for (;;) {
    const LatticeState s = world.draw_state(draw);
    const int sixths = draw.integer(-1500, 1500);
    const State to = state_of(s, sixths);
    if (!can_have_started(to, world.limits)) continue;
    const std::optional<Profile> profile = fastest(from, to, world.limits);
    EXPECT_TRUE(profile);
    return {s, sixths, to, seconds(profile)};
  }
}

// The fastest motion is the first that the theory allows: on the edge of what can be reached, and out of it
// before.
void expect_first(const State& from, const Target& target, const Limits& limits) {
  const double q = target.sixths / 6.0;
  const std::optional<Range> now = reach(from, target.state, limits, target.fastest);
  ASSERT_TRUE(now) << target.fastest;
  EXPECT_LE(std::min(std::abs(static_cast<double>(now->least) - q),
                     std::abs(static_cast<double>(now->greatest) - q)),
            1e-9);
  for (int i = 1; i < 30; ++i) {
    const std::optional<Range> before = reach(from, target.state, limits, target.fastest * i / 30.5L);
    EXPECT_FALSE(before && before->least <= q && q <= before->greatest)
        << "at " << i << "/30.5 of " << target.fastest;
  }
}

TEST(Enumerator, IsAsFastAsAnyMotionOfALattice) {
  std::map<std::string, int> won;
  int compared = 0, near = 0;
  run_cases(16, 1000, [&](Draw& draw) {
    const LatticeCase world(draw);
    LatticeState start = world.draw_state(draw);
    while (!can_stop(state_of(start), world.limits)) start = world.draw_state(draw);
    const State from = state_of(start);
    std::vector<Target> targets;
    for (int i = 0; i < 12; ++i) {
      targets.push_back(draw_target(draw, world, from));
      ++won[fastest(from, targets.back().state, world.limits)->word];
      expect_first(from, targets.back(), world.limits);
    }
    Lattice lattice(world.whole, start);
    for (int time = 1; time <= 100; ++time) {
      lattice.step();
      for (const Target& target : targets) {
        const LatticeRange& range = lattice.at(target.lattice);
        if (range.is_empty()) continue;
        const std::optional<Range> all = reach(from, target.state, world.limits, time);
        ASSERT_TRUE(all) << time;
        EXPECT_LE(static_cast<double>(range.greatest) / 6, static_cast<double>(all->greatest) + 1e-9);
        EXPECT_GE(static_cast<double>(range.least) / 6, static_cast<double>(all->least) - 1e-9);
        if (range.least > target.sixths || range.greatest < target.sixths) continue;
        EXPECT_LE(target.fastest, time + 1e-9);
        near += target.fastest > time - 2 ? 1 : 0;
        ++compared;
      }
    }
  });
  if (std::getenv("HCSP_SEED") != nullptr) return;
  EXPECT_GE(won.size(), 14U);
  EXPECT_GT(near, 50) << "of " << compared;
}

// Braking, on the same lattice: no motion is earlier within what is admissible.
TEST(Enumerator, NoMotionOfALatticeBrakesFaster) {
  std::map<std::string, int> compared;
  run_cases(200, 10000, [&](Draw& draw) {
    const LatticeCase world(draw);
    const auto& l = world.whole;
    const LatticeState start{draw.integer(4 * l.wl, 4 * l.wh), draw.integer(2 * l.bl, 2 * l.bh)};
    const Profile brake = braking(state_of(start), world.limits);
    const double time = brake.duration().convert_to<double>();
    EXPECT_TRUE(can_stop(brake.end(state_of(start)), world.limits)) << brake.word;
    State s = state_of(start);
    for (const auto& [duration, u] : brake.phases) {
      const State to = after(s, duration, u);
      EXPECT_GE(to.b, std::min(s.b, world.limits.bl) - 1e-30) << brake.word;
      EXPECT_LE(to.b, std::max(s.b, world.limits.bh) + 1e-30) << brake.word;
      s = to;
    }
    std::set<std::pair<int, int>> now{{start.twice_w, start.b}};
    for (int step = 0; step < 60; ++step) {
      std::set<std::pair<int, int>> next;
      for (const auto& [twice_w, b] : now) {
        if (can_stop(state_of({twice_w, b}), world.limits)) {
          EXPECT_LE(time, step + 1e-9) << brake.word << " from w " << twice_w / 2.0 << " b " << b;
          ++compared[brake.word];
          return;
        }
        for (int u = l.ul; u <= l.uh; ++u) {
          const bool returns = (b > l.bh && u == l.ul) || (b < l.bl && u == l.uh);
          if (returns || (b >= l.bl && b <= l.bh && b + u >= l.bl && b + u <= l.bh))
            next.emplace(twice_w + 2 * b + u, b + u);
        }
      }
      now = std::move(next);
    }
  });
  if (std::getenv("HCSP_SEED") != nullptr) return;
  for (const std::string word : {"", "+", "-", "+A", "-A", "-a", "+a", "-+", "+-", "-a+", "+A-"})
    EXPECT_GT(compared[word], 0) << word;
}

// Types I and II are what is left when the jerk is all but unlimited.
TEST(Enumerator, WithoutJerkIsALimit) {
  run_cases(300, 10000, [](Draw& draw) {
    Limits l{draw.in(-3, -0.1), draw.in(0.1, 3), draw.in(-3, -0.1), draw.in(0.1, 3), -1e9, 1e9};
    const State from{0, draw.in(-3.5, 3.5), 0}, to{draw.in(-5, 5), draw.in(-1, 1) * std::min(-l.wl, l.wh), 0};
    const double smooth = seconds(fastest_from_anywhere(from, to, l)),
                 rough = seconds(fastest_without_jerk(from, to, l));
    const bool brakes = from.w < l.wl || from.w > l.wh;  // and then goes on from elsewhere
    EXPECT_LE(rough, smooth + (brakes ? 1e-6 : 1e-12));
    EXPECT_NEAR(rough, smooth, 1e-6);
  });
}

TEST(Enumerator, FromAnywhere) {
  run_cases(200, 10000, [](Draw& draw) {
    const LatticeCase world(draw);
    const State from = {0, draw.in(-160, 160), draw.in(-28, 28)};
    State to = state_of(world.draw_state(draw), draw.integer(-6000, 6000));
    while (!can_have_started(to, world.limits)) to = state_of(world.draw_state(draw), 600);
    const std::optional<Profile> profile = fastest_from_anywhere(from, to, world.limits);
    ASSERT_TRUE(profile);
    const State end = profile->end(from);
    EXPECT_LT(abs(end.q - to.q) + abs(end.w - to.w) + abs(end.b - to.b), 1e-25);
  });
}

}  // namespace
}  // namespace hcsp::straight_line
