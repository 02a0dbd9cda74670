// SPDX-License-Identifier: Apache-2.0
#include "solver/online/contraction.h"

#include <algorithm>
#include <cmath>

#include "domains/interval/kernel.h"
#include "solver/online/middle.h"

namespace hcsp::online {

namespace {

const Interval kZero = Interval::raw(0.0, 0.0);

double width(const Interval& x) { return x.hi() - x.lo(); }

}  // namespace

Contraction::Contraction(Machine& machine, std::size_t most_tests, std::size_t most_core)
    : machine_(machine),
      before_(most_core),
      center_(most_core),
      form_slopes_((most_tests + 1) * most_core),
      form_values_(most_tests + 1),
      row_(most_core),
      has_form_(most_tests + 1),
      noise_(most_core),
      ranges_(most_tests),
      multipliers_(most_tests),
      residual_(most_core),
      pivoting_(most_tests, most_core),
      equations_(most_tests),
      matrix_(most_core * most_core),
      inverse_(most_core * most_core) {}

bool Contraction::out(std::uint32_t name) {
  refuted_by_ = name;
  return false;
}

bool Contraction::contract(const Code& code, std::span<Interval> box, std::uint64_t active, double best,
                           std::span<const double> near) {
  constexpr int kMostSteps = 12;
  constexpr double kWorthwhile = 0.7;
  code_ = &code;
  box_ = box;
  active_ = active;
  active_count_ = static_cast<std::size_t>(__builtin_popcountll(active));
  best_ = best;
  near_ = near;
  lower_ = -kInfinity;
  for (int step = 0; step < kMostSteps; ++step) {
    is_settled_ = false;
    if (!evaluate(step == 0 ? Code::all : Code::main)) return false;
    is_tested_whole_ = active_ == 0;
    if (active_ == 0) break;
    if (step == 0 && !contract_by_hc4()) return false;
    std::copy(box.begin(), box.end(), before_.begin());
    if (!contract_by_forms()) return false;
    if (active_count_ > 1) {
      const bool alive = choose_square() ? contract_by_newton() : bound_by_multipliers();
      if (!alive) return false;
    }
    find_whether_settled();
    if (is_settled_) return test_whole();
    if (widest_part() > kWorthwhile) break;
  }
  return true;
}

// What is left of a box may have a higher lower bound, and not be what inequalities require.
bool Contraction::test_whole() {
  is_tested_whole_ = true;
  return evaluate(Code::all);
}

// How much of an unknown's width was left, where that is least.
double Contraction::widest_part() const {
  double least = 1.0;
  for_each_active([&](std::size_t v) {
    const double before = width(before_[v]), now = width(box_[v]);
    least = std::min(least, before > 0.0 && before < kInfinity ? now / before : (now < before ? 0.0 : 1.0));
  });
  return least;
}

bool Contraction::evaluate(Code::Stage last) {
  if (!machine_.evaluate_while_possible(*code_, box_, last)) return out(machine_.refuted_by());
  if (code_->wanted.empty()) return true;
  const Interval& objective = machine_.value(code_->wanted[0]);
  lower_ = std::max(lower_, objective.lo());
  upper_ = objective.hi();
  expected_ = lower_;
  return objective.is_empty() || lower_ > best_ ? out(kBound) : true;
}

// Afterwards registers hold what solutions can have: derivatives need what the box has, again.
bool Contraction::contract_by_hc4() {
  if (!machine_.backward(*code_, best_)) return out(machine_.refuted_by());
  for_each_active(
      [&](std::size_t v) { box_[v] = machine_.value(code_->first() + static_cast<Register>(v)); });
  return evaluate(Code::main);
}

// Slopes over the box, then values at its centre.
void Contraction::evaluate_forms() {
  const std::size_t core = code_->core(), tests = code_->ends[Code::main].tests;
  machine_.differentiate(*code_, active_, Code::main);
  const auto keep = [&](std::size_t i, Register reg, bool is_truth) {
    has_form_[i] = !is_truth && machine_.is_lipschitz(reg) ? 1 : 0;
    if (has_form_[i] == 0) return;
    std::size_t k = 0;
    for_each_active([&](std::size_t v) { form_slopes_[i * core + v] = machine_.slope(reg, k++); });
  };
  for (std::size_t i = 0; i < tests; ++i) keep(i, code_->tests[i].reg, code_->tests[i].is_truth);
  if (!code_->wanted.empty()) keep(tests, code_->wanted[0], false);
  for (std::size_t i = 0; i < tests; ++i) ranges_[i] = width(machine_.value(code_->tests[i].reg));
  std::copy(box_.begin(), box_.end(), center_.begin());
  for_each_active([&](std::size_t v) {
    const bool is_near = !near_.empty() && box_[v].contains(near_[v]);
    const double x = is_near ? near_[v] : middle(box_[v]);
    center_[v] = Interval::raw(x, x);
  });
  machine_.evaluate(*code_, {center_.data(), core}, Code::main);
  for (std::size_t i = 0; i < tests; ++i) form_values_[i] = machine_.value(code_->tests[i].reg);
  if (!code_->wanted.empty()) form_values_[tests] = machine_.value(code_->wanted[0]);
  // A point outside the domain of definition has no value to start from.
  for (std::size_t i = 0; i <= tests; ++i) {
    if (form_values_[i].is_empty()) has_form_[i] = 0;
  }
}

bool Contraction::contract_by_forms() {
  const std::size_t core = code_->core(), tests = code_->ends[Code::main].tests;
  for (std::size_t v = 0; v < core; ++v) {
    noise_[v] = kInfinity;
    if (((active_ >> v) & 1U) != 0 && !box_[v].is_bounded()) {
      std::fill_n(has_form_.begin(), tests + 1, std::uint8_t{0});
      return true;
    }
  }
  evaluate_forms();
  for (std::size_t i = 0; i < tests; ++i) {
    const Test& test = code_->tests[i];
    if (has_form_[i] == 0) continue;
    if (!apply(form_values_[i], test.wanted, &form_slopes_[i * core], test.is_equation))
      return out(test.name);
  }
  if (code_->wanted.empty() || has_form_[tests] == 0) return true;
  const Interval *slopes = &form_slopes_[tests * core], below = Interval::raw(-kInfinity, best_);
  if (!apply(form_values_[tests], below, slopes, false)) return out(kBound);
  Interval value = form_values_[tests];
  expected_ = value.hi();
  for_each_active(
      [&](std::size_t v) { value = up::add(value, up::mul(slopes[v], up::sub(box_[v], center_[v]))); });
  lower_ = std::max(lower_, value.lo());
  return lower_ > best_ ? out(kBound) : true;
}

// at_center + slopes (x - center) in `wanted`, for each unknown; false where it nowhere is. An equation that
// tells unknowns apart makes them no narrower than its value at the centre is, by the slope.
bool Contraction::apply(const Interval& at_center, const Interval& wanted, const Interval* slopes,
                        bool tells_apart) {
  bool alive = true;
  for_each_active([&](std::size_t v) {
    if (!alive) return;
    Interval rest = up::sub(wanted, at_center);
    for_each_active([&](std::size_t u) {
      if (u != v) rest = up::sub(rest, up::mul(slopes[u], up::sub(box_[u], center_[u])));
    });
    const Interval step = up::mul_rev(slopes[v], rest, up::sub(box_[v], center_[v]));
    if (tells_apart && !slopes[v].contains(0.0))
      noise_[v] = std::min(noise_[v], width(at_center) / std::max(-slopes[v].lo(), slopes[v].hi()));
    box_[v] = meet(box_[v], up::add(center_[v], step));
    alive = !box_[v].is_empty();
  });
  return alive;
}

// As many equations as active unknowns, those that Gauss's elimination pivots on.
bool Contraction::choose_square() {
  std::size_t rows = 0;
  for (std::uint32_t i = 0; i < code_->ends[Code::main].tests; ++i) {
    if (code_->tests[i].is_equation && has_form_[i] != 0) equations_[rows++] = i;
  }
  if (rows < active_count_) return false;
  pivoting_.start(rows, code_->core());
  for (std::size_t k = 0; k < rows; ++k) {
    for_each_active([&](std::size_t v) {
      const Interval& slope = form_slopes_[equations_[k] * code_->core() + v];
      pivoting_.at(k, v) = 0.5 * slope.lo() + 0.5 * slope.hi();
    });
    pivoting_.right(k) = 0.0;
  }
  if (!pivoting_.eliminate(1e-15) || pivoting_.rank() < active_count_) return false;
  const std::size_t n = active_count_;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t l = 0; l < n; ++l) {
      const Interval& slope =
          form_slopes_[equations_[pivoting_.row(k)] * code_->core() + pivoting_.column(l)];
      matrix_[k * n + l] = 0.5 * slope.lo() + 0.5 * slope.hi();
    }
  }
  return invert({matrix_.data(), n * n}, {inverse_.data(), n * n}, n);
}

