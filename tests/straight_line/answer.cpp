// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tests/verifier/precise.h"

namespace hcsp::straight_line {

namespace {

using verifier::Precise;
using Curve = std::array<Precise, 5>;  ///< derivatives at the start of a phase

constexpr std::array<std::pair<const char*, const char*>, 4> kLimits{
    {{"vmin", "vmax"}, {"amin", "amax"}, {"jmin", "jmax"}, {nullptr, "dmax"}}};
constexpr std::array<const char*, 4> kNames = {"position", "velocity", "acceleration", "jerk"};

Precise precise(const Span& span) { return {span.lo, span.hi}; }

Curve curve(const std::array<Span, 5>& spans) {
  Curve c;
  std::transform(spans.begin(), spans.end(), c.begin(), precise);
  return c;
}

/// t^i/i!
Curve powers(const Precise& t) {
  Curve all{Precise(1.0), t};
  for (std::size_t i = 2; i < all.size(); ++i) all[i] = all[i - 1] * t / Precise(static_cast<double>(i));
  return all;
}

/// A derivative at a later instant.
Precise value(const Curve& c, const Curve& power, std::size_t order) {
  Precise sum = c[order];
  for (std::size_t i = order + 1; i < c.size(); ++i) {
    if (!c[i].is_zero()) sum = sum + c[i] * power[i - order];
  }
  return sum;
}

/// All of them.
Curve at(const Curve& c, const Curve& power) {
  Curve later;
  for (std::size_t order = 0; order < c.size(); ++order) later[order] = value(c, power, order);
  return later;
}

/// Instants within a phase at which a derivative may be extremal: such as are certainly between its ends, by
/// the middles of the next derivatives.
std::vector<double> extrema(const Curve& c, std::size_t of, const Span& duration) {
  std::vector<double> times;
  if (of + 1 >= c.size()) return times;
  std::array<double, 3> d{};  // the next derivative as a polynomial: d0 + d1 t + d2 t^2 / 2
  for (std::size_t i = 0; i < 3 && of + 1 + i < c.size(); ++i) d[i] = c[of + 1 + i].middle();
  const auto add = [&](double t) {
    if (t > 0 && t < duration.lo) times.push_back(t);
  };
  if (d[2] == 0) {
    add(-d[0] / d[1]);
  } else {
    const double root = std::sqrt(std::max(0.0, d[1] * d[1] - 2 * d[2] * d[0]));
    add((-d[1] + root) / d[2]);
    add((-d[1] - root) / d[2]);
  }
  return times;
}

class Check {
 public:
  Check(const Move& move, const Answer& answer, double width) : move_(move), answer_(answer), width_(width) {}

  std::vector<std::string> run() {
    if (!has_shape()) return faults_;
    check_times();
    read();
    for (std::size_t k = 0; k < move_.joints(); ++k) {
      check_ends(k);
      for (std::size_t i = 0; i < answer_.segments.size(); ++i) check_segment(k, i);
      for (std::size_t order = 1; order <= 4; ++order) check_limits(k, order);
    }
    return faults_;
  }

 private:
  void fault(const std::string& what) { faults_.push_back(what); }
  static std::string place(std::size_t k, std::size_t i) {
    return " of joint " + std::to_string(k + 1) + " in segment " + std::to_string(i + 1);
  }

  bool has_shape() {
    bool fits = answer_.rho.size() == move_.joints() && !answer_.segments.empty();
    for (const Segment& segment : answer_.segments) fits = fits && segment.joints.size() == move_.joints();
    if (!fits) fault("no segments, or not of all joints");
    reference_ = reference_of(answer_);
    if (fits && !precise(answer_.rho[reference_]).meets(1.0)) fault("no joint has the ratio 1");
    return faults_.empty();
  }

