// SPDX-License-Identifier: Apache-2.0
// Random Boolean models over numbers, a trajectory and a set with a known solution: it stays in the answer,
// and a Boolean that is told to be the truth of a formula keeps that truth.
#include <gtest/gtest.h>

#include <random>

#include "corpus.h"

namespace hcsp::lang {
namespace {

struct Formula {
  std::string text;
  bool truth;
};

// The solution: x(t) == t on [0, 2], p and q as drawn, L == [-1, 1].
class RandomFormulas {
 public:
  explicit RandomFormulas(unsigned seed) : random_(seed) {
    p_ = number();
    q_ = number();
  }
  [[nodiscard]] double p() const { return p_; }
  [[nodiscard]] double q() const { return q_; }

  Formula formula(int depth) {
    if (depth == 0) return atom();
    const Formula a = formula(depth - 1), b = formula(below(depth)), c = formula(below(depth));
    switch (below(9)) {
      case 0:
        return {fmt::format("({} and {})", a.text, b.text), a.truth && b.truth};
      case 1:
        return {fmt::format("({} or {})", a.text, b.text), a.truth || b.truth};
      case 2:
        return {fmt::format("(not {})", a.text), !a.truth};
      case 3:
        return {fmt::format("({} implies {})", a.text, b.text), !a.truth || b.truth};
      case 4:
        return {fmt::format("({} iff {})", a.text, b.text), a.truth == b.truth};
      case 5:
        return {fmt::format("({} xor {})", a.text, b.text), a.truth != b.truth};
      case 6:
        return {fmt::format("(if {} then {} else {} endif)", a.text, b.text, c.text),
                a.truth ? b.truth : c.truth};
      case 7: {
        const int least = 1 + below(3);
        return {fmt::format("atleast({}, ({}, {}, {}))", least, a.text, b.text, c.text),
                a.truth + b.truth + c.truth >= least};
      }
      default:
        return {fmt::format("(({}) == ({}))", a.text, b.text), a.truth == b.truth};
    }
  }

 private:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  // Between the numbers that formulas compare with, so that no relation holds by a hair.
  double number() { return -0.5 + 0.5 * below(7) + 0.125; }
  double limit() { return -1 + 0.5 * below(9); }
  bool is_on_the_line(double s) const { return 0 <= s && s <= 2; }