bool Contraction::contract_by_newton() {
  const std::size_t n = active_count_;
  for (std::size_t k = 0; k < n; ++k) {
    Interval value = kZero;
    for_each_active([&](std::size_t v) { row_[v] = kZero; });
    for (std::size_t l = 0; l < n; ++l) {
      const std::uint32_t equation = equations_[pivoting_.row(l)];
      const double factor = inverse_[k * n + l];
      if (factor == 0.0) continue;
      value = up::add(value, up::scale(factor, form_values_[equation]));
      const Interval* slopes = &form_slopes_[equation * code_->core()];
      for_each_active([&](std::size_t v) { row_[v] = up::add(row_[v], up::scale(factor, slopes[v])); });
    }
    if (!apply(value, kZero, row_.data(), true)) return out(code_->tests[equations_[pivoting_.row(0)]].name);
  }
  return true;
}

// For multipliers m, those of inequalities not negative, f + m g is at most f wherever all requirements g
// hold: its least value is a lower bound of the objective f. Near a minimum its slopes nearly cancel.
bool Contraction::bound_by_multipliers() {
  const std::size_t core = code_->core(), tests = code_->ends[Code::main].tests;
  if (code_->wanted.empty() || has_form_[tests] == 0) return true;
  find_multipliers();
  Interval value = form_values_[tests];
  for_each_active([&](std::size_t v) { row_[v] = form_slopes_[tests * core + v]; });
  for (std::size_t i = 0; i < tests; ++i) {
    const double by = multipliers_[i];
    if (by == 0.0) continue;
    value = up::add(value, up::scale(by, form_values_[i]));
    for_each_active(
        [&](std::size_t v) { row_[v] = up::add(row_[v], up::scale(by, form_slopes_[i * core + v])); });
  }
  for_each_active(
      [&](std::size_t v) { value = up::add(value, up::mul(row_[v], up::sub(box_[v], center_[v]))); });
  if (value.is_empty()) return true;
  lower_ = std::max(lower_, value.lo());
  return lower_ > best_ ? out(kBound) : true;
}

