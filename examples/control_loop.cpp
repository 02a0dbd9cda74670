// SPDX-License-Identifier: Apache-2.0
// Seven joints at 1 kHz, on a straight line: every cycle plans the rest of the motion anew, from the state
// that the last plan is in, within the cycle. While the arm moves a sensor moves its target, and its limits
// are halved. On its way back the target leaves the line: then hcsp proves that no straight motion exists,
// and says why, and the arm falls back to a time-synchronised motion: each joint by itself, all arriving
// together.
//   control_loop TYPE3.hcsp [--cycles N]        (models/straight_line/type3.hcsp, one_joint.hcsp beside it)
// Prints what happened and a histogram of the latencies. Nothing in the loop allocates, locks, throws or
// makes a system call, but for reading the clock and telling what happened.
#include <hcsp/lang/online.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr std::size_t kJoints = 7;
constexpr double kCycle = 1e-3;  // s
using Joints = std::array<double, kJoints>;

struct State {
  Joints p{}, v{}, a{};
};

double value_at(const hcsp::PolynomialTube& motion, std::size_t k, double t) noexcept {
  const double end = motion.instant(motion.phases()).lo();
  return motion.at(k, hcsp::Interval(std::min(t, end))).mid();
}

struct Limits {
  double velocity, acceleration, jerk;
};

// Straight motions: the model, its parameters and what is read of its answers.
class Straight {
 public:
  explicit Straight(const std::string& model) : problem_(hcsp::compile(model, options(), within_cycle())) {}

  void limit(const Limits& limits) noexcept {
    set(vmax_, limits.velocity);
    set(amax_, limits.acceleration);
    set(jmax_, limits.jerk);
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
  [[nodiscard]] hcsp::OnlineStatus status() const noexcept { return problem_.status(); }
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
  // At 5 to 30 microseconds each; near the end of a move, where phases become 0, some dozens are needed.
  static hcsp::OnlineOptions within_cycle() {
    hcsp::OnlineOptions options;
    options.most_boxes = 100;
    return options;
  }
  void set(hcsp::CompiledProblem::Parameter parameter, double value) noexcept {
    Joints all;
    all.fill(value);
    problem_.set(parameter, all);
  }
  [[nodiscard]] double at(hcsp::CompiledProblem::Tube tube, std::size_t k, double t) const noexcept {
    return value_at(problem_.value(tube), k, t);
  }

  hcsp::CompiledProblem problem_;
  hcsp::CompiledProblem::Parameter p0_ = problem_.parameter("p0"), v0_ = problem_.parameter("v0"),
                                   a0_ = problem_.parameter("a0"), p1_ = problem_.parameter("p1"),
                                   vmax_ = problem_.parameter("vmax"), amax_ = problem_.parameter("amax"),
                                   jmax_ = problem_.parameter("jmax");
  hcsp::CompiledProblem::Tube p_ = problem_.tube("p"), w_ = problem_.tube("w"), b_ = problem_.tube("b");
  hcsp::CompiledProblem::Variable rho_ = problem_.variable("rho");
};

// Each joint by itself, but all together at the target.
class Synchronised {
 public:
  explicit Synchronised(const std::string& model) {
    joints_.reserve(kJoints);
    for (std::size_t k = 0; k < kJoints; ++k) joints_.emplace_back(model);
  }

  void limit(const Limits& limits) noexcept {
    for (Joint& joint : joints_) {
      joint.problem.set(joint.vmax, limits.velocity);
      joint.problem.set(joint.amax, limits.acceleration);
      joint.problem.set(joint.jmax, limits.jerk);
    }
  }
  // The last to arrive tells the others when; again, as long as one has to be later than that: it may be able
  // to arrive before, and after, but not then.
  bool plan(const State& from, const Joints& target) noexcept {
    for (std::size_t k = 0; k < kJoints; ++k) {
      joints_[k].problem.set(joints_[k].p0, from.p[k]);
      joints_[k].problem.set(joints_[k].v0, from.v[k]);
      joints_[k].problem.set(joints_[k].a0, from.a[k]);
      joints_[k].problem.set(joints_[k].p1, target[k]);
    }
    duration_ = 0.0;
    reason_ = "no common time";
    constexpr int kMostRounds = 10;
    constexpr double kTogether = 1e-9;  // s
    for (int round = 0; round < kMostRounds; ++round) {
      const double least = duration_;
      for (Joint& joint : joints_) {
        joint.problem.set(joint.least, least);
        joint.problem.solve();
        if (!joint.problem.has_solution()) {
          reason_ = joint.problem.reason();
          return false;
        }
        duration_ = std::max(duration_, joint.problem.objective().hi());
      }
      if (duration_ <= least + kTogether) return true;
    }
    return false;
  }
  [[nodiscard]] double duration() const noexcept { return duration_; }
  // Why there was no plan.
  [[nodiscard]] std::string_view reason() const noexcept { return reason_; }
  [[nodiscard]] State after(double t) const noexcept {
    State state;
    for (std::size_t k = 0; k < kJoints; ++k) {
      const Joint& joint = joints_[k];
      state.p[k] = value_at(joint.problem.value(joint.p), 0, t);
      state.v[k] = value_at(joint.problem.value(joint.v), 0, t);
      state.a[k] = value_at(joint.problem.value(joint.a), 0, t);
    }
    return state;
  }

