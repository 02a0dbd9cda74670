// SPDX-License-Identifier: Apache-2.0
// Seven joints at 1 kHz, on a straight line: every cycle plans the rest of the motion anew, from the state
// that the last plan is in, within the cycle. While the arm moves a sensor moves its target, its limits are
// halved, and at last the target leaves the line: then hcsp proves that no straight motion exists, and says
// why; the arm stops on its line and goes on from rest.
//   control_loop TYPE3.hcsp [--cycles N]        (models/straight_line/type3.hcsp)
// Prints what happened and a histogram of the latencies. Nothing in the loop allocates, locks, throws or
// makes a system call, but for reading the clock.
#include <hcsp/lang/online.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <string>
#include <vector>

namespace {

constexpr std::size_t kJoints = 7;
constexpr double kCycle = 1e-3;  // s
using Joints = std::array<double, kJoints>;

struct State {
  Joints p{}, v{}, a{};
};

// The model, its parameters and what is read of its answers.
class Planner {
 public:
  explicit Planner(const std::string& model) : problem_(hcsp::compile(model, options())) {}

  void limit(double velocity, double acceleration, double jerk) {
    set("vmax", filled(velocity));
    set("amax", filled(acceleration));
    set("jmax", filled(jerk));
  }
  // Whether there is a proven motion; that it is the fastest may be open, within duration().
  bool plan(const State& from, const Joints& target) noexcept {
    problem_.set(p0_, from.p);
    problem_.set(v0_, from.v);
    problem_.set(a0_, from.a);
    problem_.set(p1_, target);
    problem_.solve();
    return problem_.has_solution();
  }
  [[nodiscard]] std::string status() const { return std::string(to_string(problem_.status())); }
  [[nodiscard]] double duration() const noexcept { return problem_.objective().hi(); }
  [[nodiscard]] std::string_view reason() const noexcept { return problem_.reason(); }
  // Where the motion is after a time. Velocity and acceleration are those of the reference times rho, so that
  // they stay on the line but for the last bit, which is within the tolerance of the model.
  [[nodiscard]] State after(double t) const noexcept {
    State state;
    const double w = at(w_, 0, t), b = at(b_, 0, t);
    const std::span<const hcsp::Interval> rho = problem_.value(rho_);
    for (std::size_t k = 0; k < kJoints; ++k) {
      state.p[k] = at(p_, k, t);
      state.v[k] = rho[k].mid() * w;
      state.a[k] = rho[k].mid() * b;
    }
    return state;
  }

 private:
  static hcsp::lang::CompileOptions options() {
    hcsp::lang::CompileOptions options;
    options.parameters = {{"K", std::to_string(kJoints)}, {"p1", "zeros(K)"}};
    return options;
  }
  static Joints filled(double value) {
    Joints all;
    all.fill(value);
    return all;
  }
  void set(const char* name, const Joints& values) { problem_.set(problem_.parameter(name), values); }
  [[nodiscard]] double at(hcsp::CompiledProblem::Tube tube, std::size_t k, double t) const noexcept {
    const hcsp::PolynomialTube& motion = problem_.value(tube);
    const double end = motion.instant(motion.phases()).lo();
    return motion.at(k, hcsp::Interval(std::min(t, end))).mid();
  }

  hcsp::CompiledProblem problem_;
  hcsp::CompiledProblem::Parameter p0_ = problem_.parameter("p0"), v0_ = problem_.parameter("v0"),
                                   a0_ = problem_.parameter("a0"), p1_ = problem_.parameter("p1");
  hcsp::CompiledProblem::Tube p_ = problem_.tube("p"), w_ = problem_.tube("w"), b_ = problem_.tube("b");
  hcsp::CompiledProblem::Variable rho_ = problem_.variable("rho");
};

Joints along(const Joints& direction, double way) {
  Joints p;
  for (std::size_t k = 0; k < kJoints; ++k) p[k] = way * direction[k];
  return p;
}

void print_histogram(std::vector<double> latencies) {
  std::sort(latencies.begin(), latencies.end());
  const auto quantile = [&](double q) {
    return latencies[static_cast<std::size_t>(q * static_cast<double>(latencies.size() - 1))];
  };
  std::printf("\n%zu plans: p50 %.1f us, p99 %.1f us, p99.9 %.1f us, longest %.1f us\n", latencies.size(),
              quantile(0.5), quantile(0.99), quantile(0.999), latencies.back());
  constexpr double kFirst = 5.0, kWidth = 50.0;
  auto from = latencies.begin();
  for (double bound = kFirst; from != latencies.end(); bound *= 1.5) {
    const auto to = std::upper_bound(from, latencies.end(), bound);
    const auto count = static_cast<std::size_t>(to - from);
    if (count > 0) {
      const auto bar = static_cast<int>(
          kWidth * static_cast<double>(count) / static_cast<double>(latencies.size()) + 0.999);
      std::printf("  up to %8.1f us %8zu %s\n", bound, count,
                  std::string(static_cast<std::size_t>(bar), '#').c_str());
    }
    from = to;
  }
}

int run(const std::string& model, std::size_t most_cycles) {
  Planner planner(model);
  planner.limit(1.0, 4.0, 40.0);
  const Joints line{0.8, -0.6, 0.5, 0.0, 1.0, -0.3, 0.2};
  Joints target = along(line, 1.0);
  State state;
  std::vector<double> latencies;
  latencies.reserve(most_cycles);
  bool has_left_line = false;
  std::size_t open_brackets = 0;
  for (std::size_t cycle = 0; cycle < most_cycles; ++cycle) {
    const double now = static_cast<double>(cycle) * kCycle;
    if (cycle == 400) {
      std::printf("%.3f s: a sensor moves the target along the line, from 1.0 to 1.4\n", now);
      target = along(line, 1.4);
    }
    if (cycle == 700) {
      std::printf("%.3f s: velocity and acceleration are halved\n", now);
      planner.limit(0.5, 2.0, 40.0);
    }
    Joints wanted = target;
    if (cycle == 1200) wanted[3] += 0.3;
    const auto start = std::chrono::steady_clock::now();
    bool is_planned = planner.plan(state, wanted);
    const std::chrono::duration<double, std::micro> latency = std::chrono::steady_clock::now() - start;
    latencies.push_back(latency.count());
    open_brackets += planner.status() == "solved" ? 0U : 1U;
    if (cycle == 1200) {
      std::printf("%.3f s: the target leaves the line: %s, by %s; the arm goes on to where it was bound\n",
                  now, planner.status().c_str(), std::string(planner.reason()).c_str());
      has_left_line = !is_planned;
      is_planned = planner.plan(state, target);
    }
    if (!is_planned) {
      std::printf("%.3f s: %s (%s)\n", now, planner.status().c_str(), std::string(planner.reason()).c_str());
      return 1;
    }
    if (planner.duration() <= kCycle) {
      std::printf("%.3f s: there\n", now);
      break;
    }
    state = planner.after(kCycle);
  }
  print_histogram(latencies);
  std::printf("%zu of them not solved: infeasible, or not proven to be the fastest\n", open_brackets);
  return has_left_line ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: control_loop TYPE3.hcsp [--cycles N]\n");
    return 2;
  }
  std::size_t cycles = 10000;
  if (argc == 4 && std::string(argv[2]) == "--cycles") cycles = std::strtoul(argv[3], nullptr, 10);
  try {
    return run(argv[1], cycles);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "control_loop: %s\n", error.what());
    return 1;
  }
}
