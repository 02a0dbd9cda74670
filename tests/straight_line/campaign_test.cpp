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

namespace hcsp::straight_line {
namespace {

/// Joints that may move in one direction only cannot come back.
bool is_out_of_reach(const KnownMove& known) {
  const Limits l = limits_on(known.line.rho, known.move);
  return known.move.type <= 5 && (l.wl == 0 || l.wh == 0) && !fastest_along(known.line, known.move);
}

/// What a run has seen, for its report.
struct Tally {
  std::map<std::string, int> answers;  ///< by status
  int compared = 0;                    ///< with the oracle's optimum; of these:
  int from_acceleration = 0, to_velocity = 0, to_acceleration = 0, directed = 0;
  std::map<std::string, int> words;  ///< of the optimum

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
    std::cout << " compared with the oracle " << compared << ", of them from an acceleration "
              << from_acceleration << ", to a velocity " << to_velocity << ", to an acceleration "
              << to_acceleration << ", with directed limits " << directed << "; optima:";
    for (const auto& [word, number] : words)
      std::cout << ' ' << (word.empty() ? "none" : word) << ' ' << number;
    std::cout << '\n';
  }
};

void expect_right(const KnownMove& known, const Answer& answer, bool ask_oracle, Tally& tally) {
  const Move& move = known.move;
  if (is_out_of_reach(known)) {
    EXPECT_EQ(answer.status, "infeasible");
    ++tally.answers["out of reach"];
    return;
  }
  ++tally.answers[answer.status];
  EXPECT_EQ(answer.status, "solved") << answer.reason;
  if (answer.status != "solved") return;
  EXPECT_THAT(faults(move, answer), ::testing::IsEmpty());
  if (move.type > 5 || !ask_oracle) return;
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
    KnownMove next = replanned(draw, on_line, {0, library().state_at(time).w, library().state_at(time).b});
    SCOPED_TRACE("after a re-plan: " + next.move.text());
    expect_right(next, library().solve(next.move), ask_oracle, tally_);
  }
};

TEST_P(Campaign, EveryAnswerIsRight) {
  int number = 0;
  run_cases(40, 100000, [&](Draw& draw) {
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
    } else if (answer.status != "undecided") {  // three vectors or more may, or may not, be on a line
      EXPECT_EQ(answer.status, "solved") << answer.reason;
      EXPECT_THAT(faults(move, answer), ::testing::IsEmpty());
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Types, Campaign, ::testing::Values(1, 2, 3, 4, 5));

}  // namespace
}  // namespace hcsp::straight_line
