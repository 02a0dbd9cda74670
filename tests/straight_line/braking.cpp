// SPDX-License-Identifier: Apache-2.0
// The way into the limits, and types I and II.
#include <algorithm>
#include <array>

#include "tests/straight_line/enumerator.h"

namespace hcsp::straight_line {

namespace {

Number jerk(char letter, const Limits& l) { return letter == '+' ? l.uh : letter == '-' ? l.ul : Number(0); }
Number level(char letter, const Limits& l) { return letter == 'A' ? l.bh : l.bl; }

/// Times t >= 0 with a t^2 + b t + c == 0; with one more where the discriminant is zero but for rounding.
void add_zeros(const Number& a, const Number& b, const Number& c, std::vector<Number>& times) {
  if (a == 0) {
    if (b != 0) times.push_back(-c / b);
    return;
  }
  const Number root = sqrt(std::max(b * b - 4 * a * c, Number(0)));
  times.push_back((-b + root) / (2 * a));
  times.push_back((-b - root) / (2 * a));
}

/// When a motion of constant jerk may enter what is admissible: where one of the conditions changes.
std::vector<Number> entrances(const State& s, const Number& u, const Limits& l) {
  std::vector<Number> times{0};
  for (const Number& w : {l.wl, l.wh}) {
    add_zeros(u / 2, s.b, s.w - w, times);
    for (const Number& v : {l.ul, l.uh}) {  // w - b^2/2v reaches a limit of w
      const Number k = (1 - u / v) / 2;
      add_zeros(k * u, 2 * k * s.b, s.w - s.b * s.b / (2 * v) - w, times);
    }
  }
  for (const Number& b : {l.bl, l.bh, Number(0)}) add_zeros(0, u, s.b - b, times);
  return times;
}

/// The acceleration comes back into its limits at once and stays there.
bool keeps_acceleration(const Profile& profile, State s, const Limits& l) {
  const Number play = negligible(l.bh - l.bl);
  for (const auto& [time, u] : profile.phases) {
    if (time < -play) return false;
    if (time > play && ((s.b > l.bh + play && u != l.ul) || (s.b < l.bl - play && u != l.uh))) return false;
    const State to = after(s, time, u);
    if (to.b < std::min(l.bl, s.b) - play || to.b > std::max(l.bh, s.b) + play) return false;
    s = to;
  }
  return true;
}

void consider(Profile profile, const State& from, const Limits& l, std::optional<Profile>& best) {
  if (best && best->duration() <= profile.duration()) return;
  if (keeps_acceleration(profile, from, l) && can_stop(profile.end(from), l)) best = std::move(profile);
}

/// The state at which a motion from beyond one velocity limit enters when it can only just stop before the
/// other.
std::array<State, 2> last_moments(const Limits& l) {
  return {State{0, l.wl, std::min(l.bh, Number(sqrt(-2 * l.ul * (l.wh - l.wl))))},
          State{0, l.wh, std::max(l.bl, Number(-sqrt(2 * l.uh * (l.wh - l.wl))))}};
}

/// u, a hold if any, v, to a velocity and an acceleration.
void consider_way_to(const State& to, char first, char hold, char last, const State& from, const Limits& l,
                     std::optional<Profile>& best) {
  const Number u = jerk(first, l), v = jerk(last, l);
  const Number k = (1 / u - 1 / v) / 2;
  const Number rest = to.w - from.w + from.b * from.b / (2 * u) - to.b * to.b / (2 * v);
  if (hold != 0) {
    const Number at = level(hold, l);
    consider(
        {{first, hold, last}, {{(at - from.b) / u, u}, {(rest - k * at * at) / at, 0}, {(to.b - at) / v, v}}},
        from, l, best);
  } else if (k != 0 && rest / k >= -negligible((l.wh - l.wl) / abs(k))) {
    const Number root = sqrt(std::max(Number(rest / k), Number(0)));
    for (const Number& at : {root, Number(-root)}) {
      consider({{first, last}, {{(at - from.b) / u, u}, {(to.b - at) / v, v}}}, from, l, best);
    }
  }
}

}  // namespace

Profile braking(const State& from, const Limits& l) {
  if (can_stop(from, l)) return {};
  std::optional<Profile> best;
  for (const char first : {'+', '-'}) {
    const Number u = jerk(first, l);
    for (const Number& t : entrances(from, u, l)) consider({{first}, {{t, u}}}, from, l, best);
    for (const char hold : {'A', 'a'}) {
      const Number until = (level(hold, l) - from.b) / u;
      if (until < 0) continue;
      for (const Number& t : entrances(after(from, until, u), 0, l)) {
        consider({{first, hold}, {{until, u}, {t, 0}}}, from, l, best);
      }
    }
    for (const State& to : last_moments(l)) {
      for (const char last : {'+', '-'}) {
        for (const char hold : {'\0', 'A', 'a'}) consider_way_to(to, first, hold, last, from, l, best);
      }
    }
  }
  return best.value();
}

std::optional<Profile> fastest_from_anywhere(const State& from, const State& to, const Limits& l) {
  if (!can_have_started(to, l)) return std::nullopt;
  Profile whole = braking(from, l);
  const std::optional<Profile> onward = fastest(whole.end(from), to, l);
  if (!onward) return std::nullopt;
  whole.word += onward->word;
  whole.phases.insert(whole.phases.end(), onward->phases.begin(), onward->phases.end());
  return whole;
}

std::optional<Profile> fastest_without_jerk(const State& from, const State& to, const Limits& l) {
  if (to.w < l.wl || to.w > l.wh) return std::nullopt;
  Profile brake;
  Number w = from.w, q = from.q;
  if (w < l.wl || w > l.wh) {
    const Number limit = w > l.wh ? l.wh : l.wl, b = w > l.wh ? l.bl : l.bh, t = (limit - w) / b;
    brake = {w > l.wh ? "-" : "+", {{t, b}}};
    q += t * (w + limit) / 2;
    w = limit;
  }
  std::optional<Profile> best;
  const Number way = to.q - q;
  for (const char first : {'+', '-'}) {
    const Number b = first == '+' ? l.bh : l.bl, c = first == '+' ? l.bl : l.bh,
                 limit = first == '+' ? l.wh : l.wl;
    const Number square = (way + w * w / (2 * b) - to.w * to.w / (2 * c)) / ((1 / b - 1 / c) / 2);
    const auto add = [&](const Number& peak, const Number& cruise) {
      const Number times[] = {(peak - w) / b, cruise, (to.w - peak) / c};
      const Number play = negligible(abs(way) / (l.wh - l.wl) + (l.wh - l.wl) / l.bh);
      Profile profile = brake;
      for (int i = 0; i < 3; ++i) {
        if (times[i] < -play) return;
        profile.phases.push_back({times[i], i == 0 ? b : i == 1 ? Number(0) : c});
        profile.word += i == 0 ? first : i == 1 ? 'V' : first == '+' ? '-' : '+';
      }
      if (!best || profile.duration() < best->duration()) best = std::move(profile);
    };
    if (square >= -negligible((l.wh - l.wl) * (l.wh - l.wl))) {
      const Number root = sqrt(std::max(square, Number(0)));
      for (const Number& peak : {root, Number(-root)}) {
        if (peak >= l.wl && peak <= l.wh) add(peak, 0);
      }
    }
    if (limit != 0)
      add(limit, (way - (limit * limit - w * w) / (2 * b) - (to.w * to.w - limit * limit) / (2 * c)) / limit);
  }
  return best;
}

}  // namespace hcsp::straight_line
