// SPDX-License-Identifier: Apache-2.0
// Each type where it is degenerate, at the edge or wrong: what is solved is checked in full, what is refuted
// has to be told with a reason, and nothing is thrown.
#include <gmock/gmock.h>

#include "tests/straight_line/collinear.h"
#include "tests/straight_line/one_type.h"
#include "tests/straight_line/wrong_input.h"

namespace hcsp::straight_line {
namespace {

using ::testing::IsEmpty;

class Edges : public OneType {
 protected:
  void zero_displacement() {
    expect_time("nothing to do", on_line(type(), {0.3}, {0.3}), 0);
    expect_time("nothing to do in the origin", on_line(type(), {}, {}), 0);
    expect_solved("back to where it is in motion", on_line(type(), {0.3, 0.5}, {0.3}));
    expect_solved("likewise, the other way", on_line(type(), {0.3, -0.5}, {0.3}));
    if (has("v1")) expect_time("in motion as it is", on_line(type(), {0.3, 0.5}, {0.3, 0.5}), 0);
    if (has("a1")) expect_time("accelerating as it is", on_line(type(), {0.3, 0.5, 1}, {0.3, 0.5, 1}), 0);
    if (has("j1"))
      expect_time("with a jerk as it is", on_line(type(), {0.3, 0.5, 1, 2}, {0.3, 0.5, 1, 2}), 0);
  }

  void joints_that_do_not_move() {
    Move move = on_line(type(), {0, 0.5}, {2}, {1, 0, 0.25});
    for (Vector* greatest : {&move.vmax, &move.amax, &move.jmax, &move.dmax}) (*greatest)[1] = 1e-3;
    for (Vector* least : {&move.vmin, &move.amin, &move.jmin}) (*least)[1] = -1e-3;
    move.p0[1] = move.p1[1] = 0.7;
    const Answer answer = expect_solved("one rests, whatever its limits", move);
    if (answer.status == "solved") {
      EXPECT_EQ(answer.rho[1].lo, 0);
    }
    expect_solved("all but one rest", on_line(type(), {0.1, -0.5}, {-2}, {0, 0, 1}));
    expect_solved("only the first moves", on_line(type(), {0, 0}, {0.01}, {1, 0, 0}));
  }

  void directed_limits() {
    for (const double way : {2.0, -2.0}) {
      Move move = on_line(type(), {0, -0.1, has("a0") ? 0.3 : 0}, {way, has("v1") ? 0.15 : 0});
      move.vmin = {-0.2, -1, -3};
      move.amin = {-0.7, -1, -1};
      if (has("a0")) move.jmin = {-5, -20, -30};
      expect_solved("directed", move);
    }
    Move move = on_line(type(), {0, 0}, {2});
    move.vmin = {0, -1, 0};
    move.vmax = {1, 0, 1};
    expect_solved("one way", move);
  }

  void beyond_limits() {
    for (const double s : {1.0, -1.0}) {
      for (const double way : {3.0, -3.0, 0.1}) {
        expect_solved("beyond velocity", on_line(type(), {0, 1.7 * s}, {way}), false);
        if (!has("a0")) continue;
        expect_solved("beyond acceleration", on_line(type(), {0, 0.1, 2.8 * s}, {way}), false);
        expect_solved("beyond acceleration, and back", on_line(type(), {0, 0.9 * s, -3 * s}, {way}), false);
        expect_solved("going to be beyond velocity", on_line(type(), {0, 0.97 * s, 1.9 * s}, {way}), false);
        expect_solved("beyond both", on_line(type(), {0, 1.2 * s, 2.4 * s}, {way}), false);
      }
    }
    if (!has("j0")) return;
    expect_solved("beyond jerk", on_line(type(), {0, 0.1, 0.2, 25}, {3}), false);
    expect_solved("going to be beyond acceleration", on_line(type(), {0, 0.1, 1.95, 15}, {3}), false);
  }

