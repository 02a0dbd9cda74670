// SPDX-License-Identifier: Apache-2.0
// What a view tells of a box: HC4-revise of all tests at once, mean value forms one by one (Moore 1966), and
// in more than one unknown the interval Newton operator of Hansen and Sengupta, preconditioned.
#pragma once

#include "solver/online/machine.h"
#include "solver/online/pivoting.h"

namespace hcsp::online {

class Contraction {
 public:
  static constexpr std::uint32_t kBound = ~std::uint32_t{0};

  Contraction(Machine& machine, std::size_t most_tests, std::size_t most_core);

  /// Contracts a box in place, with regard to the unknowns of a mask; the others are data. What has an
  /// objective above `best` is out. False where nothing is left: refuted_by() is then the name of a test, or
  /// kBound. Forms are expanded from `near` where that is in the box: at a solution they contract best. It
  /// may be empty. PRECONDITION: the thread rounds upward.
  bool contract(const Code& code, std::span<Interval> box, std::uint64_t active, double best,
                std::span<const double> near);
  [[nodiscard]] std::uint32_t refuted_by() const { return refuted_by_; }
  /// Tests the box, as it was left, against all that is required, and bounds the objective on it; false where
  /// nothing is left.
  bool test_whole();
  /// Whether that was done already.
  [[nodiscard]] bool is_tested_whole() const { return is_tested_whole_; }
  /// A lower bound of the objective on the box.
  [[nodiscard]] double lower() const { return lower_; }
  /// An upper bound of it there.
  [[nodiscard]] double upper() const { return upper_; }
  /// About what the objective is in the middle of the box.
  [[nodiscard]] double expected() const { return expected_; }
  /// Whether the box is as narrow as data and rounding allow an equation to make it.
  [[nodiscard]] bool is_settled() const { return is_settled_; }

 private:
  bool evaluate(Code::Stage last);
  bool contract_by_hc4();
  bool contract_by_forms();
  void evaluate_forms();
  bool apply(const Interval& at_center, const Interval& wanted, const Interval* slopes, bool tells_apart);
  bool contract_by_newton();
  bool bound_by_multipliers();
  void find_multipliers();
  bool choose_square();
  void find_whether_settled();
  [[nodiscard]] bool is_all_noise(double factor) const;
  [[nodiscard]] double widest_part() const;
  bool out(std::uint32_t name);
  template <class F>
  void for_each_active(F f) const {
    for (std::uint64_t left = active_; left != 0; left &= left - 1)
      f(static_cast<std::size_t>(__builtin_ctzll(left)));
  }

  Machine& machine_;
  const Code* code_ = nullptr;
  std::span<Interval> box_;
  std::span<const double> near_;
  std::uint64_t active_ = 0;
  std::size_t active_count_ = 0;
  double best_ = 0.0, lower_ = 0.0, upper_ = 0.0, expected_ = 0.0;
  std::uint32_t refuted_by_ = 0;
  bool is_settled_ = false, is_tested_whole_ = false;
  std::vector<Interval> before_, center_, form_slopes_, form_values_, row_;
  std::vector<std::uint8_t> has_form_;          // by test, and one more for the objective
  std::vector<double> noise_;                   // by unknown: how narrow an equation could make it
  std::vector<double> ranges_;                  // by test: the width of its values on the box of the forms
  std::vector<double> multipliers_, residual_;  // by test; by unknown
  Pivoting pivoting_;
  std::vector<std::uint32_t> equations_;  // tests with forms
  std::vector<double> matrix_, inverse_;
};

}  // namespace hcsp::online
