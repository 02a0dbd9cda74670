// SPDX-License-Identifier: Apache-2.0
// What a solve answers: domains that contain every solution, and how they came about.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "domains/box.h"
#include "domains/polynomial_tube.h"
#include "domains/set_interval.h"
#include "domains/tube.h"

namespace hcsp {

/// contracted: no solution was lost, whether one exists is not said; infeasible: proven, none exists;
/// solved: the search came to its end; limit: stopped early, the domains are still
/// guaranteed.
enum class Status : std::uint8_t { contracted, infeasible, solved, limit };

/// unique: exactly one solution is inside, whatever the values that the literals of the model enclose;
/// exists: one at least; inner: every point is one; none: that is not proven.
enum class Certificate : std::uint8_t { unique, exists, inner, none };
/// Why there is no proof: more equations than unknowns; a solution where the Jacobian is singular, or none;
/// a relation that holds here and fails there, or a solution at the edge of a domain; a set of solutions that
/// is no point; a limit.
enum class Reason : std::uint8_t { proven, overdetermined, singular, boundary, manifold, limit };

std::string_view to_string(Status status);
std::string_view to_string(Certificate certificate);
/// Empty for Reason::proven.
std::string_view to_string(Reason reason);

using Domain = std::variant<Interval, Box, Tube, SetInterval, PolynomialTube>;

/// How a result writes an unknown down, beyond its domain.
struct Shape {
  enum class Scalar : std::uint8_t { real, whole, boolean };
  Scalar scalar = Scalar::real;
  std::size_t columns = 0;   ///< of a matrix; 0 of anything else
  std::string array;         ///< the array that it is an element of, if any
  std::vector<int> indices;  ///< and where in it
  bool is_drawn = false;     ///< a tube on phases, against known instants for a picture
  std::size_t degree = 0;    ///< of its polynomials then
};

struct ResultVariable {
  std::string name;
  Domain domain;
  Shape shape = {};
  [[nodiscard]] bool is_empty() const;
};

/// The variables of these names in their order, an array's elements by its name; all where no name is given.
std::vector<const ResultVariable*> select(const std::vector<ResultVariable>& variables,
                                          const std::vector<std::string>& names);

/// One reading of a sampled tube.
struct SupportingReading {
  std::string variable;
  double time;
  std::string source;
};

/// Why no solution exists: the constraint whose contractor found a domain empty, the variable that it
/// emptied (none where a search refutes by many boxes), when (for a tube), and readings that are jointly
/// inconsistent: infeasible already when every other one is ignored.
struct Explanation {
  std::string constraint;
  std::string variable;
  std::optional<std::array<double, 2>> time;
  std::vector<SupportingReading> support;
  bool support_is_complete = true;  ///< false when a limit stopped the search for a small support
};

struct ContractorStatistics {
  std::string name;
  std::uint64_t calls = 0;
  double seconds = 0.0;
};

struct Statistics {
  double seconds = 0.0;
  std::uint64_t passes = 0;
  unsigned threads = 1;
  std::vector<ContractorStatistics> contractors;
};

/// The domains after one pass, for the pictures of a propagation (the paper's Fig. 8).
struct PassSnapshot {
  std::uint64_t pass;
  std::vector<ResultVariable> variables;
};

/// What one run of a contractor removed from one variable (the paper's Fig. 10).
struct TraceEntry {
  std::uint64_t pass;
  std::string contractor;
  std::string variable;
  double measure_before;
  double measure_after;
  /// For a tube: every item that changed, its time span, and its bounds before and after, component by
  /// component.
  struct Change {
    std::array<double, 2> time;
    std::vector<Interval> before;
    std::vector<Interval> after;
  };
  std::vector<Change> changes;
};

/// A box that holds a solution, or of which a search could not tell.
struct Solution {
  Certificate certificate = Certificate::none;
  Reason reason = Reason::proven;
  std::vector<ResultVariable> variables;
};

/// Every solution is in one of these boxes; no two unique ones hold the same. Of an optimisation, every best
/// one is, and the first box holds the best that is proven to exist, where there is one.
struct SolutionSet {
  std::vector<Solution> solutions;                      ///< in the order of their lower bounds
  std::vector<std::vector<ResultVariable>> unexplored;  ///< boxes that a limit left
  std::uint64_t cells = 0;                              ///< boxes that were looked at
};

/// Boxes that cover the domain of some unknowns, the coordinates: flat, so many intervals a box.
struct Paving {
  std::vector<std::string> names;    ///< of the coordinates
  std::vector<Interval> inside;      ///< every point is a solution, for some values of the other unknowns
  std::vector<Interval> boundary;    ///< undecided, and as small as was asked for
  std::vector<Interval> outside;     ///< no point is a solution
  std::vector<Interval> unexplored;  ///< undecided when a limit stopped the search
  double inside_volume = 0.0;        ///< a lower bound of the inside boxes' volume; a whole number counts 1
  double boundary_volume = 0.0;      ///< an upper bound of that of the boundary and of what is unexplored
  std::uint64_t cells = 0;           ///< boxes that were looked at
};

struct Result {
  std::string model;
  Status status = Status::contracted;
  std::vector<ResultVariable> variables;  ///< in the order of declaration, hidden ones left out
  std::optional<SolutionSet> search;      ///< of a search for all solutions, or for those that are best
  /// Of an optimisation: holds the infimum, or the supremum; empty where there is no solution.
  std::optional<Interval> objective;
  std::optional<Paving> paving;            ///< of a search for the set of solutions
  std::optional<Explanation> explanation;  ///< when infeasible
  Statistics statistics;
  std::vector<PassSnapshot> snapshots;  ///< when asked for
  std::vector<TraceEntry> trace;        ///< when asked for

  /// Throws std::out_of_range when no variable has that name.
  [[nodiscard]] const Domain& operator[](std::string_view name) const;
};

/// What pictures and motion polynomials tell: of a search, the first solution that is proven to exist.
const std::vector<ResultVariable>& told_variables(const Result& result);

}  // namespace hcsp