  Formula atom() {
    double c = limit(), d = limit();
    if (c > d) std::swap(c, d);
    switch (below(22)) {
      case 0:
        return {fmt::format("p > {}", c), p_ > c};
      case 1:
        return {fmt::format("p*q <= {}", c), p_ * q_ <= c};
      case 2:  // at every instant
        return {fmt::format("x > {}", c - 0.25), 0 > c - 0.25};
      case 3:
        return {fmt::format("x - t < {}", c + 0.125), 0 < c + 0.125};
      case 4:
        return {fmt::format("(exists(t) (x > {} and x < {}))", c, d), c < d && c < 2 && d > 0};
      case 5:
        return {fmt::format("(forall(t in [0.5, 1.5]) x < {})", c + 0.25), 1.5 < c + 0.25};
      case 6:
        return {fmt::format("(forall(t) (x < {} or x > {}))", d + 0.25, c - 0.25), d + 0.25 > c - 0.25};
      case 7:  // false where p is not on the time line
        return {fmt::format("x(p) > {}", c), is_on_the_line(p_) && p_ > c};
      case 8:
        return {fmt::format("x(p) < q"), is_on_the_line(p_) && p_ < q_};
      case 9:
        return {"p in L", -1 < p_ && p_ < 1};
      case 10:
        return {"(exists(t) x in L)", true};
      case 11:  // the inner t is another
        return {fmt::format("(exists(t) (x > {} and exists(t) x < {}))", d, c), d < 2 && c > 0};
      case 12:
        return {fmt::format("(forall(t) (x < {} and exists(t) x > {}))", c + 0.25, d), 2 < c + 0.25 && d < 2};
      case 13:  // of a choice at every instant all but one are the same all the time
        return {fmt::format("(forall(t) ((exists(t) x < {}) or x in L or p > {}))", c, d), c > 0 || p_ > d};
      case 14:
        return {fmt::format("(exists(t) (x in {{a : real[1] | abs(a[1]) < {}}} and x(p) > {}))",
                            std::abs(c) + 0.25, d),
                is_on_the_line(p_) && p_ > d};
      case 15:  // choices that fall differently at each instant
        return {fmt::format("(forall(t) (x in L or x >= {}))", c + 0.125), c + 0.125 <= 1};
      case 16:
        return {fmt::format("(forall(t) (not x in L or x < {}))", c + 0.25), 1 < c + 0.25};
      case 17:
        return {fmt::format("(forall(t) (meets({{a : real[1] | abs(a[1] - x) < 0.125}}, L) or x > {}))",
                            c + 0.25),
                c + 0.25 < 1.125};
      case 18:  // relations as numbers, and within functions
        return {fmt::format("(if p in L then 1 else 0 endif) + q > {}", c),
                (-1 < p_ && p_ < 1 ? 1 : 0) + q_ > c};
      case 19:
        return {fmt::format("leaves(p, {})", c + 0.25), !(-1 < p_ && p_ < 1) || p_ < c + 0.25};
      case 20:
        return {fmt::format("leaves(x, {})", c + 0.25), 1 < c + 0.25};
      default:
        return {fmt::format("{{a : real[1] | abs(a[1]) < {}}} subset L", std::abs(c) + 0.25),
                std::abs(c) + 0.25 <= 1};
    }
  }

  std::mt19937 random_;
  double p_, q_;
};

std::string around(double value) { return fmt::format("[{}, {}]", value - 1.5, value + 1.25); }

TEST(RandomLogic, LosesNoSolutionAndEntailsNothingFalse) {
  int decided = 0;
  for (unsigned seed = 0; seed < 1500; ++seed) {
    RandomFormulas draw(seed);
    const Formula stated = draw.formula(1 + static_cast<int>(seed % 3)), told = draw.formula(2);
    const std::string text = fmt::format(
        "model m;\ntime t in [0, 2] step 0.25;\nvar x : tube real;\nvar p : real in {};\nvar q : real in "
        "{};\n"
        "function leaves(a : real, c : real) : bool = not a in L or a < c;\n"
        "var b : bool;\nvar L : set real[1] precision 0.25;\nconstraint x(0) == 0 and der(x) == 1;\n"
        "constraint L == {{ a | abs(a[1]) <= 1 }};\nconstraint {}{};\nconstraint b iff {};\nsolve "
        "propagate;\n",
        around(draw.p()), around(draw.q()), stated.truth ? "" : "not ", stated.text, told.text);
    SCOPED_TRACE(text);
    const Compilation compilation = compile_text({"m.hcsp", text});
    ASSERT_EQ(compilation.diagnostics.text(), "");
    PropagationOptions options;
    options.time_limit = 0.2;
    const Result result = compilation.model->problem->propagate(options);
    ASSERT_NE(result.status, Status::infeasible);
    ASSERT_TRUE(std::get<Interval>(result["p"]).contains(draw.p()));
    ASSERT_TRUE(std::get<Interval>(result["q"]).contains(draw.q()));
    const Interval& b = std::get<Interval>(result["b"]);
    ASSERT_TRUE(b.contains(told.truth ? 1.0 : 0.0)) << told.text;
    decided += b.is_point() ? 1 : 0;
    const Tube& x = std::get<Tube>(result["x"]);
    for (std::size_t item = 0; item < x.items(); ++item) {
      const Interval span = x.line().span(item);
      ASSERT_TRUE(leq(span, x.at(0, item)));
    }
  }
  EXPECT_GT(decided, 300);
}

}  // namespace
}  // namespace hcsp::lang
