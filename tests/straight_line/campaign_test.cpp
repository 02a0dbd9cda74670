// SPDX-License-Identifier: Apache-2.0
// Random moves of every type with seven joints, one re-plan at a random instant of each: every answer is
// straight, within limits and as fast as the oracle's, and none is declared infeasible that is not.
// HCSP_FULL=1 runs 100,000 of each type, and asks the oracle for the optima of the first 1,000.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <memory>

#include "tests/straight_line/collinear.h"
#include "tests/straight_line/comparison.h"
#include "tests/straight_line/library.h"
#include "tests/straight_line/random_move.h"
#include "tests/straight_line/snap.h"

namespace hcsp::straight_line {
namespace {

/// A joint that may move in one direction only cannot come back; nor be at the end as it must not be.
bool is_out_of_reach(const Move& move) {
  for (std::size_t k = 0; k < move.joints(); ++k) {
    const double d = move.p1[k] - move.p0[k];
    if ((move.vmin[k] == 0 && d < 0) || (move.vmax[k] == 0 && d > 0)) return true;
    if (move.v1[k] < move.vmin[k] || move.v1[k] > move.vmax[k]) return true;
    const Limits own{move.vmin[k], move.vmax[k], move.amin[k], move.amax[k], move.jmin[k], move.jmax[k]};
    if (move.type >= 3 && !can_have_started({0, move.v1[k], move.a1[k]}, own)) return true;
  }
  return false;
}

/// Nor can one from a velocity that it must not keep.
bool is_out_of_reach(const KnownMove& known) {
  const Limits l = limits_on(known.line.rho, known.move);
  if (l.wl != 0 && l.wh != 0) return false;
  return known.move.type <= 5 ? !fastest_along(known.line, known.move) : is_out_of_reach(known.move);
}

/// What a run has seen, for its report.
struct Tally {
  std::map<std::string, int> answers;  ///< by status
  int compared = 0;                    ///< with the oracle's optimum; of these:
  int from_acceleration = 0, to_velocity = 0, to_acceleration = 0, directed = 0;
  std::map<std::string, int> words;  ///< of the optimum
  int wide = 0;                      ///< brackets of types VI to IX

  void count_compared(const Move& move) {
    const auto any = [&](const char* name) {
      const Vector* values = move.parameter(name);
      return values != nullptr &&
             std::any_of(values->begin(), values->end(), [](double x) { return x != 0; });
    };
    ++compared;
    from_acceleration += any("a0") ? 1 : 0;
    to_velocity += any("v1") ? 1 : 0;
    to_acceleration += any("a1") ? 1 : 0;
    for (std::size_t k = 0; k < move.joints(); ++k) {
      if (move.vmin[k] == -move.vmax[k] && move.amin[k] == -move.amax[k]) continue;
      ++directed;
      break;
    }
  }
  void print(int type) const {
    std::cout << "type " << type << ':';
    for (const auto& [status, number] : answers) std::cout << ' ' << number << ' ' << status << ';';
    if (wide > 0) std::cout << " wide brackets " << wide << ';';
    std::cout << " compared with the oracle " << compared << ", of them from an acceleration "
              << from_acceleration << ", to a velocity " << to_velocity << ", to an acceleration "
              << to_acceleration << ", with directed limits " << directed << "; optima:";
    for (const auto& [word, number] : words)
      std::cout << ' ' << (word.empty() ? "none" : word) << ' ' << number;
    std::cout << '\n';
  }
};

/// Where velocities are narrow braking is all of the first half, to rest within them: it leaves them no
/// further than turning as fast as possible does, or rests at the end that is far from where it leaves them,
/// where it may not turn faster.
void expect_no_needless_excess(const Move& move, Answer answer) {
  const Line line = line_of(move, answer);
  const Limits l = limits_on(line.rho, move);
  const Number snap = snap_on(line.rho, move);
  const auto at = [&, k = reference_of(answer)](std::size_t segment, std::size_t order) {
    return Number(answer.segments[segment].joints[k][order].middle());
  };
  const Number rest = at(13, 1), play = 1e-7 * (l.wh - l.wl), far = std::numeric_limits<double>::max();
  const State turn{0, at(2, 1), at(2, 2)};
  const Number crest = least_crest(turn, at(2, 3), l, snap),
               trough = -least_crest(mirrored(turn), -at(2, 3), mirrored(l), snap);
  const Number most = abs(rest - l.wl) < play ? far : std::min(far, Number(std::max(l.wh, crest) + play));
  const Number least =
      abs(rest - l.wh) < play ? Number(-far) : std::max(Number(-far), Number(std::min(l.wl, trough) - play));
  Move eased = move;
  for (std::size_t k = 0; k < move.joints(); ++k) {
    const Number a = line.rho[k] * least, b = line.rho[k] * most;
    eased.vmin[k] = std::min(a, b).convert_to<double>();
    eased.vmax[k] = std::max(a, b).convert_to<double>();
  }
  answer.braking = 6;
  EXPECT_THAT(faults(eased, answer, 1e-7), ::testing::IsEmpty());
}

Limits within(const Limits& l, double part) {
  return {part * l.wl, part * l.wh, part * l.bl, part * l.bh, part * l.ul, part * l.uh};
}

/// Types VI to IX need not be solved, but must not be wrong. Nothing that begins within limits leaves them.
void expect_not_wrong(const KnownMove& known, Answer answer, Tally& tally) {
  const Move& move = known.move;
  const Limits l = limits_on(known.line.rho, move);
  const Number snap = snap_on(known.line.rho, move);
  const bool stops = can_stop_with_snap(known.line.from, known.line.from_jerk, l, snap);
  if (is_out_of_reach(known)) {
    EXPECT_NE(answer.status, "solved");
    ++tally.answers["out of reach"];
    return;
  }
  ++tally.answers[answer.status + (stops ? " from within" : " from beyond")];
  EXPECT_NE(answer.status, "infeasible") << answer.reason;
  if (answer.status != "solved") return;
  tally.wide += answer.bracket.hi - answer.bracket.lo > 2e-9 * std::max(1.0, answer.bracket.hi) ? 1 : 0;
  constexpr double kClearly = 1 - 1e-8;
  if (can_stop_with_snap(known.line.from, known.line.from_jerk, within(l, kClearly), snap)) {
    answer.braking = 0;
  } else if (is_narrow(l, snap)) {
    answer.braking = 13;
    expect_no_needless_excess(move, answer);
  }
  EXPECT_THAT(faults(move, answer, 1e-7), ::testing::IsEmpty());
  const Line line = line_of(move, answer);
  if (stops) {
    EXPECT_GE(answer.T.hi, least_with_snap(line, move) - 1e-9);
  }
  const auto& ends = {line.from.b, line.to.b, known.line.from_jerk, known.line.to_jerk};
  if (stops && std::all_of(ends.begin(), ends.end(), [](const Number& x) { return x == 0; })) {
    EXPECT_LE(answer.bracket.lo, enough_with_snap(line, move) + 1e-9);
    ++tally.compared;
  }
}

void expect_right(const KnownMove& known, const Answer& answer, bool ask_oracle, Tally& tally) {
  const Move& move = known.move;
  if (move.type >= 6) return expect_not_wrong(known, answer, tally);
  if (is_out_of_reach(known)) {
    EXPECT_EQ(answer.status, "infeasible");
    ++tally.answers["out of reach"];
    return;
  }
  ++tally.answers[answer.status];
  EXPECT_EQ(answer.status, "solved") << answer.reason;
  if (answer.status != "solved") return;
  EXPECT_THAT(faults(move, answer, 1e-7), ::testing::IsEmpty());
  if (!ask_oracle) return;
  const Comparison with_oracle = compared_with_oracle(move, answer);
  EXPECT_LE(with_oracle.off, 1e-9) << "bracket [" << answer.bracket.lo << ", " << answer.bracket.hi << "]";
  ++tally.words[with_oracle.word];
  tally.count_compared(move);
}

class Campaign : public ::testing::TestWithParam<int> {
 protected:
  Tally tally_;

