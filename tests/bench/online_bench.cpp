// SPDX-License-Identifier: Apache-2.0
// Latencies of compiled problems, one thread, in microseconds of this thread's time: percentiles over random
// parameters, first with nothing remembered, then "warm". Of motions: re-plans from where the motion is at a
// random instant, to the same target, and a cycle of a millisecond later to one a little further. Of circles:
// a solve of almost the same.
//   online_bench [DRAWS]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <span>

#include "lang/online.h"
#include "tests/support/two_circles.h"

namespace hcsp {
namespace {

double thread_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Latencies {
  std::vector<double> seconds;
  std::array<std::size_t, 4> counts{};
  double widest = 0.0;

  void solve(CompiledProblem& compiled) {
    const double started = thread_seconds();
    const OnlineStatus status = compiled.solve();
    seconds.push_back(thread_seconds() - started);
    ++counts[static_cast<std::size_t>(status)];
    if (status == OnlineStatus::solved) widest = std::max(widest, compiled.objective().width());
  }

  void print(const char* name) {
    std::sort(seconds.begin(), seconds.end());
    const auto at = [&](double part) {
      const auto last = static_cast<double>(seconds.size() - 1);
      return 1e6 * seconds[static_cast<std::size_t>(part * last)];
    };
    std::printf("%-24s p50 %6.1f p90 %6.1f p99 %6.1f p99.9 %6.1f max %6.1f us; ", name, at(0.5), at(0.9),
                at(0.99), at(0.999), at(1.0));
    std::printf("solved %zu infeasible %zu undecided %zu; widest bracket %.1e\n", counts[0], counts[1],
                counts[2], widest);
  }
};

using Random = std::mt19937_64;
double draw(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

// A random motion along a line within random limits of seven joints.
class Motion {
 public:
  static constexpr std::size_t kJoints = 7;
  Motion(CompiledProblem& compiled, Random& random, bool is_moving, bool ends_moving)
      : compiled_(compiled),
        ends_moving_(ends_moving),
        d_(kJoints),
        vmax_(kJoints),
        amax_(kJoints),
        jmax_(kJoints) {
    double w = kInfinity, a = kInfinity, j = kInfinity;
    for (double& x : d_) x = draw(random, -2.0, 2.0);
    const auto greatest =
        std::max_element(d_.begin(), d_.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
    reference_ = *greatest;
    for (std::size_t k = 0; k < kJoints; ++k) {
      vmax_[k] = draw(random, 0.5, 2.0);
      amax_[k] = draw(random, 1.0, 5.0);
      jmax_[k] = draw(random, 5.0, 50.0);
      const double ratio = std::abs(d_[k] / reference_);
      w = std::min(w, vmax_[k] / ratio);
      a = std::min(a, amax_[k] / ratio);
      j = std::min(j, jmax_[k] / ratio);
    }
    while (is_moving) {
      a0_ = draw(random, -a, a);
      v0_ = draw(random, -w, w);
      if (std::abs(v0_ + a0_ * std::abs(a0_) / (2.0 * j)) < w) break;
    }
    if (ends_moving) v1_ = draw(random, -w, w);
  }

  void start() {
    give("vmax", vmax_);
    give("amax", amax_);
    give("jmax", jmax_);
    give("p0", scaled(0.0));
    give("v0", scaled(v0_));
    give("a0", scaled(a0_));
    if (ends_moving_) give("v1", scaled(v1_));
    aim(1.0);
  }
  /// At a part of the way that was first asked for.
  void aim(double part) { give("p1", scaled(part * reference_)); }

  /// The state of the last plan after a time, which is where the next is to begin.
  void go_on(double time) {
    const std::span<const Interval> rho = compiled_.value(compiled_.variable("rho"));
    const double w = at("w", 0, time), b = at("b", 0, time);
    std::vector<double> p, v, a;
    for (std::size_t k = 0; k < kJoints; ++k) {
      p.push_back(at("p", k, time));
      v.push_back(rho[k].mid() * w);
      a.push_back(rho[k].mid() * b);
    }
    give("p0", p);
    give("v0", v);
    give("a0", a);
  }

 private:
  std::vector<double> scaled(double scalar) const {
    std::vector<double> result;
    for (const double d : d_) result.push_back(d / reference_ * scalar);
    return result;
  }
  void give(const char* name, const std::vector<double>& values) {
    compiled_.set(compiled_.parameter(name), values);
  }

  double at(const char* tube, std::size_t k, double time) const {
    const PolynomialTube& motion = compiled_.value(compiled_.tube(tube));
    return motion.at(k, Interval(std::min(time, motion.instant(motion.phases()).lo()))).mid();
  }

  CompiledProblem& compiled_;
  bool ends_moving_;
  std::vector<double> d_, vmax_, amax_, jmax_;
  double reference_ = 0.0, v0_ = 0.0, a0_ = 0.0, v1_ = 0.0;
};

void bench_motions(const char* name, int draws, bool is_moving, bool ends_moving) {
  Random random(1);
  lang::CompileOptions options;
  options.parameters = {{"K", std::to_string(Motion::kJoints)}, {"p1", "zeros(K)"}};
  const std::string model = ends_moving ? "type4.hcsp" : "type3.hcsp";
  CompiledProblem compiled =
      compile(std::string(HCSP_SOURCE_DIR) + "/models/straight_line/" + model, options);
  constexpr double kCycle = 1e-3;
  Latencies cold, same, further;
  for (int k = 0; k < draws; ++k) {
    Motion motion(compiled, random, is_moving, ends_moving);
    motion.start();
    compiled.forget();
    cold.solve(compiled);
    if (!compiled.has_solution()) continue;
    motion.go_on(draw(random, 0.0, compiled.objective().lo()));
    same.solve(compiled);
    if (!compiled.has_solution()) continue;
    motion.go_on(kCycle);
    motion.aim(1.0 + 1e-3 * draw(random, 0.0, 1.0));
    further.solve(compiled);
  }
  cold.print(name);
  same.print("  re-plan, same target");
  further.print("  1 ms later, further");
}

void bench_circles(int draws) {
  Random random(2);
  oracle::TwoCircles circles;
  CompiledProblem compiled = circles.compiled();
  Latencies cold, warm;
  for (int k = 0; k < draws; ++k) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < oracle::TwoCircles::kNames.size(); ++i)
      numbers.push_back(i < 3 ? draw(random, 1.0, 4.0) : draw(random, -1.0, 1.0));
    const auto set = [&](double factor) {
      for (std::size_t i = 0; i < numbers.size(); ++i)
        compiled.set(compiled.parameter(oracle::TwoCircles::kNames[i]), factor * numbers[i]);
    };
    set(1.0);
    compiled.forget();
    cold.solve(compiled);
    set(1.001);
    warm.solve(compiled);
  }
  cold.print("two circles and a line");
  warm.print("  warm");
}

}  // namespace
}  // namespace hcsp

int main(int argc, char** argv) {
  const int draws = argc > 1 ? std::atoi(argv[1]) : 100000;
  hcsp::bench_motions("type III, from rest", draws, false, false);
  hcsp::bench_motions("type III, in motion", draws, true, false);
  hcsp::bench_motions("type IV, from rest", draws, false, true);
  hcsp::bench_motions("type IV, in motion", draws, true, true);
  hcsp::bench_circles(draws);
}
