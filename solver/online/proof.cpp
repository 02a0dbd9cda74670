// SPDX-License-Identifier: Apache-2.0
#include "solver/online/proof.h"

#include <algorithm>
#include <cmath>

#include "domains/interval/kernel.h"
#include "solver/online/play.h"

namespace hcsp::online {

namespace {

// Which of the unknowns of a mask one is.
std::size_t place(std::uint64_t mask, std::uint32_t v) {
  return static_cast<std::size_t>(__builtin_popcountll(mask & ((std::uint64_t{1} << v) - 1)));
}

}  // namespace

Proof::Proof(Machine& machine, std::size_t most_tests, std::size_t most_core)
    : machine_(machine),
      unknowns_(most_core),
      point_(most_core),
      changes_(most_core),
      greatest_(most_core),
      rooms_(most_core),
      is_active_(most_tests),
      is_solved_(most_tests),
      rows_(most_tests),
      open_(most_tests),
      aims_(most_tests),
      least_(most_tests),
      pivoting_(most_tests, most_core),
      solved_rows_(most_core),
      columns_(most_core),
      jacobian_(most_core * most_core),
      inverse_(most_core * most_core),
      radius_(most_core),
      box_(most_core),
      reach_(most_core),
      slopes_(most_core * most_core),
      residual_(most_core),
      step_(most_core),
      image_(most_core) {}

bool Proof::find(const Code& code, std::span<const double> near, std::span<const Interval> domains, By by) {
  constexpr int kMostRounds = 6;
  code_ = &code;
  domains_ = domains;
  size_ = code.core();
  free_ = all_ = 0;
  for (std::size_t v = 0; v < size_; ++v) {
    all_ |= std::uint64_t{1} << v;
    if (!is_thin(domains[v])) free_ |= std::uint64_t{1} << v;
  }
  if (by == By::data) free_ = all_ &= ~free_;
  std::copy(near.begin(), near.end(), point_.begin());
  std::fill_n(is_active_.begin(), code.tests.size(), std::uint8_t{0});
  std::fill_n(aims_.begin(), code.tests.size(), 0.0);
  for (int round = 0; round < kMostRounds; ++round) {
    if (!correct()) return false;
    if (is_exact_ && holds_at_point()) return true;
    if (!solve_exactly()) return false;
    if (all_hold()) return true;
    if (!activate_open()) return false;
  }
  return false;
}

void Proof::keep_within_domains() {
  for (std::size_t v = 0; v < size_; ++v)
    point_[v] = std::min(std::max(point_[v], domains_[v].lo()), domains_[v].hi());
}

// How far an unknown can move before it leaves its domain, where that is little. What is solved for may be at
// an end, and get off it; data that only help are not to come near one.
double Proof::room(std::size_t v) const {
  const double x = point_[v], below = x - domains_[v].lo(), above = domains_[v].hi() - x;
  const bool is_solved_for = ((free_ >> v) & 1U) != 0;
  const double most = is_solved_for ? std::max(below, above) : std::min(below, above);
  return std::max(0.0, std::min(std::max(std::abs(x), 1.0), most));
}

// Equations, and what an attempt before left undecided, or violated.
void Proof::collect_rows() {
  row_count_ = 0;
  for (std::uint32_t i = 0; i < code_->tests.size(); ++i) {
    const Test& test = code_->tests[i];
    if (test.is_equation || is_active_[i] != 0) rows_[row_count_++] = i;
  }
  const bool is_main = row_count_ == 0 || rows_[row_count_ - 1] < code_->ends[Code::main].tests;
  stage_ = is_main ? Code::main : Code::all;
}

// With regard to the unknowns of a mask; false where a number is not finite.
bool Proof::fill_matrix(std::uint64_t active) {
  machine_.differentiate_real(*code_, active, stage_);
  std::size_t columns = 0;
  for (std::uint64_t left = active; left != 0; left &= left - 1)
    unknowns_[columns++] = static_cast<std::uint32_t>(__builtin_ctzll(left));
  pivoting_.start(row_count_, columns);
  for (std::size_t l = 0; l < columns; ++l) rooms_[unknowns_[l]] = room(unknowns_[l]);
  for (std::size_t k = 0; k < row_count_; ++k) {
    const Register reg = code_->tests[rows_[k]].reg;
    for (std::size_t l = 0; l < columns; ++l)
      pivoting_.at(k, l) = machine_.real_slope(reg, l) * rooms_[unknowns_[l]];
    pivoting_.right(k) = -excess(k);
  }
  active_ = active;
  constexpr double kNoise = 1e-15, kPlay = 1e-11;  // what data move is less than that of the others
  return pivoting_.eliminate(active == all_ ? kNoise : kPlay);
}

// The matrix of a step before, at the point at hand.
void Proof::keep_matrix() {
  for (std::size_t k = 0; k < row_count_; ++k) pivoting_.right(k) = -excess(k);
  pivoting_.solve_again();
}

// How far row k is above what is aimed at.
double Proof::excess(std::size_t k) const {
  return machine_.real(code_->tests[rows_[k]].reg) - aims_[rows_[k]];
}

// Whether some row is much nearer to 0 than it ever was: otherwise all that moves is rounding.
bool Proof::is_closer() {
  constexpr double kMuch = 0.5;
  bool is_any = false;
  for (std::size_t k = 0; k < row_count_; ++k) {
    const double size = std::abs(excess(k));
    is_any = is_any || size < kMuch * least_[k];
    least_[k] = std::min(least_[k], size);
  }
  return is_any;
}

// Towards a double root each step is half of the one before: what all of them would come to, nearly.
double Proof::change_of(std::size_t k) {
  constexpr double kAll = 1.999, kAbout = 0.05;
  const std::uint32_t v = unknowns_[pivoting_.column(k)];
  const double change = pivoting_.solution(k) * rooms_[v], half = 0.5 * changes_[v];
  const bool is_halved = std::abs(change - half) < kAbout * std::abs(half);
  changes_[v] = is_halved ? 0.0 : change;
  return is_halved ? kAll * change : change;
}

// A step's change of each unknown; data are solved for only where the others do not do. False without one.
bool Proof::find_step(bool is_chord) {
  if (is_chord) {
    keep_matrix();
    return true;
  }
  return fill_matrix(free_) && (pivoting_.rank() == row_count_ || fill_matrix(all_));
}

// Makes it: how much it changes, relatively, next to what an unknown is and next to what it was of late. Not
// finite where a change is not.
Proof::Step Proof::take_step() {
  constexpr double kFades = 1e-4;
  Step step{0.0, 0.0};
  for (std::size_t k = 0; k < pivoting_.rank(); ++k) {
    const std::uint32_t v = unknowns_[pivoting_.column(k)];
    const double change = change_of(k);
    if (!std::isfinite(change)) return {kInfinity, kInfinity};
    greatest_[v] = std::max(kFades * greatest_[v], std::abs(point_[v]));
    point_[v] += change;
    const double size = std::max(std::abs(point_[v]), std::numeric_limits<double>::min());
    step.now = std::max(step.now, std::abs(change) / size);
    step.of_late = std::max(step.of_late, std::abs(change) / std::max(size, greatest_[v]));
  }
  return step;
}

// Newton's method in floating point. Where a step is small, next to all that an unknown was on the way of
// late, the next would be far smaller. Near the solution the slopes of a step before do.
bool Proof::correct() {
  constexpr int kMostSteps = 20;
  constexpr int kMostVain = 2, kAstray = 6;
  constexpr double kSmall = 1e-12;  // next to what data play, or a kink may be on the way
  constexpr double kNear = 1e-2, kStalled = 0.75, kSquare = 1e-7, kMuchSmaller = 1e-3, kMuchLess = 0.1;
  collect_rows();
  std::fill_n(least_.begin(), row_count_, kInfinity);
  std::fill_n(changes_.begin(), size_, 0.0);
  std::fill_n(greatest_.begin(), size_, std::numeric_limits<double>::min());
  int vain = 0;
  double before = kInfinity;
  bool is_chord = false;
  for (int i = 0; i < kMostSteps; ++i) {
    keep_within_domains();
    machine_.evaluate_real(*code_, {point_.data(), size_}, stage_);
    is_exact_ = true;
    for (std::size_t k = 0; k < row_count_; ++k) is_exact_ = is_exact_ && excess(k) == 0.0;
    vain = is_closer() ? 0 : vain + 1;
    if (!find_step(is_chord)) return false;
    const Step step = take_step();
    if (!(step.now < kInfinity)) return false;
    const bool is_square = is_chord ? step.now * step.now < kSquare * kSquare * before
                                    : step.now < kSquare && step.now < kMuchSmaller * before;
    const bool is_stalled = vain >= kMostVain || step.now > kStalled * before;
    const bool is_overdetermined = pivoting_.rank() < row_count_;  // to converge, it has to at once
    const bool is_vain =
        vain >= kAstray || (is_stalled && step.now < kNear) || (is_overdetermined && i >= kAstray);
    if (is_square || step.of_late < kSmall || is_vain) break;
    is_chord = step.now < kNear && (!is_chord || step.now < kMuchLess * before);
    before = step.now;
  }
  keep_within_domains();
  return true;
}

// Where all rests equations hold exactly, though no Newton's method could tell.
bool Proof::holds_at_point() {
  std::fill_n(is_solved_.begin(), code_->tests.size(), std::uint8_t{0});
  for (std::size_t v = 0; v < size_; ++v) box_[v] = Interval::raw(point_[v], point_[v]);
  return all_hold();
}

// The rows that pivots were found for, in the pivots' unknowns.
bool Proof::solve_exactly() {
  rank_ = pivoting_.rank();
  std::fill_n(is_solved_.begin(), code_->tests.size(), std::uint8_t{0});
  for (std::size_t k = 0; k < rank_; ++k) {
    solved_rows_[k] = rows_[pivoting_.row(k)];
    columns_[k] = unknowns_[pivoting_.column(k)];
    is_solved_[solved_rows_[k]] = 1;
  }
  for (std::size_t v = 0; v < size_; ++v) box_[v] = Interval::raw(point_[v], point_[v]);
  if (rank_ == 0) return true;
  for (std::size_t k = 0; k < rank_; ++k) {
    for (std::size_t l = 0; l < rank_; ++l)
      jacobian_[k * rank_ + l] =
          machine_.real_slope(code_->tests[solved_rows_[k]].reg, place(active_, columns_[l]));
  }
  machine_.evaluate(*code_, {box_.data(), size_}, stage_);
  for (std::size_t k = 0; k < rank_; ++k) {
    const std::uint32_t row = solved_rows_[k];
    residual_[k] = up::sub(machine_.value(code_->tests[row].reg), Interval::raw(aims_[row], aims_[row]));
  }
  std::fill_n(radius_.begin(), rank_, 0.0);
  if (!precondition()) return false;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (!expand()) return false;
    // At a kink the slopes are of several sides: between them is the best inverse.
    if (is_kinked_ && (!take_middle() || !precondition())) return false;
    if (contract_to_solution()) return true;
    for (std::size_t k = 0; k < rank_; ++k) radius_[k] *= kMore;
  }
  return false;
}

