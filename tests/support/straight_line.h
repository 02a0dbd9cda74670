// SPDX-License-Identifier: Apache-2.0
// A straight-line motion of K joints within symmetric limits on velocity, acceleration and jerk, written by
// hand as a problem of numbers: seven phases, their tubes expanded at the gates. For tests and benchmarks of
// compiled problems, which know nothing of motions.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/online/compiled_problem.h"

namespace hcsp::oracle {

class StraightLine {
 public:
  explicit StraightLine(std::size_t joints) : problem_("straight line"), joints_(joints) {
    state_parameters();
    project();
    state_phases();
  }
  CompiledProblem compiled() { return compile(problem_, problem_(*duration_)); }
  Problem& problem() { return problem_; }
  Expr duration() { return problem_(*duration_); }

 private:
  VectorExpr vector(const std::string& name, double value) {
    return problem_(problem_.parameter_vector(name, box(joints_, Interval(value))));
  }
  static Box box(std::size_t size, const Interval& side) {
    return Box(IntervalVector::Constant(static_cast<Eigen::Index>(size), side));
  }
  Expr number(double x) { return problem_.constant(Interval(x)); }

  void state_parameters() {
    d_ = vector("d", 1.0);
    v0_ = vector("v0", 0.0);
    a0_ = vector("a0", 0.0);
    v1_ = vector("v1", 0.0);
    a1_ = vector("a1", 0.0);
    vmax_ = vector("vmax", 1.0);
    amax_ = vector("amax", 1.0);
    jmax_ = vector("jmax", 1.0);
    tol_.push_back(problem_(problem_.parameter("tol", Interval(1e-9))));
  }

  // The joint that moves most is the reference; the others keep their ratio to it.
  void project() {
    VectorExpr reference{d_[0], v0_[0], a0_[0], v1_[0], a1_[0]};
    const std::array given{&d_, &v0_, &a0_, &v1_, &a1_};
    for (std::size_t k = 1; k < joints_; ++k) {
      const Expr is_more = abs(d_[k]) > abs(reference[0]) * number(1.000000001);
      for (std::size_t m = 0; m < reference.size(); ++m)
        reference[m] = if_then_else(is_more, (*given[m])[k], reference[m]);
    }
    reference_ = reference;
    const Expr still = reference[0] == number(0.0);
    for (std::size_t k = 0; k < joints_; ++k) {
      const Expr ratio = if_then_else(still, number(k == 0 ? 1.0 : 0.0), d_[k] / reference[0]);
      for (std::size_t m = 1; m < reference.size(); ++m) {
        const Expr off = abs((*given[m])[k] - ratio * reference[m]);
        problem_.constrain("straight", off <= tol_[0] * abs((*given[m])[k]));
      }
      const auto tighten = [&](std::optional<Expr>& limit, const Expr& own) {
        const Expr scaled = if_then_else(ratio == number(0.0), number(1e9), own / abs(ratio));
        limit = limit ? min(*limit, scaled) : scaled;
      };
      tighten(w_, vmax_[k]);
      tighten(a_, amax_[k]);
      tighten(j_, jmax_[k]);
    }
    for (const auto& limit : {w_, a_, j_}) problem_.constrain("limits are positive", *limit > number(0.0));
  }

  Expr played(const std::string& name, std::size_t m) {
    const Expr x = problem_(problem_.real(name)), play = number(1e-12) * abs(reference_[m]);
    problem_.constrain(name + " is given", x >= reference_[m] - play);
    problem_.constrain(name + " is given", x <= reference_[m] + play);
    return x;
  }

  // q, w, b at the end of a phase with a jerk.
  struct State {
    Expr q, w, b;
  };
  State after(const State& at, const Expr& jerk, const Expr& tau) {
    const Expr half = number(0.5), sixth = jerk / number(6.0);
    return {at.q + at.w * tau + half * at.b * sqr(tau) + sixth * (tau * sqr(tau)),
            at.w + at.b * tau + half * jerk * sqr(tau), at.b + jerk * tau};
  }

