// SPDX-License-Identifier: Apache-2.0
// The registers of a compiled problem at work: values and derivatives, as intervals and as doubles. Nothing
// is allocated after construction. PRECONDITION of all: the thread rounds upward.
#pragma once

#include <span>
#include <vector>

#include "solver/online/sections.h"

namespace hcsp::online {

/// f(kind, rule) of each rule, the kind known to the compiler: one dispatch for a run of one kind.
template <class F>
void for_each_rule(std::span<const ChainRule> rules, F f) {
  using Kind = ChainRule::Kind;
  const ChainRule *at = rules.data(), *const end = at + rules.size();
  const auto run = [&](auto kind) {
    do f(kind, *at++);
    while (at != end && at->kind == kind());
  };
  const auto dispatch = [&]<Kind... kKinds>(std::integer_sequence<Kind, kKinds...>) {
    static_cast<void>(
        ((at->kind == kKinds ? (run(std::integral_constant<Kind, kKinds>{}), true) : false) || ...));
  };
  while (at != end) {
    dispatch(std::integer_sequence<Kind, Kind::copy, Kind::negate, Kind::add, Kind::sub, Kind::min, Kind::max,
                                   Kind::abs, Kind::choice, Kind::constant, Kind::root, Kind::scale,
                                   Kind::scale_both>{});
  }
}

class Machine {
 public:
  /// Room for a prefix, and for the own registers, the unknowns and the surfaces of kinks of the largest
  /// view.
  Machine(const Prefix& prefix, std::size_t own_registers, std::size_t core, std::size_t surfaces);

  /// Gives the parameters values.
  void load(std::span<const Interval> parameters);
  /// Evaluates code of the prefix.
  void evaluate(std::span<const Instruction> givens);
  /// The same, but for sections whose guards tell that nothing reads them.
  void evaluate(std::span<const Section> givens);

  /// Evaluates the tests and objectives of a view on a box of its core, as far as a stage.
  void evaluate(const Code& code, std::span<const Interval> box, Code::Stage last = Code::all);
  /// The same as far as a stage, or as one with a test that holds nowhere in the box: then false, and
  /// refuted_by() is its name.
  bool evaluate_while_possible(const Code& code, std::span<const Interval> box, Code::Stage last);
  /// After evaluate(): what definitions are; after that, what further wanted expressions are.
  void evaluate_rest(const Code& code) { run(code.rest); }
  void evaluate_further(const Code& code) { run(code.further); }
  /// After evaluate(): derivatives of what a stage needs, with regard to the unknowns of a mask; those of
  /// undecided kinks are hulls.
  void differentiate(const Code& code, std::uint64_t active, Code::Stage last = Code::all);
  /// After evaluate(): the surfaces of kinks that are within the box, as many as there is room for; false
  /// where they are more.
  bool find_open_surfaces(const Code& code, Code::Stage last, std::span<std::uint32_t> found,
                          std::size_t& count) const;
  /// From now on derivatives at kinks with this surface are those of a side of it, or of both.
  enum class Side : std::uint8_t { both, below, above };
  void set_side(std::uint32_t surface, Side side) { sides_[surface] = side; }

  [[nodiscard]] const Interval& value(Register reg) const { return values_[reg]; }
  /// Whether the expression is defined on all of the box.
  [[nodiscard]] bool is_defined(Register reg) const { return (flags_[reg] & kDefined) != 0; }
  /// Whether slope() holds of it: where it is defined its values differ by no more.
  [[nodiscard]] bool is_lipschitz(Register reg) const { return (flags_[reg] & kLipschitz) != 0; }
  /// After differentiate(), with regard to the k-th of the unknowns of its mask.
  [[nodiscard]] const Interval& slope(Register reg, std::size_t k) const { return slopes_of(reg)[k]; }
  /// Whether a requirement may hold somewhere in the box.
  [[nodiscard]] bool is_possible(const Test& test) const {
    const Interval met = meet(values_[test.reg], test.wanted);
    return !met.is_empty() && !(test.strict && met.lo() == test.wanted.hi());
  }
  /// Whether a requirement holds on all of the box.
  [[nodiscard]] bool holds(const Test& test) const {
    const Interval& value = values_[test.reg];
    return is_defined(test.reg) && leq(value, test.wanted) &&
           !(test.strict && value.hi() == test.wanted.hi());
  }

  /// After evaluate(), HC4-revise of all tests of numbers at once, and of the first objective <= best; the
  /// core's registers are then contracted. False where no point of the box obeys them.
  bool backward(const Code& code, double best);
  [[nodiscard]] std::uint32_t refuted_by() const { return refuted_by_; }

  /// Puts aside what a code's own registers hold, and brings it back.
  void keep(const Code& code);
  void recall(const Code& code);

  /// What a code reads of the prefix, in floating point.
  void load_real(const Code& code);
  /// The same expressions in floating point, at a point; derivatives, where a kink has the one of a side.
  void evaluate_real(const Code& code, std::span<const double> point, Code::Stage last);
  void differentiate_real(const Code& code, std::uint64_t active, Code::Stage last);
  [[nodiscard]] double real(Register reg) const { return reals_[reg]; }
  /// After differentiate_real(), with regard to the k-th of the unknowns of its mask.
  [[nodiscard]] double real_slope(Register reg, std::size_t k) const {
    return real_slopes_of(reg)[k / kLanes][k % kLanes];
  }

 private:
  static constexpr std::uint8_t kDefined = 1, kLipschitz = 2;
  // Rows of derivatives in floating point have their columns by twos, what is beyond the last is 0.
  using Lanes [[gnu::vector_size(16)]] = double;
  static constexpr std::size_t kLanes = 2;
  static constexpr std::size_t lanes(std::size_t columns) { return (columns + kLanes - 1) / kLanes; }
  /// What a solution needs of a register: that it has a value, or one in less than what was computed.
  enum class Need : std::uint8_t { none, value, narrower };

  // Rows of derivatives: of a prefix's register, zeros.
  [[nodiscard]] const Interval* slopes_of(Register reg) const {
    return &slopes_[reg < first_ ? 0 : (reg - first_ + 1) * columns_];
  }
  [[nodiscard]] const Lanes* real_slopes_of(Register reg) const {
    return &real_slopes_[reg < first_ ? 0 : (reg - first_ + 1) * real_lanes_];
  }
  void load(const Code& code, std::span<const Interval> box);
  void run(std::span<const Instruction> code, std::uint8_t known = 0);
  template <Op kOp, class Operator>
  static void run_one(const Instruction& at, Interval* values, std::uint8_t* all_flags, std::uint8_t known);
  static std::uint8_t flags_of_choice(const Instruction& at, const Interval* values,
                                      const std::uint8_t* flags);
  template <ChainRule::Kind kKind>
  void apply(const ChainRule& rule);
  template <Op kOp, class Operator>
  bool revise_one(const Code& code, const Instruction& at);
  bool narrow(const Code& code, Register reg, const Interval& value);
  void run_real(std::span<const Instruction> code);
  template <ChainRule::Kind kKind>
  void apply_real(const ChainRule& rule);

  Register first_;  // own register
  std::size_t columns_ = 0, real_lanes_ = 0;
  std::vector<Interval> values_, slopes_, kept_;
  std::vector<std::uint8_t> flags_;
  std::vector<Need> needed_;
  std::vector<double> reals_;
  std::vector<Lanes> real_slopes_;
  std::vector<Side> sides_;  // by surface
  std::uint32_t refuted_by_ = 0;
};

}  // namespace hcsp::online