// Least squares of the slopes that are left, by coordinate descent: any multipliers will do.
void Contraction::find_multipliers() {
  constexpr int kSweeps = 30;
  const std::size_t core = code_->core(), tests = code_->ends[Code::main].tests;
  const auto slope = [&](std::size_t i, std::size_t v) {
    const Interval& own = form_slopes_[i * core + v];
    return (0.5 * own.lo() + 0.5 * own.hi()) * width(before_[v]);
  };
  for_each_active([&](std::size_t v) { residual_[v] = slope(tests, v); });
  std::fill_n(multipliers_.begin(), tests, 0.0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double most = 0.0;
    for (std::size_t i = 0; i < tests; ++i) {
      const Test& test = code_->tests[i];
      if (has_form_[i] == 0 || !(test.wanted.hi() == 0.0)) continue;
      double square = 0.0, product = 0.0;
      for_each_active([&](std::size_t v) {
        square += slope(i, v) * slope(i, v);
        product += slope(i, v) * residual_[v];
      });
      if (!(square > 0.0 && square < kInfinity)) continue;
      const double wanted = multipliers_[i] - product / square;
      const double now = test.is_equation ? wanted : std::max(0.0, wanted);
      const double change = now - multipliers_[i];
      if (!(std::abs(change) < kInfinity)) continue;
      multipliers_[i] = now;
      for_each_active([&](std::size_t v) { residual_[v] += change * slope(i, v); });
      most = std::max(most, change * change * square);
    }
    double left = 0.0;
    for_each_active([&](std::size_t v) { left += residual_[v] * residual_[v]; });
    if (most <= 1e-6 * left) break;
  }
}

// Data and rounding make an equation's zeros a set with some width: cutting it tells nothing.
void Contraction::find_whether_settled() {
  constexpr double kFilled = 4.0, kTiny = 4e-16, kLocal = 1e-2;
  bool all = true;
  for_each_active([&](std::size_t v) {
    const Interval& x = box_[v];
    const double size = std::max(std::abs(x.lo()), std::abs(x.hi()));
    const bool is_local = width(before_[v]) <= kLocal * size;  // or its centre tells of elsewhere
    const double noise = is_local && noise_[v] < kInfinity ? kFilled * noise_[v] : 0.0;
    const double spacing = kTiny * size + std::numeric_limits<double>::min();
    all = all && x.is_bounded() && width(x) <= std::max(noise, spacing);
  });
  is_settled_ = all || (active_count_ == 1 && is_all_noise(kFilled));
}

// Whether no equation varies over the box, before this step, by much more than data and rounding blur it.
bool Contraction::is_all_noise(double factor) const {
  bool has_equation = false;
  const auto v = static_cast<std::size_t>(__builtin_ctzll(active_));
  for (std::size_t i = 0; i < code_->ends[Code::main].tests; ++i) {
    if (!code_->tests[i].is_equation) continue;
    const Interval& slope = form_slopes_[i * code_->core() + v];
    const double steepest = std::max(-slope.lo(), slope.hi());
    const double noise = factor * width(form_values_[i]);
    const bool is_flat = has_form_[i] != 0 && steepest * width(before_[v]) <= noise;
    if (!is_flat && !(ranges_[i] <= noise)) return false;
    has_equation = true;
  }
  return has_equation;
}

}  // namespace hcsp::online
