// SPDX-License-Identifier: Apache-2.0
// A problem: unknowns with their domains and the constraints between them. This is the primary way into hcsp;
// the .hcsp language is its first client. A Problem compiles each constraint to contractors on one contractor
// graph (the paper's Fig. 6) and solves it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "domains/box.h"
#include "domains/set_interval.h"
#include "domains/tube.h"
#include "solver/contractors/set_algebra.h"
#include "solver/engine/graph.h"
#include "solver/engine/propagation.h"
#include "solver/expression/expr.h"
#include "solver/phases/phase_error.h"
#include "solver/result.h"
#include "solver/search/search_options.h"

namespace hcsp {

// Handles of the unknowns; valid for the Problem that made them.
struct RealVariable {
  VariableId id;
};
struct IntegerVariable {
  VariableId id;
};
struct BooleanVariable {
  VariableId id;
};
struct VectorVariable {
  VariableId id;
  std::size_t dim;
};
struct TubeVariable {
  VariableId id;
  std::size_t dim;
};
struct SetVariable {
  VariableId id;
  std::size_t dim;
};

/// { a | relation }: the points a of R^dim for which the relation holds. The relation may mention tubes (at
/// the time at hand), reals and vectors. Made from Problem::point().
struct SetBuilder {
  std::size_t dim;
  Expr relation;
};

/// A reading of a sampled tube: what an explanation's support is made of. `source` says where it came from
/// ("log.range, row 35"); empty is fine.
struct Reading {
  std::size_t gate;
  std::string source;
};

/// The closed span between two instants of the time line; std::invalid_argument where it is none.
struct Window {
  double from;
  double to;
};

class Problem;
namespace online {
struct Question;
Question question_of(Problem& problem, const std::optional<Expr>& objective,
                     const std::vector<Expr>& outputs);
}  // namespace online

class Problem {
 public:
  explicit Problem(std::string name);
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;
  ~Problem();

  // Unknowns. Names are unique: std::invalid_argument otherwise. A domain is what is known before any
  // constraint.
  RealVariable real(std::string name, const Interval& domain = {});
  /// A whole number: its domain is the whole numbers of this one, and empty where there are none.
  IntegerVariable integer(std::string name, const Interval& domain = {});
  BooleanVariable boolean(std::string name);
  VectorVariable vector(std::string name, const Box& domain);
  /// A matrix, as the vector of its components row after row.
  VectorVariable matrix(std::string name, std::size_t rows, const Box& domain);
  /// A number that is given: it has every value of the domain for all that is asked, is never solved for, and
  /// never cut. compile() can change it from one solve to the next.
  RealVariable parameter(std::string name, const Interval& value);
  VectorVariable parameter_vector(std::string name, const Box& value);
  /// The same, of a value that is an expression of other parameters until it is set itself.
  RealVariable parameter(std::string name, Expr follows);
  VectorVariable parameter_vector(std::string name, const VectorExpr& follows);
  /// Declares what of a number's domain, or a component's, certainly belongs to it, where the ends are
  /// numbers that no double holds: a proof of a solution keeps to that. Otherwise all of it does.
  void set_certain_domain(VariableId id, const Interval& certain);
  /// Declares that an unknown is an element of an array, at these indices: results present arrays as one.
  void place_in_array(VariableId element, std::string array, std::vector<int> indices);
  /// The one time line of the problem; to be set before the first tube.
  void set_time_line(TimeLine line);
  [[nodiscard]] const std::shared_ptr<const TimeLine>& time_line() const;
  /// Or a time line of phases, whose instants are unknown: phase i takes durations[i], which is not negative;
  /// the last ends at `end`, the sum of them. Tubes are polynomials on each phase, defined by
  /// constrain_derivative() or by x == f; what else is stated of them is decided for every t. What they
  /// cannot do throws PhaseError, a std::invalid_argument, when it is stated or when define_phases() is
  /// called.
  void set_phases(Expr end, const VectorExpr& durations);
  /// How many phases there are; 0 on any other time line.
  [[nodiscard]] std::size_t phases() const;
  /// The instant after k phases; std::invalid_argument where there is none.
  Expr gate(std::size_t k);
  /// Which gate an instant is, if any.
  [[nodiscard]] std::optional<std::size_t> gate_at(Expr instant) const;
  /// What is stated while body() runs speaks of the time between two gates, and defines no tube;
  /// std::invalid_argument unless from < to.
  void during_phases(std::size_t from, std::size_t to, const std::function<void()>& body);
  /// The tube that is values[i] throughout phase i; results do not show it.
  TubeVariable hold(const std::vector<VectorExpr>& values);
  /// With phases: turns what was stated into relations between reals. Nothing can be stated after; what
  /// solves calls it.
  void define_phases();
  TubeVariable tube(std::string name, std::size_t dim);
  TubeVariable tube(std::string name, const Tube& domain);
  /// Declares which gates of a given tube are readings, for explanations of infeasibility.
  void set_readings(TubeVariable tube, std::vector<Reading> readings);
  /// A set of R^dim (1 to 3) on cells of edge `precision`. With a frame: nothing of the set is outside it.
  SetVariable set(std::string name, std::size_t dim, double precision, const std::optional<Box>& frame = {});