  void check_times() {
    Precise sum;
    for (const Segment& segment : answer_.segments) {
      if (!(segment.duration.lo <= segment.duration.hi && segment.duration.hi >= 0))
        fault("a negative duration");
      sum = sum + precise(segment.duration);
    }
    if (!sum.meets(precise(answer_.T))) fault("T is not the sum of the durations");
    if (!(answer_.bracket.lo <= answer_.T.hi)) fault("the lower bound is above T");
    if (!(answer_.bracket.hi >= answer_.T.lo)) fault("T is above the upper bound");
  }

  void read() {
    for (const Segment& segment : answer_.segments) {
      const Curve power = powers(precise(segment.duration));
      starts_.emplace_back();
      ends_.emplace_back();
      for (const auto& spans : segment.joints) {
        starts_.back().push_back(curve(spans));
        ends_.back().push_back(at(starts_.back().back(), power));
        for (std::size_t order = 0; order < 5; ++order)
          scale_[order] = std::max(scale_[order], std::abs(spans[order].middle()));
      }
    }
    for (std::size_t order = 1; order < 5;
         ++order) {  // how great such numbers get, or may: for what is narrow
      const Vector* limit = move_.parameter(kLimits[order - 1].second);
      if (limit == nullptr) continue;
      scale_[order] = std::max(scale_[order], *std::max_element(limit->begin(), limit->end()));
    }
  }

  /// Given vectors are boxes of relative half-width tol.
  void check_given(const Curve& state, const std::array<const Vector*, 4>& given, std::size_t k,
                   const char* where) {
    for (std::size_t order = 0; order < 4; ++order) {
      if (given[order] == nullptr) continue;
      const Precise x((*given[order])[k]);
      if (!state[order].meets(x * (Precise(1) + Precise(-move_.tol, move_.tol)))) {
        fault(std::string(kNames[order]) + " of joint " + std::to_string(k + 1) + " is not as given " +
              where);
      }
    }
  }
  void check_ends(std::size_t k) {
    const Vector zero(move_.joints(), 0);
    const auto given = [&](const char* name, int from_type) {
      const Vector* values = move_.parameter(name);
      return values == nullptr && move_.type >= from_type ? &zero : values;
    };
    check_given(starts_.front()[k], {given("p0", 1), given("v0", 1), given("a0", 3), given("j0", 6)}, k,
                "at the start");
    check_given(ends_.back()[k], {given("p1", 1), given("v1", 1), given("a1", 3), given("j1", 6)}, k,
                "at the end");
  }

  void check_segment(std::size_t k, std::size_t i) {
    const Curve &here = starts_[i][k], &reference = starts_[i][reference_], &first = starts_[0][k];
    const Precise rho = precise(answer_.rho[k]);
    const std::size_t orders = move_.type <= 2 ? 3 : move_.type <= 5 ? 4 : 5;
    const auto name = [&](std::size_t order) { return (order < 4 ? kNames[order] : "snap") + place(k, i); };
    for (std::size_t order = 0; order < orders; ++order) {
      if (!std::isfinite(here[order].middle()) || here[order].width() > width_ * scale_[order] + 1e-12)
        fault("wide " + name(order));
      const Precise along =
          order == 0 ? first[0] + rho * (reference[0] - starts_[0][reference_][0]) : rho * reference[order];
      if (!here[order].meets(along)) fault("off the line: " + name(order));
      if (i > 0 && order + 1 < orders && !here[order].meets(ends_[i - 1][k][order]))
        fault("a jump at the start: " + name(order));
    }
  }

