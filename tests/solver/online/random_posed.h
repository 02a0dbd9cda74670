// SPDX-License-Identifier: Apache-2.0
// Random small problems with parameters, made anew from a seed: numbers, whole numbers and Booleans,
// equations, inequalities, alternatives, negations, choices, terms that are not defined everywhere. Each
// relation has a parameter of its own on one side, so that a given point can be made a solution.
#pragma once

#include <memory>
#include <optional>
#include <random>

#include "domains/rounding.h"
#include "solver/expression/program.h"
#include "solver/online/compiled_problem.h"

namespace hcsp::oracle {

using Random = std::mt19937_64;

inline int below(Random& random, int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }
inline bool one_in(Random& random, int n) { return below(random, n) == 0; }

/// Values of reals by their variable.
using Point = std::map<VariableId, Interval>;

/// What an expression is at a point; nothing where it is not certainly defined.
inline std::optional<Interval> value_at(Expr expression, const Point& point) {
  const RoundUpward guard;
  const Program program(expression.dag(), {expression.node()});
  Evaluation evaluation(program);
  for (std::uint32_t i = 0; i < program.inputs().size(); ++i)
    evaluation.set(i, point.at(program.inputs()[i].variable));
  evaluation.forward();
  if (!evaluation.defined(program.root())) return {};
  return evaluation.get(program.root());
}

struct RandomPosed {
  struct Side {
    Expr expression;
    VariableId offset;  ///< the parameter that it is compared with
    bool is_equation;
  };

  /// `domains`: of unknowns, and values of parameters, by their names, instead of the usual ones.
  explicit RandomPosed(std::uint64_t seed, const std::map<std::string, Interval>& domains = {})
      : random(seed), own_domains(domains) {
    const int reals = 1 + below(random, 4), parameters = 1 + below(random, 3), booleans = below(random, 3);
    for (int i = 0; i < parameters; ++i) add_parameter(fmt::format("p{}", i));
    for (int i = 0; i < reals; ++i) add_unknown(fmt::format("x{}", i));
    for (int i = 0; i < booleans; ++i) add_boolean(fmt::format("b{}", i));
    if (one_in(random, 4)) add_data();
    const int relations = 1 + below(random, reals + 2);
    for (int i = 0; i < relations; ++i) {
      const Expr relation = stated(i);
      problem.constrain(fmt::format("c{}", i), relation);
      all.push_back(relation);
    }
    if (one_in(random, 4)) add_truism();
    objective.push_back(one_in(random, 2) ? unknown() : term(2));
  }

  Problem problem{"random"};
  std::vector<RealVariable> parameters;
  std::vector<VariableId> unknowns;  ///< Booleans and whole numbers too
  std::vector<bool> is_boolean, is_whole;
  std::vector<Interval> declared;
  std::vector<Side> sides;
  std::vector<Expr> all, objective;
  struct Data {
    VariableId unknown, least, play;
  };
  std::optional<Data> data;

