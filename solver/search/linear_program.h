// SPDX-License-Identifier: Apache-2.0
// Linear programs whose answers are proven. The simplex method (CLP) works in floating point, and is only
// asked for multipliers: the rows, each times its multiplier, add up to one row that holds whatever the
// multipliers are, and interval arithmetic contracts the columns by it. At the simplex method's dual solution
// that is the safe bound of Neumaier and Shcherbina (Math. Program. 99, 2004); at a ray, their certificate of
// infeasibility.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp {

struct LinearTerm {
  std::uint32_t column;
  double factor;
};

/// PRECONDITION of all that compute: the thread rounds upward. No two threads share one.
class LinearProgram {
 public:
  LinearProgram();

  /// Starts anew, with no rows.
  void start(std::span<const Interval> columns);
  void add_row(std::span<const LinearTerm> terms, const Interval& within);
  [[nodiscard]] std::size_t rows() const { return within_.size(); }
  [[nodiscard]] std::span<const Interval> columns() const { return columns_; }

  /// Looks for the least value of a sum, in floating point. The program stands after the first call: then
  /// only objectives change. False where the simplex method gave up, or found no solution, or where
  /// factors are too large for it.
  bool solve(std::span<const LinearTerm> objective);
  /// After solve(): where the least value is.
  [[nodiscard]] std::span<const double> solution() const { return solution_; }

  /// Looks for the least value of a column, or the greatest, and contracts the columns by what that shows;
  /// false when no point of the columns satisfies the rows.
  bool contract(std::uint32_t column, bool from_below);

 private:
  struct Deleter {
    void operator()(void* model) const;
  };
  void load();
  bool contract_by(std::span<const double> multipliers);
  bool contract_by_ray();

  std::unique_ptr<void, Deleter> model_;
  bool is_loaded_ = false, is_refuted_ = false, is_moderate_ = true;
  std::vector<Interval> columns_, within_, terms_, sums_, factors_;
  std::vector<std::size_t> starts_;  // of the rows' terms, and their end
  std::vector<LinearTerm> row_terms_;
  std::vector<double> objective_, solution_;
  std::vector<std::uint32_t> used_;  // columns of a combination
};

}  // namespace hcsp
