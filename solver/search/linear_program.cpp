// SPDX-License-Identifier: Apache-2.0
#include "solver/search/linear_program.h"

#include <Clp_C_Interface.h>

#include <algorithm>
#include <cmath>

#include "domains/interval/kernel.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

constexpr Interval kZero = Interval::raw(0.0, 0.0);
// Beyond it CLP's own assertions end the process.
constexpr double kMostFactor = 1e20;

Clp_Simplex* clp(void* model) { return static_cast<Clp_Simplex*>(model); }

}  // namespace

void LinearProgram::Deleter::operator()(void* model) const { Clp_deleteModel(clp(model)); }

LinearProgram::LinearProgram() { starts_.push_back(0); }

void LinearProgram::start(std::span<const Interval> columns) {
  columns_.assign(columns.begin(), columns.end());
  within_.clear();
  starts_.assign(1, 0);
  row_terms_.clear();
  is_loaded_ = is_refuted_ = false;
  is_moderate_ = true;
}

void LinearProgram::add_row(std::span<const LinearTerm> terms, const Interval& within) {
  for (const LinearTerm& term : terms) is_moderate_ = is_moderate_ && std::abs(term.factor) < kMostFactor;
  row_terms_.insert(row_terms_.end(), terms.begin(), terms.end());
  starts_.push_back(row_terms_.size());
  within_.push_back(within);
}

// By column, as CLP wants it.
void LinearProgram::load() {
  const std::size_t n = columns_.size(), m = rows();
  std::vector<CoinBigIndex> start(n + 1, 0);
  for (const LinearTerm& term : row_terms_) ++start[term.column + 1];
  for (std::size_t j = 0; j < n; ++j) start[j + 1] += start[j];
  std::vector<int> index(row_terms_.size());
  std::vector<double> value(row_terms_.size());
  std::vector<CoinBigIndex> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k) {
      const auto place = static_cast<std::size_t>(next[row_terms_[k].column]++);
      index[place] = static_cast<int>(i);
      value[place] = row_terms_[k].factor;
    }
  }
  // What is far out is as good as unbounded, to the simplex method.
  constexpr double kFar = 1e15;
  const auto bounds = [&](const std::vector<Interval>& sides, double (Interval::*bound)() const) {
    std::vector<double> result;
    for (const Interval& side : sides) {
      const double value = (side.*bound)();
      result.push_back(
          std::abs(value) < kFar ? value : std::copysign(kInfinity, bound == &Interval::lo ? -1.0 : 1.0));
    }
    return result;
  };
  objective_.assign(n, 0.0);
  model_.reset(Clp_newModel());
  Clp_setLogLevel(clp(model_.get()), 0);
  constexpr int kNoPerturbation = 100;
  Clp_setPerturbation(clp(model_.get()), kNoPerturbation);
  Clp_loadProblem(clp(model_.get()), static_cast<int>(n), static_cast<int>(m), start.data(), index.data(),
                  value.data(), bounds(columns_, &Interval::lo).data(),
                  bounds(columns_, &Interval::hi).data(), objective_.data(),
                  bounds(within_, &Interval::lo).data(), bounds(within_, &Interval::hi).data());
  constexpr int kMostSteps = 20;  // a row or column
  Clp_setMaximumIterations(clp(model_.get()), kMostSteps * static_cast<int>(n + m));
}

