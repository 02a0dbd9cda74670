// SPDX-License-Identifier: Apache-2.0
// A problem of numbers compiled once, and solved again and again with other values of its parameters: inside
// a control cycle. set(), solve() and all that reads results allocate nothing, lock nothing, throw nothing
// and make no system call, but for functions that MPFR computes (docs/embedding.md). The answers are as
// guaranteed as those of the searches of Problem.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "domains/polynomial_tube.h"
#include "solver/problem.h"

namespace hcsp {

/// solved: a solution is proven, and the objective is bracketed, to half of the digits that are asked for at
/// least (the square root of the precision). infeasible: proven, there is none.
/// undecided: neither, within the limit of boxes. invalid: a parameter is no number.
enum class OnlineStatus : std::uint8_t { solved, infeasible, undecided, invalid };
std::string_view to_string(OnlineStatus status);

struct OnlineOptions {
  double precision = 1e-9;  ///< the search goes on for as long as the objective may be better by more
  /// That one solve looks at, at 5 to 30 microseconds each; a fifth of them once the status would be solved.
  std::size_t most_boxes = 5000;
  std::size_t most_cases = 256;  ///< that the problem may have
  std::vector<Expr> outputs;     ///< expressions whose values at the solution are wanted, too
};

class CompiledProblem {
 public:
  /// A parameter, or a vector of them. Valid for the CompiledProblem that gave it.
  struct Parameter {
    std::size_t first = 0, size = 0;
  };
  /// An unknown, or a vector of them.
  struct Variable {
    std::size_t first = 0, size = 0;
  };

  CompiledProblem(CompiledProblem&&) noexcept;
  CompiledProblem& operator=(CompiledProblem&&) noexcept;
  ~CompiledProblem();

  /// A tube on a time line of phases. Valid for the CompiledProblem that gave it.
  struct Tube {
    std::size_t index = 0;
  };

  // Before the loop. std::out_of_range where nothing has that name. A solve reads the tubes that were asked
  // for by then.
  [[nodiscard]] Parameter parameter(std::string_view name) const;
  [[nodiscard]] Variable variable(std::string_view name) const;
  [[nodiscard]] Tube tube(std::string_view name) const;

  // In the loop.
  /// Gives a parameter values; false, and solve() will say invalid, where their number is not the parameter's
  /// or one is no number (NaN or infinite; an empty interval). Its values are then what they were.
  bool set(Parameter parameter, std::span<const double> values) noexcept;
  bool set(Parameter parameter, std::span<const Interval> values) noexcept;
  bool set(Parameter parameter, double value) noexcept { return set(parameter, std::span(&value, 1)); }
  /// Solves from what the last solve found, for speed; the answer does not depend on it but for what is left
  /// open by precision.
  OnlineStatus solve() noexcept;
  /// Forgets what was found.
  void forget() noexcept;

  // Of the last solve.
  [[nodiscard]] OnlineStatus status() const noexcept;
  /// Holds the objective's infimum over all solutions that obey what is implied: from a lower bound of all
  /// of them to an upper bound at the one that is proven. Of no interest unless has_solution().
  [[nodiscard]] Interval objective() const noexcept;
  /// Whether a solution is proven: always when solved, and perhaps when undecided.
  [[nodiscard]] bool has_solution() const noexcept;
  /// Enclosures of one exact solution, the best that was found. Empty without one.
  [[nodiscard]] std::span<const Interval> value(Variable variable) const noexcept;
  [[nodiscard]] Interval value(RealVariable variable) const noexcept;
  /// The tube of that solution, its polynomials on each phase: ready to execute. Without one it is that of
  /// the last solution since it was asked for; nothing is known of it before.
  [[nodiscard]] const PolynomialTube& value(Tube tube) const noexcept;
  /// Values there of the expressions that OnlineOptions named.
  [[nodiscard]] std::span<const Interval> outputs() const noexcept;
  /// When infeasible the name of a constraint that refuted, when invalid the parameter; empty when solved.
  /// When undecided the name of one that leaves nothing of the family (Problem::choose_family), or empty.
  [[nodiscard]] std::string_view reason() const noexcept;
  /// How many boxes the last solve looked at, and how many cases there are.
  [[nodiscard]] std::size_t boxes() const noexcept;
  [[nodiscard]] std::size_t cases() const noexcept;

 private:
  friend CompiledProblem compile(Problem& problem, const std::optional<Expr>& objective,
                                 const OnlineOptions& options);
  struct Impl;
  explicit CompiledProblem(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Compiles the search for the least value of an expression, or for one solution. std::invalid_argument
/// unless the problem is one that solve_all() takes, and where it has too many cases.
CompiledProblem compile(Problem& problem, const std::optional<Expr>& objective,
                        const OnlineOptions& options = {});

}  // namespace hcsp