  void state_phases() {
    duration_ = problem_.real("T", Interval(0.0, 1e9));
    const VectorExpr tau = problem_(problem_.vector("tau", box(7, Interval(0.0, 1e9))));
    const Expr s = if_then_else(problem_(problem_.boolean("up")), number(1.0), number(-1.0));
    const Expr q1 = s * played("q1", 0), w0 = s * played("w0", 1), b0 = s * played("b0", 2);
    const Expr w1 = s * played("w1", 3), b1 = s * played("b1", 4);
    const Expr xi = problem_(problem_.real("xi")), eta = problem_(problem_.real("eta")),
               x = problem_(problem_.real("x"));
    const Expr zero = number(0.0), &A = *a_, &J = *j_, &W = *w_;
    const std::array<Expr, 7> jerk{J, zero, -J, zero, -J, zero, J};
    std::vector<State> gates{{zero, w0, b0}};
    for (std::size_t i = 0; i < 7; ++i) gates.push_back(after(gates.back(), jerk[i], tau[i]));
    const Expr alpha = min(xi, A), beta = -min(eta, A), cross = max(beta, min(alpha, zero));
    problem_.constrain("duration",
                       problem_(*duration_) == tau[0] + tau[1] + tau[2] + tau[3] + tau[4] + tau[5] + tau[6]);
    problem_.constrain("rise", gates[1].b == alpha);
    problem_.constrain("hold", tau[1] == max(zero, xi - A) / J);
    problem_.constrain("cross", gates[3].b == cross);
    problem_.constrain("cruise", tau[3] == max(zero, x - W) / A);
    problem_.constrain("a cruise is steady", cross == zero || x <= W);
    problem_.constrain("fall", gates[5].b == beta);
    problem_.constrain("hold low", tau[5] == max(zero, eta - A) / J);
    problem_.constrain("peak", gates[3].w == min(x, W));
    problem_.constrain("end acceleration", gates[7].b == b1);
    problem_.constrain("end velocity", gates[7].w == w1);
    problem_.constrain("target", gates[7].q == q1);
    state_limits(gates, jerk);
    imply_formulas(w0, b0, w1, b1, xi, eta, x, cross);
  }

  void state_limits(const std::vector<State>& gates, const std::array<Expr, 7>& jerk) {
    const Expr &A = *a_, &W = *w_, zero = number(0.0);
    for (std::size_t i = 0; i < gates.size(); ++i) {
      problem_.constrain("acceleration limit", gates[i].b <= A);
      problem_.constrain("acceleration limit", gates[i].b >= -A);
      problem_.constrain("velocity limit", gates[i].w <= W);
      problem_.constrain("velocity limit", gates[i].w >= -W);
      if (i == 7 || i % 2 == 1) continue;
      const Expr vertex = gates[i].w - sqr(gates[i].b) / (number(2.0) * jerk[i]);
      const Expr inside = gates[i].b * gates[i + 1].b < zero;
      problem_.constrain("velocity limit", !inside || (vertex <= W && vertex >= -W));
    }
  }

  void imply_formulas(const Expr& w0, const Expr& b0, const Expr& w1, const Expr& b1, const Expr& xi,
                      const Expr& eta, const Expr& x, const Expr& cross) {
    const Expr zero = number(0.0), two = number(2.0), &A = *a_, &J = *j_, m = min(x, *w_);
    // What brings the velocity up by `gain`, ramps of the acceleration up from 0 and down to it included.
    const auto ramp = [&](const Expr& gain) {
      return if_then_else(gain * J <= sqr(A), sqrt(gain * J), A + J * ((gain - sqr(A) / J) / A));
    };
    const Expr own0 = sqr(b0) / (two * J), own1 = sqr(b1) / (two * J);
    const Expr peak = cross == zero && xi == ramp(m - w0 + own0) && eta == ramp(m - w1 + own1);
    const Expr low = -min(eta, A), high = min(xi, A);
    const Expr rising = cross > zero && eta < zero && xi == ramp(w1 - w0 + own0 - own1 + sqr(eta) / J) &&
                        x == w1 - own1 + sqr(low) / (two * J);
    const Expr falling = cross < zero && xi < zero && eta == ramp(w0 - w1 + own1 - own0 + sqr(xi) / J) &&
                         x == w0 - own0 + sqr(high) / (two * J);
    problem_.imply("kinds", peak || rising || falling);
  }

  Problem problem_;
  std::size_t joints_;
  VectorExpr d_, v0_, a0_, v1_, a1_, vmax_, amax_, jmax_, tol_, reference_;
  std::optional<Expr> w_, a_, j_;
  std::optional<RealVariable> duration_;
};

}  // namespace hcsp::oracle
