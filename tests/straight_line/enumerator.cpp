// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/enumerator.h"

#include <algorithm>
#include <cctype>

#include "tests/straight_line/polynomial.h"

namespace hcsp::straight_line {

namespace {

constexpr std::size_t kLongest = 7;

bool is_sign(char letter) { return letter == '+' || letter == '-'; }
bool is_cruise(char letter) { return letter == 'V' || letter == 'v'; }

/// A hold at the greatest acceleration comes after a rise and before a fall. A cruise at the greatest
/// velocity comes after a fall of the acceleration to zero: it came from below.
bool may_follow(char before, char letter) {
  switch (letter) {
    case '+':
      return before == '-' || before == 'a' || before == 'v' || before == 0;
    case '-':
      return before == '+' || before == 'A' || before == 'V' || before == 0;
    case 'A':
      return before == '+';
    case 'a':
      return before == '-';
    case 'V':
      return before == '-';
    default:
      return before == '+';
  }
}

/// Between two cruises, or an end and a cruise, two equations have to be met by two phases beside the holds;
/// without a cruise three by three, for the cruise's duration meets the third elsewhere. With two cruises one
/// is too many.
bool is_determined(const std::string& word) {
  if (std::count_if(word.begin(), word.end(), is_cruise) > 1) return false;
  const auto cruise = std::find_if(word.begin(), word.end(), is_cruise);
  const auto signs = [](auto begin, auto end) { return std::count_if(begin, end, is_sign); };
  if (cruise == word.end()) return signs(word.begin(), word.end()) == 3;
  return signs(word.begin(), cruise) == 2 && signs(cruise, word.end()) == 2;
}

void extend(std::string& word, std::vector<std::string>& found) {
  if (!word.empty() && is_sign(word.back()) && is_determined(word)) found.push_back(word);
  if (word.size() == kLongest) return;
  for (const char letter : {'+', '-', 'A', 'a', 'V', 'v'}) {
    if (!may_follow(word.empty() ? '\0' : word.back(), letter)) continue;
    word.push_back(letter);
    extend(word, found);
    word.pop_back();
  }
}

Number jerk(char letter, const Limits& l) { return letter == '+' ? l.uh : letter == '-' ? l.ul : Number(0); }
Number held(char letter, const Limits& l) { return letter == 'A' ? l.bh : l.bl; }

/// The phases of a word as polynomials in one unknown z, and what else z has to satisfy.
struct Path {
  std::vector<Polynomial> durations;
  Polynomial q, w, b;