  void check_limits(std::size_t k, std::size_t order) {
    const auto& [lower, upper] = kLimits[order - 1];
    const Vector* greatest = move_.parameter(upper);
    if (greatest == nullptr) return;
    const Precise range(lower == nullptr ? -(*greatest)[k] : (*move_.parameter(lower))[k], (*greatest)[k]);
    const Precise nearly = range + (range - range) * Precise(-width_, width_);
    for (std::size_t i = answer_.braking; i < answer_.segments.size(); ++i) {
      const auto check = [&](const Precise& x) {
        if (x.lies_in(range)) return;
        if (!x.meets(range))
          fault(std::string("beyond ") + upper + place(k, i) + ": " + fmt::format("{}", x.middle()));
        else if (!x.lies_in(nearly))
          fault(std::string("perhaps beyond ") + upper + place(k, i));
      };
      const Curve& here = starts_[i][k];
      check(here[order]);
      check(ends_[i][k][order]);
      for (const double t : extrema(here, order, answer_.segments[i].duration))
        check(value(here, powers(t), order));
    }
  }

  const Move& move_;
  const Answer& answer_;
  double width_;
  std::size_t reference_ = 0;
  std::vector<std::vector<Curve>> starts_, ends_;  ///< by segment and joint
  std::array<double, 5> scale_{};
  std::vector<std::string> faults_;
};

/// Around what Number is wrong by, too.
Span around(const Number& x) {
  const double nearest = x.convert_to<double>();
  constexpr double kFar = std::numeric_limits<double>::infinity(), kWrong = 1e-40;
  return {std::nextafter(nearest, -kFar) - kWrong, std::nextafter(nearest, kFar) + kWrong};
}

}  // namespace

std::size_t reference_of(const Answer& answer) {
  const auto distance = [](const Span& s) { return std::max({0.0, s.lo - 1, 1 - s.hi}); };
  const auto nearest =
      std::min_element(answer.rho.begin(), answer.rho.end(),
                       [&](const Span& a, const Span& b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(nearest - answer.rho.begin());
}

std::vector<std::string> faults(const Move& move, const Answer& answer, double width) {
  return Check(move, answer, width).run();
}

Line line_of(const Move& move, const Answer& answer) {
  Line line;
  const std::size_t reference = reference_of(answer);
  for (const Span& rho : answer.rho)
    line.rho.emplace_back(Number(rho.middle()) / answer.rho[reference].middle());
  const auto& start = answer.segments.front().joints[reference];
  const Segment& last = answer.segments.back();
  const Curve end = at(curve(last.joints[reference]), powers(precise(last.duration)));
  // What is given, where that is possible: the middle of an enclosure of a limit may be beyond it.
  const auto nearest = [&](const Precise& of, const char* name) -> Number {
    const Vector* given = move.parameter(name);
    if (given == nullptr) return 0;
    return of.meets((*given)[reference]) ? (*given)[reference] : of.middle();
  };
  line.from = {0, nearest(precise(start[1]), "v0"), nearest(precise(start[2]), "a0")};
  line.to = {Number(end[0].middle()) - start[0].middle(), nearest(end[1], "v1"), nearest(end[2], "a1")};
  return line;
}

Answer answer_of(const Move& move, const Line& line, const Profile& profile) {
  Answer answer{"solved", "", around(profile.duration()), around(profile.duration()), {}, {}};
  std::size_t reference = 0;
  for (std::size_t k = 0; k < line.rho.size(); ++k) {
    if (abs(line.rho[k]) > abs(line.rho[reference])) reference = k;
  }
  for (const Number& rho : line.rho) answer.rho.push_back(around(rho / line.rho[reference]));
  answer.rho[reference] = {1, 1};
  State s = line.from;
  for (const Phase& phase : profile.phases) {
    Segment& segment = answer.segments.emplace_back(Segment{around(phase.duration), {}});
    if (move.type <= 2) s.b = phase.jerk;
    const Number jerk = move.type <= 2 ? Number(0) : phase.jerk;
    for (std::size_t k = 0; k < line.rho.size(); ++k) {
      const Number& rho = line.rho[k];
      segment.joints.push_back(
          {around(move.p0[k] + rho * s.q), around(rho * s.w), around(rho * s.b), around(rho * jerk), {}});
    }
    s = after(s, phase.duration, jerk);
  }
  return answer;
}

}  // namespace hcsp::straight_line