 private:
  struct Joint {
    explicit Joint(const std::string& model) : problem(hcsp::compile(model)) {}
    hcsp::CompiledProblem problem;
    hcsp::CompiledProblem::Parameter p0 = problem.parameter("p0"), v0 = problem.parameter("v0"),
                                     a0 = problem.parameter("a0"), p1 = problem.parameter("p1"),
                                     vmax = problem.parameter("vmax"), amax = problem.parameter("amax"),
                                     jmax = problem.parameter("jmax"), least = problem.parameter("least");
    hcsp::CompiledProblem::Tube p = problem.tube("p"), v = problem.tube("v"), a = problem.tube("a");
  };
  std::vector<Joint> joints_;
  double duration_ = 0.0;
  std::string_view reason_;
};

enum class Outcome { arrived, no_plan, out_of_cycles };

// The arm, which does exactly what is planned, and the clock of its plans.
class Arm {
 public:
  Arm(const std::string& straight, const std::string& one_joint)
      : straight_(straight), synchronised_(one_joint) {
    latencies_.reserve(kMostCycles);
  }

  void limit(const Limits& limits) noexcept {
    straight_.limit(limits);
    synchronised_.limit(limits);
  }
  // To where `target(cycle)` is, and as far as it is on a line: a plan a cycle.
  template <class Target>
  Outcome go_straight(std::size_t most_cycles, const Target& target) {
    for (std::size_t cycle = 0; cycle < most_cycles; ++cycle) {
      const Joints wanted = target(cycle);
      if (!timed([&] { return straight_.plan(state_, wanted); })) return Outcome::no_plan;
      open_brackets_ += straight_.status() == hcsp::OnlineStatus::solved ? 0U : 1U;
      if (straight_.duration() <= kCycle) return Outcome::arrived;
      state_ = straight_.after(kCycle);
      now_ += kCycle;
    }
    return Outcome::out_of_cycles;
  }
  // The fallback: one plan, and the arm follows it.
  bool go_synchronised(const Joints& target) {
    if (!synchronised_.plan(state_, target)) return false;
    now_ += synchronised_.duration();
    state_ = synchronised_.after(synchronised_.duration());
    return true;
  }
  [[nodiscard]] double now() const noexcept { return now_; }
  [[nodiscard]] const Straight& straight() const noexcept { return straight_; }
  [[nodiscard]] const Synchronised& synchronised() const noexcept { return synchronised_; }
  [[nodiscard]] double distance_to(const Joints& target) const noexcept {
    double distance = 0.0;
    for (std::size_t k = 0; k < kJoints; ++k)
      distance = std::max(distance, std::abs(target[k] - state_.p[k]));
    return distance;
  }
  [[nodiscard]] const std::vector<double>& latencies() const noexcept { return latencies_; }
  [[nodiscard]] std::size_t open_brackets() const noexcept { return open_brackets_; }

 private:
  template <class Plan>
  bool timed(const Plan& plan) {
    const auto start = std::chrono::steady_clock::now();
    const bool is_planned = plan();
    const std::chrono::duration<double, std::micro> latency = std::chrono::steady_clock::now() - start;
    if (latencies_.size() < kMostCycles) latencies_.push_back(latency.count());
    return is_planned;
  }