  Library& library() {
    static std::map<int, std::unique_ptr<Library>> all;
    std::unique_ptr<Library>& one = all[GetParam()];
    if (!one) one = std::make_unique<Library>(GetParam());
    return *one;
  }

  void replan(Draw& draw, const KnownMove& known, const Answer& answer, bool ask_oracle) {
    const double time = draw.in(0, answer.T.lo);
    KnownMove on_line = known;
    for (std::size_t k = 0; k < answer.rho.size(); ++k) on_line.line.rho[k] = answer.rho[k].middle();
    on_line.move.p0 = library().positions_at(time);
    const State now = library().state_at(time);
    const double jerk = GetParam() >= 6 ? library().jerk_at(time) : 0;
    KnownMove next = replanned(draw, on_line, {0, now.w, now.b}, jerk);
    SCOPED_TRACE("after a re-plan: " + next.move.text());
    expect_right(next, library().solve(next.move), ask_oracle, tally_);
  }
};

TEST_P(Campaign, EveryAnswerIsRight) {
  int number = 0;
  run_cases(GetParam() <= 5 ? 40 : 10, 100000, [&](Draw& draw) {
    const Kind kind = random_kind(draw);
    KnownMove known = random_move(draw, GetParam(), kind);
    if (draw.chance(0.3)) known.move = shaken(draw, known.move, draw.in(0, 0.5) * known.move.tol);
    SCOPED_TRACE(to_string(kind) + ": " + known.move.text());
    const bool ask_oracle = ++number <= 1000;
    const Answer answer = library().solve(known.move);
    expect_right(known, answer, ask_oracle, tally_);
    if (answer.status == "solved") replan(draw, known, answer, ask_oracle);
  });
  tally_.print(GetParam());
}

TEST_P(Campaign, CrookedIsRefuted) {
  run_cases(40, 100000, [&](Draw& draw) {
    const KnownMove known = random_move(draw, GetParam(), random_kind(draw));
    const Move move = crooked(draw, known.move);
    SCOPED_TRACE(move.text());
    const std::optional<Refutation> why = refutation(move);
    const Answer answer = library().solve(move);
    if (why) {
      EXPECT_EQ(answer.status, "infeasible") << why->m << ' ' << why->n << ' ' << why->k << ' ' << why->l;
    } else if (answer.status == "solved") {  // three vectors or more may, or may not, be on a line
      EXPECT_THAT(faults(move, answer), ::testing::IsEmpty());
    } else if (answer.status == "infeasible") {
      EXPECT_TRUE(is_out_of_reach(move)) << answer.reason;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Types, Campaign, ::testing::Range(1, 10));

}  // namespace
}  // namespace hcsp::straight_line