  explicit Path(const State& from) : q(from.q), w(from.w), b(from.b) {}
  void go(const Polynomial& time, const Number& u) {
    durations.push_back(time);
    q = q + time * (w + time * (Polynomial(Number(1) / 2) * b + Polynomial(u / 6) * time));
    w = w + time * (b + Polynomial(u / 2) * time);
    b = b + Polynomial(u) * time;
  }
  void turn(const Polynomial& to, const Number& u) { go(Polynomial(1 / u) * (to - b), u); }
};

Profile profile_at(const std::string& word, const Path& path, const Number& z, const Limits& l) {
  Profile profile{word, {}};
  for (std::size_t i = 0; i < word.size(); ++i)
    profile.phases.push_back({path.durations[i].at(z), jerk(word[i], l)});
  return profile;
}

/// From (w, b) to (w1, b1) by one rise and one fall of the acceleration, or the reverse: the turning points.
/// w1 - w == (turn^2 - b^2)/2u + (b1^2 - turn^2)/2u' + turn * hold.
std::vector<Path> two_phases(const std::string& word, const State& from, const State& to, const Limits& l) {
  const Number u = jerk(word.front(), l), v = jerk(word.back(), l);
  const Number k = (1 / u - 1 / v) / 2;  // both signs of word: + gives k > 0
  const Number rest = to.w - from.w + from.b * from.b / (2 * u) - to.b * to.b / (2 * v);
  std::vector<std::pair<Number, Number>> turns;  // with the hold
  if (word.size() == 3) {
    const Number level = held(word[1], l);
    turns.emplace_back(level, (rest - k * level * level) / level);
  } else if (rest / k >= -negligible((l.wh - l.wl) / abs(k))) {
    const Number root = sqrt(std::max(Number(rest / k), Number(0)));
    turns.emplace_back(root, 0);
    turns.emplace_back(-root, 0);
  }
  std::vector<Path> paths;
  for (const auto& [level, hold] : turns) {
    Path& path = paths.emplace_back(from);
    path.turn(level, u);
    if (word.size() == 3) path.go(hold, 0);
    path.turn(to.b, v);
  }
  return paths;
}

std::vector<Profile> with_cruise(const std::string& word, const State& from, const State& to,
                                 const Limits& l) {
  const std::size_t at = word.find_first_of("Vv");
  const State cruise{0, word[at] == 'V' ? l.wh : l.wl, 0};
  std::vector<Profile> found;
  if (cruise.w == 0) return found;
  for (const Path& before : two_phases(word.substr(0, at), from, cruise, l)) {
    for (const Path& behind : two_phases(word.substr(at + 1), cruise, to, l)) {
      Path path = before;
      path.durations.push_back((to.q - before.q.at(0) - behind.q.at(0)) / cruise.w);
      path.durations.insert(path.durations.end(), behind.durations.begin(), behind.durations.end());
      found.push_back(profile_at(word, path, 0, l));
    }
  }
  return found;
}

/// Three phases u, v, u with turning points x and y: w1 - w0 == rest' + k (x^2 - y^2) + x * hold + y * hold'.
/// The unknown z is the way from x to y without holds (then x^2 - y^2 is known, and with it the sum x + y),
/// the turning point that is free beside one hold, the first hold beside two.
Path three_phases(const std::string& word, const State& from, const State& to, const Limits& l) {
  const Number u = jerk(word.front(), l), v = word.front() == '+' ? l.ul : l.uh;
  const Number k = (1 / u - 1 / v) / 2;
  const Number rest = to.w - from.w + (from.b * from.b - to.b * to.b) / (2 * u);
  const bool is_held[] = {!is_sign(word[1]), !is_sign(word[word.size() - 2])};
  const Number top = held(word[1], l), bottom = held(word[word.size() - 2], l);
  const Polynomial z = Polynomial::z();
  Polynomial x(top), y(bottom), hold, hold_of_y;
  if (is_held[0] && is_held[1]) {
    hold = z;
    hold_of_y =
        Polynomial(1 / bottom) * (Polynomial(rest - k * (top * top - bottom * bottom)) - Polynomial(top) * z);
  } else if (is_held[0]) {
    y = z;
    hold = Polynomial(1 / top) * (Polynomial(rest - k * top * top) + Polynomial(k) * z * z);
  } else if (is_held[1]) {
    x = z;
    hold_of_y = Polynomial(1 / bottom) * (Polynomial(rest + k * bottom * bottom) - Polynomial(k) * z * z);
  } else {
    const Polynomial sum(-1, {rest / k});  // (rest/k) / z == (x^2 - y^2) / (x - y)
    x = Polynomial(Number(1) / 2) * (sum + z);
    y = Polynomial(Number(1) / 2) * (sum - z);
  }
  Path path(from);
  path.turn(x, u);
  if (is_held[0]) path.go(hold, 0);
  path.turn(y, v);
  if (is_held[1]) path.go(hold_of_y, 0);
  path.turn(to.b, u);
  return path;
}

std::vector<Profile> without_cruise(const std::string& word, const State& from, const State& to,
                                    const Limits& l) {
  const Path path = three_phases(word, from, to, l);
  const std::size_t holds = word.size() - 3;
  // Where z may be: a hold, a turning point, or the way between two (positive from a higher to a lower one).
  Number bottom = l.bl, top = l.bh;
  if (holds == 2) {
    const Number most =
        abs(to.w - from.w) + l.wh - l.wl + (l.bh - l.bl) * (l.bh - l.bl) * (1 / l.uh - 1 / l.ul);
    bottom = 0;
    top = most / std::min(l.bh, Number(-l.bl));
  } else if (holds == 0) {
    bottom = word.front() == '+' ? Number(0) : l.bl - l.bh;
    top = word.front() == '+' ? l.bh - l.bl : Number(0);
  }
  std::vector<Profile> found;
  for (const Number& z : (path.q - Polynomial(to.q)).candidates(bottom, top)) {
    if (holds == 0 && z == 0) continue;
    found.push_back(profile_at(word, path, z, l));
  }
  return found;
}

Number size_of(const State& from, const State& to, const Limits& l) {
  return abs(to.q) + abs(from.q) + abs(from.w) + abs(to.w) + abs(from.b) + abs(to.b) + l.wh - l.wl + l.bh -
         l.bl;
}

bool is_at(const State& s, const State& target, const Number& play) {
  return abs(s.q - target.q) <= play && abs(s.w - target.w) <= play && abs(s.b - target.b) <= play;
}

}  // namespace

std::vector<std::string> words() {
  std::vector<std::string> found;
  std::string word;
  extend(word, found);
  return found;
}

std::vector<Profile> motions(const State& from, const State& to, const Limits& l, const std::string& word) {
  const bool cruises = std::any_of(word.begin(), word.end(), is_cruise);
  return cruises ? with_cruise(word, from, to, l) : without_cruise(word, from, to, l);
}

std::optional<Profile> fastest(const State& from, const State& to, const Limits& l) {
  static const std::vector<std::string> all = words();
  const Number scale = size_of(from, to, l), play = negligible(scale);
  std::optional<Profile> best;
  if (is_at(from, to, play)) best = Profile{};
  for (const std::string& word : all) {
    for (Profile& profile : motions(from, to, l, word)) {
      if (best && best->duration() <= profile.duration()) continue;
      if (profile.keeps(l, from, scale) && is_at(profile.end(from), to, play)) best = std::move(profile);
    }
  }
  return best;
}

}  // namespace hcsp::straight_line