  // Expressions over the unknowns.
  /// An unknown that is one for all constants of these bounds and this origin: [value] is a domain. Different
  /// numbers with the same enclosure need different origins.
  Expr constant(const Interval& value, std::uint64_t origin = 0);
  /// An unknown of its own, somewhere in the interval, that results do not show.
  Expr unknown_constant(const Interval& value);
  Expr operator()(RealVariable x);
  Expr operator()(IntegerVariable x);
  /// A relation: it holds when x is true.
  Expr operator()(BooleanVariable x);
  VectorExpr operator()(VectorVariable x);
  Expr component(VectorVariable x, std::size_t i);
  /// The tube at the time at hand.
  VectorExpr operator()(TubeVariable x);
  /// The tube at an instant of the time line; std::invalid_argument if t is none. With phases, 0 is the one
  /// that is known.
  VectorExpr at(TubeVariable x, double t);
  /// The tube at an instant to be found, an expression of reals; on the time line, or what uses it is false.
  /// With phases, at a gate; std::invalid_argument elsewhere. A tube that jumps there is what comes after.
  VectorExpr at(TubeVariable x, Expr instant);
  /// The tube as it was `delay` ago, or will be where that is negative: x(t - delay) at the time at hand. Of
  /// instants before the time line, or after it, nothing is known.
  VectorExpr delayed(TubeVariable x, double delay);
  /// The integral of f, expressions at the time at hand, from an instant of the time line on.
  TubeVariable integral(const VectorExpr& f, double from);
  /// An instant to be found, on the time line or in the window at hand.
  Expr instant(std::string name);
  /// The identity tube t.
  Expr time();
  /// "For every real of `domain`, relation(it)", and "for some real": relations. The real is one more
  /// unknown, bound there. Paving decides them; propagation contracts by the weaker relation "for some", and
  /// solve_all() does not take them. `certain` is as in set_certain_domain().
  Expr for_every(std::string name, const Interval& domain, const std::function<Expr(Expr)>& relation,
                 const std::optional<Interval>& certain = {});
  Expr for_some(std::string name, const Interval& domain, const std::function<Expr(Expr)>& relation,
                const std::optional<Interval>& certain = {});
  /// The bound point a of a set builder in R^dim.
  VectorExpr point(std::size_t dim);

