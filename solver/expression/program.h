// SPDX-License-Identifier: Apache-2.0
// Expressions as flat bytecode: the part of a graph that some roots need, in evaluation order, each
// instruction with its own register. HC4-revise (Benhamou, Goualard, Granvilliers, Puget 1999) is one sweep
// forward and one back. The same bytecode runs on one box (one lane), on a range of a tube's items (a lane an
// item) and on the 64 children of a block of cells; nothing is allocated in it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "solver/expression/dag.h"

namespace hcsp {

/// The compiled form. Immutable; registers are the inputs, the constants, then one an instruction.
class Program {
 public:
  struct Instruction {
    Op op;
    std::uint32_t result, a, b, c;  // registers; unused operands repeat a
    int arity;
  };

  Program(const Dag& dag, const std::vector<NodeId>& roots);

  [[nodiscard]] const std::vector<Input>& inputs() const { return inputs_; }
  [[nodiscard]] std::uint32_t root(std::size_t i = 0) const { return roots_[i]; }
  [[nodiscard]] std::size_t roots() const { return roots_.size(); }
  /// The instructions that need no bound point come first: point_code() is the place of the first that needs
  /// one.
  [[nodiscard]] std::span<const Instruction> code() const { return code_; }
  [[nodiscard]] std::size_t point_code() const { return point_code_; }
  /// The register of a node that the roots need.
  [[nodiscard]] std::uint32_t register_of(NodeId node) const { return places_.at(node); }
  [[nodiscard]] std::size_t registers() const { return registers_; }
  /// The axes of the bound point that a register depends on: bit k for axis k.
  [[nodiscard]] unsigned axes(std::uint32_t reg) const { return axes_[reg]; }
  /// Values of the constants, which stand after the inputs.
  [[nodiscard]] const std::vector<Interval>& constants() const { return constants_; }
  [[nodiscard]] bool is_constant(std::uint32_t reg) const {
    return reg >= inputs_.size() && reg < inputs_.size() + constants_.size();
  }

 private:
  std::vector<Input> inputs_;
  std::vector<Interval> constants_;
  std::vector<Instruction> code_;
  std::vector<std::uint32_t> roots_;
  std::map<NodeId, std::uint32_t> places_;
  std::size_t registers_ = 0;
  std::size_t point_code_ = 0;
  std::vector<unsigned> axes_;  // by register
};

/// The registers of a program for a number of lanes. One thread at a time. PRECONDITION of forward and
/// backward: the thread rounds upward.
class Evaluation {
 public:
  static constexpr std::size_t kMaxLanes = 64;

  /// Lanes of their own boxes: every input has a value a lane.
  explicit Evaluation(const Program& program, std::size_t lanes = 1);
  /// For forward() on the 64 children of a cubic block in R^dim as lanes (set_interval.h): a register has one
  /// value where it does not depend on the bound point, one a layer where it depends on one axis, one a child
  /// otherwise.
  static Evaluation over_children(const Program& program, std::size_t dim);

  void set(std::uint32_t reg, const Interval& value, std::size_t lane = 0) {
    registers_[place(reg, lane)] = value;
  }
  [[nodiscard]] const Interval& get(std::uint32_t reg, std::size_t lane = 0) const {
    return registers_[place(reg, lane)];
  }

  /// What get() gives, lane after lane, of a register with a value a lane: an input or the result of an
  /// instruction, in an evaluation of several lanes.
  [[nodiscard]] std::span<Interval> row(std::uint32_t reg) {
    return {&registers_[places_[reg].offset], places_[reg].mask + std::size_t{1}};
  }