  /// With velocities that are small for the jerk a braking that stops at nothing would come out below.
  void braking_overshoots() {
    for (const double s : {1.0, -1.0}) {
      expect_solved("past the target", on_line(type(), {0, s}, {0.01 * s}));
      expect_solved("past the target, from beyond", on_line(type(), {0, 1.5 * s}, {0.01 * s}), false);
      Move move = on_line(type(), {0, 0.3 * s, has("a0") ? s : 0}, {0.2 * s});
      for (double& x : move.vmax) x = 0.02;
      for (double& x : move.vmin) x = -0.02;
      expect_solved("past the other limit", move, false, type() >= 6 ? 13 : 0);  // the range is narrow
    }
  }

  void target_in_motion() {
    if (!has("v1")) return;
    for (const double way : {2.0, 0.05, -0.3}) {
      expect_solved("with a velocity", on_line(type(), {0, 0.2}, {way, 0.8}));
      expect_solved("with a velocity backward", on_line(type(), {0, 0.2}, {way, -0.8}));
      expect_solved("at the limit of velocity", on_line(type(), {0, -1}, {way, 1}));
      if (!has("a1")) continue;
      expect_solved("accelerating", on_line(type(), {0, 0.2, -0.5}, {way, 0.5, 1.2}));
      expect_solved("braking", on_line(type(), {0, 0.2, 0.5}, {way, 0.5, -1.2}));
    }
    if (has("j1")) expect_solved("with a jerk", on_line(type(), {0, 0.2, 0.5}, {2, 0.5, 0.3, -4}));
  }

  void inadmissible_targets() {
    const std::string why = "target|target_jerk";
    if (has("v1")) expect_infeasible("too fast", on_line(type(), {}, {2, 1.01}), why);
    if (has("v1")) expect_infeasible("too fast backward", on_line(type(), {}, {2, -1.01}), why);
    if (has("a1")) {
      expect_infeasible("too great an acceleration", on_line(type(), {}, {2, 0, 2.02}), why);
      expect_infeasible("has been too fast", on_line(type(), {}, {2, 0.96, -1.9}), why);
      expect_infeasible("has been too slow", on_line(type(), {}, {2, -0.96, 1.9}), why);
    }
    if (has("j1")) expect_infeasible("too great a jerk", on_line(type(), {}, {2, 0, 0, 21}), why);
    Move move = on_line(type(), {}, {2});
    move.vmax[0] = 0;
    expect_infeasible("the other way only", move, "direction.*");
    move = on_line(type(), {0, 0.1}, {2});
    move.vmin[1] = move.vmax[1] = 0;
    // It brakes to where it cannot but stay.
    expect_infeasible("a joint that cannot move", move, "target|choice|braking|to");
  }

  void without_tolerance() {
    Move move = on_line(type(), {0, 0.25, has("a0") ? 0.5 : 0}, {2});
    move.tol = 0;
    const Answer exact = library().solve(move);
    EXPECT_NE(exact.status, "infeasible") << exact.reason;
    if (exact.status == "solved") {
      EXPECT_THAT(faults(move, exact), IsEmpty());
    }
    move.p1 = {0.3, 0.7, 1.1};
    move.v0 = {0.1 * 0.3, 0.1 * 0.7, 0.1 * 1.1};
    move.a0 = {0, 0, 0};
    const Answer rounded = library().solve(move);
    if (rounded.status == "infeasible") {
      EXPECT_TRUE(refutation(move)) << rounded.reason;
    } else if (rounded.status == "solved") {
      EXPECT_THAT(faults(move, rounded), IsEmpty());
    }
    move.tol = 1e-9;
    expect_solved("with the usual tolerance", move);
  }