  static constexpr std::size_t kMostCycles = 100000;
  Straight straight_;
  Synchronised synchronised_;
  State state_;
  double now_ = 0.0;  // s
  std::vector<double> latencies_;
  std::size_t open_brackets_ = 0;
};

Joints along(const Joints& direction, double way) {
  Joints p;
  for (std::size_t k = 0; k < kJoints; ++k) p[k] = way * direction[k];
  return p;
}

void print_histogram(std::vector<double> latencies) {
  if (latencies.empty()) return;
  std::sort(latencies.begin(), latencies.end());
  const auto quantile = [&](double q) {
    return latencies[static_cast<std::size_t>(q * static_cast<double>(latencies.size() - 1))];
  };
  std::printf("\n%zu plans: p50 %.1f us, p99 %.1f us, p99.9 %.1f us, longest %.1f us\n", latencies.size(),
              quantile(0.5), quantile(0.99), quantile(0.999), latencies.back());
  std::printf("%td of them took longer than a cycle\n",
              latencies.end() - std::upper_bound(latencies.begin(), latencies.end(), 1e6 * kCycle));
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

bool is_there(const Arm& arm, const Joints& target) {
  std::printf("%.3f s: within %.1g of the target\n", arm.now(), arm.distance_to(target));
  constexpr double kNear = 1e-6;
  return arm.distance_to(target) < kNear;
}

void tell_end(const Arm& arm, Outcome outcome) {
  if (outcome == Outcome::out_of_cycles) std::printf("%.3f s: out of cycles\n", arm.now());
  if (outcome == Outcome::no_plan)
    std::printf("%.3f s: no straight motion, %s: %s\n", arm.now(),
                std::string(to_string(arm.straight().status())).c_str(),
                std::string(arm.straight().reason()).c_str());
}

bool go_out(Arm& arm, const Joints& line, std::size_t most_cycles) {
  double way = 1.0;
  arm.limit({1.0, 4.0, 40.0});
  const auto target = [&](std::size_t cycle) {
    if (cycle == 400) {
      std::printf("%.3f s: a sensor moves the target along the line, from 1.0 to 1.4\n", arm.now());
      way = 1.4;
    }
    if (cycle == 700) {
      std::printf("%.3f s: velocity and acceleration are halved\n", arm.now());
      arm.limit({0.5, 2.0, 40.0});
    }
    return along(line, way);
  };
  const Outcome outcome = arm.go_straight(most_cycles, target);
  tell_end(arm, outcome);
  return outcome == Outcome::arrived && is_there(arm, along(line, way));
}

bool come_back(Arm& arm, std::size_t most_cycles) {
  Joints home{};
  const auto target = [&](std::size_t cycle) {
    if (cycle == 600) {
      std::printf("%.3f s: the target leaves the line\n", arm.now());
      home[3] = 0.3;
    }
    return home;
  };
  const Outcome outcome = arm.go_straight(most_cycles, target);
  tell_end(arm, outcome);
  if (outcome != Outcome::no_plan) return false;
  if (!arm.go_synchronised(home)) {
    std::printf("%.3f s: no time-synchronised motion either: %s\n", arm.now(),
                std::string(arm.synchronised().reason()).c_str());
    return false;
  }
  std::printf("%.3f s: the joints went on time-synchronised\n", arm.now());
  return is_there(arm, home);
}

int run(const std::filesystem::path& model, std::size_t most_cycles) {
  Arm arm(model.string(), (model.parent_path() / "one_joint.hcsp").string());
  const Joints line{0.8, -0.6, 0.5, 0.0, 1.0, -0.3, 0.2};
  const bool is_done = go_out(arm, line, most_cycles) && come_back(arm, most_cycles);
  print_histogram(arm.latencies());
  std::printf("%zu of the straight motions not proven to be the fastest\n", arm.open_brackets());
  return is_done ? 0 : 1;
}

// None where the arguments are not a model and, perhaps, a number of cycles.
std::optional<std::size_t> most_cycles(std::span<const char* const> arguments) {
  constexpr std::size_t kDefault = 10000;
  if (arguments.size() == 2) return kDefault;
  if (arguments.size() != 4 || std::string_view(arguments[2]) != "--cycles") return {};
  const std::string_view digits = arguments[3];
  std::size_t cycles = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), cycles);
  if (error != std::errc{} || end != digits.data() + digits.size()) return {};
  return cycles;
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<std::size_t> cycles = most_cycles({argv, static_cast<std::size_t>(argc)});
  if (!cycles) {
    std::fprintf(stderr, "usage: control_loop TYPE3.hcsp [--cycles N]\n");
    return 2;
  }
  try {
    return run(argv[1], *cycles);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "control_loop: %s\n", error.what());
    return 1;
  }
}