  /// Evaluates the first `lanes` lanes: every register is an enclosure of its node on the inputs' box, and
  /// defined() tells whether the node is defined on all of it.
  void forward(std::size_t lanes = 1) { run_forward<false>(0, program_->code().size(), lanes); }
  /// forward() in two halves: what the bound point does not enter, and the rest.
  void forward_before_point(std::size_t lanes = 1) { run_forward<false>(0, program_->point_code(), lanes); }
  void forward_from_point(std::size_t lanes = 1) {
    run_forward<false>(program_->point_code(), program_->code().size(), lanes);
  }
  /// forward_from_point() over children, of which only some matter: the others may be left as they were.
  void forward_over_children(std::uint64_t wanted) {
    wanted_ = wanted;
    forward_from_point(kMaxLanes);
  }
  /// Over children, with the bound point in each given as what its cells have in common, [hi, lo] being
  /// improper: for every register bounds K that what forward gives on any one cell of the child holds, K.lo
  /// >= lo and K.hi <= hi, possibly improper themselves (Kaucher's order; definedness is taken for granted).
  /// A relation that is certain on some cell of the child has the core [1, 1] or [1, 0]. To the last bit:
  /// forward operations are isotone.
  void core_over_children(std::uint64_t wanted) {
    wanted_ = wanted;
    run_forward<true>(program_->point_code(), program_->code().size(), kMaxLanes);
  }
  /// Those of some children where a condition on the root holds.
  template <class Condition>
  [[nodiscard]] std::uint64_t children_where(std::uint64_t children, Condition condition) const {
    std::uint64_t found = 0;
    for (; children != 0; children &= children - 1) {
      const int child = __builtin_ctzll(children);
      const bool holds = condition(get(program_->root(), static_cast<std::size_t>(child)));
      found |= static_cast<std::uint64_t>(holds) << child;
    }
    return found;
  }
  [[nodiscard]] bool defined(std::uint32_t reg, std::size_t lane = 0) const {
    return ((defined_[reg] >> lane) & 1U) != 0;
  }

  /// After forward: contracts the inputs to where root `i` can lie in `wanted`, the same for every lane.
  /// False when some lane has no such point; failed_lane() tells which.
  bool backward(const Interval& wanted, std::size_t i = 0, std::size_t lanes = 1);
  [[nodiscard]] std::size_t failed_lane() const { return failed_lane_; }

  /// The registers of a lane that the bound point does not enter. They can be taken up again after
  /// backward(), or by an evaluation of one lane or over_children().
  struct Prefix {
    std::vector<Interval> registers;
    std::vector<std::uint64_t> defined;
  };
  void save(Prefix& prefix, std::size_t lane = 0) const;
  void restore(const Prefix& prefix);

  [[nodiscard]] const Program& program() const { return *program_; }

 private:
  // Where a register's values stand: that of a lane at offset + (lane >> shift & mask).
  struct Place {
    std::uint32_t offset = 0;
    std::uint8_t shift = 0, mask = 0;
  };
  Evaluation(const Program& program, std::size_t row, const std::vector<Place>& layout);
  [[nodiscard]] static std::size_t place(const Place& at, std::size_t lane) {
    return at.offset + ((lane >> at.shift) & at.mask);
  }
  [[nodiscard]] std::size_t place(std::uint32_t reg, std::size_t lane) const {
    return place(places_[reg], lane);
  }
  template <bool kCore>
  void run_forward(std::size_t first, std::size_t last, std::size_t lanes);
  template <class Operator, bool kBoolean, bool kRelation, bool kCore>
  void forward_one(const Program::Instruction& at, std::size_t lanes);
  [[nodiscard]] static std::uint64_t by_lane(const Place& at, std::uint64_t values, std::size_t lanes);
  template <class Operator, bool kBoolean, bool kRelation>
  bool backward_one(const Program::Instruction& at);

  const Program* program_;
  std::size_t row_;  // lanes along which every register moves on by one value or stays
  std::uint64_t wanted_ = ~std::uint64_t{0};
  std::size_t failed_lane_ = 0;
  std::vector<Place> places_;  // by register
  std::vector<Interval> registers_;
  // By register, a bit a lane:
  std::vector<std::uint64_t> defined_;  // the decoration `def`
  std::vector<std::uint64_t>
      needed_;  // backward: the root takes a wanted value only if this register has one
  std::vector<std::uint64_t> narrowed_;  // backward: no longer what forward gave
};

}  // namespace hcsp