// Y, an inverse of the Jacobian at hand, and Y f(c): how far the solution may be.
bool Proof::precondition() {
  const std::size_t n = rank_ * rank_;
  if (!invert({jacobian_.data(), n}, {inverse_.data(), n}, rank_)) return false;
  for (std::size_t k = 0; k < rank_; ++k) {
    Interval sum = Interval::raw(0.0, 0.0);
    for (std::size_t l = 0; l < rank_; ++l) {
      const double factor = inverse_[k * rank_ + l];
      if (factor != 0.0) sum = up::add(sum, up::scale(factor, residual_[l]));
    }
    if (sum.is_empty() || !sum.is_bounded()) return false;
    step_[k] = -sum;
    constexpr double kRoom = 2.0, kLeast = 1e-16;
    const double needed = kRoom * std::max(sum.hi(), -sum.lo()) + kLeast * std::abs(point_[columns_[k]]) +
                          std::numeric_limits<double>::min();
    radius_[k] = std::max(radius_[k], needed);
  }
  return true;
}

// F'(X), X around the point: where kinks are in X the hull of what it is on all sides of them, since along a
// line through X it is one of these at almost every place.
bool Proof::expand() {
  std::copy_n(box_.begin(), size_, reach_.begin());
  std::uint64_t active = 0;
  for (std::size_t k = 0; k < rank_; ++k) {
    const std::uint32_t v = columns_[k];
    reach_[v] = Interval::raw(up::sub_down(point_[v], radius_[k]), point_[v] + radius_[k]);
    active |= std::uint64_t{1} << v;
  }
  machine_.evaluate(*code_, {reach_.data(), size_}, stage_);
  for (std::size_t k = 0; k < rank_; ++k) {
    const Register reg = code_->tests[solved_rows_[k]].reg;
    if (!machine_.is_defined(reg) || !machine_.is_lipschitz(reg)) return false;
  }
  std::array<std::uint32_t, kMostSurfaces> surfaces{};
  std::size_t open = 0;
  if (!machine_.find_open_surfaces(*code_, stage_, surfaces, open))
    open = 0;  // the hull of each kink by itself
  is_kinked_ = open > 0;
  std::fill_n(slopes_.begin(), rank_ * rank_, Interval::empty());
  for (std::size_t sides = 0; sides < std::size_t{1} << open; ++sides) {
    for (std::size_t s = 0; s < open; ++s)
      machine_.set_side(surfaces[s], ((sides >> s) & 1U) != 0 ? Machine::Side::above : Machine::Side::below);
    machine_.differentiate(*code_, active, stage_);
    join_slopes(active);
  }
  for (std::size_t s = 0; s < open; ++s) machine_.set_side(surfaces[s], Machine::Side::both);
  return true;
}