  void crooked() {
    for (const std::string vector : {"v0", "a0", "j0", "v1", "a1", "j1"}) {
      if (!has(vector)) continue;
      Motion from{0, 0.1, 0.2, 0.3}, to{2, 0.1, 0.2, 0.3};
      Move move = on_line(type(), from, to);
      Vector* const values[] = {&move.v0, &move.a0, &move.j0, &move.v1, &move.a1, &move.j1};
      const std::string names = "v0a0j0v1a1j1";
      (*values[names.find(vector) / 2])[2] *= 1 + 1e-6;
      SCOPED_TRACE(vector);
      const Answer answer = library().solve(move);
      EXPECT_EQ(answer.status, "infeasible");
      EXPECT_THAT(answer.reason, ::testing::MatchesRegex("[a-z0-9]+_[a-z0-9]+.[0-9, ]+.")) << answer.reason;
    }
  }

  /// The same in other units of length and time.
  void units() {
    const Move move = on_line(type(), {0.5, 0.3, has("a0") ? -0.4 : 0}, {2.5, has("v1") ? 0.25 : 0});
    const Answer plain = expect_solved("in plain units", move);
    for (const auto& [length, time] :
         {std::pair{1e-6, 1.0}, {1e6, 1.0}, {1.0, 1e-4}, {1.0, 1e4}, {1e-9, 1e3}}) {
      Move other = move;
      double unit = length;
      for (const auto& all :
           std::vector<std::vector<Vector*>>{{&other.p0, &other.p1},
                                             {&other.v0, &other.v1, &other.vmin, &other.vmax},
                                             {&other.a0, &other.a1, &other.amin, &other.amax},
                                             {&other.j0, &other.j1, &other.jmin, &other.jmax},
                                             {&other.dmax}}) {
        for (Vector* values : all) {
          for (double& x : *values) x *= unit;
        }
        unit /= time;
      }
      SCOPED_TRACE(::testing::Message() << length << " of length, " << time << " of time");
      const Answer answer = library().solve(other);
      const bool open = type() >= 6 && length < 1e-6;
      EXPECT_TRUE(answer.status == "solved" || (open && answer.status == "undecided")) << answer.reason;
      if (answer.status != "solved" || plain.status != "solved") continue;
      EXPECT_THAT(faults(other, answer), IsEmpty());
      EXPECT_NEAR(answer.bracket.lo / time, plain.bracket.lo, 2e-9);
      EXPECT_NEAR(answer.bracket.hi / time, plain.bracket.hi, 2e-9);
    }
  }

  /// In mid-motion another target on the line: the motion stays on it.
  void replanned() {
    Move move = on_line(type(), {0.1, 0.2}, {3}, {1, -0.3, 0.7});
    const Answer first = expect_solved("before the re-plan", move);
    if (first.status != "solved") return;
    for (const double share : {0.1, 0.5, 0.8}) {
      Move next = move;
      const double time = share * first.T.lo;
      next.line.resize(3);
      for (std::size_t k = 0; k < 3; ++k) next.line[k] = first.rho[k].middle();
      library().solve(move);
      next.p0 = library().positions_at(time);
      const State now = library().state_at(time);
      const double u = type() >= 6 ? library().jerk_at(time) : 0;
      for (std::size_t k = 0; k < 3; ++k) {
        next.v0[k] = (Number(next.line[k]) * now.w).convert_to<double>();
        next.a0[k] = (Number(next.line[k]) * now.b).convert_to<double>();
        next.j0[k] = next.line[k] * u;
        next.p1[k] = next.p0[k] + next.line[k] * 1.7;
      }
      const Answer answer = expect_solved("after the re-plan", next);
      for (std::size_t k = 0; k < answer.rho.size(); ++k) EXPECT_EQ(answer.rho[k].middle(), next.line[k]);
    }
  }
};

TEST_P(Edges, AreAnsweredRight) {
  zero_displacement();
  joints_that_do_not_move();
  directed_limits();
  beyond_limits();
  braking_overshoots();
  target_in_motion();
  inadmissible_targets();
  without_tolerance();
  crooked();
  units();
  replanned();
}

TEST_P(Edges, WrongInputIsToldInTheLoop) { expect_told(library(), on_line(type(), {0, 0.1}, {2})); }

INSTANTIATE_TEST_SUITE_P(Types, Edges, ::testing::Range(1, 10));

}  // namespace
}  // namespace hcsp::straight_line