bool LinearProgram::solve(std::span<const LinearTerm> objective) {
  double most = 0.0;
  for (const LinearTerm& term : objective) most = std::max(most, std::abs(term.factor));
  is_refuted_ = false;
  if (rows() == 0 || !is_moderate_ || !std::isfinite(most)) return false;
  const RoundNearest nearest;
  const bool is_first = !is_loaded_;
  if (is_first) load();
  is_loaded_ = true;
  std::fill(objective_.begin(), objective_.end(), 0.0);
  // The least value is at the same place in any scale, and the simplex method wants a moderate one.
  const double scale = most > 0.0 ? std::ldexp(1.0, -std::clamp(std::ilogb(most), -1000, 1000)) : 1.0;
  for (const LinearTerm& term : objective) objective_[term.column] += term.factor * scale;
  Clp_Simplex* model = clp(model_.get());
  Clp_chgObjCoefficients(model, objective_.data());
  Clp_setNumberIterations(model, 0);
  is_first ? Clp_dual(model, 0) : Clp_primal(model, 0);
  is_refuted_ = Clp_status(model) == 1;
  if (Clp_status(model) != 0) return false;
  const double* values = Clp_primalColumnSolution(model);
  solution_.assign(values, values + columns_.size());
  return true;
}

bool LinearProgram::contract(std::uint32_t column, bool from_below) {
  const LinearTerm objective{column, from_below ? 1.0 : -1.0};
  if (solve({&objective, 1})) return contract_by({Clp_dualRowSolution(clp(model_.get())), rows()});
  return !is_refuted_ || contract_by_ray();
}

// The rows leave nothing: a ray of the dual says so, in one direction or the other.
bool LinearProgram::contract_by_ray() {
  Clp_Simplex* model = clp(model_.get());
  double* ray = nullptr;
  {
    const RoundNearest nearest;
    ray = Clp_infeasibilityRay(model);
    if (ray == nullptr && Clp_dual(model, 0) == 1) ray = Clp_infeasibilityRay(model);
  }
  if (ray == nullptr) return true;
  std::vector<double> multipliers(ray, ray + rows());
  Clp_freeRay(model, ray);
  if (!contract_by(multipliers)) return false;
  for (double& multiplier : multipliers) multiplier = -multiplier;
  return contract_by(multipliers);
}

// HC4-revise of the sum of the rows times their multipliers. Of a row that is bounded on one side alone, a
// multiplier of the wrong sign would leave the sum unbounded.
bool LinearProgram::contract_by(std::span<const double> multipliers) {
  constexpr double kNoise = 1e-13;
  double most = 0.0;
  for (const double multiplier : multipliers) most = std::max(most, std::abs(multiplier));
  if (!(most > 0.0) || !std::isfinite(most)) return true;
  factors_.assign(columns_.size(), kZero);
  used_.clear();
  Interval total = kZero;
  for (std::size_t i = 0; i < rows(); ++i) {
    const double multiplier = multipliers[i];
    const double active = multiplier > 0 ? within_[i].lo() : within_[i].hi();
    if (std::abs(multiplier) <= kNoise * most || !std::isfinite(active)) continue;
    const Interval times = Interval::raw(multiplier, multiplier);
    total = up::add(total, up::mul(times, within_[i]));
    for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k) {
      const auto [column, factor] = row_terms_[k];
      used_.push_back(column);
      factors_[column] = up::add(factors_[column], up::mul(times, Interval::raw(factor, factor)));
    }
  }
  std::sort(used_.begin(), used_.end());
  used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  // Sums from the left, then what is left from the right.
  const std::size_t size = used_.size();
  terms_.resize(size);
  sums_.assign(size + 1, kZero);
  for (std::size_t k = 0; k < size; ++k) {
    terms_[k] = up::mul(factors_[used_[k]], columns_[used_[k]]);
    sums_[k + 1] = up::add(sums_[k], terms_[k]);
  }
  if (meet(sums_[size], total).is_empty()) return false;
  Interval rest = total;
  for (std::size_t k = size; k-- > 0;) {
    const Interval term = meet(terms_[k], up::sub(rest, sums_[k]));
    if (term.is_empty()) return false;
    if (!(term == terms_[k])) {
      Interval& column = columns_[used_[k]];
      column = up::mul_rev(factors_[used_[k]], term, column);
      if (column.is_empty()) return false;
    }
    rest = up::sub(rest, terms_[k]);
  }
  return true;
}

}  // namespace hcsp