void Proof::join_slopes(std::uint64_t active) {
  for (std::size_t k = 0; k < rank_; ++k) {
    for (std::size_t l = 0; l < rank_; ++l) {
      Interval& slope = slopes_[k * rank_ + l];
      slope = join(slope, machine_.slope(code_->tests[solved_rows_[k]].reg, place(active, columns_[l])));
    }
  }
}

bool Proof::take_middle() {
  for (std::size_t i = 0; i < rank_ * rank_; ++i) {
    if (!slopes_[i].is_bounded()) return false;
    jacobian_[i] = 0.5 * slopes_[i].lo() + 0.5 * slopes_[i].hi();
  }
  return true;
}

// K(X) = c - Y f(c) + (I - Y F'(X)) (X - c), within the interior of X: the map x - Y f(x) has a fixed point
// in X (Brouwer), and Y is regular.
bool Proof::contract_to_solution() {
  for (std::size_t k = 0; k < rank_; ++k) {
    Interval image = step_[k];
    for (std::size_t l = 0; l < rank_; ++l) {
      Interval slope = k == l ? Interval::raw(1.0, 1.0) : Interval::raw(0.0, 0.0);
      for (std::size_t m = 0; m < rank_; ++m) {
        const double factor = inverse_[k * rank_ + m];
        if (factor != 0.0) slope = up::sub(slope, up::scale(factor, slopes_[m * rank_ + l]));
      }
      image = up::add(image, up::mul(slope, up::sub(reach_[columns_[l]], box_[columns_[l]])));
    }
    const std::uint32_t v = columns_[k];
    image_[k] = up::add(box_[v], image);
    if (!(image_[k].lo() > reach_[v].lo() && image_[k].hi() < reach_[v].hi())) return false;
  }
  for (std::size_t k = 0; k < rank_; ++k) box_[columns_[k]] = image_[k];
  return true;
}