  // Constraints. `name` is what statistics and explanations call it.
  /// A relation. With tubes at the time at hand in it, it holds at every instant.
  void constrain(std::string name, Expr relation);
  /// A relation that follows from the constraints, or that may be assumed: searches use it, and what they say
  /// of all solutions, or of the best, is relative to it. No solution's proof has to show it.
  void imply(std::string name, Expr relation);
  /// A relation that solutions of a family obey, which is looked for in place of all: the best that is found
  /// is the best of the family. Nothing is then infeasible but by what speaks of parameters alone, since
  /// other solutions may exist.
  void choose_family(std::string name, Expr relation);
  /// A relation that holds at some instant.
  void constrain_sometime(std::string name, Expr relation);
  /// What is stated while body() runs speaks of the instants of a window, or of all: "every t" above and
  /// below is one of them.
  void during(const std::optional<Window>& window, const std::function<void()>& body);
  /// What is stated while body() runs holds at each instant by itself, so that constrain_at_least() chooses
  /// anew at each; unknowns that it declares are others at each. It may speak of the time at hand, of given
  /// instants and of delays; std::invalid_argument for derivatives, integrals and instants to be found.
  void at_each_instant(std::string name, const std::function<void()>& body);
  [[nodiscard]] bool is_at_each_instant() const;
  /// At least `least` of some alternatives hold. An alternative is all that is stated while its function
  /// runs; unknowns may be declared there too. std::invalid_argument unless 1 <= least <= their number.
  void constrain_at_least(std::string name, std::size_t least,
                          const std::vector<std::function<void()>>& alternatives);
  /// der(x) == f for almost every t; x is continuous. f has x's dimension.
  void constrain_derivative(std::string name, TubeVariable x, const VectorExpr& f);
  /// The same of one component of x.
  void constrain_derivative(std::string name, TubeVariable x, std::size_t component, Expr f);
  /// set == union over t of zone(t); with no tube in the zone, set == zone.
  void constrain_union(std::string name, SetVariable set, const SetBuilder& zone);
  /// a and b share no point. Precisions must be equal: std::invalid_argument otherwise.
  void constrain_disjoint(std::string name, SetVariable a, SetVariable b);
  /// For every t, zone(t) meets the set.
  void constrain_meets(std::string name, const SetBuilder& zone, SetVariable set);
  [[nodiscard]] double precision(SetVariable set) const;
  /// A Boolean that results do not show.
  BooleanVariable hidden_boolean(std::string name);
  /// A set that results do not show, on the grid of another: what a set expression is put together from.
  SetVariable hidden_set(std::string name, SetVariable like);
  /// The same set on the finer grid of another, hidden too. std::invalid_argument unless the ratio of their
  /// precisions is a power of two, 2^20 at most.
  SetVariable refined(SetVariable set, SetVariable like);
  /// a is a subset of b. Here and below the grids must be equal: std::invalid_argument otherwise.
  void constrain_subset(std::string name, SetTerm a, SetTerm b);
  /// whole == a inter b.
  void constrain_intersection(std::string name, SetTerm whole, SetTerm a, SetTerm b);
  /// whole == a symdiff b.
  void constrain_symmetric_difference(std::string name, SetTerm whole, SetTerm a, SetTerm b);
  /// a and b have a point in common.
  void constrain_common_point(std::string name, SetTerm a, SetTerm b);
  /// z == min over a in map of delta(a), for every t: a rangefinder (Jaulin 2011, equations 1 to 3). The map
  /// is closed. Decomposed by Theorems 1 and 2 with a hidden dug space of the map's precision.
  void constrain_range(std::string name, Expr z, const VectorExpr& a, Expr delta, SetVariable map);

  /// Whether special cases (the Euclidean ring) may replace the general paths in the constraints stated from
  /// here on; true by default. The answer is the same, bit for bit.
  void use_fast_paths(bool use);

  /// Propagates to the fixed point. May be called again: each call starts from the declared domains.
  Result propagate(const PropagationOptions& options = {});

  /// Whether all unknowns are reals, whole numbers and Booleans, and all constraints relations that hold or
  /// not: what solve_all() takes.
  [[nodiscard]] bool is_system() const;
  /// Finds every solution (branch and prune). std::invalid_argument unless is_system() and the precision is
  /// positive.
  Result solve_all(const SearchOptions& options = {});
  /// Finds the least value of an expression of the unknowns over all solutions, or the greatest, and boxes
  /// that hold every solution where it is taken (branch and bound). std::invalid_argument unless is_system(),
  /// the expression is a number, and the precision is positive.
  Result minimize(Expr objective, const SearchOptions& options = {});
  Result maximize(Expr objective, const SearchOptions& options = {});
  /// Whether all unknowns are such and all constraints relations, with quantifiers or without: what pave()
  /// takes.
  [[nodiscard]] bool is_region() const;
  /// Encloses the set of values of some unknowns for which all constraints hold at some values of the others,
  /// from inside and from outside. std::invalid_argument unless is_region(), the variables are different
  /// unknowns and the precision is positive.
  Result pave(const std::vector<Expr>& variables, const SearchOptions& options = {});

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const ContractorGraph& graph() const;

 private:
  friend online::Question online::question_of(Problem& problem, const std::optional<Expr>& objective,
                                              const std::vector<Expr>& outputs);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hcsp
