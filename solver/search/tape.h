// SPDX-License-Identifier: Apache-2.0
// The expressions of a system of relations as code over one set of registers, for search: a common
// sub-expression is computed once, and what one relation says of it the others see. What has no derivative,
// choices, steps and connectives, is left to choices.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/expression/dag.h"

namespace hcsp {

/// Whether a tape can hold an expression: a real-valued one, of reals, without choices and steps.
bool fits_tape(const Dag& dag, NodeId root);

class Tape {
 public:
  struct Instruction {
    Op op;
    std::uint8_t arity;
    std::uint32_t y, a, b, c;  // registers; unused operands repeat a
  };
  /// How y depends on its operand a: with the slope 1 or -1, or with the derivative in the register `value`.
  /// Of some, differences from a centre tell more (TapeRun::slopes): the square of a; a times the register
  /// `value`; what is divided by a; a function of one operand.
  struct Slope {
    enum class Kind : std::uint8_t { one, minus_one, derivative, square, factor, divisor, function };
    Kind kind;
    Op op;
    std::uint32_t y, a, value, exponent;  // of powers
  };

  /// Adds nodes of derivatives to the graph. Every input of the roots is one of `variables`, whose registers
  /// are 0, 1, ...
  Tape(Dag& dag, const std::vector<NodeId>& roots, const std::vector<Input>& variables);

  [[nodiscard]] std::size_t variables() const { return variables_; }
  [[nodiscard]] std::size_t roots() const { return roots_.size(); }
  [[nodiscard]] std::size_t registers() const { return registers_; }
  [[nodiscard]] std::uint32_t root(std::size_t i) const { return roots_[i].reg; }
  /// Of code(): the registers of constants come after those of variables and before those of results.
  [[nodiscard]] bool is_constant(std::uint32_t reg) const { return variables_ <= reg && reg < first_result_; }
  /// Constants and the registers that hold them.
  [[nodiscard]] std::span<const std::pair<std::uint32_t, Interval>> constants() const { return constants_; }
  /// All expressions, and one alone, whose instructions stand side by side; operands precede results.
  [[nodiscard]] std::span<const Instruction> code() const { return code_; }
  [[nodiscard]] std::span<const Instruction> code(std::size_t i) const { return roots_[i].code; }
  /// What the slopes need besides code().
  [[nodiscard]] std::span<const Instruction> slope_code() const { return slope_code_; }
  /// The chain rule of a root, from the root to the variables.
  [[nodiscard]] std::span<const Slope> slopes(std::size_t i) const { return roots_[i].slopes; }
  /// The variables of a root.
  [[nodiscard]] std::span<const std::uint32_t> variables(std::size_t i) const { return roots_[i].variables; }
  /// The instructions that need not be defined and Lipschitz continuous on a box.
  [[nodiscard]] std::span<const Instruction> partial(std::size_t i) const { return roots_[i].partial; }

 private:
  struct Root {
    std::uint32_t reg = 0;
    std::vector<Instruction> code, partial;
    std::vector<Slope> slopes;
    std::vector<std::uint32_t> variables;
  };
  std::size_t variables_, registers_ = 0;
  std::uint32_t first_result_ = 0;
  std::vector<std::pair<std::uint32_t, Interval>> constants_;
  std::vector<Instruction> code_, slope_code_;
  std::vector<Root> roots_;
};

/// The registers of a tape at work on boxes. PRECONDITION of all: the thread rounds upward.
class TapeRun {
 public:
  explicit TapeRun(const Tape& tape);

  /// Starts on a box, whose intervals the registers of the variables then are.
  void start(std::span<const Interval> box);
  [[nodiscard]] const Interval& variable(std::size_t v) const { return registers_[v]; }
  /// What is known of a register: of an expression, since start(), where a relation that has it was revised.
  [[nodiscard]] const Interval& at(std::uint32_t reg) const { return registers_[reg]; }

  /// HC4-revise of "root i lies in `wanted`" on the domains that the registers hold since start(); false when
  /// it nowhere can.
  bool revise(std::size_t i, const Interval& wanted);

  /// The values of all roots, and of the slopes' registers, on a box. Forgets start().
  void evaluate(std::span<const Interval> box, bool with_slopes);
  [[nodiscard]] const Interval& value(std::size_t i) const { return registers_[tape_.root(i)]; }
  /// After evaluate() with slopes: the gradient of root i on the box, by variable; those that it does not
  /// depend on are left alone.
  void gradient(std::size_t i, std::span<Interval> result);

  /// The values of all roots at a point of a box, and what slopes() needs besides. Forgets start().
  void evaluate_from(std::span<const Interval> center, std::span<const Interval> box);
  [[nodiscard]] const Interval& value_at_center(std::size_t i) const { return center_[tape_.root(i)]; }
  /// After evaluate_from(): f(x) - f(center) lies in slopes (x - center) for every x of the box where root i
  /// is defined between the two (Krawczyk, Neumaier 1985; Ratz 1996 on convex functions). Narrower than the
  /// gradient, by half where f is a polynomial of degree 2.
  void slopes(std::size_t i, std::span<Interval> result);
  /// After evaluate(): whether root i is defined and Lipschitz continuous on all of the box.
  [[nodiscard]] bool is_continuous(std::size_t i) const;

 private:
  void load(std::span<const Interval> box);
  template <class Operator>
  bool forward_one(const Tape::Instruction& at);
  template <class Operator>
  bool backward_one(const Tape::Instruction& at);
  void evaluate_code(std::span<const Tape::Instruction> code);
  template <class SlopeOf>
  void accumulate(std::size_t i, std::span<Interval> result, SlopeOf slope_of);
  [[nodiscard]] Interval slope_from_center(const Tape::Slope& slope) const;
  [[nodiscard]] Interval slope_of_function(const Tape::Slope& slope) const;

  const Tape& tape_;
  std::vector<Interval> registers_, center_, adjoints_;
  std::vector<std::uint8_t> narrowed_;  // by register: no longer what forward gave
};

}  // namespace hcsp