// What is solved for does; what else does not, or may not, is open.
bool Proof::all_hold() {
  open_count_ = 0;
  for (std::size_t v = 0; v < size_; ++v) {
    if (!leq(box_[v], domains_[v])) return false;
  }
  machine_.evaluate(*code_, {box_.data(), size_});
  for (std::uint32_t i = 0; i < code_->tests.size(); ++i) {
    const Test& test = code_->tests[i];
    if ((is_solved_[i] == 0 || test.strict) && !machine_.holds(test)) open_[open_count_++] = i;
  }
  return open_count_ == 0;
}

// What is violated is to be solved for in the next round; or else what only just holds, if it does, is to be
// clear of its limit. False where there is nothing new to solve for, or what was solved for is violated.
bool Proof::activate_open() {
  constexpr double kClear = 8.0;  // widths of what is undecided
  const auto open = std::span(open_).first(open_count_);
  const auto is_violated = [&](std::uint32_t i) { return !machine_.is_possible(code_->tests[i]); };
  const bool is_any_violated = std::ranges::any_of(open, is_violated);
  bool is_any_new = false;
  for (const std::uint32_t i : open) {
    if (is_any_violated && !is_violated(i)) continue;
    const Test& test = code_->tests[i];
    const bool is_limit = !test.is_equation && test.wanted.hi() == 0.0 && machine_.is_defined(test.reg);
    if (is_any_violated && (!is_limit || is_active_[i] != 0)) return false;
    const Interval& value = machine_.value(test.reg);
    const double aim = is_any_violated ? 0.0 : -kClear * (value.hi() - value.lo());
    if (!is_limit || (is_active_[i] != 0 && aims_[i] <= aim)) continue;
    is_active_[i] = 1;
    aims_[i] = aim;
    is_any_new = true;
  }
  return is_any_new;
}

}  // namespace hcsp::online