  /// A point with quarters for coordinates.
  Point draw_point(Random& draw) const {
    Point point;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      const double x = one_in(draw, 4) ? 0.0 : 0.25 * (below(draw, 33) - 16);
      const double value = is_boolean[i] ? below(draw, 2) : is_whole[i] ? below(draw, 5) - 2 : x;
      point[unknowns[i]] = Interval(std::min(std::max(value, declared[i].lo()), declared[i].hi()));
    }
    return point;
  }
  /// Whether a point certainly is a solution.
  [[nodiscard]] bool certainly_solves(const Point& point) const {
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      if (!leq(point.at(unknowns[i]), declared[i])) return false;
    }
    return std::all_of(all.begin(), all.end(), [&](Expr relation) {
      const auto truth = value_at(relation, point);
      return truth && truth->lo() == 1.0;
    });
  }

 private:
  void add_parameter(const std::string& name) {
    parameters.push_back(problem.parameter(name, domain_of(name, Interval(1.0))));
  }
  Interval domain_of(const std::string& name, const Interval& usual) {
    const auto own = own_domains.find(name);
    return own == own_domains.end() ? usual : own->second;
  }
  void note(VariableId id, bool boolean, bool whole, const Interval& domain) {
    unknowns.push_back(id);
    is_boolean.push_back(boolean);
    is_whole.push_back(whole);
    declared.push_back(domain);
  }
  void add_unknown(const std::string& name) {
    Interval usual(-4.0, 4.0);
    switch (below(random, 12)) {
      case 0:
        usual = Interval::entire();
        break;
      case 1:
        usual = Interval(0.0, kInfinity);
        break;
      case 2: {
        const Interval domain = domain_of(name, Interval(-2.0, 2.0));
        const IntegerVariable own = problem.integer(name, domain);
        note(own.id, false, true, domain);
        numbers.push_back(problem(own));
        return;
      }
      case 3:
        usual = Interval(0.0, 4.0);
        break;
      default:
        break;
    }
    const Interval domain = domain_of(name, usual);
    const RealVariable own = problem.real(name, domain);
    note(own.id, false, false, domain);
    numbers.push_back(problem(own));
  }
  void add_boolean(const std::string& name) {
    const BooleanVariable own = problem.boolean(name);
    note(own.id, true, false, Interval(0.0, 1.0));
    flags.push_back(problem(own));
  }

  // A number within a little play of a parameter, which other parameters make wide, or negative.
  void add_data() {
    const Expr least = problem(parameters[0]);
    add_unknown("d");
    parameters.push_back(problem.parameter("w", domain_of("w", Interval(1e-12))));
    const Expr own = numbers.back(), most = least + problem(parameters.back());
    all.push_back(least <= own);
    all.push_back(own <= most);
    problem.constrain("play", all[0] && all[1]);
    data = {unknowns.back(), parameters[0].id, parameters.back().id};
  }
  // What tells cases apart, and excludes nothing.
  void add_truism() {
    const Expr x = unknown();
    problem.imply("sides", x == abs(x) || x == -abs(x));
  }

  Expr constant() { return problem.constant(Interval(0.5 * (below(random, 9) - 4))); }
  Expr unknown() { return numbers[random() % numbers.size()]; }
  Expr leaf() {
    const int kind = below(random, 10);
    if (kind < 6) return unknown();
    return kind < 8 ? problem(parameters[random() % std::min<std::size_t>(parameters.size(), 3)])
                    : constant();
  }
  Expr term(int depth) {
    if (depth == 0) return leaf();
    const auto next = [&] { return term(depth - 1); };
    switch (below(random, 17)) {
      case 0:
      case 1:
        return next() + next();
      case 2:
      case 3:
        return next() - next();
      case 4:
      case 5:
        return next() * next();
      case 6:
        return sqr(next());
      case 7:
        return abs(next());
      case 8:
        return min(next(), next());
      case 9:
        return max(next(), next());
      case 10:
        return sqrt(one_in(random, 2) ? next() : sqr(next()));
      case 11:
        return next() / next();
      case 12:
        return if_then_else(truth(), next(), next());
      case 13:
        return -next();
      case 14:
        return one_in(random, 3) ? root(next(), 3) : pown(next(), 3);
      default:
        return leaf();
    }
  }
  Expr truth() {
    if (!flags.empty() && one_in(random, 2)) return flags[random() % flags.size()];
    switch (below(random, 5)) {
      case 0:
        return term(1) < term(1);
      case 1:
        return !(term(1) >= term(1));
      case 2:
        return term(1) == term(1);
      default:
        return term(1) <= term(1);
    }
  }
  Expr compared(int number) {
    add_parameter(fmt::format("q{}", number));
    const Expr own = term(3), offset = problem(parameters.back());
    const int kind = below(random, 10);
    sides.push_back({own, parameters.back().id, kind < 5});
    if (kind < 5) return one_in(random, 2) ? own == offset : offset == own;
    if (kind < 8) return own <= offset;
    return kind == 8 ? own < offset + problem.constant(Interval(0.5)) : !(own > offset);
  }
  Expr stated(int number) {
    const Expr own = compared(number);
    switch (below(random, 8)) {
      case 0:
        return own || (truth() && truth());
      case 1:
        return own && truth();
      case 2:
        return truth() || own;
      case 3:
        return !flags.empty() ? flags[0] || own : own;
      default:
        return own;
    }
  }

  Random random;
  std::map<std::string, Interval> own_domains;
  std::vector<Expr> numbers, flags;
};

}  // namespace hcsp::oracle
