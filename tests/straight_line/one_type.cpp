// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/one_type.h"

#include <gmock/gmock.h>

#include <map>
#include <memory>
#include <set>

#include "tests/straight_line/comparison.h"

namespace hcsp::straight_line {

using ::testing::IsEmpty;

namespace {

/// What types VI to IX do not solve, or not with a narrow bracket: their answer must not be wrong.
const std::set<std::string> kOpenWithSnap{"at the limit of velocity", "a joint that cannot move"};

Vector along(const std::vector<Number>& rho, double scalar) {
  Vector values;
  for (const Number& ratio : rho) values.push_back((ratio * scalar).convert_to<double>());
  return values;
}

void expect_not_too_fast_or_slow(const Move& move, const Answer& answer) {
  const Line line = line_of(move, answer);
  EXPECT_GE(answer.T.hi, least_with_snap(line, move) - 1e-9);
  if (line.from.b == 0 && line.to.b == 0 && move.j0[0] == 0 && move.j1[0] == 0) {
    EXPECT_LE(answer.bracket.lo, enough_with_snap(line, move) + 1e-9);
  }
}

}  // namespace

Move on_line(int type, const Motion& from, const Motion& to, const std::vector<Number>& rho) {
  Move move = from_rest(type, along(rho, to.q), {1, 1, 1}, {2, 2, 2}, {20, 20, 20});
  move.p0 = along(rho, from.q);
  move.v0 = along(rho, from.w);
  move.a0 = along(rho, from.b);
  move.j0 = along(rho, from.u);
  move.v1 = along(rho, to.w);
  move.a1 = along(rho, to.b);
  move.j1 = along(rho, to.u);
  return move;
}

bool OneType::has(const std::string& vector) {
  const std::vector<std::string> names = vectors_of(type());
  return std::find(names.begin(), names.end(), vector) != names.end();
}

Library& OneType::library() {
  static std::map<int, std::unique_ptr<Library>> all;
  std::unique_ptr<Library>& one = all[type()];
  if (!one) one = std::make_unique<Library>(type(), 3);
  return *one;
}

Answer OneType::expect_solved(const std::string& name, const Move& move, bool from_within,
                              std::size_t braking) {
  SCOPED_TRACE(name + ": " + move.text());
  const bool open = type() >= 6 && kOpenWithSnap.contains(name);
  Answer answer = library().solve(move);
  EXPECT_TRUE(answer.status == "solved" || (open && answer.status == "undecided"))
      << answer.status << ' ' << answer.reason << " after " << library().compiled().boxes() << " boxes";
  if (answer.status != "solved") return answer;
  EXPECT_THAT(answer.reason, IsEmpty());
  if (braking > 0) answer.braking = braking;
  EXPECT_THAT(faults(move, answer), IsEmpty());
  EXPECT_TRUE(open || answer.bracket.hi - answer.bracket.lo <= 2e-9 * std::max(1.0, answer.bracket.hi))
      << "bracket [" << answer.bracket.lo << ", " << answer.bracket.hi << "]";
  if (type() <= 5) {
    EXPECT_LE(compared_with_oracle(move, answer).off, 1e-9);
  } else if (from_within) {
    expect_not_too_fast_or_slow(move, answer);
  }
  return answer;
}

void OneType::expect_time(const std::string& name, const Move& move, double T) {
  const Answer answer = expect_solved(name, move);
  EXPECT_LE(answer.bracket.lo, T + 1e-12) << name;
  EXPECT_GE(answer.bracket.hi, T - 1e-12) << name;
}

void OneType::expect_infeasible(const std::string& name, const Move& move, const std::string& reason) {
  SCOPED_TRACE(name + ": " + move.text());
  const Answer answer = library().solve(move);
  if (type() >= 6 && kOpenWithSnap.contains(name)) {
    EXPECT_NE(answer.status, "solved");
    return;
  }
  EXPECT_EQ(answer.status, "infeasible");
  EXPECT_THAT(answer.reason, ::testing::MatchesRegex(reason));
}

}  // namespace hcsp::straight_line
