// SPDX-License-Identifier: Apache-2.0
// Set contractors by brute force: every cell of a small world, one at a time, through the relation's program.
#pragma once

#include "domains/rounding.h"
#include "solver/expression/program.h"
#include "solver/problem.h"
#include "tests/support/oracle.h"

namespace hcsp::oracle {

/// Calls visit(cell) for every cell with indices in [-reach, reach).
template <class Visit>
void for_cells(std::size_t dim, std::int64_t reach, const Visit& visit) {
  CellIndex cell{};
  for (std::size_t axis = 0; axis < dim; ++axis) cell[axis] = -reach;
  for (;;) {
    visit(cell);
    std::size_t axis = 0;
    while (axis < dim && ++cell[axis] == reach) cell[axis++] = -reach;
    if (axis == dim) return;
  }
}

/// One evaluation of a relation, with reals and the bound point as its inputs.
class ZoneProbe {
 public:
  ZoneProbe(const Dag& dag, NodeId relation) : program_(dag, {relation}), evaluation_(program_) {}

  /// What the relation is on the closure of a cell, for all values of the variables: kTrue, kFalse or
  /// kEither.
  Interval holds(const Grid& grid, const CellIndex& cell, const std::vector<Interval>& variables) {
    load(grid, cell, variables);
    return evaluation_.get(program_.root());
  }

  /// A box around the zones of all values: what one HC4-revise leaves of the bound point in all of space.
  std::vector<Interval> hull(std::size_t dim, const std::vector<Interval>& variables) {
    set_variables(variables);
    std::vector<Interval> box(dim);
    for (std::uint32_t i = 0; i < program_.inputs().size(); ++i) {
      if (program_.inputs()[i].kind == Input::Kind::point) evaluation_.set(i, Interval());
    }
    RoundUpward guard;
    evaluation_.forward();
    const bool alive = evaluation_.backward(kTrue);
    for (std::uint32_t i = 0; i < program_.inputs().size(); ++i) {
      const Input& input = program_.inputs()[i];
      if (input.kind == Input::Kind::point) box[input.component] = evaluation_.get(i);
    }
    return alive ? box : std::vector<Interval>(dim, Interval::empty());
  }

  /// HC4-revise: the part of each variable's domain that the closed cell supports; false when there is
  /// none.
  bool support(const Grid& grid, const CellIndex& cell, const std::vector<Interval>& variables,
               std::vector<Interval>& result) {
    load(grid, cell, variables);
    RoundUpward guard;
    evaluation_.forward();
    if (!evaluation_.backward(kTrue)) return false;
    result = variables;
    for (std::uint32_t i = 0; i < program_.inputs().size(); ++i) {
      const Input& input = program_.inputs()[i];
      if (input.kind == Input::Kind::real) result[input.variable] = evaluation_.get(i);
    }
    return true;
  }

 private:
  static constexpr Interval kTrue = Interval::raw(1.0, 1.0);

  void set_variables(const std::vector<Interval>& variables) {
    for (std::uint32_t i = 0; i < program_.inputs().size(); ++i) {
      const Input& input = program_.inputs()[i];
      if (input.kind == Input::Kind::real) evaluation_.set(i, variables[input.variable]);
    }
  }

  void load(const Grid& grid, const CellIndex& cell, const std::vector<Interval>& variables) {
    set_variables(variables);
    for (std::uint32_t i = 0; i < program_.inputs().size(); ++i) {
      const Input& input = program_.inputs()[i];
      if (input.kind != Input::Kind::point) continue;
      const std::int64_t line = cell[input.component];
      evaluation_.set(i, Interval::raw(grid.line(line), grid.line(line + 1)));
    }
    RoundUpward guard;
    evaluation_.forward();
  }

  Program program_;
  Evaluation evaluation_;
};

/// Whether a half-open cell holds a point of a box.
inline bool meets(const Grid& grid, const CellIndex& cell, const std::vector<Interval>& box) {
  for (std::size_t axis = 0; axis < box.size(); ++axis) {
    if (grid.line(cell[axis]) > box[axis].hi() || grid.line(cell[axis] + 1) <= box[axis].lo()) return false;
  }
  return true;
}

/// The zones that the set contractors are tried on, over a bound point and four unknowns.
using ZoneMaker = std::function<Expr(const VectorExpr& a, const std::vector<Expr>& x)>;

struct NamedZone {
  const char* name;
  std::size_t dim;
  ZoneMaker make;
};

inline std::vector<NamedZone> zones() {
  const auto center = [](const std::vector<Expr>& x, std::size_t dim) {
    return VectorExpr(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(dim));
  };
  return {
      {"Disc", 2, [=](const VectorExpr& a, const auto& x) { return norm(a - center(x, 2)) < x[3]; }},
      {"ClosedDisc", 2, [=](const VectorExpr& a, const auto& x) { return norm(center(x, 2) - a) <= x[3]; }},
      {"Circle", 2, [=](const VectorExpr& a, const auto& x) { return norm(a - center(x, 2)) == x[3]; }},
      {"SwappedAxes", 2,
       [=](const VectorExpr& a, const auto& x) {
         return norm({a[1] - x[1], x[0] - a[0]}) < x[3];
       }},
      {"Sphere", 3, [=](const VectorExpr& a, const auto& x) { return norm(a - center(x, 3)) == x[3]; }},
      {"Ball", 3, [=](const VectorExpr& a, const auto& x) { return norm(a - center(x, 3)) < x[3]; }},
      {"Segment", 1, [=](const VectorExpr& a, const auto& x) { return abs(a[0] - x[0]) < x[3]; }},
      {"Ellipse", 2,
       [=](const VectorExpr& a, const auto& x) {
         return sqrt(sqr(a[0] - x[0]) + sqr(2.0 * (a[1] - x[1]))) < x[3];
       }},
      {"Cone", 2,
       [=](const VectorExpr& a, const auto& x) {
         return norm(a - center(x, 2)) < x[3] && abs(atan2(a[1] - x[1], a[0] - x[0]) - x[2]) <= 0.5;
       }},
      {"TwoDiscs", 2,
       [=](const VectorExpr& a, const auto& x) {
         return norm(a - center(x, 2)) < x[3] || norm({a[0] - 4.5, a[1] - x[2]}) <= 0.25;
       }},
      {"DiscWithoutADisc", 2,
       [=](const VectorExpr& a, const auto& x) {
         return norm(a - center(x, 2)) <= 2.0 * x[3] && !(norm(a - center(x, 2)) < x[3]);
       }},
      {"Choice", 2,
       [=](const VectorExpr& a, const auto& x) {
         return if_then_else(a[0] < x[0], norm(a - center(x, 2)), abs(a[1] - x[1]) + sqrt(a[0] - x[0])) <=
                x[3];
       }},
      {"Box", 2,
       [=](const VectorExpr& a, const auto& x) { return max(abs(a[0] - x[0]), abs(a[1] - x[1])) <= x[3]; }},
  };
}

}  // namespace hcsp::oracle
